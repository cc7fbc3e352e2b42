#pragma once
/// Strength of a hydrate bond: tension, compression and the F_n - F_s - M envelope (Jiang et al. 2017, Eqs. 9 to 15).
#include <Kokkos_Core.hpp>
#include <cmath>

#include "kernels/break_mode.hpp"
#include "kernels/elementary.hpp"
#include "kernels/lane.hpp"

namespace clathra {

/// Micro-bond strength of the hydrate: three times the strength of a macroscopic sample (Eq. 12).
template <class R>
struct BondStrengthLawOf {
  R tensile_stress = R(1.421e7);      ///< 3 q_max,t [Pa]
  R compressive_stress = R(2.571e7);  ///< 3 q_max,c [Pa]
  R moment_length = 0;                ///< L_r = moment_length + moment_width_ratio * B [m]: the length scale that Eq. 9b lacks
  R moment_width_ratio = R(1.0 / 14);
  // How a bond between grains is read off the bonds between rods that were tested, 0.6 mm thick and more (Eqs. 10, 11).
  R rod_scale = 1;            ///< thickness of the bond between rods over that between grains
  R rod_share = 1;            ///< what counts of the addends of Eq. 11: rod_share + rod_share_per_width B
  R rod_share_per_width = 0;  ///< [1/m]
  R least_rod_thickness = 0;  ///< [m]; thinner ones are taken for this thick
  // A bonded contact is never weaker than an unbonded one: R_s >= mu F_n, R_r >= (B_c / 6) F_n with B_c the width of the grain
  // contact. 0 and 0: as printed, without.
  R floor_friction = 0;      ///< mu
  R floor_shape_factor = 0;  ///< beta: B_c = beta times the common radius
};
using BondStrengthLaw = BondStrengthLawOf<Real>;

/// The law of bonds that have a share of its strength: of all addends of R_t and R_c (Eq. 11), and so of R_s and R_r, which are
/// proportional to them (Eq. 9).
inline BondStrengthLaw part_of(BondStrengthLaw law, Real share) {
  law.tensile_stress *= share;
  law.compressive_stress *= share;
  law.rod_share *= share;
  law.rod_share_per_width *= share;
  return law;
}

/// The same law in the numbers of a kernel.
template <class R>
KOKKOS_INLINE_FUNCTION BondStrengthLawOf<R> cast(BondStrengthLaw const& law) {
  return {R(law.tensile_stress), R(law.compressive_stress), R(law.moment_length),       R(law.moment_width_ratio),
          R(law.rod_scale),      R(law.rod_share),          R(law.rod_share_per_width), R(law.least_rod_thickness),
          R(law.floor_friction), R(law.floor_shape_factor)};
}

/// Thickness [m] of the bond between rods that stands for one of thickness h_cr [m] between grains: Eqs. 10 and 11 are functions
/// of it.
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION L rod_thickness(BondStrengthLawOf<R> const& law, L const& thickness) {
  return lane_max(L(law.rod_scale) * thickness, L(law.least_rod_thickness));
}

/// What Eqs. 11a and 11b add to the strength of the hydrate [N/m] at the thickness h [m] of a bond between rods.
template <class L>
KOKKOS_FORCEINLINE_FUNCTION L tension_addend(L const& thickness) {
  return constant<L>(2.67e5) * thickness - constant<L>(160.2);
}
template <class L>
KOKKOS_FORCEINLINE_FUNCTION L compression_addend(L const& thickness) {
  return -(constant<L>(4.18e6) * thickness - constant<L>(2508.0));
}
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION L share_of_addends(BondStrengthLawOf<R> const& law, L const& width) {
  return law.rod_share + law.rod_share_per_width * width;
}

/// R_t = 3 B q_max,t + 2.67e5 (h - 0.6 mm) [N/m] (Eqs. 11a, 12a; with the printed stress this is Eq. 15a). Can be <= 0: such a
/// bond is not formed (see domain/generation/bonding.hpp).
/// @param width  bond width B [m];  @param thickness  h [m], rod_thickness(): as printed h_cr
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION L tensile_strength(BondStrengthLawOf<R> const& law, L const& width, L const& thickness) {
  return law.tensile_stress * width + share_of_addends(law, width) * tension_addend(thickness);
}

/// R_c = 3 B q_max,c - 4.18e6 (h - 0.6 mm) [N/m] (Eqs. 11b, 12b; Eq. 15b).
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION L compressive_strength(BondStrengthLawOf<R> const& law, L const& width, L const& thickness) {
  return law.compressive_stress * width + share_of_addends(law, width) * compression_addend(thickness);
}

/// L_r [m], the length that turns Eq. 9b into a moment.
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION L moment_length(BondStrengthLawOf<R> const& law, L const& width) {
  return law.moment_length + law.moment_width_ratio * width;
}

/// Slopes K_s and K_r of the envelope against the thickness of a bond between rods [m] (Eqs. 10b, 10d), dimensionless. Above 6.7
/// and 5.7 mm the printed lines are negative: no strength, so 0. (The envelope is compared in squares and would take them for
/// strength.)
template <class L>
KOKKOS_FORCEINLINE_FUNCTION L shear_slope(L const& thickness) {
  return lane_max(L(0), constant<L>(0.41) - constant<L>(61.07) * thickness);
}
template <class L>
KOKKOS_FORCEINLINE_FUNCTION L rolling_slope(L const& thickness) {
  return lane_max(L(0), constant<L>(0.83) - constant<L>(146.36) * thickness);
}

/// f_s and f_r (Eqs. 10a, 10c), dimensionless; smallest (1.16 and 1.13) at a thickness of 1.15 mm.
KOKKOS_INLINE_FUNCTION Real shape_of_shear(Real thickness) {
  Real const z = 1000 * thickness - 1.15;
  return 2.05 - 0.89 * exponential(-z * z);
}
KOKKOS_INLINE_FUNCTION Real shape_of_rolling(Real thickness) {
  Real const z = 1000 * thickness - 1.15;
  return 2.05 - 0.92 * exponential(-z * z);
}

/// x (-ln x)^0.59, the shape of Eq. 9 with x = (F_n + R_t) / (R_c + R_t); 0 at and outside the closed ends 0 and 1.
KOKKOS_INLINE_FUNCTION Real envelope_shape(Real x) {
  if (!(x > 0) || !(x < 1)) return 0;
  return x * power(-natural_log(x), 0.59);
}

/// A lower bound of scale * envelope_shape(part / scale): its chords, since the shape is concave. It needs no logarithm, and is
/// the test that spares nearly every bond the exact envelope.
/// @param part  F_n + R_t [N/m], 0 < part < scale;  @param scale  R_c + R_t [N/m]
template <class L>
KOKKOS_FORCEINLINE_FUNCTION L envelope_lower_bound(L const& part, L const& scale) {
  // Minima in pairs: a chain of them would be the longest dependency of the contact kernel.
  L const low = lane_min(constant<L>(1.9931) * part, constant<L>(1.264849) * part + constant<L>(0.029130) * scale);
  L const rising = lane_min(constant<L>(0.706626) * part + constant<L>(0.112860) * scale,
                            constant<L>(0.173959) * part + constant<L>(0.299290) * scale);
  L const falling = lane_min(constant<L>(0.624130) * scale - constant<L>(0.367461) * part,
                             constant<L>(1.144500) * scale - constant<L>(1.017960) * part);
  return lane_min(lane_min(low, rising), lane_min(falling, constant<L>(2.826300) * (scale - part)));
}

/// The exact strength envelope of one bond under its bond forces (Eq. 9, combined as an ellipse at fixed F_n:
/// (F_s/R_s)^2 + (M/R_r)^2 >= 1 breaks; written without division, so that R_s -> 0 at the closed ends is no trap).
struct BondStrength {
  Real tension;                 ///< R_t [N/m]
  Real compression;             ///< R_c [N/m]
  Real shear_slope;             ///< f_s K_s
  Real moment_slope;            ///< f_r K_r L_r [m]
  Real least_shear_slope = 0;   ///< R_s >= this times F_n
  Real least_moment_slope = 0;  ///< R_r >= this times F_n [m]

