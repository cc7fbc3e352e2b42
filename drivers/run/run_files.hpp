#pragma once
/// The files of a run that grow while its specimen is loaded: history, events, snapshots.
#include <optional>

#include "io/results/checkpoint.hpp"
#include "io/results/events.hpp"
#include "io/results/history.hpp"
#include "io/results/snapshot_file.hpp"

namespace clathra {

/// All calls are collective; rank 0 writes the rows. All throw FileProblem.
class RunFiles {
 public:
  /// @param before  where the files of a run that goes on stood
  RunFiles(std::filesystem::path folder, Scene const& scene, Ranks ranks, BiaxialTest const& test,
           std::optional<RunProgress> const& before);

  /// A row of the stages before the loading.
  void write_consolidation(HistoryRow const& row);
  /// One record: its row, the bonds that broke since the last one, and a snapshot where one is due.
  /// @param energy  of the same moment, only with scene.output.energy
  void write(BiaxialTest& test, HistoryRow const& row, EnergyRow const& energy);
  /// The path of the axial strain of the next snapshot that has one of its own (output.snapshots_at); infinite where there is
  /// none.
  double next_snapshot_at() const;
  /// Writes it where that strain is reached.
  void write_snapshot_at(BiaxialTest& test);
  /// Where the files stand, after everything has reached the disk.
  RunProgress flushed() const;
  /// Everything has reached the disk then.
  void close();

 private:
  void write_row(HistoryRow const& row, EnergyRow const& energy);
  void take_events(BiaxialTest& test);
  void write_snapshot(BiaxialTest& test);

  std::filesystem::path folder_;
  Ranks ranks_;
  OutputScene output_;
  std::optional<HistoryFile> history_;  // on rank 0
  std::optional<EventsFile> events_;    // on rank 0
  std::optional<SnapshotSeries> snapshots_;
  BreakEvents since_snapshot_;  // on rank 0
  double interval_ = 0;         // of the regular snapshots, in the path of the axial strain
  int regular_ = 0;             // of them have been written
  std::size_t given_ = 0;       // of those with a strain of their own lie behind
};

/// The names of all files of a run's folder reach the disk, as their contents have before. @throws FileProblem io_error
void flush_run_folder(std::filesystem::path const& folder);

}  // namespace clathra
