#include "domain/biaxial/quasi_static.hpp"

#include <cmath>
#include <cstdio>

#include "domain/generation/equilibration.hpp"
#include "domain/scene/scene_laws.hpp"
#include "domain/scene/stage.hpp"

namespace clathra {

namespace {

std::string short_number(double value, int digits = 3) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

/// W follows the void ratio, which is known only when the specimen is consolidated: with these digits the forecast says the same.
constexpr int digits_of_wave = 2;

/// So does I where W bounds it.
int digits_of_rate(RateNumbers const& n) { return n.share < 1 ? digits_of_wave : 3; }

/// A rate that was asked for as the limit itself may come back a bit above it.
bool is_too_fast(RateNumbers const& n) { return n.inertial_number > (1 + 1e-9) * inertial_limit; }

double stiffness_number(Scene const& scene) { return scene.grains.kn / scene.test.confining_stress; }

}  // namespace

double wave_number(Scene const& scene, double strain_rate, double height, double void_ratio, double density) {
  double const bulk_density = density / (1 + void_ratio), speed = std::sqrt(packing_modulus(grain_law(scene)) / bulk_density);
  return bulk_density * speed * (0.5 * strain_rate * height) / scene.test.confining_stress;
}

RateNumbers rate_numbers(Scene const& scene, double d50, double height, double void_ratio, double added_mass) {
  RateNumbers n;
  double const stress = scene.test.confining_stress, density = scene.grains.density * (1 + added_mass);
  n.strain_rate =
      scene.test.strain_rate > 0 ? scene.test.strain_rate : strain_rate_of(scene.test.inertial_number, stress, density, d50);
  n.wave_number = wave_number(scene, n.strain_rate, height, void_ratio, density);
  if (scene.test.strain_rate == 0 && scene.test.wave_number > 0 && n.wave_number > scene.test.wave_number) {
    n.share = scene.test.wave_number / n.wave_number;
    n.strain_rate *= n.share;
    n.wave_number = scene.test.wave_number;
  }
  n.inertial_number = n.strain_rate * d50 * std::sqrt(density / stress);
  return n;
}

std::vector<std::string> rate_refusals(Scene const& scene, RateNumbers const& n) {
  std::vector<std::string> refusals;
  if (is_too_fast(n))
    refusals.push_back("inertial number I = " + short_number(n.inertial_number, digits_of_rate(n)) + " is above " +
                       short_number(inertial_limit) + ": the loading is not quasi-static");
  if (double const stiffness = stiffness_number(scene); stiffness < stiffness_limit)
    refusals.push_back("kn / sigma_3 = " + short_number(stiffness) + " is below " + short_number(stiffness_limit) +
                       ": grains overlap by more than a tenth of their diameter, which no contact law here describes");
  if (scene.run.precision == Precision::mixed && !mixed_precision_resolves(scene))
    refusals.push_back("kn / sigma_3 = " + short_number(stiffness_number(scene)) + " is above " +
                       short_number(stiffness_resolved) +
                       ": mixed precision does not resolve such small overlaps; take run.precision = \"double\"");
  return refusals;
}

std::vector<std::string> rate_warnings(Scene const& scene, RateNumbers const& n) {
  std::vector<std::string> warnings;
  if (n.inertial_number > inertial_warning && !is_too_fast(n))
    warnings.push_back("inertial number I = " + short_number(n.inertial_number, digits_of_rate(n)) +
                       " is above 1e-3: rate effects of several percent");
  if (n.wave_number > wave_limit) {
    warnings.push_back("wave number W = " + short_number(n.wave_number, digits_of_wave) +
                       " is above 0.5: this run is not quasi-static, lower the inertial number");
  } else if (n.wave_number > wave_warning) {
    warnings.push_back("wave number W = " + short_number(n.wave_number, digits_of_wave) + " is above " +
                       short_number(wave_warning) + ": stress varies along the specimen");
  }
  if (double const stiffness = stiffness_number(scene); stiffness < stiffness_warning && stiffness >= stiffness_limit)
    warnings.push_back("kn / sigma_3 = " + short_number(stiffness) + " is below " + short_number(stiffness_warning) +
                       ": grains overlap noticeably");
  return warnings;
}

std::vector<std::string> check_rate(Scene const& scene, RateNumbers const& n) {
  std::vector<std::string> warnings = rate_warnings(scene, n);
  std::string all;
  for (std::string const& refusal : rate_refusals(scene, n)) {
    warnings.push_back("forced: " + refusal);
    all += (all.empty() ? "" : "; ") + refusal;
  }
  if (!all.empty() && !scene.run.force) throw Refused(all + " (use run.force = true to run it all the same)");
  return warnings;
}

}  // namespace clathra
