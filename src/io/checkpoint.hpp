#pragma once
/// Checkpoints of a run: two alternating generations, each an HDF5 file of full precision and a manifest that vouches for it.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "domain/experiment.hpp"
#include "io/snapshot_file.hpp"

namespace clathra {

/// Where the files of a run stood when a checkpoint was written.
struct RunProgress {
  std::uintmax_t history_bytes = 0, events_bytes = 0;
  std::vector<SnapshotEntry> snapshots;
};

/// A checkpoint whose manifest and content agree.
struct FoundCheckpoint {
  std::filesystem::path file;
  int generation = 0;  ///< 0 or 1
  std::int64_t sequence = 0;
  std::int64_t step = 0;  ///< of the shear
  std::string digest;
  RunProgress progress;
};

/// Writes under RUN/ckpt/ by turns; the older generation stays until the newer one is whole.
class CheckpointSeries {
 public:
  /// @param last  the checkpoint that the run goes on from, if any: it is not overwritten first
  CheckpointSeries(std::filesystem::path run_folder, Ranks ranks, std::optional<FoundCheckpoint> const& last);
  /// @throws FileProblem
  void write(Scene const& scene, TestState const& state, std::int64_t step, RunProgress const& progress);
  std::int64_t written() const { return written_; }

 private:
  std::filesystem::path folder_;
  Ranks ranks_;
  int generation_ = 0;
  std::int64_t sequence_ = 0, written_ = 0;
};

/// The newest checkpoint of a run's folder whose size and digest are those of its manifest; nothing where there is none at all.
/// @throws FileProblem file_missing where there are some, but none that can be used, with what is wrong with each
/// Rank 0 looks; all learn of what it finds.
std::optional<FoundCheckpoint> find_checkpoint(std::filesystem::path const& run_folder, Ranks const& ranks = {});

/// Whether a folder holds the results of a finished run of this scene.
/// @param resolved  what its resolved.toml must hold;  @throws FileProblem refused where it is a finished run of another scene
bool is_finished_run(std::filesystem::path const& run_folder, std::string const& resolved);

/// This rank's part of a checkpoint.
/// @throws FileProblem bad_input where the content is no checkpoint of this version, or refused where it is one of another scene,
/// with the keys that differ
TestState read_checkpoint(FoundCheckpoint const& checkpoint, Scene const& scene, Ranks const& ranks);

/// The state hash that a checkpoint says it has. @throws FileProblem
std::string checkpoint_state_hash(std::filesystem::path const& file);
/// Whether an HDF5 file says that it is a checkpoint.
bool is_checkpoint(std::filesystem::path const& file);

/// Removes the checkpoints of a finished run.
void remove_checkpoints(std::filesystem::path const& run_folder);

}  // namespace clathra
