#pragma once
/// What an earlier run left in a folder.
#include <filesystem>
#include <optional>
#include <string>

#include "domain/scene/scene.hpp"

namespace clathra {

/// Whether the run in a folder is finished: it is that of this scene, or of one that this scene extends, to a larger axial
/// strain.
enum class EarlierRun { unfinished, finished, to_be_extended };

/// @param specimen_digest  of the specimen file that the scene reads, if it does
/// @throws FileProblem refused where it is a finished run of another scene, with the keys that differ, or one that kept no
/// checkpoint to be extended from
EarlierRun earlier_run(std::filesystem::path const& run_folder, Scene const& scene, std::string const& specimen_digest);

/// How a run ended that has checkpoints and is not finished: what its run.json says; nothing where there is no such run.
std::optional<std::string> unfinished_run(std::filesystem::path const& run_folder);

}  // namespace clathra
