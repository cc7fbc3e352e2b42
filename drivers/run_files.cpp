#include "run_files.hpp"

#include <utility>

#include "domain/scene/hydrate.hpp"
#include "io/errors/rank_errors.hpp"

namespace clathra {

RunFiles::RunFiles(std::filesystem::path folder, Scene const& scene, Ranks ranks, BiaxialTest const& test,
                   std::optional<RunProgress> const& before)
    : folder_(std::move(folder)), ranks_(std::move(ranks)), output_(scene.output) {
  on_root(ranks_, [&] {
    bool const events = output_.events && has_bonds(scene);
    if (before) {
      history_.emplace(folder_ / "history.csv", before->history.bytes);
      if (events) events_.emplace(folder_ / "events.csv", before->events.bytes);
    } else {
      history_.emplace(folder_ / "history.csv", output_.energy);
      if (events) events_.emplace(folder_ / "events.csv");
    }
  });
  if (output_.snapshots == 0) return;
  std::vector<SnapshotEntry> const snapshots = before ? before->snapshots : std::vector<SnapshotEntry>();
  snapshots_.emplace(folder_, ranks_, snapshots, output_.full_precision ? SnapshotNumbers::full : SnapshotNumbers::rounded);
  if (before) since_snapshot_ = test.events_after(snapshots.empty() ? -1 : snapshots.back().step);
}

void RunFiles::write(BiaxialTest& test, HistoryRow const& row, EnergyRow const& energy) {
  std::vector<BreakEvent> const broken = test.take_events();
  on_root(ranks_, [&] {
    if (output_.energy)
      history_->write(row, energy);
    else
      history_->write(row);
    if (events_) events_->write(broken);
    if (output_.snapshots > 0) since_snapshot_.insert(since_snapshot_.end(), broken.begin(), broken.end());
  });
  if (snapshots_) write_snapshot_if_due(test);
}

void RunFiles::write_snapshot_if_due(BiaxialTest& test) {
  double const next = static_cast<double>(snapshots_->entries().size()) / output_.snapshots;
  if (test.strain_fraction() < next - 1e-9) return;
  Snapshot snapshot = test.snapshot();
  snapshot.events = std::exchange(since_snapshot_, {});
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
