#pragma once
/// Checkpoints of a run: two alternating generations, each an HDF5 file of full precision and a manifest that vouches for it.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "domain/biaxial/biaxial_test.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/scene/scene.hpp"
#include "io/errors/problems.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/snapshot_file.hpp"

namespace clathra {

/// Where the files of a run stood when a checkpoint was written.
struct RunProgress {
  RowsWritten history, events;
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
  /// @param last  the checkpoint that the run goes on from, if any: it is not overwritten first, and what a kill of that run left
  /// half written is removed
  CheckpointSeries(std::filesystem::path run_folder, Ranks ranks, std::optional<FoundCheckpoint> const& last);
  /// @throws FileProblem
  void write(Scene const& scene, TestState const& state, std::int64_t step, RunProgress const& progress);
  std::int64_t written() const { return written_; }
  /// Of a finished run: removes the older generation and what a kill left half written.
  void keep_newest() const;

 private:
  std::filesystem::path folder_;
  Ranks ranks_;
  int generation_ = 0;
  std::int64_t sequence_ = 0, written_ = 0;
};

/// What a run's folder holds of checkpoints.
struct FoundCheckpoints {
  std::vector<FoundCheckpoint> usable;  ///< size and digest are those of the manifest; the newest first
  std::vector<FileProblem> damaged;     ///< what is wrong with each of the others; on rank 0 only
};

/// Rank 0 looks; all learn of what it finds. @throws FileProblem file_missing where there are some, but none that can be used,
/// with what is wrong with each
FoundCheckpoints find_checkpoints(std::filesystem::path const& run_folder, Ranks const& ranks = {});

/// The text of several problems, with how the user can go on where no checkpoint of a folder serves.
std::string no_checkpoint_text(std::vector<FileProblem> const& problems);

/// Whether the rows that a run wrote before a checkpoint still stand in its folder as they were.
/// @throws FileProblem file_missing or bad_input where they do not
void require_rows(std::filesystem::path const& run_folder, RunProgress const& progress);

/// This rank's part of a checkpoint.
/// @throws FileProblem bad_input where the content is no checkpoint of this version, refused where it is of another precision,
/// cannot_create where it is one of another scene, with the keys that differ
TestState read_checkpoint(FoundCheckpoint const& checkpoint, Scene const& scene, Ranks const& ranks);

/// The state hash that a checkpoint says it has.
std::string checkpoint_state_hash(std::filesystem::path const& file);
/// Whether an HDF5 file says that it is a checkpoint.
bool is_checkpoint(std::filesystem::path const& file);

/// Whether a folder has a checkpoint, whole or not.
bool has_checkpoints(std::filesystem::path const& run_folder);

/// Removes the checkpoints of a finished run.
void remove_checkpoints(std::filesystem::path const& run_folder);

}  // namespace clathra
