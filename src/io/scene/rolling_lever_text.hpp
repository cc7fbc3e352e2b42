#pragma once
/// The key bond.rolling_lever as text: a length, "1 mm", or a part of the bond width B, "0.25 B" or "B/4".
#include <string>
#include <string_view>

#include "domain/scene/scene.hpp"

namespace clathra {

inline constexpr double shortest_lever = 1e-6, longest_lever = 10;              // [m]
inline constexpr double least_width_fraction = 1e-4, most_width_fraction = 10;  // of B

/// @throws std::invalid_argument with a text that follows the key's name
RollingLever parse_rolling_lever(std::string_view text);

/// The shortest text that parse_rolling_lever() reads back to the same bits: "1 mm", "0.25 B".
std::string format_rolling_lever(RollingLever const& lever);

/// "1 um to 10 m, or 1e-04 B to 10 B"
std::string rolling_lever_limits();

}  // namespace clathra
