#pragma once
/// The ways in which a bond breaks: the one list of them that files, tables and pictures follow.
#include <cstdint>
#include <iterator>

namespace clathra {

/// How a bond broke, or that its hydrate dissolved between steps. `none` = intact. The numbers stand in files.
enum class BreakMode : std::int8_t { none = 0, tension = 1, compression = 2, shear = 3, rolling = 4, dissolved = 5 };

/// The names of a mode: its own, and that of its column in history.csv, of its state in exported pairs.
struct BreakModeNames {
  BreakMode mode;
  char const* name;
  char const* broken;
};
inline constexpr BreakModeNames break_modes[] = {{BreakMode::tension, "tension", "broken_tension"},
                                                 {BreakMode::compression, "compression", "broken_compression"},
                                                 {BreakMode::shear, "shear", "broken_shear"},
                                                 {BreakMode::rolling, "rolling", "broken_rolling"},
                                                 {BreakMode::dissolved, "dissolved", "broken_dissolved"}};
inline constexpr int break_mode_count = 1 + static_cast<int>(std::size(break_modes));  ///< with `none`

/// Of a mode's number; "none" for those that there are not.
constexpr char const* break_mode_name(int mode) {
  return mode > 0 && mode < break_mode_count ? break_modes[mode - 1].name : "none";
}

/// Bonds broken, by mode.
struct BreakCounts {
  std::int64_t number[break_mode_count] = {};
  constexpr std::int64_t& operator[](BreakMode mode) { return number[static_cast<int>(mode)]; }
  constexpr std::int64_t const& operator[](BreakMode mode) const { return number[static_cast<int>(mode)]; }
  constexpr std::int64_t total() const {
    std::int64_t sum = 0;
    for (BreakModeNames const& m : break_modes) sum += (*this)[m.mode];
    return sum;
  }
  bool operator==(BreakCounts const&) const = default;
};

}  // namespace clathra
