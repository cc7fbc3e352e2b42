#pragma once
/// What numbers in SI units are multiplied by to be shown.
#include <numbers>

namespace clathra {

inline constexpr double percent = 100, milli = 1e3, mega = 1e-6, degrees = 180 / std::numbers::pi;

}  // namespace clathra
