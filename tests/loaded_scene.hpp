#pragma once
/// Scenes read from texts.
#include <string>
#include <vector>

#include "io/scene/scene_file.hpp"

namespace clathra {

using Texts = std::vector<std::string>;

inline std::string const sized = "[specimen]\nparticles = 2000\n";  ///< what a scene has to state

inline LoadedScene load(std::string const& text, Texts const& overrides = {}) {
  return parse_scene(text, "my.toml", "folder", overrides);
}

}  // namespace clathra
