#pragma once
/// TOML from files that may hold anything.
#include <optional>
#include <string>
#include <vector>

#include "io/errors/problems.hpp"
#include "io/scene/toml_tree.hpp"

namespace clathra {

/// Parses a text that guard_scene_text() lets through. @param file  name for the messages
/// @param problems  what is wrong is added to them: of a text that the guard refuses everything, else the first error of the
/// parser, said in the words of somebody who writes scenes
/// @return nothing where there is a problem
std::optional<TomlTable> parse_guarded(std::string const& text, std::string const& file, std::vector<Problem>& problems);

}  // namespace clathra
