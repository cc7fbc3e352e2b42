#pragma once
/// Snapshots of a run: one immutable HDF5 file each, and two XDMF index files that ParaView opens.
#include <filesystem>
#include <vector>

#include "domain/measurement/snapshot.hpp"
#include "domain/parallel/ranks.hpp"

namespace clathra {

/// What becomes of the numbers of a snapshot in its file. `rounded`: to the resolution that stands beside each column as the
/// attribute `resolution`; a snapshot shows a state, a specimen file (specimen.h5, final.h5) continues it. `full`: every digit of
/// positions, forces, moments, gaps and widths, the other columns in single precision; `resolution` is 0.
enum class SnapshotNumbers { rounded, full };

/// Writes a snapshot. Discs and pairs keep their spatial order, in which they compress best; `particles/id` is their identity.
/// @throws FileProblem cannot_create or io_error
/// @param snapshot  this rank's part; events on rank 0 only
void write_snapshot(std::filesystem::path const& path, Snapshot const& snapshot, Ranks const& ranks = {},
                    SnapshotNumbers numbers = SnapshotNumbers::rounded);

/// @throws FileProblem file_missing, or bad_input where the file is damaged, no snapshot, or of another version
Snapshot read_snapshot(std::filesystem::path const& path);

/// Whether an HDF5 file says that it is a snapshot. @throws FileProblem file_missing, or bad_input where it is no HDF5 file
bool is_snapshot(std::filesystem::path const& path);

/// The snapshots of a run's folder in the order of their steps; none where there are none.
std::vector<std::filesystem::path> snapshot_files(std::filesystem::path const& run_folder);

/// A snapshot of a run, as its index files name it.
struct SnapshotEntry {
  std::string file;  ///< relative to the run's folder
  std::int64_t step;
  double path;
  std::size_t discs, pairs;
};

/// The snapshots of a run, written under RUN/snap/, with RUN/particles.xdmf and RUN/contacts.xdmf brought up to date after each.
class SnapshotSeries {
 public:
  /// @param before  those that a resumed run has already;  @throws FileProblem cannot_create
  explicit SnapshotSeries(std::filesystem::path run_folder, Ranks ranks = {}, std::vector<SnapshotEntry> before = {},
                          SnapshotNumbers numbers = SnapshotNumbers::rounded);
  std::vector<SnapshotEntry> const& entries() const { return entries_; }
  void write(Snapshot const& snapshot);  ///< @throws FileProblem

 private:
  std::string particles_index() const;
  std::string contacts_index() const;

  std::filesystem::path folder_;
  Ranks ranks_;
  std::vector<SnapshotEntry> entries_;
  SnapshotNumbers numbers_;  ///< of all of them
};

}  // namespace clathra
