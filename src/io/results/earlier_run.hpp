#pragma once
/// What an earlier run left in a folder.
#include <filesystem>
#include <optional>
#include <string>

#include "domain/scene/scene.hpp"

namespace clathra {

/// Whether a folder holds the results of a finished run of this scene.
/// @param specimen_digest  of the specimen file that the scene reads, if it does
/// @throws FileProblem refused where it is a finished run of another scene, with the keys that differ
bool is_finished_run(std::filesystem::path const& run_folder, Scene const& scene, std::string const& specimen_digest);

/// How a run ended that has checkpoints and is not finished: what its run.json says; nothing where there is no such run.
std::optional<std::string> unfinished_run(std::filesystem::path const& run_folder);

}  // namespace clathra
