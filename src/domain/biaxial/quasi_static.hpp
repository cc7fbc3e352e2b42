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
  double strain_rate = 0;         ///< [1/s]
  double inertial_number = 0;     ///< I = rate d50 sqrt(rho / sigma_3)
  double platen_wave_stress = 0;  ///< W = rho_bulk c v_platen / sigma_3, the stress of the wave that a platen sends out
  double share = 1;  ///< of the rate of test.inertial_number, which test.max_platen_wave_stress has lowered to this part
};

/// Of I: above it peaks of q are more than 2 % too high as a rule (perf/guards). Friction follows the rate sooner than bonds do.
inline constexpr double inertial_warning_of_sand = 3.5e-4, inertial_warning_of_bonds = 1e-3;
double inertial_warning(Scene const& scene);
inline constexpr double inertial_limit = 1e-2, wave_limit = 0.5;
/// Of W: up to there the walls measure 1 % more than the contacts inside at most, of 500 discs 1.4 %
/// (perf/reports/0.1/accuracy.md).
inline constexpr double wave_warning = 0.3;
/// Of k_n / sigma_1: grains overlap by 7 and 20 % of their diameter on the average of those that carry the load.
inline constexpr double stiffness_warning = 15, stiffness_limit = 5;
inline constexpr double least_void_ratio = 0.05;  ///< of a specimen that still consists of grains
/// Of its contacts, overlapping by more than a tenth of the smaller radius: most of them. bond.preset "literal" has 0.46 at 1 MPa
/// and passes it at 3 MPa.
inline constexpr double most_deep = 0.5;
inline bool mixed_precision_resolves(Scene const& scene) {
  return mixed_precision_resolves(scene.grains.normal_stiffness, scene.test.confining_stress);
}

/// The stress of the wave that either platen sends out when they compress a specimen at a rate, over the confining stress.
/// @param strain_rate [1/s];  @param height [m], compressed by two platens that each do half;  @param density [kg/m^3] of grains
double platen_wave_stress(Scene const& scene, double strain_rate, double height, double void_ratio, double density);

/// The largest sigma_1 that a test of this saturation and confining stress is expected to reach [Pa]: on the envelopes that
/// perf/reports/0.1/examples.md measures, of sand without its cohesion, linear between their saturations; and no less than what a
/// stage puts on.
double expected_sigma1(Scene const& scene);

/// Why a specimen is none any more: its void ratio is below 0.05, or most of its contacts are deep; else empty.
std::string collapse(double void_ratio, double deep_share);

/// The rate of a test and what it comes to: that of test.strain_rate, or of test.inertial_number as far as
/// test.max_platen_wave_stress lets it. @param height [m];  @param d50 [m];  @param added_mass  over the mass of the grains
RateNumbers rate_numbers(Scene const& scene, double d50, double height, double void_ratio, double added_mass = 0);

/// The same of a stage, whose rate it is where it states one. @param scene  of the test
RateNumbers rate_numbers(Scene const& scene, LoadingStage const& stage, double d50, double height, double void_ratio,
                         double added_mass = 0);

/// True where a run may be called quasi-static: I up to inertial_warning() and W below 0.5.
bool is_quasi_static(Scene const& scene, RateNumbers const& n);

/// Why a test is not to be run, whether the scene forces it or not: I above 1e-2, k_n over the expected sigma_1 below 5,
/// k_n / sigma_3 above 1e4 in mixed precision.
std::vector<std::string> rate_refusals(Scene const& scene, RateNumbers const& numbers);
/// What is near those limits, in words.
std::vector<std::string> rate_warnings(Scene const& scene, RateNumbers const& numbers);
/// What the largest sigma_1 that was seen [Pa] means for the stiffness of the grains, where the expected one did not say it.
std::string stiffness_warning_at(Scene const& scene, double sigma1);
/// The warnings, and the refusals as warnings where the scene forces the test; @throws Refused where it does not.
std::vector<std::string> check_rate(Scene const& scene, RateNumbers const& numbers);

}  // namespace clathra
