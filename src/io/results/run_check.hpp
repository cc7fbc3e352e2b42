#pragma once
/// Are the files of a run still what the run wrote?
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace clathra {

/// XXH3-128 of each result file of a run's folder, by its path relative to the folder; run.json itself and files that the run did
/// not make are left out. @throws FileProblem
std::map<std::string, std::string> result_digests(std::filesystem::path const& run_folder);

struct FileCheck {
  std::string file;     ///< relative to the run's folder
  std::string problem;  ///< empty where the file is as it was written
};

/// Compares the files of a finished run with the digests in its run.json.
/// @throws FileProblem file_missing without a run.json, bad_input where it is no record of a finished run
std::vector<FileCheck> check_run(std::filesystem::path const& run_folder);

}  // namespace clathra
