#pragma once
/// The folder of one run's results.
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace clathra {

/// Names of the files that a run leaves in its folder, besides its snapshots.
std::span<std::string_view const> result_files();

/// Makes the folder, locks it against a second run, and clears it of the results of an earlier one.
class OutputFolder {
 public:
  /// @param keep  a file of the folder that is not cleared (the specimen that the run reads)
  /// @throws FileProblem cannot_create (no right to write, another run is writing), or refused: the folder is a link, or holds
  /// files but no run of Clathra
  /// @param resume  keeps all results
  OutputFolder(std::filesystem::path folder, std::filesystem::path const& keep, bool resume = false);
  ~OutputFolder();
  OutputFolder(OutputFolder const&) = delete;
  OutputFolder& operator=(OutputFolder const&) = delete;

  std::filesystem::path operator/(std::string const& name) const { return folder_ / name; }
  std::filesystem::path const& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
  int lock_ = -1;
};

}  // namespace clathra
