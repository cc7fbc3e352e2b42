#include "test_run.hpp"

#include <fmt/format.h>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <algorithm>
#include <cmath>

#include "clathra_version.hpp"
#include "interrupt.hpp"
#include "io/errors/failure.hpp"
#include "io/errors/rank_errors.hpp"
#include "io/formats/text_file.hpp"
#include "io/report/report.hpp"
#include "io/results/earlier_run.hpp"
#include "io/results/output_folder.hpp"
#include "io/results/run_check.hpp"
#include "io/results/specimen_file.hpp"
#include "io/results/specimen_label.hpp"
#include "print.hpp"
#include "resumption.hpp"
#include "run_files.hpp"
#include "specimen_source.hpp"
#include "stage_progress.hpp"
#include "summary.hpp"
#include "threads.hpp"

namespace clathra {

namespace {

/// Gives the system back what earlier stages have freed: an allocator keeps it in pieces that the next stage's arrays do not fit
/// in.
void return_free_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

}  // namespace

class TestRun::Running {
 public:
  Running(LoadedScene input, std::optional<Specimen> specimen, RunLimits const& limits, Ranks const& ranks)
      : ranks_(ranks), limits_(limits), scene_(input.scene), specimen_(std::move(specimen)) {
    label_before_ = specimen_ ? label_of(*specimen_) : specimen_label(scene_, false);
    strain_before_ = specimen_ ? specimen_->axial_strain : 0;
    record_.version = CLATHRA_VERSION;
    record_.git_hash = CLATHRA_GIT_HASH;
    record_.input = std::move(input);
    record_.threads = thread_count(scene_.run.threads);
    record_.ranks = ranks.count();
    on_root(ranks_, [&] {
      lock_.emplace(scene_.output.folder, "run");
      if (std::string const warning = lock_->lock_warning(); !warning.empty()) warn(warning);
      record_.digests = input_digests(scene_);
    });
    folder_ = ranks_.from_root(lock_ ? lock_->path().string() : "");
    if (limits_.resume) look_for_an_earlier_part();
    if (finished_ || resumes()) return;
    on_root(ranks_, [&] {
      if (!limits_.resume && !limits_.overwrite) require_no_kept_run();
      replaces_ = holds_results(folder_);
      std::error_code ignored;
      if (replaces_ && specimen_ && std::filesystem::equivalent(scene_.specimen.file, folder_ / "final.h5", ignored))
        throw FileProblem(ExitCode::refused, scene_.specimen.file,
                          "is a result that the new run would take the place of: copy it elsewhere, or choose another folder");
      forget_next_specimen();  // of a run that was killed
    });
    replaces_ = ranks_.any(replaces_);
    checkpoints_.emplace(folder_, ranks_, std::nullopt);
    if (limits_.resume) line_.note("clathra: there is no checkpoint yet, so the run starts from the beginning");
    for (FileProblem const& problem : found_.damaged) warn(std::string("a checkpoint is not used: ") + problem.what());
  }

  void warn(std::string const& text) { line_.warn(text); }

  /// @throws whatever ended the run, after run.json says so
  ExitCode run() {
    if (finished_) {
      if (!keeps_checkpoint()) on_root(ranks_, [&] { remove_checkpoints(folder_); });  // a kill came between
      return print_result(fmt::format("this run is finished: {}\n", folder_.string()));
    }
    if (!resumes() && !replaces_) take_folder();
    try {
      shear();
      on_root(ranks_, [&] { record_.result_digests = result_digests(folder_); });
    } catch (Stopped const& stop) {
      return stopped(stop.what());
    } catch (Diverged const& fault) {
      return diverged(fault);
    } catch (...) {
      Failure const failure = failure_in_flight();
      if (!failure.everywhere && !ranks_.alone()) end_all_ranks(ranks_, FileProblem(failure.code, failure.text));
      return fail(failure.code, failure.text);
    }
    conclude(ExitCode::done, "finished");
    on_root(ranks_, [&] {
      flush_run_folder(folder_);
      if (keeps_checkpoint())
        checkpoints_->keep_newest();
      else
        remove_checkpoints(folder_);  // last: what is finished and on the disk needs them no more
    });
    line_.repeat_warnings();
    print_result(start_text(record_.stages.at("prepare"), scene_.test.confining_stress) +
                 summary_->text(record_.stages.at("shear").at("sigma3_held")) +
                 fmt::format("results   {}\n", folder_.string()));  // a closed stdout is no failure of the run
    return ExitCode::done;
  }

