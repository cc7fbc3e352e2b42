#pragma once
/// What saturation, temperature, pore pressure and density of hydrate mean for a bond (Jiang et al. 2017, Eqs. 3, 13, 14, 18).
#include <string>

#include "domain/scene/scene.hpp"

namespace clathra {

template <class R>
struct BondLawOf;
using BondLaw = BondLawOf<double>;

/// Strength and stiffness of solid hydrate.
struct HydrateStrength {
  double compression;  ///< q_max,c [Pa]
  double tension;      ///< q_max,t [Pa]
  double modulus;      ///< E_m [Pa]
};

inline constexpr double atmospheric_pressure = 1.01e5;  ///< p_a of Eqs. 13 and 18 [Pa]
inline constexpr double water_density = 1000;           ///< rho_w at 4 deg C [kg/m^3]

/// Eqs. 13a, 13b and 18. Values may be <= 0 far from the calibrated range (see hydrate_problem()).
/// @param temperature [deg C];  @param pore_pressure sigma_w [Pa];  @param density rho [kg/m^3]
HydrateStrength hydrate_strength(double temperature, double pore_pressure, double density);

/// h_max / d50 at a saturation 0..1 (Eq. 3, half-open intervals as printed: 0 up to and including 20 %, 0.1 above 70 %).
/// @throws std::invalid_argument outside [0, 1] (a saturation in percent)
double critical_thickness_ratio(double saturation);

/// What Eq. 3 does with a saturation outside its range (above 20 % up to 70 %), in words; empty within it and without hydrate.
std::string saturation_warning(double saturation);

/// Why hydrate of this state dissociates (phase_boundary.hpp), with the boundary at its pressure and at its temperature; or an
/// empty string.
std::string stability_problem(HydrateScene const& hydrate);

/// Why this state cannot carry bonds (strength or modulus not positive), or an empty string.
std::string hydrate_problem(HydrateScene const& hydrate);

/// What of this state Eqs. 13 and 18 were not fitted to, in words; empty where nothing is. The data that are known to us begin at
/// -30 degC and have 1.5 to 8 MPa and 720 to 840 kg/m^3; Jiang et al. (2017) take 900 kg/m^3, which counts as inside. Where
/// they end on the warm side is not known; there stability_problem() sees to it that hydrate is stable.
std::string fit_warning(HydrateScene const& hydrate);

/// True where a scene can have bonds at all: there is hydrate, and a law for it. Nothing of bonds is allocated or launched
/// elsewhere.
bool has_bonds(Scene const& scene);

/// The bond law of a scene whose hydrate has the critical thickness h_max [m] between grains of the median diameter d50 [m]. 3
/// q_t and 3 q_c come from Eq. 13 (`conditions`) or are 1.421e7 and 2.571e7 Pa (`printed`); E_m is that of Eq. 18 with both.
BondLaw make_bond_law(Scene const& scene, double d50, double critical_thickness);

/// Every number of one bond, for `clathra bond` and for checks by hand. SI.
struct BondCard {
  bool bonded;  ///< 0 < h_max, gap < h_max and R_t > 0
  double h_max, common_radius;
  double thickness;  ///< h_cr: the gap, 0 for an overlap; t_0 for the constant-thickness law
  double B, h0, area;
  double q_c, q_t, E_m;  ///< of the hydrate's state by Eqs. 13 and 18, whichever coefficients the strengths below use
  double R_t, R_c, k_mh, k_bn, k_bs, k_bm, f_s, K_s, f_r, K_r;
  double R_s;             ///< [N/m] at the given normal force, 0 outside -R_t < F_n < R_c
  double R_r_per_length;  ///< R_r / L_r [N/m]
  double moment_length;   ///< L_r [m]
};

/// h_max is Eq. 3 times d50, or bond.critical_thickness where that is given.
/// @param gap  distance of the surfaces [m]; an overlap (negative) counts as 0;  @param normal_force  bond F_n [N/m]
BondCard evaluate_bond(Scene const& scene, double d50, double r1, double r2, double gap, double normal_force);

}  // namespace clathra
