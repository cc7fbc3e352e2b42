#include "io/report/drawn_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/report/markup.hpp"
#include "io/report/plot.hpp"
#include "io/report/png.hpp"
#include "kernels/break_mode.hpp"

namespace clathra {

std::string strain_text(Snapshot const& s) { return fmt::format("ε₁ = {:.3g} %", s.eps1 * 100); }

std::string drawn(Picture const& wanted, std::size_t bytes) {
  constexpr double lowest = 120, highest = 1400, safety = 0.93;
  MapView view = wanted.view;
  double pixels = std::clamp(view.height / wanted.grain * wanted.pixels_per_grain, lowest, highest);
  for (;;) {
    view.pixels = static_cast<int>(pixels);
    Canvas const canvas = wanted.draw(view);
    std::string const png = png_bytes(canvas);
    if (png.size() <= bytes || pixels <= lowest) return picture(png, canvas, wanted.alt);
    double const shrink = std::sqrt(static_cast<double>(bytes) / static_cast<double>(png.size()));
    pixels = std::max(lowest, pixels * std::min(safety, shrink));
  }
}

std::string titled(std::string const& image, std::string const& text) {
  return "<div>" + image + "<p>" + escaped(text) + "</p></div>\n";
}

std::string strip(std::string const& contents) { return "<div class=\"strip\">\n" + contents + "</div>\n"; }

std::string mode_entries() {
  std::string entries;
  for (BreakModeNames const& m : break_modes)
    entries += patch_entry(mode_stroke(m.mode).colour, std::string("broken in ") + m.name);
  return entries;
}

double upper_end(std::vector<float> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); }), values.end());
  if (values.empty()) return 0;
  auto const at = values.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  double const end = double(*at);
  return end > 0 ? std::ceil(end / tick_step(0, end, 10)) * tick_step(0, end, 10) : 0;
}

}  // namespace clathra
