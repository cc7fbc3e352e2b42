#pragma once
/// Options that several verbs have.
#include <CLI/CLI.hpp>
#include <filesystem>
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

/// Where the figures of a verb's page become files.
CLI::Option* add_figures_option(CLI::App& verb, std::filesystem::path& folder);
/// Points of a laboratory for that page.
CLI::Option* add_data_option(CLI::App& verb, std::filesystem::path& file);

/// The hidden option by which a study learns how far its members are (terminal/status.hpp).
void add_status_option(CLI::App& verb);

}  // namespace clathra
