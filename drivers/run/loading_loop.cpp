#include "run/loading_loop.hpp"

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <algorithm>
#include <cmath>

#include "machine/interrupt.hpp"

namespace clathra {

void return_free_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

void LoadingLoop::open_files(BiaxialTest const& test) {
  if (files_) return;
  std::optional<FoundCheckpoint> const& resumed = session_.resumed_from();
  goes_on_ = resumed && !test.consolidates();
  files_.emplace(session_.folder(), session_.scene(), session_.ranks(), test,
                 resumed ? std::optional(resumed->progress) : std::nullopt);
}

void LoadingLoop::write_consolidation_row(HistoryRow const& row) {
  reporter_.add(row);
  files_->write_consolidation(row);
}

void LoadingLoop::consolidate(BiaxialTest& test) {
  if (!test.consolidates()) return;
  open_files(test);
  double& seconds = session_.record().wall_seconds["prepare"];
  double const before = seconds;
  Speedometer const clock(test.consolidation_progress().fraction);
  std::int64_t const steps_before = test.disc_steps();
  if (!session_.resumed_from()) write_consolidation_row(test.record());
  while (test.consolidates()) {
    bool const due = test.advance(pace_);
    seconds = before + clock.seconds();
    if (!test.consolidates()) break;  // the row is the first of the loading
    if (due) write_consolidation_row(test.record());
    reporter_.say_new_warnings(test);
    reporter_.show(test.consolidation_progress(), clock, steps_before);
    poll(test);
  }
}

void LoadingLoop::load(BiaxialTest& test, double preparing_seconds) {
  RunRecord& record = session_.record();
  open_files(test);
  Speedometer const clock(test.fraction());
  std::int64_t const steps_before = test.loading_disc_steps();
  std::map<std::string, double> before = record.wall_seconds;
  double const searching_before = test.search_seconds(), every = session_.limits().checkpoint_every;
  if (!goes_on_) {
    for (HistoryRow const& row : test.consolidation()) write_consolidation_row(row);
    write_record_of(test);
    if (every > 0 && session_.ranks().any(preparing_seconds > 0.05 * every)) write_checkpoint(test);
  }
  while (!test.finished()) {
    if (test.advance(pace_, files_->next_snapshot_at())) write_record_of(test);
    reporter_.say_new_warnings(test);
    files_->write_snapshot_at(test);
    record.disc_steps = test.loading_disc_steps();
    record.wall_seconds["shear"] = before["shear"] + clock.seconds();
    record.wall_seconds["neighbour_searches"] = before["neighbour_searches"] + test.search_seconds() - searching_before;
    record.disc_steps_per_second = static_cast<double>(record.disc_steps - steps_before) / clock.seconds();
    reporter_.show(test, clock.text(test.fraction(), record.disc_steps - steps_before));
    poll(test);
  }
  if (session_.keeps_checkpoint()) write_checkpoint(test);
  files_->close();
}

void LoadingLoop::write_record_of(BiaxialTest& test) {
  reporter_.add(test.record());
  bool const keeps_energy = session_.scene().output.energy;
  EnergyRow const energy = keeps_energy ? test.energy() : EnergyRow();
  if (keeps_energy) reporter_.add(energy);
  files_->write(test, reporter_.last(), energy);
}

/// Looks, about four times a second, whether the run is to stop or a checkpoint is due. All ranks decide alike.
void LoadingLoop::poll(BiaxialTest& test) {
  constexpr double poll_interval = 0.25;  // [s]
  RunLimits const& limits = session_.limits();
  double const now = wall_.seconds();
  bool const due = limits.checkpoint_every > 0 && now - last_checkpoint_ > limits.checkpoint_every;
  double request[] = {now - last_glance_, due ? 1.0 : 0.0, interrupted() ? 1.0 : 0.0,
                      limits.most_seconds > 0 && now > limits.most_seconds ? 1.0 : 0.0};
  session_.ranks().max(request, 4);
  last_glance_ = now;
  // A record that is due cuts a stretch short: it says little of the pace.
  constexpr double most = 100000;
  pace_ = std::llround(std::clamp(static_cast<double>(pace_) * poll_interval / std::max(request[0], 1e-6), 1.0,
                                  std::min(4.0 * static_cast<double>(pace_), most)));
  bool const stop = request[2] + request[3] > 0 && !test.finished();
  if (stop || request[1] > 0) write_checkpoint(test);
  if (stop) throw Stopped(request[2] > 0 ? "by a signal" : "as its wall time is over");
}

void LoadingLoop::write_checkpoint(BiaxialTest& test) {
  Speedometer const clock;
  RunProgress const progress = files_->flushed();
  return_free_memory();
  session_.checkpoints().write(session_.scene(), test.state(), reporter_.last().step, progress);
  session_.record().wall_seconds["checkpoints"] += clock.seconds();
  last_checkpoint_ = wall_.seconds();
}

}  // namespace clathra
