#include "io/report/colours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clathra {
namespace {

// Samples of viridis (Smith and van der Walt), even in lightness.
constexpr std::array<Rgb, 9> viridis{{{68, 1, 84},
                                      {71, 45, 123},
                                      {59, 82, 139},
                                      {44, 114, 142},
                                      {33, 145, 140},
                                      {40, 174, 128},
                                      {94, 201, 98},
                                      {173, 220, 48},
                                      {253, 231, 37}}};

std::uint8_t between(std::uint8_t a, std::uint8_t b, double part) {
  return static_cast<std::uint8_t>(std::lround(a + part * (b - a)));
}

}  // namespace

std::string hex(Rgb colour) { return fmt::format("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue); }

Stroke run_stroke(std::size_t i) {
  constexpr std::array<Rgb, 7> rgb{colours::blue, colours::vermilion, colours::green, colours::purple,
                                   colours::dark, colours::orange,    colours::sky};
  static std::array<char const*, 5> const dashes{"", "8 3", "2 2.5", "9 3 2 3", "14 4"};
  return {rgb[i % rgb.size()], dashes[i % dashes.size()]};
}

Rgb state_colour(ContactState state) {
  for (BreakModeNames const& m : break_modes)
    if (broken_in(m.mode) == state) return mode_stroke(m.mode).colour;
  return state == ContactState::bonded ? colours::grey : colours::dark;
}

Stroke mode_stroke(BreakMode mode) {
  switch (mode) {
    case BreakMode::tension:
      return {colours::green, "8 3"};
    case BreakMode::compression:
      return {colours::orange, "2 2.5"};
    case BreakMode::shear:
      return {colours::blue, "9 3 2 3"};
    case BreakMode::rolling:
      return {colours::vermilion, ""};
    case BreakMode::dissolved:
      return {colours::sky, "14 4"};
    case BreakMode::none:
      break;
  }
  return {colours::dark, ""};
}

Rgb ramp(double part) {
  double const place = std::clamp(part, 0.0, 1.0) * (viridis.size() - 1);
  std::size_t const low = std::min(static_cast<std::size_t>(place), viridis.size() - 2);
  double const rest = place - static_cast<double>(low);
  Rgb const a = viridis[low], b = viridis[low + 1];
  return {between(a.red, b.red, rest), between(a.green, b.green, rest), between(a.blue, b.blue, rest)};
}

std::string ramp_css() {
  std::string gradient = "linear-gradient(to right";
  for (Rgb const colour : viridis) gradient += fmt::format(",{}", hex(colour));
  return gradient + ")";
}

}  // namespace clathra
