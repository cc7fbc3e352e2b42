#include "domain/quasi_static.hpp"

#include <cmath>
#include <cstdio>

#include "domain/progress.hpp"
#include "domain/settling.hpp"

namespace clathra {

namespace {

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace

RateNumbers rate_numbers(Scene const& scene, double d50, double height, double void_ratio) {
  RateNumbers n;
  double const stress = scene.test.confining_stress, density = scene.grains.density;
  n.strain_rate =
      scene.test.strain_rate > 0 ? scene.test.strain_rate : strain_rate_of(scene.test.inertial_number, stress, density, d50);
  n.inertial_number = n.strain_rate * d50 * std::sqrt(density / stress);
  double const bulk_density = density / (1 + void_ratio), speed = std::sqrt(0.8 * scene.grains.kn / bulk_density);
  n.wave_number = bulk_density * speed * (0.5 * n.strain_rate * height) / stress;
  return n;
}

std::vector<std::string> judge_rate(Scene const& scene, RateNumbers const& n) {
  std::vector<std::string> warnings;
  if (n.inertial_number > inertial_limit && !scene.run.force) {
    throw Refused("inertial number I = " + short_number(n.inertial_number) + " is above " + short_number(inertial_limit) +
                  ": the loading is not quasi-static (use run.force = true to run it all the same)");
  }
  if (n.inertial_number > inertial_warning)
    warnings.push_back("inertial number I = " + short_number(n.inertial_number) +
                       " is above 1e-3: rate effects of several percent");
  if (n.wave_number > wave_limit) {
    warnings.push_back("wave number W = " + short_number(n.wave_number) +
                       " is above 0.5: this run is not quasi-static, lower the inertial number");
  } else if (n.wave_number > wave_warning) {
    warnings.push_back("wave number W = " + short_number(n.wave_number) + " is above 0.2: stress varies along the specimen");
  }
  double const stiffness = scene.grains.kn / scene.test.confining_stress;
  if (stiffness < 50) warnings.push_back("kn / sigma_3 = " + short_number(stiffness) + " is below 50: grains overlap noticeably");
  return warnings;
}

}  // namespace clathra