 private:
  bool keeps_checkpoint() const { return scene_.output.keep_checkpoint && limits_.checkpoint_every > 0; }
  bool resumes() const { return !found_.usable.empty(); }

  void look_for_an_earlier_part() {
    on_root(ranks_, [&] { finished_ = earlier_run(folder_, scene_, record_.digests) == EarlierRun::finished; });
    finished_ = ranks_.any(finished_);
    if (!finished_) found_ = find_checkpoints(folder_, ranks_);
  }

  void require_no_kept_run() const {
    if (std::optional<KeptRun> const kept = kept_run(folder_))
      throw FileProblem(ExitCode::refused, folder_,
                        fmt::format("holds {}: --output names another folder, {}--overwrite puts the new run in its place",
                                    kept->what, kept->can_go_on ? "--resume goes on with it, " : ""));
  }

  void forget_next_specimen() const {
    std::error_code none;
    std::filesystem::remove(folder_ / next_specimen, none);
  }

  /// What the folder held goes, and the run's own files begin: at once where no result is lost, else when the specimen is ready
  /// to be sheared, after which no guard of the preparation can refuse it.
  void take_folder() {
    on_root(ranks_, [&] {
      lock_->clear(scene_.specimen.file);
      if (replaces_ && !scene_.specimen.is_read()) std::filesystem::rename(folder_ / next_specimen, folder_ / "specimen.h5");
    });
    begin_record();
  }

  /// From here on the folder is that of this run. A run that is resumed must first have understood its checkpoint.
  void begin_record() {
    on_root(ranks_, [&] {
      replace_text_file(folder_ / "input.toml", record_.input.source);
      replace_text_file(folder_ / "resolved.toml", resolved_scene(scene_, folder_));
      write_record(ExitCode::done, "running");
    });
    begun_ = true;
  }

  void make_specimen() {
    if (specimen_) return;
    specimen_ = generate_recorded(scene_, line_, record_, ranks_);
    write_specimen(folder_ / (replaces_ ? next_specimen : "specimen.h5"), *specimen_, ranks_);
  }

  std::unique_ptr<BiaxialTest> prepared_test() {
    if (resumes()) return resumed_test();
    make_specimen();
    auto test = std::make_unique<BiaxialTest>(scene_, std::move(*specimen_), show_stage(line_, ranks_), ranks_);
    specimen_.reset();
    return_free_memory();
    if (replaces_) take_folder();
    return test;
  }

  std::unique_ptr<BiaxialTest> resumed_test() {
    Resumption resumed = resume_run(found_, folder_, scene_, ranks_);
    resumed_ = resumed.checkpoint;
    for (std::string const& problem : resumed.passed_over) warn("a checkpoint is passed over: " + problem);
    line_.note(fmt::format("clathra: goes on from step {} of the shear", resumed_->step));
    record_.checkpoint_digest = resumed_->digest;
    on_root(ranks_, [&] { earlier_ = earlier_sessions(folder_); });
    if (!earlier_.generate.empty()) record_.stages["generate"] = earlier_.generate;
    record_.layer_void_ratios = earlier_.layer_void_ratios;
    record_.wall_seconds = earlier_.wall_seconds;
    checkpoints_.emplace(folder_, ranks_, resumed_);
    for (HistoryEntry const& entry : resumed.history) {
      last_ = entry.row;
      summary_->add(entry.row);
      if (entry.energy) summary_->add(*entry.energy);
    }
    begin_record();
    return std::move(resumed.test);
  }

  /// Bonds, consolidates, shears and writes what comes out.
  void shear() {
    summary_.emplace();
    Speedometer const preparing;
    std::unique_ptr<BiaxialTest> const test = prepared_test();
    bool const generated = !resumed_ && record_.wall_seconds.contains("generate");
    record_.wall_seconds["prepare"] += preparing.seconds() - (generated ? record_.wall_seconds.at("generate") : 0);
    record_.stages["prepare"] = test->preparation();
    record_.stages["plan"] = plan_of(*test);
    for (std::string const& warning : test->warnings()) warn(warning);
    try {
      write_curves(*test, preparing.seconds());
    } catch (...) {
      record_shear(*test);
      throw;
    }
    record_shear(*test);
    for (std::string const& warning : test->shear_warnings()) warn(warning);
    for (std::string const& warning : summary_->warnings()) warn(warning);
    record_.state_hash = test->state_hash();
    return_free_memory();
    write_specimen(folder_ / "final.h5", sheared_specimen(*test), ranks_);
  }

