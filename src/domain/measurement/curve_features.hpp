#pragma once
/// What can be read off a curve of a test: places, slopes and how it bends. Abscissae (axial strains, as a rule) ascend.
#include <optional>
#include <vector>

namespace clathra {

/// The value at a place, linear between the points, that of the nearest end outside. @param x  one at least
double value_at(std::vector<double> const& x, std::vector<double> const& y, double place);

/// The middle of the places with y >= share * max(y), which for a curve without noise is where its top is. A single largest
/// record says less where the top is flat.
/// @param y  one finite value at least
double middle_of_top(std::vector<double> const& x, std::vector<double> const& y, double share);

/// The slope of the least-squares line over from <= x <= to; nothing for fewer than two points there.
std::optional<double> slope_over(std::vector<double> const& x, std::vector<double> const& y, double from, double to);

/// y = at_mean + slope (x - mean x) + bend (x - mean x)^2 by least squares.
struct Parabola {
  double at_mean = 0, slope = 0, bend = 0;
};
/// Nothing for fewer than three different places.
std::optional<Parabola> fitted_parabola(std::vector<double> const& x, std::vector<double> const& y);

/// The middle of the stretch of a width over which y grows most; nothing for a curve that is shorter or does not grow.
std::optional<double> fastest_growth(std::vector<double> const& x, std::vector<double> const& y, double width);

/// The first place behind the largest y where y has lost a share of its way down to a level; nothing where it does not get there.
std::optional<double> end_of_fall(std::vector<double> const& x, std::vector<double> const& y, double level, double share);

}  // namespace clathra
