#pragma once
/// Curves over two axes as inline SVG.
#include <string>
#include <vector>

#include "io/report/colours.hpp"

namespace clathra {

struct Curve {
  std::string name;
  std::vector<double> x, y;  ///< points that are not finite interrupt the line
  Stroke stroke;
  bool marked = false;  ///< with a dot on each point
};

/// The area between two curves over the same x.
struct Area {
  std::string name;
  std::vector<double> x, low, high;
  Rgb colour;
  double opacity = 1;
};

struct Axis {
  std::string title;  ///< with the unit
  double from = 0, to = 1;
  bool logarithmic = false;
};

struct Plot {
  std::string title, description;  ///< for those who cannot see it
  Axis x, y;
  std::vector<Area> areas;
  std::vector<Curve> curves;
  double height = 320;  ///< where the width is 480
};

/// Grows with the finite values that it is shown, and holds zero.
class Range {
 public:
  void include(double value);
  void include(std::vector<double> const& values);
  Axis axis(std::string title) const;        ///< widened to round numbers
  Axis exact_axis(std::string title) const;  ///< ends where the values do

 private:
  double low_ = 0, high_ = 0;
};

/// The part of a plot inside its axes, in units of the drawing.
struct PlotFrame {
  double left, top, width, height;
};
PlotFrame frame_of(Plot const& plot);

/// The height that a plot needs for equal scales on both axes.
double height_for_equal_scales(Axis const& x, Axis const& y);

/// The group of class "curves" says by data-x, data-y (from, to) and data-frame (left, top, width, height) which place stands for
/// which number. Curves of more than a thousand points are thinned so that no peak is lost.
std::string svg(Plot const& plot);

/// 1, 2 or 5 times a power of ten, so that a range has at most about `count` steps.
double tick_step(double from, double to, int count);
/// The multiples of that step in a range.
std::vector<double> ticks(double from, double to, int count);

/// Values in another unit.
std::vector<double> scaled(std::vector<double> values, double factor);

}  // namespace clathra
