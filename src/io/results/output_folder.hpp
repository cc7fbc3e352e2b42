#pragma once
/// The folder of one run's results.
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace clathra {

/// Names of the files that a run leaves in its folder, besides its snapshots.
std::span<std::string_view const> result_files();

/// Makes the folder and locks it against a second run.
class OutputFolder {
 public:
  /// @throws FileProblem cannot_create (no right to write, another run is writing), or refused: the folder is a link, or holds
  /// files but no run of Clathra
  explicit OutputFolder(std::filesystem::path folder);
  ~OutputFolder();
  OutputFolder(OutputFolder const&) = delete;
  OutputFolder& operator=(OutputFolder const&) = delete;

  /// Removes the results of an earlier run. @param keep  a file that stays (the specimen that the run reads)
  void clear(std::filesystem::path const& keep) const;
  std::filesystem::path operator/(std::string const& name) const { return folder_ / name; }
  std::filesystem::path const& path() const { return folder_; }
  /// Whether the lock holds: some file systems of clusters know no locks, and then nothing keeps a second run out.
  bool held() const { return held_; }

 private:
  std::filesystem::path folder_;
  int lock_ = -1;
  bool held_ = false;
};

/// Whether a run is writing into a folder now, as far as locks can tell.
bool folder_in_use(std::filesystem::path const& folder);

}  // namespace clathra