  /// R_s [N/m] and R_r [N m/m] at the normal bond force F_n [N/m], compression positive; 0 outside -R_t < F_n < R_c.
  KOKKOS_INLINE_FUNCTION Real shear(Real normal) const {
    return lane_max(shear_slope * shape(normal), least_shear_slope * normal);
  }
  KOKKOS_INLINE_FUNCTION Real rolling(Real normal) const {
    return lane_max(moment_slope * shape(normal), least_moment_slope * normal);
  }

  /// Tension and compression are tested first: outside their window the envelope would take the log of a negative number.
  KOKKOS_INLINE_FUNCTION BreakMode test(Real normal, Real shear_force, Real moment) const {
    if (normal <= -tension) return BreakMode::tension;
    if (normal >= compression) return BreakMode::compression;
    Real const size = shape(normal);
    Real of_shear = shear_force * moment_slope, of_moment = moment * shear_slope;
    Real const limit = shear_slope * moment_slope * size;
    if (of_shear * of_shear + of_moment * of_moment < limit * limit) return BreakMode::none;
    if (least_shear_slope > 0 || least_moment_slope > 0) {
      Real const shear_strength = shear(normal), moment_strength = rolling(normal);
      of_shear = shear_force * moment_strength;
      of_moment = moment * shear_strength;
      Real const of_both = shear_strength * moment_strength;
      if (of_shear * of_shear + of_moment * of_moment < of_both * of_both) return BreakMode::none;
    }
    return lane_abs(of_shear) >= lane_abs(of_moment) ? BreakMode::shear : BreakMode::rolling;
  }

