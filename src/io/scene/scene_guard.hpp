#pragma once
/// What a scene file must look like before the TOML parser, which hostile text can crash, is let at it.
#include <string>
#include <string_view>
#include <vector>

#include "io/errors/problems.hpp"

namespace clathra {

inline constexpr std::size_t largest_scene_file = std::size_t{1} << 20;  ///< [bytes]
inline constexpr std::size_t longest_scene_line = std::size_t{1} << 16;  ///< [bytes]

/// Text that is safe to parse: the scene with its comments blanked out, so that every position in it stays the same.
struct GuardedText {
  std::string text;
  std::vector<Problem> problems;  ///< where there are any, the text must not be parsed
};

/// Checks the size, that there is no byte order mark, the length of the lines, that all outside comments is printable ASCII, but
/// for UTF-8 in quotes, and that there is no multi-line string and no nan or inf.
/// @param file  name for the messages
GuardedText guard_scene_text(std::string_view text, std::string const& file);

}  // namespace clathra
