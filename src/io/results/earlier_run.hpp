#pragma once
/// What an earlier run left in a folder.
#include <filesystem>
#include <optional>
#include <string>

#include "domain/scene/scene.hpp"

namespace clathra {

/// Whether the run in a folder is finished: it is that of this scene, or of one that this scene extends, to a larger axial
/// strain. `unfinished` is also a folder without a run.
enum class EarlierRun { unfinished, finished, to_be_extended };

/// @param specimen_digest  of the specimen file that the scene reads, if it does
/// @throws FileProblem bad_input where run.json is damaged: then nobody knows. Refused where the run is finished, or has results
/// but no checkpoint, and is of another scene, with the keys that differ; where it has results and no run.json; or where it is
/// finished and kept no checkpoint to be extended from
EarlierRun earlier_run(std::filesystem::path const& run_folder, Scene const& scene, std::string const& specimen_digest);

/// The version_text() of the program that a folder's run.json says has run last in it; nothing where there is none that can be
/// read.
std::string program_of_run(std::filesystem::path const& run_folder);

/// What a folder holds that a new run would take the place of: "a finished run", "a run that is not finished (...)". Nothing
/// where no result would be lost.
std::optional<std::string> kept_run(std::filesystem::path const& run_folder);

}  // namespace clathra
