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

/// A measured effect of the loading rate: 2,000 discs at an inertial number and the W that they have there.
struct RateEffect {
  double inertial_number = 0, wave_number = 0;
  MeasuredError sand, bonded;  ///< without hydrate, and with a saturation of 55 %
};

/// A measured effect of another setting.
struct SettingEffect {
  double value = 0;
  MeasuredError sand, bonded;
};

/// The rows of the table, by rising rate and value.
std::span<RateEffect const> rate_effects();
std::span<SettingEffect const> mixed_precision_effects();  ///< one row

struct ExpectedError {
  std::optional<MeasuredError> peak_q;
  std::string range;  ///< where that was measured, or why there is no number
};

/// The error of the peak of q against slow shear in double precision: that of the rate, taken at the larger of I and of the rate
/// at which the measured specimens have the scene's W, between the rows of the table; and those of other settings, their
/// intervals added as those of independent numbers. Of saturations between 0 and 55 % the larger error of both. Nothing for
/// scenes out of the measured range: another law, stiffness, damping or confining stress, faster rates, settings that are not in
/// the table.
ExpectedError expected_error(Scene const& scene, RateNumbers const& rate);

}  // namespace clathra
