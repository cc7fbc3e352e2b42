#include "run/run_files.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "domain/scene/hydrate.hpp"
#include "io/errors/rank_errors.hpp"

namespace clathra {
namespace {

constexpr double strain_slack = 1e-9;  // of the interval: strains are sums of many steps

}  // namespace

RunFiles::RunFiles(std::filesystem::path folder, Scene const& scene, Ranks ranks, BiaxialTest const& test,
                   std::optional<RunProgress> const& before)
    : folder_(std::move(folder)), ranks_(std::move(ranks)), output_(scene.output) {
  on_root(ranks_, [&] {
    bool const events = output_.events && has_bonds(scene);
    if (before) {
      history_.emplace(folder_ / "history.csv", before->history.bytes);
      if (events) events_.emplace(folder_ / "events.csv", before->events.bytes);
    } else {
      history_.emplace(folder_ / "history.csv", output_.energy, changes_hydrate(stages_of(scene)));
      if (events) events_.emplace(folder_ / "events.csv", output_.event_details);
    }
  });
  if (!output_.takes_snapshots()) return;
  std::vector<SnapshotEntry> const snapshots = before ? before->snapshots : std::vector<SnapshotEntry>();
  snapshots_.emplace(folder_, ranks_, snapshots, output_.lossless_snapshots ? SnapshotNumbers::full : SnapshotNumbers::rounded);
  if (output_.snapshots > 0) interval_ = planned_path(scene) / output_.snapshots;
  if (!before || test.consolidates()) return;
  since_snapshot_ = test.events_after(snapshots.empty() ? -1 : snapshots.back().step);
  if (interval_ > 0) regular_ = 1 + static_cast<int>(std::floor(test.path_of_last_record() / interval_ + strain_slack));
  auto const& strains = output_.snapshots_at;
  given_ = static_cast<std::size_t>(std::upper_bound(strains.begin(), strains.end(), test.path()) - strains.begin());
}

/// The bonds that broke since the last call, into the rows and towards the next snapshot.
void RunFiles::take_events(BiaxialTest& test) {
  BreakEvents const broken = test.take_events();
  since_snapshot_.detailed = broken.detailed;
  on_root(ranks_, [&] {
    if (events_) events_->write(test.stage().name, broken);
    if (output_.takes_snapshots()) since_snapshot_.add(broken);
  });
}

/// On rank 0.
void RunFiles::write_row(HistoryRow const& row, EnergyRow const& energy) {
  if (output_.energy)
    history_->write(row, energy);
  else
    history_->write(row);
}

void RunFiles::write_consolidation(HistoryRow const& row) {
  EnergyRow none;
  for_each_energy_column(none, [](char const*, double& value) { value = std::numeric_limits<double>::quiet_NaN(); });
  on_root(ranks_, [&] { write_row(row, none); });
}

void RunFiles::write(BiaxialTest& test, HistoryRow const& row, EnergyRow const& energy) {
  on_root(ranks_, [&] { write_row(row, energy); });
  take_events(test);
  bool const regular = interval_ > 0 && test.path_of_last_record() >= (regular_ - strain_slack) * interval_;
  bool const given = test.path_of_last_record() >= next_snapshot_at();
  if (!regular && !given) return;
  write_snapshot(test);
  if (regular) ++regular_;
}

double RunFiles::next_snapshot_at() const {
  return given_ < output_.snapshots_at.size() ? output_.snapshots_at[given_] : std::numeric_limits<double>::infinity();
}

void RunFiles::write_snapshot_at(BiaxialTest& test) {
  if (test.path() < next_snapshot_at()) return;
  take_events(test);
  write_snapshot(test);
}

void RunFiles::write_snapshot(BiaxialTest& test) {
  Snapshot snapshot = test.snapshot();
  snapshot.events = std::exchange(since_snapshot_, {});
  while (next_snapshot_at() <= snapshot.path) ++given_;
  snapshots_->write(snapshot);
}

RunProgress RunFiles::flushed() const {
  RunProgress progress;
  on_root(ranks_, [&] {
    progress.history = history_->flushed();
    if (events_) progress.events = events_->flushed();
    flush_run_folder(folder_);
  });
  if (snapshots_) progress.snapshots = snapshots_->entries();
  return progress;
}

void RunFiles::close() {
  on_root(ranks_, [&] {
    history_->close();
    if (events_) events_->close();
  });
}

void flush_run_folder(std::filesystem::path const& folder) {
  std::error_code ignored;
  flush_folder(folder);
  if (std::filesystem::is_directory(folder / "snap", ignored)) flush_folder(folder / "snap");
}

}  // namespace clathra
