#pragma once
/// The folder of one run's results.
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace clathra {

/// Names of the files that a run leaves in its folder, besides its snapshots.
std::span<std::string_view const> result_files();

/// The specimen of a run that will take the place of an earlier one, until it does.
inline constexpr char next_specimen[] = "specimen.h5.next";

/// Makes the folder with its marker, which says that it holds results of this verb, or makes sure that it is such a one; without
/// a lock: for programs that work in it side by side. @throws FileProblem as OutputFolder does
void claim_folder(std::filesystem::path const& folder, std::string_view verb);

/// Makes the folder and locks it against a second run. A file in it, the marker, says which verb's results it holds.
class OutputFolder {
 public:
  /// @param verb  "run", "study", ...
  /// @throws FileProblem cannot_create: no right to write, another run is writing, the folder is a link, or holds files but no
  /// marker of this verb
  OutputFolder(std::filesystem::path folder, std::string_view verb);
  ~OutputFolder();
  OutputFolder(OutputFolder const&) = delete;
  OutputFolder& operator=(OutputFolder const&) = delete;

  /// Removes the results of an earlier run. @param keep  a file that stays (the specimen that the run reads)
  void clear(std::filesystem::path const& keep) const;
  std::filesystem::path operator/(std::string const& name) const { return folder_ / name; }
  std::filesystem::path const& path() const { return folder_; }
  /// What to warn of where the lock does not hold: some file systems of clusters know no locks. Nothing where it does.
  std::string lock_warning() const;

 private:
  std::filesystem::path folder_;
  int lock_ = -1;
  bool held_ = false;
};

/// Whether a run is writing into a folder now, as far as locks can tell.
bool folder_in_use(std::filesystem::path const& folder);

/// Whether the folder of a run holds what took it time: rows, events, snapshots, specimens, checkpoints. run.json and the scene
/// alone are of a run that came to nothing.
bool holds_results(std::filesystem::path const& run_folder);

}  // namespace clathra
