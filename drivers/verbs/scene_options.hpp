#pragma once
/// The options of every verb that reads a scene.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "io/scene/scene_file.hpp"

namespace clathra {

struct SceneOptions {
  std::string file;
  std::vector<std::string> overrides;  ///< --set key=value
  int threads = 0;
  bool ignore_guards = false;

  void add_to(CLI::App& verb);
  /// The scene with all overrides. @throws SceneProblems, FileProblem
  /// @param more  overrides by options of the verb itself
  LoadedScene load(std::vector<std::string> more = {}) const;
};

/// The hidden option by which a study learns how far its members are (terminal/status.hpp).
void add_status_option(CLI::App& verb);

}  // namespace clathra
