#pragma once
/// A scene file with some keys set to other values, the rest of its text left as somebody wrote it.
#include <filesystem>
#include <string>
#include <vector>

#include "domain/scene/scene.hpp"

namespace clathra {

/// A key with its value as a scene file states it ("1 MPa" with its quotes) and what to say of it.
struct SceneEdit {
  std::string key, value;
  std::string comment;  ///< one line, without "# "; may be empty
};

/// The text of a scene with keys set, each under its comment, and others left out. A key that the text states on a line of its
/// own is replaced there, the line that was is kept as a comment; others are put below the header of their section, or in a new
/// one.
/// @param left_out  keys whose lines become comments
/// @return text that need not load as wanted where a scene is written in unusual ways, with inline tables for one: see
/// scene_text_for()
std::string edited_scene_text(std::string const& source, std::vector<SceneEdit> const& edits,
                              std::vector<std::string> const& left_out = {});

/// The same, checked: the text loads to `wanted` from its folder. Where the edited text does not, the scene is written anew,
/// every key under its meaning, the comments of the edits at the top.
std::string scene_text_for(Scene const& wanted, std::string const& source, std::vector<SceneEdit> const& edits,
                           std::vector<std::string> const& left_out, std::filesystem::path const& folder);

}  // namespace clathra
