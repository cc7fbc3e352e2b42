#pragma once
/// A test that goes on: its rows and snapshots, and between them looks at clock, signals and checkpoints that are due.
#include "domain/biaxial/biaxial_test.hpp"
#include "run/run_files.hpp"
#include "run/run_reporter.hpp"
#include "run/run_session.hpp"
#include "run/stage_progress.hpp"

namespace clathra {

class LoadingLoop {
 public:
  LoadingLoop(RunSession& session, RunReporter& reporter) : session_(session), reporter_(reporter) {}

  /// From the beginning of the consolidation, or where the test goes on from, to that of the loading.
  /// @throws Stopped after a checkpoint, where a signal came or the wall time is over; Refused; Diverged; FileProblem
  void consolidate(BiaxialTest& test);
  /// From there, consolidate() or the constructor of the test, to its end. @param preparing_seconds  what took long to prepare is
  /// kept in a checkpoint at once. Throws as consolidate() does.
  void load(BiaxialTest& test, double preparing_seconds);

 private:
  void open_files(BiaxialTest const& test);
  void write_consolidation_row(HistoryRow const& row);
  void write_record_of(BiaxialTest& test);
  void poll(BiaxialTest& test);
  void write_checkpoint(BiaxialTest& test);

  RunSession& session_;
  RunReporter& reporter_;
  std::optional<RunFiles> files_;
  Speedometer wall_;
  double last_glance_ = 0, last_checkpoint_ = 0;  // [s]
  std::int64_t pace_ = 16;                        // steps between two glances at clock and signals
  bool goes_on_ = false;                          // in the loading, from a checkpoint
};

/// Gives the system back what earlier stages have freed: an allocator keeps it in pieces that the next stage's arrays do not fit
/// in.
void return_free_memory();

}  // namespace clathra
