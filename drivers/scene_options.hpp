#pragma once
/// The options of every verb that reads a scene.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "domain/scene/specimen.hpp"
#include "io/scene/scene_file.hpp"

namespace clathra {

struct SceneOptions {
  std::string file;
  std::vector<std::string> overrides;  ///< --set key=value
  int threads = 0;
  bool force = false;

  void add_to(CLI::App& verb);
  /// The scene with all overrides. @throws SceneProblems, FileProblem
  /// @param more  overrides by options of the verb itself
  LoadedScene load(std::vector<std::string> more = {}) const;
};

/// The scene with its size taken from a specimen: what predict() needs where the specimen comes from a file.
Scene sized_by(Scene scene, Specimen const& specimen, std::int64_t discs);

}  // namespace clathra
