#pragma once
/// Colours and line styles that people who see few colours can tell apart (the set of Okabe and Ito), and ramps for fields.
#include <array>
#include <string>
#include <vector>

#include "domain/measurement/snapshot.hpp"
#include "io/report/canvas.hpp"

namespace clathra {

namespace colours {
inline constexpr Rgb blue{0, 114, 178}, vermilion{213, 94, 0}, green{0, 158, 115}, purple{170, 68, 153}, orange{230, 159, 0},
    sky{86, 180, 233}, grey{190, 190, 190}, dark{60, 60, 60}, black{0, 0, 0};
}

/// "#rrggbb"
std::string hex(Rgb colour);

/// How a curve is drawn. `dash` as in SVG's stroke-dasharray, empty = solid.
struct Stroke {
  Rgb colour;
  std::string dash;
  double width = 2;
};

/// The stroke of the i-th run: seven colours, each with a dash of its own; later runs take other pairs.
Stroke run_stroke(std::size_t i);

/// Of a pair's state: intact bonds grey, broken ones by mode, unbonded contacts dark.
Rgb state_colour(ContactState state);

/// How what broke in a mode is drawn.
Stroke mode_stroke(BreakMode mode);

/// Dark blue over green to yellow, lightness rising evenly. @param part  0 to 1, clamped
Rgb ramp(double part);
/// The same as a CSS gradient.
std::string ramp_css();

}  // namespace clathra
