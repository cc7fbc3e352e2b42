#pragma once
/// What an earlier run left in a folder.
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "domain/scene/scene.hpp"
#include "domain/scene/stage.hpp"
#include "io/results/input_digests.hpp"

namespace clathra {

/// Whether the run in a folder is finished: it is that of this scene, or of one that this scene extends, to a larger axial
/// strain. `unfinished` is also a folder without a run.
enum class EarlierRun { unfinished, finished, to_be_extended };

/// @throws FileProblem bad_input where run.json is damaged: then nobody knows. cannot_create where the run is finished, or has
/// results but no checkpoint, and is of another scene, with the keys that differ; where it read files of another content; where
/// it has results and no run.json; or where it is finished and kept no checkpoint to be extended from
EarlierRun earlier_run(std::filesystem::path const& run_folder, Scene const& scene, InputDigests const& digests);

/// The version_text() of the program that a folder's run.json says has run last in it; nothing where there is none that can be
/// read.
std::string program_of_run(std::filesystem::path const& run_folder);

/// What the run.json of a run that is gone on with says of its earlier sessions.
struct EarlierSessions {
  StageRecord generate, plan;
  std::vector<double> layer_void_ratios;
  std::map<std::string, double> wall_seconds;
  double axial_strain = 0;  ///< that was asked for
};
/// Without what it does not say. @throws FileProblem where run.json is damaged
EarlierSessions earlier_sessions(std::filesystem::path const& run_folder);

/// What a folder holds that a new run would take the place of.
struct KeptRun {
  std::string what;  ///< "a finished run", "a run that is not finished (...)"
  bool can_go_on;    ///< by what is known of it
};
/// Nothing where no result would be lost.
std::optional<KeptRun> kept_run(std::filesystem::path const& run_folder);

}  // namespace clathra