  /// How far the forces that broke the bond lie beyond its strength, >= 1: -F_n / R_t in tension, F_n / R_c in compression, else
  /// sqrt((F_s / R_s)^2 + (M / R_r)^2) at F_n; no_strength for a bond that has no strength there.
  KOKKOS_INLINE_FUNCTION Real utilisation(BreakMode mode, Real normal, Real shear_force, Real moment) const {
    if (mode == BreakMode::tension) return beyond(-normal, tension);
    if (mode == BreakMode::compression) return beyond(normal, compression);
    Real const of_shear = beyond(shear_force, shear(normal)), of_moment = beyond(moment, rolling(normal));
    if (lane_max(of_shear, of_moment) >= no_strength) return no_strength;
    return lane_max(Real(1), std::sqrt(of_shear * of_shear + of_moment * of_moment));  // 1 less a rounding is 1
  }
  static constexpr Real no_strength = 1e300;

 private:
  KOKKOS_INLINE_FUNCTION static Real beyond(Real load, Real strength) {
    return strength > 0 ? lane_abs(load) / strength : no_strength;
  }
  KOKKOS_INLINE_FUNCTION Real shape(Real normal) const {
    Real const scale = compression + tension;
    return scale > 0 ? scale * envelope_shape((normal + tension) / scale) : 0;
  }
};

/// The exact envelope of a bond of width B and thickness h_cr [m]. @param common_radius  2 r1 r2 / (r1 + r2) [m], for the floors
KOKKOS_INLINE_FUNCTION BondStrength bond_strength(BondStrengthLaw const& law, Real width, Real thickness,
                                                  Real common_radius = 0) {
  Real const rod = rod_thickness(law, thickness);
  BondStrength strength;
  strength.tension = tensile_strength(law, width, rod);
  strength.compression = compressive_strength(law, width, rod);
  strength.shear_slope = shape_of_shear(rod) * shear_slope(rod);
  strength.moment_slope = shape_of_rolling(rod) * rolling_slope(rod) * moment_length(law, width);
  strength.least_shear_slope = law.floor_friction;
  strength.least_moment_slope = law.floor_shape_factor * common_radius / 6;
  return strength;
}

}  // namespace clathra
