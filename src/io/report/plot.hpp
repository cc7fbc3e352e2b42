#pragma once
/// Curves over two axes.
#include <string>
#include <vector>

#include "io/report/colours.hpp"
#include "io/report/figure.hpp"

namespace clathra {

/// What stands along an axis.
struct Variable {
  char const* title = "";   ///< with the unit that is shown
  char const* column = "";  ///< its name in files, with the SI unit
  double factor = 1;        ///< of the shown unit to that of the column
};
inline constexpr Variable axial_strain{"axial strain ε₁ [%]", "eps1", 100},
    hydrate_saturation{"hydrate saturation [%]", "saturation_pct"};

struct Curve {
  std::string name;
  std::vector<double> x, y;  ///< in the units of the columns; points that are not finite interrupt the line
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
  Variable what;
  double from = 0, to = 1;  ///< in the shown unit
  bool logarithmic = false;
};

struct Plot {
  std::string title, description;  ///< for those who cannot see it
  Axis x, y;
  std::vector<Area> areas;
  std::vector<Curve> curves;
  double height = 320;  ///< where the width is 480
};

/// Grows with the finite values that it is shown, in the unit of their column, and holds zero.
class Range {
 public:
  void include(double value);
  void include(std::vector<double> const& values);
  Axis axis(Variable const& what) const;        ///< widened to round numbers
  Axis exact_axis(Variable const& what) const;  ///< ends where the values do

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
/// which number. Curves of more than a thousand points are thinned so that no peak is lost; the data have all points, of an area
/// its lower and its upper edge.
Piece drawing(Plot const& plot);

/// 1, 2 or 5 times a power of ten, so that a range has at most about `count` steps.
double tick_step(double from, double to, int count);
/// The multiples of that step in a range.
std::vector<double> ticks(double from, double to, int count);

}  // namespace clathra
