#pragma once
/// The folder of a run and its record: what was there before, what becomes of it, and how the run ended.
#include <filesystem>
#include <optional>
#include <string>

#include "domain/parallel/ranks.hpp"
#include "io/results/checkpoint.hpp"
#include "io/results/earlier_run.hpp"
#include "io/results/output_folder.hpp"
#include "io/results/run_record.hpp"
#include "run/resumption.hpp"
#include "run/run_reporter.hpp"

namespace clathra {

/// How a run is guarded against its own end. Wall time in seconds.
struct RunLimits {
  bool resume = false;            ///< go on from the newest checkpoint, if there is one
  bool overwrite = false;         ///< take the place of an earlier run in the folder
  double most_seconds = 0;        ///< stop with a checkpoint then; 0 = never
  double checkpoint_every = 600;  ///< 0 = never
};

/// All calls are collective but those of const numbers.
class RunSession {
 public:
  /// Takes hold of the output folder, which stays as it is. @throws FileProblem where it is in use, or holds what must be kept
  RunSession(LoadedScene input, RunLimits const& limits, Ranks const& ranks, RunReporter& reporter);

  Scene const& scene() const { return record_.input.scene; }
  Ranks const& ranks() const { return ranks_; }
  RunLimits const& limits() const { return limits_; }
  std::filesystem::path const& folder() const { return folder_; }
  RunRecord& record() { return record_; }
  CheckpointSeries& checkpoints() { return *checkpoints_; }

  bool finished() const { return finished_; }  ///< already, when the run was to resume
  bool resumes() const { return !found_.usable.empty(); }
  bool begun() const { return begun_; }  ///< the folder is that of this run
  bool keeps_checkpoint() const;

  /// The folder becomes that of this run: at once where no result is lost, else with `prepared`, when the specimen is ready to be
  /// sheared, after which no guard of the preparation can refuse it.
  void take_folder(bool prepared);
  /// Where a specimen is to be written that was made for this run.
  std::filesystem::path specimen_file() const;
  /// Takes the newest checkpoint that serves, and from run.json what the sessions before have said.
  Resumption resume();
  std::optional<FoundCheckpoint> const& resumed_from() const { return resumed_; }
  /// That of the whole test, however often it was stopped or extended.
  StageRecord plan_of(BiaxialTest const& test) const;

  /// run.json, then the report that draws on it. That there can be no report is a warning and loses nothing else.
  void conclude(ExitCode code, std::string const& reason);
  /// After a finished run is on the disk.
  void settle_checkpoints();
  /// What is left of the folder, for the line that says why a run ended.
  std::string what_remains() const;

 private:
  void look_for_an_earlier_part();
  void look_at_what_the_folder_holds();
  void begin_record();
  void write_record(ExitCode code, std::string const& reason);
  void forget_next_specimen() const;

  Ranks ranks_;
  RunLimits limits_;
  RunReporter& reporter_;
  RunRecord record_;
  std::optional<OutputFolder> lock_;  // on rank 0
  std::filesystem::path folder_;
  EarlierSessions earlier_;                 // of a run that goes on; on rank 0
  FoundCheckpoints found_;                  // none where the run begins anew
  std::optional<FoundCheckpoint> resumed_;  // the one of them that it goes on from
  std::optional<CheckpointSeries> checkpoints_;
  bool begun_ = false, finished_ = false;
  bool replaces_ = false;  // the folder holds results of an earlier run, which go when this one has its own
};

}  // namespace clathra
