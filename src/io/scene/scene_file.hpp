#pragma once
/// Scene files: TOML with units in, a validated Scene out, and back as the echo of all values.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "domain/scene/scene.hpp"
#include "io/errors/problems.hpp"

namespace clathra {

struct LoadedScene {
  Scene scene;
  std::string source;                  ///< the bytes of the file
  std::vector<std::string> overrides;  ///< "key=value" as given
  std::vector<std::string> warnings;
  std::vector<std::string_view> stated;  ///< names of the keys that the file or an override states
};

/// Reads a scene file and applies overrides "test.strain_rate=5 %/min" on top of it. Paths in the file are relative to its
/// folder, those in overrides to the current one. An override of test.strain_rate or test.inertial_number replaces the other in
/// the file; the first drops the file's test.max_platen_wave_stress, too.
/// @throws SceneProblems with everything that is wrong;  FileProblem if the file cannot be read
LoadedScene load_scene(std::filesystem::path const& path, std::vector<std::string> const& overrides = {});

/// The same from text. @param file  name for the messages;  @param folder  to which paths are relative
LoadedScene parse_scene(std::string const& source, std::string const& file, std::filesystem::path const& folder,
                        std::vector<std::string> const& overrides = {});

/// Every key with its value and meaning, as a scene file to be kept in `folder` that loads to the same Scene.
std::string resolved_scene(Scene const& scene, std::filesystem::path const& folder);

}  // namespace clathra
