#pragma once
/// What the settings of a scene will do to its peak strength, as far as that was measured on other specimens.
#include <optional>
#include <span>
#include <string>

#include "domain/biaxial/quasi_static.hpp"
#include "domain/scene/scene.hpp"

namespace clathra {

/// An error as a part of the number, with the half of its 95 % interval.
struct MeasuredError {
  double error = 0, half_width = 0;
};

/// A measured effect at an inertial number: of the rate itself, or of another setting beside the usual one at that rate.
struct RateEffect {
  double inertial_number = 0;
  MeasuredError sand, bonded;  ///< without hydrate, and with a saturation of 55 %
};

/// A measured effect that does not depend on the rate.
struct SettingEffect {
  MeasuredError sand, bonded;
};

/// The rows of the table, by rising rate.
std::span<RateEffect const> rate_effects();
std::span<RateEffect const> inertia_effects();  ///< of moments of inertia times 3
SettingEffect mixed_precision_effect();

struct ExpectedError {
  std::optional<MeasuredError> peak_q;
  std::string range;  ///< where that was measured, or why there is no number
};

/// The error of the peak of q against slow shear in double precision with true moments of inertia: that of the inertial number,
/// between the rows of the table (at equal I it does not grow with W up to 5,000 discs), and those of other settings, their
/// intervals added as those of independent numbers. Moments of inertia between once and three times their own count as three
/// times. Of saturations between 0 and 55 % the larger error of both. Nothing for scenes out of the measured range: where any key
/// of the model is another than in the tests of the table ("grains.friction"), or the rate is faster.
ExpectedError expected_error(Scene const& scene, RateNumbers const& rate);

}  // namespace clathra
