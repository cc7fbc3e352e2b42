#include "domain/biaxial/quasi_static.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "domain/generation/equilibration.hpp"
#include "domain/scene/hydrate.hpp"
#include "domain/scene/scene_laws.hpp"
#include "domain/scene/short_number.hpp"
#include "domain/scene/stage.hpp"

namespace clathra {

namespace {

/// W follows the void ratio, which is known only when the specimen is consolidated: with these digits the forecast says the same.
constexpr int digits_of_wave = 2;

/// So does I where W bounds it.
int digits_of_rate(RateNumbers const& n) { return n.share < 1 ? digits_of_wave : 3; }

/// A rate that was asked for as the limit itself may come back a bit above it.
bool is_too_fast(RateNumbers const& n) { return n.inertial_number > (1 + 1e-9) * inertial_limit; }
bool has_rate_effects(Scene const& scene, RateNumbers const& n) {
  return n.inertial_number > (1 + 1e-9) * inertial_warning(scene);
}

std::string stiffness_text(Scene const& scene, double sigma1) {
  return "kn / sigma_1 = " + short_number(scene.grains.normal_stiffness / sigma1) + " with a sigma_1 of " +
         short_number(sigma1 * 1e-6) + " MPa";
}

}  // namespace

double inertial_warning(Scene const& scene) { return has_bonds(scene) ? inertial_warning_of_bonds : inertial_warning_of_sand; }

bool is_quasi_static(Scene const& scene, RateNumbers const& n) {
  return !has_rate_effects(scene, n) && n.platen_wave_stress < wave_limit;
}

double expected_sigma1(Scene const& scene) {
  struct Envelope {
    double saturation, slope, at_zero;  // sigma_1 = slope sigma_3 + at_zero [Pa]
  };
  static constexpr Envelope measured[] = {{0, 3.3, 0}, {0.26, 2.33, 2.41e6}, {0.41, 2.07, 6.71e6}, {0.55, 2.22, 8.44e6}};
  double const saturation = has_bonds(scene) ? std::min(scene.hydrate.saturation, measured[3].saturation) : 0;
  int k = 1;
  while (measured[k].saturation < saturation) ++k;
  Envelope const &a = measured[k - 1], &b = measured[k];
  double const part = (saturation - a.saturation) / (b.saturation - a.saturation), stress = scene.test.confining_stress;
  double largest = (1 - part) * (a.slope * stress + a.at_zero) + part * (b.slope * stress + b.at_zero);
  for (LoadingStage const& stage : stages_of(scene)) largest = std::max({largest, stage.vertical.stress, stage.lateral.stress});
  return largest;
}

std::string collapse(double void_ratio, double deep_share) {
  if (!(void_ratio >= least_void_ratio))
    return "the void ratio has fallen to " + short_number(void_ratio) + ", below " + short_number(least_void_ratio);
  if (deep_share > most_deep)
    return short_number(100 * deep_share) + " % of the contacts overlap by more than a tenth of the smaller radius";
  return {};
}

std::string stiffness_warning_at(Scene const& scene, double sigma1) {
  bool const was_said = scene.grains.normal_stiffness < stiffness_warning * expected_sigma1(scene);
  if (was_said || !(sigma1 > 0) || scene.grains.normal_stiffness >= stiffness_warning * sigma1) return {};
  return stiffness_text(scene, sigma1) + " was below " + short_number(stiffness_warning) + ": grains overlapped noticeably";
}

double platen_wave_stress(Scene const& scene, double strain_rate, double height, double void_ratio, double density) {
  double const bulk_density = density / (1 + void_ratio), speed = std::sqrt(packing_modulus(grain_law(scene)) / bulk_density);
  return bulk_density * speed * (0.5 * strain_rate * height) / scene.test.confining_stress;
}

RateNumbers rate_numbers(Scene const& scene, double d50, double height, double void_ratio, double added_mass) {
  RateNumbers n;
  double const stress = scene.test.confining_stress, density = scene.grains.density * (1 + added_mass);
  n.strain_rate =
      scene.test.strain_rate > 0 ? scene.test.strain_rate : strain_rate_of(scene.test.inertial_number, stress, density, d50);
  n.platen_wave_stress = platen_wave_stress(scene, n.strain_rate, height, void_ratio, density);
  if (scene.test.strain_rate == 0 && scene.test.max_platen_wave_stress > 0 &&
      n.platen_wave_stress > scene.test.max_platen_wave_stress) {
    n.share = scene.test.max_platen_wave_stress / n.platen_wave_stress;
    n.strain_rate *= n.share;
    n.platen_wave_stress = scene.test.max_platen_wave_stress;
  }
  n.inertial_number = n.strain_rate * d50 * std::sqrt(density / stress);
  return n;
}

RateNumbers rate_numbers(Scene const& scene, LoadingStage const& stage, double d50, double height, double void_ratio,
                         double added_mass) {
  Scene by = scene;
  SideScene const& driven = stage.vertical.has_rate() ? stage.vertical : stage.lateral;
  if (driven.has_rate()) {
    by.test.inertial_number = std::abs(driven.inertial_number);
    by.test.strain_rate = std::abs(driven.strain_rate);
  }
  return rate_numbers(by, d50, height, void_ratio, added_mass);
}

std::vector<std::string> rate_refusals(Scene const& scene, RateNumbers const& n) {
  std::vector<std::string> refusals;
  if (is_too_fast(n))
    refusals.push_back("inertial number I = " + short_number(n.inertial_number, digits_of_rate(n)) + " is above " +
                       short_number(inertial_limit) + ": the loading is not quasi-static");
  double const sigma1 = expected_sigma1(scene);
  if (scene.grains.normal_stiffness < stiffness_limit * sigma1)
    refusals.push_back(stiffness_text(scene, sigma1) + ", as is to be expected, is below " + short_number(stiffness_limit) +
                       ": grains overlap by a fifth of their diameter, which no contact law here describes");
  if (scene.run.precision == Precision::mixed && !mixed_precision_resolves(scene))
    refusals.push_back("kn / sigma_3 = " + short_number(scene.grains.normal_stiffness / scene.test.confining_stress) +
                       " is above " + short_number(stiffness_resolved) +
                       ": mixed precision does not resolve such small overlaps; take run.precision = \"double\"");
  return refusals;
}

std::vector<std::string> rate_warnings(Scene const& scene, RateNumbers const& n) {
  std::vector<std::string> warnings;
  if (has_rate_effects(scene, n) && !is_too_fast(n))
    warnings.push_back("inertial number I = " + short_number(n.inertial_number, digits_of_rate(n)) + " is above " +
                       short_number(inertial_warning(scene)) + ": the peak of q is likely to be more than 2 % too high");
  if (n.platen_wave_stress > wave_limit) {
    warnings.push_back("platen wave stress W = " + short_number(n.platen_wave_stress, digits_of_wave) +
                       " is above 0.5: this run is not quasi-static, lower the inertial number");
  } else if (n.platen_wave_stress > wave_warning) {
    warnings.push_back("platen wave stress W = " + short_number(n.platen_wave_stress, digits_of_wave) + " is above " +
                       short_number(wave_warning) + ": stress varies along the specimen");
  }
  double const sigma1 = expected_sigma1(scene);
  if (double const stiffness = scene.grains.normal_stiffness / sigma1;
      stiffness < stiffness_warning && stiffness >= stiffness_limit)
    warnings.push_back(stiffness_text(scene, sigma1) + ", as is to be expected, is below " + short_number(stiffness_warning) +
                       ": grains overlap noticeably");
  return warnings;
}

std::vector<std::string> check_rate(Scene const& scene, RateNumbers const& n) {
  std::vector<std::string> warnings = rate_warnings(scene, n);
  std::string all;
  for (std::string const& refusal : rate_refusals(scene, n)) {
    warnings.push_back(guard_ignored + refusal);
    all += (all.empty() ? "" : "; ") + refusal;
  }
  if (!all.empty() && !scene.run.ignore_guards) throw Refused(all + ignore_hint);
  return warnings;
}

}  // namespace clathra
