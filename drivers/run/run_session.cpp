#include "run/run_session.hpp"

#include <fmt/format.h>

#include <cmath>

#include "clathra_version.hpp"
#include "io/errors/rank_errors.hpp"
#include "io/formats/text_file.hpp"
#include "io/report/report.hpp"
#include "machine/threads.hpp"

namespace clathra {

RunSession::RunSession(LoadedScene input, RunLimits const& limits, Ranks const& ranks, RunReporter& reporter)
    : ranks_(ranks), limits_(limits), reporter_(reporter) {
  record_.version = CLATHRA_VERSION;
  record_.git_hash = CLATHRA_GIT_HASH;
  record_.input = std::move(input);
  record_.threads = thread_count(scene().run.threads);
  record_.ranks = ranks.count();
  on_root(ranks_, [&] {
    lock_.emplace(scene().output.folder, "run");
    if (std::string const warning = lock_->lock_warning(); !warning.empty()) reporter_.warn(warning);
    record_.digests = input_digests(scene());
  });
  folder_ = ranks_.from_root(lock_ ? lock_->path().string() : "");
  if (limits_.resume) look_for_an_earlier_part();
  if (finished_ || resumes()) return;
  on_root(ranks_, [&] { look_at_what_the_folder_holds(); });
  replaces_ = ranks_.any(replaces_);
  checkpoints_.emplace(folder_, ranks_, std::nullopt);
  if (limits_.resume) reporter_.line().note("clathra: there is no checkpoint yet, so the run starts from the beginning");
  for (FileProblem const& problem : found_.damaged) reporter_.warn(std::string("a checkpoint is not used: ") + problem.what());
}

void RunSession::look_for_an_earlier_part() {
  on_root(ranks_, [&] { finished_ = earlier_run(folder_, scene(), record_.digests) == EarlierRun::finished; });
  finished_ = ranks_.any(finished_);
  if (!finished_) found_ = find_checkpoints(folder_, ranks_);
}

void RunSession::look_at_what_the_folder_holds() {
  if (!limits_.resume && !limits_.overwrite)
    if (std::optional<KeptRun> const kept = kept_run(folder_))
      throw FileProblem(ExitCode::cannot_create, folder_,
                        fmt::format("holds {}: --output names another folder, {}--overwrite puts the new run in its place",
                                    kept->what, kept->can_go_on ? "--resume goes on with it, " : ""));
  replaces_ = holds_results(folder_);
  std::error_code ignored;
  if (replaces_ && scene().specimen.is_read() &&
      std::filesystem::equivalent(scene().specimen.file, folder_ / "final.h5", ignored))
    throw FileProblem(ExitCode::cannot_create, scene().specimen.file,
                      "is a result that the new run would take the place of: copy it elsewhere, or choose another folder");
  forget_next_specimen();  // of a run that was killed
}

bool RunSession::keeps_checkpoint() const { return scene().output.keep_checkpoint && limits_.checkpoint_every > 0; }

void RunSession::forget_next_specimen() const {
  std::error_code none;
  std::filesystem::remove(folder_ / next_specimen, none);
}

std::filesystem::path RunSession::specimen_file() const { return folder_ / (replaces_ ? next_specimen : "specimen.h5"); }

void RunSession::take_folder(bool prepared) {
  if (begun_ || resumes() || prepared != replaces_) return;
  on_root(ranks_, [&] {
    lock_->clear(scene().specimen.file);
    if (replaces_ && !scene().specimen.is_read()) std::filesystem::rename(folder_ / next_specimen, folder_ / "specimen.h5");
  });
  begin_record();
}

/// From here on the folder is that of this run. A run that is resumed must first have understood its checkpoint.
void RunSession::begin_record() {
  on_root(ranks_, [&] {
    replace_text_file(folder_ / "input.toml", record_.input.source);
    replace_text_file(folder_ / "resolved.toml", resolved_scene(scene(), folder_));
    write_record(ExitCode::done, "running");
  });
  begun_ = true;
}

Resumption RunSession::resume() {
  Resumption resumed = resume_run(found_, folder_, scene(), ranks_);
  resumed_ = resumed.checkpoint;
  for (std::string const& problem : resumed.passed_over) reporter_.warn("a checkpoint is passed over: " + problem);
  reporter_.line().note(fmt::format("clathra: goes on from step {} of the {}", resumed_->step,
                                    resumed.test->consolidates() ? "consolidation" : "loading"));
  record_.checkpoint_digest = resumed_->digest;
  on_root(ranks_, [&] { earlier_ = earlier_sessions(folder_); });
  if (!earlier_.generate.empty()) record_.stages["generate"] = earlier_.generate;
  record_.layer_void_ratios = earlier_.layer_void_ratios;
  record_.wall_seconds = earlier_.wall_seconds;
  checkpoints_.emplace(folder_, ranks_, resumed_);
  for (HistoryEntry const& entry : resumed.history) {
    reporter_.add(entry.row);
    if (entry.energy && !is_consolidation(entry.row.stage)) reporter_.add(*entry.energy);
  }
  begin_record();
  return resumed;
}

StageRecord RunSession::plan_of(BiaxialTest const& test) const {
  StageRecord plan = earlier_.plan.empty() ? test.plan() : earlier_.plan;
  plan["steps"] = planned_steps(scene(), plan.at("strain_rate_per_s"), plan.at("time_step_s"));
  return plan;
}

void RunSession::write_record(ExitCode code, std::string const& reason) {
  record_.warnings = reporter_.line().warnings();
  record_.exit_code = static_cast<int>(code);
  record_.exit_reason = reason;
  write_run_record(folder_ / "run.json", record_);
}

void RunSession::conclude(ExitCode code, std::string const& reason) {
  on_root(ranks_, [&] {
    if (!begun_) return forget_next_specimen();
    write_record(code, reason);
    if (reporter_.records() < 2) return;
    try {
      write_report({folder_}, folder_ / "report.html");
    } catch (std::exception const& problem) {
      reporter_.warn(fmt::format("there is no report: {}", problem.what()));
      write_record(code, reason);
    }
  });
}

void RunSession::settle_checkpoints() {
  on_root(ranks_, [&] {
    if (!keeps_checkpoint())
      remove_checkpoints(folder_);
    else if (checkpoints_)
      checkpoints_->keep_newest();
  });
}

std::string RunSession::what_remains() const {
  if (begun_) return "; what was written so far is in " + folder_.string();
  return replaces_ ? "; the earlier run in " + folder_.string() + " is as it was" : "";
}

}  // namespace clathra