  /// The numbers of the shear, and what it has made of the verdict on the whole.
  void record_shear(BiaxialTest const& test) {
    record_.stages["prepare"] = test.preparation();
    record_.stages["shear"] = summary_->numbers();
    record_.stages["shear"].merge(test.shear_checks());
  }

  /// That of the whole test, however often it was stopped or extended.
  StageRecord plan_of(BiaxialTest const& test) const {
    StageRecord plan = earlier_.plan.empty() ? test.plan() : earlier_.plan;
    plan["steps"] = std::ceil(scene_.test.axial_strain / (plan.at("strain_rate_per_s") * plan.at("time_step_s")));
    return plan;
  }

  Specimen sheared_specimen(BiaxialTest const& test) const {
    Specimen specimen = test.specimen();
    specimen.axial_strain = strain_before_ + last_.eps1;
    specimen.provenance = provenance_text(record_, label_after(label_before_, scene_, specimen.critical_thickness > 0));
    return specimen;
  }

  void write_curves(BiaxialTest& test, double preparing_seconds) {
    files_.emplace(folder_, scene_, ranks_, test, resumed_ ? std::optional(resumed_->progress) : std::nullopt, last_.eps1);
    Speedometer const clock(test.strain_fraction());
    std::int64_t const steps_before = test.shear_disc_steps();
    std::map<std::string, double> before = record_.wall_seconds;
    double const searching_before = test.search_seconds();
    if (!resumed_) write_record_of(test);
    // What took long to prepare is kept at once.
    if (!resumed_ && limits_.checkpoint_every > 0 && ranks_.any(preparing_seconds > 0.05 * limits_.checkpoint_every))
      write_checkpoint(test);
    while (!test.finished()) {
      if (test.advance(pace_, files_->next_snapshot_at())) write_record_of(test);
      files_->write_snapshot_at(test);
      record_.disc_steps = test.shear_disc_steps();
      record_.wall_seconds["shear"] = before["shear"] + clock.seconds();
      record_.wall_seconds["neighbour_searches"] = before["neighbour_searches"] + test.search_seconds() - searching_before;
      record_.disc_steps_per_second = static_cast<double>(record_.disc_steps - steps_before) / clock.seconds();
      show(test, clock.text(test.strain_fraction(), record_.disc_steps - steps_before));
      poll(test);
    }
    if (keeps_checkpoint()) write_checkpoint(test);
    files_->close();
  }

  void write_record_of(BiaxialTest& test) {
    last_ = test.record();
    summary_->add(last_);
    EnergyRow const energy = scene_.output.energy ? test.energy() : EnergyRow();
    if (scene_.output.energy) summary_->add(energy);
    files_->write(test, last_, energy);
  }

  /// Looks, about four times a second, whether the run is to stop or a checkpoint is due. All ranks decide alike.
  void poll(BiaxialTest& test) {
    constexpr double poll_interval = 0.25;  // [s]
    double const now = wall_.seconds();
    bool const due = limits_.checkpoint_every > 0 && now - last_checkpoint_ > limits_.checkpoint_every;
    double request[] = {now - last_glance_, due ? 1.0 : 0.0, interrupted() ? 1.0 : 0.0,
                        limits_.most_seconds > 0 && now > limits_.most_seconds ? 1.0 : 0.0};
    ranks_.max(request, 4);
    last_glance_ = now;
    // A record that is due cuts a stretch short: it says little of the pace.
    constexpr double most = 100000;
    pace_ = std::llround(std::clamp(static_cast<double>(pace_) * poll_interval / std::max(request[0], 1e-6), 1.0,
                                    std::min(4.0 * static_cast<double>(pace_), most)));
    bool const stop = request[2] + request[3] > 0 && !test.finished();
    if (stop || request[1] > 0) write_checkpoint(test);
    if (stop) throw Stopped(request[2] > 0 ? "by a signal" : "as its wall time is over");
  }

  void write_checkpoint(BiaxialTest& test) {
    Speedometer const clock;
    RunProgress const progress = files_->flushed();
    return_free_memory();
    checkpoints_->write(scene_, test.state(), last_.step, progress);
    record_.wall_seconds["checkpoints"] += clock.seconds();
    last_checkpoint_ = wall_.seconds();
  }

  void show(BiaxialTest const& test, std::string const& speed) {
    std::string text = fmt::format("eps1 {:.1f}/{:g}% | {} | q {:.3g} MPa", last_.eps1 * 100, scene_.test.axial_strain * 100,
                                   speed, last_.q_Pa * 1e-6);
    if (last_.bonds_intact_pct > 0) text += fmt::format(" | intact {:.0f}%", last_.bonds_intact_pct);
    line_.show("shear", test.strain_fraction(), text + fmt::format(" | I {:.1g}", last_.inertial_number));
  }

