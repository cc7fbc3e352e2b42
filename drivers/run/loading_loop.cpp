#include "run/shear_loop.hpp"

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

void ShearLoop::run(BiaxialTest& test, double preparing_seconds) {
  RunRecord& record = session_.record();
  Ranks const& ranks = session_.ranks();
  std::optional<FoundCheckpoint> const& resumed = session_.resumed_from();
  files_.emplace(session_.folder(), session_.scene(), ranks, test, resumed ? std::optional(resumed->progress) : std::nullopt);
  Speedometer const clock(test.fraction());
  std::int64_t const steps_before = test.loading_disc_steps();
  std::map<std::string, double> before = record.wall_seconds;
  double const searching_before = test.search_seconds(), every = session_.limits().checkpoint_every;
  if (!resumed) {
    files_->write_consolidation(test.consolidation());
    write_record_of(test);
  }
  if (!resumed && every > 0 && ranks.any(preparing_seconds > 0.05 * every)) write_checkpoint(test);
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

void ShearLoop::write_record_of(BiaxialTest& test) {
  reporter_.add(test.record());
  bool const keeps_energy = session_.scene().output.energy;
  EnergyRow const energy = keeps_energy ? test.energy() : EnergyRow();
  if (keeps_energy) reporter_.add(energy);
  files_->write(test, reporter_.last(), energy);
}

/// Looks, about four times a second, whether the run is to stop or a checkpoint is due. All ranks decide alike.
void ShearLoop::poll(BiaxialTest& test) {
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

void ShearLoop::write_checkpoint(BiaxialTest& test) {
  Speedometer const clock;
  RunProgress const progress = files_->flushed();
  return_free_memory();
  session_.checkpoints().write(session_.scene(), test.state(), reporter_.last().step, progress);
  session_.record().wall_seconds["checkpoints"] += clock.seconds();
  last_checkpoint_ = wall_.seconds();
}

}  // namespace clathra
