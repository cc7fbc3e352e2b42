#pragma once
/// Whether a loading deserves to be called quasi-static: its rate, and how stiff the grains are under its stress.
///
/// Users buy speed with the strain rate before anything else, so the price is computed and said before the run, refused where
/// nobody could want it, and looked at again while the specimen shears (shear_watch.hpp).
#include <string>
#include <vector>

#include "domain/scene/scene.hpp"

namespace clathra {

/// The two numbers that matter: inertia of the grains and inertia of the specimen.
struct RateNumbers {
  double strain_rate = 0;      ///< [1/s]
  double inertial_number = 0;  ///< I = rate d50 sqrt(rho / sigma_3)
  double wave_number = 0;      ///< W = rho_bulk c v_platen / sigma_3, the stress of the wave that a platen sends out
  double share = 1;            ///< of the rate of test.inertial_number, which test.wave_number has lowered to this part
};

inline constexpr double inertial_warning = 1e-3, inertial_limit = 1e-2, wave_limit = 0.5;
/// Of W: up to there the walls measure 1 % more than the contacts inside at most, of 500 discs 1.4 % (docs/accuracy.md).
inline constexpr double wave_warning = 0.3;
inline constexpr double stiffness_warning = 50, stiffness_limit = 10;  ///< of k_n / sigma_3
inline bool mixed_precision_resolves(Scene const& scene) {
  return mixed_precision_resolves(scene.grains.kn, scene.test.confining_stress);
}

/// The stress of the wave that either platen sends out when they compress a specimen at a rate, over the confining stress.
/// @param strain_rate [1/s];  @param height [m], compressed by two platens that each do half;  @param density [kg/m^3] of grains
double wave_number(Scene const& scene, double strain_rate, double height, double void_ratio, double density);

/// The rate of a test and what it comes to: that of test.strain_rate, or of test.inertial_number as far as test.wave_number lets
/// it. @param height [m];  @param d50 [m];  @param added_mass  over the mass of the grains
RateNumbers rate_numbers(Scene const& scene, double d50, double height, double void_ratio, double added_mass = 0);

/// True where a run may be called quasi-static: I below 1e-3 and W below 0.5.
inline bool is_quasi_static(RateNumbers const& n) { return n.inertial_number < inertial_warning && n.wave_number < wave_limit; }

/// Why a test is not to be run, whether the scene forces it or not: I above 1e-2, k_n / sigma_3 below 10, or above
/// 1e4 in mixed precision.
std::vector<std::string> rate_refusals(Scene const& scene, RateNumbers const& numbers);
/// What is near those limits, in words.
std::vector<std::string> rate_warnings(Scene const& scene, RateNumbers const& numbers);
/// The warnings, and the refusals as warnings where the scene forces the test; @throws Refused where it does not.
std::vector<std::string> check_rate(Scene const& scene, RateNumbers const& numbers);

}  // namespace clathra
