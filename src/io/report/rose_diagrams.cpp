#include "io/report/rose_diagrams.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "io/report/markup.hpp"

namespace clathra {
namespace {

constexpr double half_turn = std::numbers::pi, to_degrees = 180 / half_turn;
constexpr double size = 340, middle = size / 2, largest = 128;  // of a diagram
constexpr double bin_angle = half_turn / Rose::bins;

using Values = std::array<double, Rose::bins>;

/// Both halves: a normal has two ends.
std::string petals(Values const& values, double unit) {
  std::string path;
  for (std::size_t i = 0; i < 2 * Rose::bins; ++i) {
    double const from = static_cast<double>(i) * bin_angle, to = from + bin_angle;
    double const r = std::max(0.0, values[i % Rose::bins]) * unit;
    fmt::format_to(std::back_inserter(path), "M{0:.1f} {0:.1f}L{1:.1f} {2:.1f}A{3:.1f} {3:.1f} 0 0 0 {4:.1f} {5:.1f}Z", middle,
                   middle + r * std::cos(from), middle - r * std::sin(from), r, middle + r * std::cos(to),
                   middle - r * std::sin(to));
  }
  return path;
}

std::string outline(Values const& values, double unit) {
  std::string points;
  for (std::size_t i = 0; i < 2 * Rose::bins; ++i)
    for (int end = 0; end < 2; ++end) {
      double const angle = (static_cast<double>(i) + end) * bin_angle, r = std::max(0.0, values[i % Rose::bins]) * unit;
      fmt::format_to(std::back_inserter(points), "{:.1f},{:.1f} ", middle + r * std::cos(angle), middle - r * std::sin(angle));
    }
  return points;
}

std::string cosine_curve(double anisotropy, double direction, double unit) {
  std::string points;
  constexpr int count = 120;
  for (int i = 0; i < count; ++i) {
    double const angle = 2 * half_turn * i / count, r = std::max(0.0, 1 + anisotropy * std::cos(2 * (angle - direction))) * unit;
    fmt::format_to(std::back_inserter(points), "{:.1f},{:.1f} ", middle + r * std::cos(angle), middle - r * std::sin(angle));
  }
  return points;
}

/// Of the bins.
std::vector<double> middles() {
  std::vector<double> angles;
  for (std::size_t i = 0; i < Rose::bins; ++i) angles.push_back((static_cast<double>(i) + 0.5) * bin_angle);
  return angles;
}

std::string rings(double most, double unit) {
  double const step = tick_step(0, most, 3);
  std::string drawn = fmt::format("<path d=\"M{0} {1}v{2}M{3} {0}h{2}\" stroke=\"#c9d0d4\"/>", middle, middle - largest - 6,
                                  2 * largest + 12, middle - largest - 6);
  for (double value = step; value <= most * (1 + 1e-9); value += step)
    drawn += fmt::format(
        "<circle cx=\"{0}\" cy=\"{0}\" r=\"{1:.1f}\" stroke=\"#c9d0d4\"/><text x=\"{2:.1f}\" y=\"{3:.1f}\">{4:g}</text>", middle,
        value * unit, middle + value * unit * 0.72 + 3, middle + value * unit * 0.72 + 4, value);
  return drawn + fmt::format(
                     "<text x=\"{0}\" y=\"14\" text-anchor=\"middle\">σ₁ ↕</text><text x=\"{1}\" y=\"{2}\" "
                     "text-anchor=\"end\">σ₃ ↔</text>",
                     middle, size - 2, middle - 6);
}

Piece diagram(Values const& now, Values const& before, double anisotropy, double direction, std::string const& title) {
  double most = 1 + anisotropy;
  for (std::size_t i = 0; i < Rose::bins; ++i) most = std::max({most, now[i], before[i]});
  double const unit = largest / most;
  Drawing const box{
      size, size,
      fmt::format("<path d=\"{}\" fill=\"{}\" fill-opacity=\"0.75\" stroke=\"#fff\" stroke-width=\"0.7\"/>"
                  "<g fill=\"none\">{}<polygon points=\"{}\" stroke=\"{}\" stroke-width=\"1.4\" stroke-dasharray=\"4 3\"/>"
                  "<polygon points=\"{}\" stroke=\"{}\" stroke-width=\"2\"/></g>",
                  petals(now, unit), hex(colours::sky), rings(most, unit), outline(before, unit), hex(colours::dark),
                  cosine_curve(anisotropy, direction, unit), hex(colours::vermilion))};
  return drawing(
      box, "plot rose", title,
      fmt::format("Anisotropy {:.2f}, largest at {:.0f} degrees from the horizontal.", anisotropy, direction * to_degrees),
      {"series,direction_rad,over_the_mean,over_the_mean_at_the_start", [=] {
         return data_rows({{title, {middles(), {now.begin(), now.end()}, {before.begin(), before.end()}}}});
       }});
}

}  // namespace

Piece normal_rose(Rose const& now, Rose const& before, std::string const& label) {
  return diagram(now.normals, before.normals, now.fabric.anisotropy(), now.fabric.direction,
                 "Directions of contact normals, " + label);
}

Piece force_rose(Rose const& now, Rose const& before, std::string const& label) {
  return diagram(now.forces, before.forces, now.force_anisotropy, now.force_direction,
                 "Mean normal force by direction, " + label);
}

}  // namespace clathra
