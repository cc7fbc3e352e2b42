#include "io/report/canvas.hpp"

#include <algorithm>
#include <cmath>

namespace clathra {
namespace {

/// The pixels from `low` to `high` that are in a picture of this size; none where a coordinate is not finite.
struct Span {
  int first = 0, last = -1;
  Span(double low, double high, int size) {
    if (!(low < size) || !(high >= 0)) return;
    first = static_cast<int>(std::max(0.0, std::floor(low)));
    last = static_cast<int>(std::min(size - 1.0, std::floor(high)));
  }
};

constexpr double half_pixel = 0.5;

/// Some pixels: no need for the range of std::hypot, which took a seventh of a report's time.
double length(double x, double y) { return std::sqrt(x * x + y * y); }

std::uint8_t mixed(std::uint8_t below, std::uint8_t above, double cover) {
  return static_cast<std::uint8_t>(std::lround(below + cover * (above - below)));
}

}  // namespace

Canvas::Canvas(int width, int height)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), {255, 255, 255}) {}

void Canvas::blend(int x, int y, double cover, Rgb colour) {
  if (!(cover > 0)) return;
  Rgb& pixel = pixels_[index(x, y)];
  pixel = {mixed(pixel.red, colour.red, cover), mixed(pixel.green, colour.green, cover), mixed(pixel.blue, colour.blue, cover)};
}

void Canvas::disc(double x, double y, double radius, Rgb colour) {
  double const drawn = std::max(radius, half_pixel);
  double const strength = (radius / drawn) * (radius / drawn);
  Span const columns(x - drawn - half_pixel, x + drawn + half_pixel, width_);
  Span const rows(y - drawn - half_pixel, y + drawn + half_pixel, height_);
  for (int row = rows.first; row <= rows.last; ++row)
    for (int column = columns.first; column <= columns.last; ++column) {
      double const distance = length(column + half_pixel - x, row + half_pixel - y);
      blend(column, row, strength * std::clamp(drawn - distance + half_pixel, 0.0, 1.0), colour);
    }
}

void Canvas::line(double x0, double y0, double x1, double y1, double width, Rgb colour) {
  double const half = std::max(width / 2, half_pixel), strength = width / 2 / half, reach = half + half_pixel;
  double const dx = x1 - x0, dy = y1 - y0, length2 = dx * dx + dy * dy;
  Span const columns(std::min(x0, x1) - reach, std::max(x0, x1) + reach, width_);
  Span const rows(std::min(y0, y1) - reach, std::max(y0, y1) + reach, height_);
  for (int row = rows.first; row <= rows.last; ++row)
    for (int column = columns.first; column <= columns.last; ++column) {
      double const px = column + half_pixel - x0, py = row + half_pixel - y0;
      double const along = length2 > 0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0;
      double const distance = length(px - along * dx, py - along * dy);
      blend(column, row, strength * std::clamp(half - distance + half_pixel, 0.0, 1.0), colour);
    }
}

}  // namespace clathra
