#pragma once
/// What the schema says of a scene's keys, for readers: the reference in Markdown, a JSON Schema for editors, a scene to start
/// from.
#include <string>
#include <string_view>
#include <vector>

#include "domain/scene/scene.hpp"
#include "io/scene/schema.hpp"

namespace clathra {

/// "1 kPa to 1 GPa", "one of 'replace', 'parallel', 'memory'", "true or false".
std::string allowed_values(Key const& key);

/// The reference of all keys, a table a section.
std::string schema_markdown();

/// A JSON Schema (draft 2020-12) of scene files, for editors that check TOML against one.
std::string schema_json();

/// A scene file with every key, each under a comment that says what it means and what is allowed. Keys that are not `stated` are
/// commented out and show their value in `scene`, so that the file loads to the same Scene.
/// @param opening  comment lines for the top, with their "# "
/// @param source  the scene file, one line a key, whose spelling of the values is kept; empty: they are written anew
std::string commented_scene(Scene const& scene, std::vector<std::string_view> const& stated, std::string_view opening,
                            std::string_view source = {});

}  // namespace clathra
