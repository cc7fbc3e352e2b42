#include "io/report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "io/report/markup.hpp"

namespace clathra {
namespace {

constexpr double drawing_width = 480, left_margin = 68, right_margin = 20, top_margin = 12, bottom_margin = 48;
constexpr std::size_t most_points = 1000;

/// IdIndex of numbers in a plot.
struct Scale {
  Plot const& plot;
  PlotFrame frame = frame_of(plot);

  static double part(Axis const& axis, double value) {
    if (axis.logarithmic) return std::log(value / axis.from) / std::log(axis.to / axis.from);
    return (value - axis.from) / (axis.to - axis.from);
  }
  double shown_x(double value) const { return frame.left + frame.width * part(plot.x, value); }
  double shown_y(double value) const { return frame.top + frame.height * (1 - part(plot.y, value)); }
  double x(double value) const { return shown_x(value * plot.x.what.factor); }
  double y(double value) const { return shown_y(value * plot.y.what.factor); }
};

/// Indices of at most most_points points: the first and last, and from each stretch between them its lowest and highest.
std::vector<std::size_t> thinned(std::vector<double> const& y) {
  std::vector<std::size_t> kept;
  std::size_t const n = y.size(), stretches = most_points / 2 - 1;
  if (n <= most_points) {
    for (std::size_t i = 0; i < n; ++i) kept.push_back(i);
    return kept;
  }
  kept.push_back(0);
  for (std::size_t k = 0; k < stretches; ++k) {
    std::size_t const from = 1 + k * (n - 2) / stretches, to = 1 + (k + 1) * (n - 2) / stretches;
    auto const first = y.begin() + static_cast<std::ptrdiff_t>(from), last = y.begin() + static_cast<std::ptrdiff_t>(to);
    auto const [low, high] = std::minmax_element(first, last);
    std::size_t const a = static_cast<std::size_t>(low - y.begin()), b = static_cast<std::size_t>(high - y.begin());
    kept.push_back(std::min(a, b));
    if (a != b) kept.push_back(std::max(a, b));
  }
  kept.push_back(n - 1);
  return kept;
}

std::string points(Scale const& scale, std::vector<double> const& x, std::vector<double> const& y,
                   std::vector<std::size_t> const& which) {
  std::string text;
  for (std::size_t const i : which) {
    double const px = scale.x(x[i]), py = scale.y(y[i]);
    if (std::isfinite(px) && std::isfinite(py)) fmt::format_to(std::back_inserter(text), "{:.1f},{:.1f} ", px, py);
  }
  if (!text.empty()) text.pop_back();
  return text;
}

std::string dots(Scale const& scale, Curve const& curve) {
  std::string text;
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    if (double const x = scale.x(curve.x[i]), y = scale.y(curve.y[i]); std::isfinite(x) && std::isfinite(y))
      text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\" fill=\"{}\"/>", x, y, hex(curve.stroke.colour));
  return text;
}

/// A curve in pieces, cut where a point is not finite.
std::string polylines(Scale const& scale, Curve const& curve) {
  std::string text;
  std::vector<std::size_t> piece;
  auto const end_piece = [&] {
    if (piece.size() > 1)
      text += fmt::format("<polyline data-name=\"{}\" points=\"{}\" stroke=\"{}\" stroke-width=\"{:g}\"{}/>\n",
                          escaped(curve.name), points(scale, curve.x, curve.y, piece), hex(curve.stroke.colour),
                          curve.stroke.width, dash_attribute(curve.stroke));
    piece.clear();
  };
  for (std::size_t const i : thinned(curve.y)) {
    if (std::isfinite(scale.x(curve.x[i])) && std::isfinite(scale.y(curve.y[i])))
      piece.push_back(i);
    else
      end_piece();
  }
  end_piece();
  return text + (curve.marked ? dots(scale, curve) : "");
}

std::string polygon(Scale const& scale, Area const& area) {
  std::vector<std::size_t> there = thinned(area.high), back = there;
  std::reverse(back.begin(), back.end());
  return fmt::format("<polygon data-name=\"{}\" points=\"{} {}\" fill=\"{}\"{} stroke=\"none\"/>\n", escaped(area.name),
                     points(scale, area.x, area.high, there), points(scale, area.x, area.low, back), hex(area.colour),
                     area.opacity < 1 ? fmt::format(" fill-opacity=\"{:g}\"", area.opacity) : "");
}

std::vector<double> axis_ticks(Axis const& axis, int count) {
  if (!axis.logarithmic) return ticks(axis.from, axis.to, count);
  std::vector<double> marks;
  for (double decade = std::pow(10, std::floor(std::log10(axis.from))); decade <= axis.to; decade *= 10)
    for (int digit = 1; digit < 10; ++digit)
      if (double const mark = digit * decade; mark >= axis.from * (1 - 1e-9) && mark <= axis.to * (1 + 1e-9))
        marks.push_back(mark);
  return marks;
}

/// Of the marks of a logarithmic axis those with the digits 1, 2, 3 and 5 have room for their number.
bool is_labelled(double mark) {
  long const digit = std::lround(mark / std::pow(10, std::floor(std::log10(mark) + 1e-9)));
  return digit == 1 || digit == 2 || digit == 3 || digit == 5;
}

std::string axes(Scale const& scale) {
  auto const& [left, top, width, height] = scale.frame;
  std::string grid, labels;
  for (double const mark : axis_ticks(scale.plot.x, 6)) {
    grid += fmt::format("<path d=\"M{0:.2f} {1:.2f}v{2:.2f}\"/>", scale.shown_x(mark), top, height);
    if (scale.plot.x.logarithmic && !is_labelled(mark)) continue;
    labels += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{:.4g}</text>", scale.shown_x(mark),
                          top + height + 17, mark);
  }
  for (double const mark : axis_ticks(scale.plot.y, height > 200 ? 6 : 4)) {
    grid += fmt::format("<path d=\"M{0:.2f} {1:.2f}h{2:.2f}\"/>", left, scale.shown_y(mark), width);
    labels += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"end\">{:.4g}</text>", left - 6,
                          scale.shown_y(mark) + 4.5, mark);
  }
  return fmt::format(
      "<g class=\"grid\">{}</g><rect class=\"frame\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"/>"
      "<g>{}<text class=\"title\" x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{}</text>"
      "<text class=\"title\" transform=\"translate(16 {:.2f}) rotate(-90)\" text-anchor=\"middle\">{}</text></g>\n",
      grid, left, top, width, height, labels, left + width / 2, top + height + 40, escaped(scale.plot.x.what.title),
      top + height / 2, escaped(scale.plot.y.what.title));
}