  void write_record(ExitCode code, std::string const& reason) {
    record_.warnings = line_.warnings();
    record_.exit_code = static_cast<int>(code);
    record_.exit_reason = reason;
    write_run_record(folder_ / "run.json", record_);
  }

  /// run.json, then the report that draws on it. That there can be no report is a warning and loses nothing else.
  void conclude(ExitCode code, std::string const& reason) {
    if (!begun_) return on_root(ranks_, [&] { forget_next_specimen(); });
    on_root(ranks_, [&] {
      write_record(code, reason);
      if (!summary_ || summary_->records() < 2) return;
      try {
        write_report({folder_}, folder_ / "report.html");
      } catch (std::exception const& problem) {
        warn(fmt::format("there is no report: {}", problem.what()));
        write_record(code, reason);
      }
    });
  }

  /// All ranks diverge alike. What the disc was surrounded by is written for ParaView.
  ExitCode diverged(Diverged const& fault) {
    std::string text = std::string("diverged: ") + fault.what();
    if (fault.around && begun_) try {
        SnapshotSeries(folder_ / "diverged", ranks_, {}, SnapshotNumbers::full).write(*fault.around);
        text += fmt::format("; its surroundings are in {} (ParaView)", (folder_ / "diverged" / "particles.xdmf").string());
      } catch (FileProblem const& problem) {
        warn(fmt::format("the surroundings of the particle cannot be written: {}", problem.what()));
      }
    return fail(ExitCode::diverged, text);
  }

  ExitCode stopped(std::string const& cause) {
    bool const kept = resumes() || checkpoints_->written() > 0;
    ExitCode const code = kept ? ExitCode::to_be_resumed : ExitCode::interrupted;
    std::string const where = kept ? fmt::format("stopped {} at an axial strain of {:.3g} %", cause, last_.eps1 * 100) : cause;
    conclude(code, where);
    line_.repeat_warnings();
    line_.note("clathra: " + where + what_remains() + (kept ? ", and --resume goes on" : ""));
    return code;
  }

  std::string what_remains() const {
    if (begun_) return "; what was written so far is in " + folder_.string();
    return replaces_ ? "; the earlier run in " + folder_.string() + " is as it was" : "";
  }

  /// The first failure counts: that the record cannot be written either (full disk) changes neither message nor code.
  ExitCode fail(ExitCode code, std::string const& reason) {
    line_.repeat_warnings();
    line_.note("clathra: " + reason + (begun_ ? "" : what_remains()));
    try {
      conclude(code, reason);
    } catch (FileProblem const& problem) {
      line_.note(fmt::format("clathra: {}", problem.what()));
    }
    return code;
  }

  Ranks ranks_;
  RunLimits limits_;
  Scene scene_;
  std::optional<Specimen> specimen_;
  EarlierSessions earlier_;           // of a run that goes on; on rank 0
  SceneTexts label_before_;           // of the specimen before this test
  double strain_before_ = 0;          // axial, of earlier tests
  std::optional<OutputFolder> lock_;  // on rank 0
  std::filesystem::path folder_;
  RunRecord record_;
  ProgressLine line_;
  std::optional<Summary> summary_;
  HistoryRow last_;
  std::optional<RunFiles> files_;
  FoundCheckpoints found_;                  // none where the run begins anew
  std::optional<FoundCheckpoint> resumed_;  // the one of them that it goes on from
  std::optional<CheckpointSeries> checkpoints_;
  Speedometer wall_;
  double last_glance_ = 0, last_checkpoint_ = 0;  // [s]
  bool begun_ = false;                            // the folder is that of this run
  bool replaces_ = false;                         // it holds results of an earlier one, which go when this one has its own
  bool finished_ = false;                         // already, when the run was to resume
  std::int64_t pace_ = 16;                        // steps between two glances at clock and signals
};

TestRun::TestRun(LoadedScene input, std::optional<Specimen> specimen, RunLimits const& limits, Ranks const& ranks)
    : running_(std::make_unique<Running>(std::move(input), std::move(specimen), limits, ranks)) {}
TestRun::~TestRun() = default;
void TestRun::warn(std::string const& text) { running_->warn(text); }
ExitCode TestRun::run() { return running_->run(); }

}  // namespace clathra