/// A row a point: the curves, then the edges of the areas.
DrawnData data_of(Plot const& plot) {
  std::vector<DataColumns> series;
  for (Curve const& curve : plot.curves) series.push_back({curve.name, {curve.x, curve.y}});
  for (Area const& area : plot.areas) {
    series.push_back({area.name + ", lower edge", {area.x, area.low}});
    series.push_back({area.name + ", upper edge", {area.x, area.high}});
  }
  return {fmt::format("series,{},{}", plot.x.what.column, plot.y.what.column),
          [series = std::move(series)] { return data_rows(series); }};
}

}  // namespace

void Range::include(double value) {
  if (!std::isfinite(value)) return;
  low_ = std::min(low_, value);
  high_ = std::max(high_, value);
}

void Range::include(std::vector<double> const& values) {
  for (double const value : values) include(value);
}

Axis Range::axis(Variable const& what) const {
  auto const [ignored, from, to, logarithmic] = exact_axis(what);
  double const span = to - from, step = tick_step(from, to, 6);
  // A curve that starts a hair below zero needs no empty strip there.
  double const low = from < 0 && from > -0.01 * span ? 0 : from;
  return {what, std::floor(low / step + 1e-9) * step, std::ceil(to / step - 1e-9) * step};
}

Axis Range::exact_axis(Variable const& what) const {
  double const low = low_ * what.factor, high = high_ * what.factor;
  return {what, low, high > low ? high : low + 1};
}

double tick_step(double from, double to, int count) {
  double const rough = (to - from) / count, decade = std::pow(10, std::floor(std::log10(rough)));
  for (double const factor : {1.0, 2.0, 5.0})
    if (factor * decade >= rough * (1 - 1e-9)) return factor * decade;
  return 10 * decade;
}

std::vector<double> ticks(double from, double to, int count) {
  double const step = tick_step(from, to, count), first = std::ceil(from / step - 1e-3), last = std::floor(to / step + 1e-3);
  std::vector<double> marks;
  for (double k = first; k <= last; ++k) marks.push_back(k == 0 ? 0 : k * step);
  return marks;
}

PlotFrame frame_of(Plot const& plot) {
  return {left_margin, top_margin, drawing_width - left_margin - right_margin, plot.height - top_margin - bottom_margin};
}

double height_for_equal_scales(Axis const& x, Axis const& y) {
  double const width = drawing_width - left_margin - right_margin;
  return width * (y.to - y.from) / (x.to - x.from) + top_margin + bottom_margin;
}

Piece drawing(Plot const& plot) {
  Scale const scale{plot};
  auto const& [left, top, width, height] = scale.frame;
  std::string drawn;
  for (Area const& area : plot.areas) drawn += polygon(scale, area);
  for (Curve const& curve : plot.curves) drawn += polylines(scale, curve);
  Drawing const box{drawing_width, plot.height,
                    fmt::format("{}<g class=\"curves\" data-x=\"{} {}\" data-y=\"{} {}\" data-frame=\"{} {} {} {}\">\n{}</g>",
                                axes(scale), plot.x.from, plot.x.to, plot.y.from, plot.y.to, left, top, width, height, drawn)};
  return drawing(box, "plot", plot.title, plot.description, data_of(plot));
}

}  // namespace clathra
