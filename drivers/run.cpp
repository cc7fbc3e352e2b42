/// `clathra run`: from a scene file to a sheared specimen and its curves.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "clathra_version.hpp"
#include "domain/hydrate.hpp"
#include "forecast.hpp"
#include "interrupt.hpp"
#include "io/digest.hpp"
#include "io/events.hpp"
#include "io/history.hpp"
#include "io/output_folder.hpp"
#include "io/report/report.hpp"
#include "io/run_check.hpp"
#include "io/snapshot_file.hpp"
#include "io/specimen_file.hpp"
#include "io/text_file.hpp"
#include "io/together.hpp"
#include "print.hpp"
#include "rank_checks.hpp"
#include "scene_options.hpp"
#include "specimen_source.hpp"
#include "stage_progress.hpp"
#include "summary.hpp"
#include "threads.hpp"
#include "verbs.hpp"

namespace clathra {
namespace {

struct RunOptions {
  SceneOptions scene;
  std::string output;
  bool dry_run = false;
};

/// One run with its folder, its record and what the user sees of it.
class Run {
 public:
  Run(LoadedScene input, std::optional<Specimen> specimen, Ranks const& ranks)
      : ranks_(ranks), scene_(input.scene), specimen_(std::move(specimen)) {
    record_.version = CLATHRA_VERSION;
    record_.git_hash = CLATHRA_GIT_HASH;
    record_.input = std::move(input);
    record_.threads = thread_count(scene_.run.threads);
    record_.ranks = ranks.count();
    on_root(ranks_, [&] {
      lock_.emplace(scene_.output.folder, scene_.sample.file);
      if (specimen_) record_.specimen_digest = file_digest(scene_.sample.file);
    });
    folder_ = ranks_.from_root(lock_ ? lock_->path().string() : "");
  }

  void warn(std::string const& text) { line_.warn(text); }

  /// @throws whatever ended the run, after run.json says so
  ExitCode run() {
    on_root(ranks_, [&] {
      replace_text_file(folder_ / "input.toml", record_.input.source);
      replace_text_file(folder_ / "resolved.toml", resolved_scene(scene_, folder_));
      write_record(ExitCode::done, "running");
    });
    try {
      KokkosSession const kokkos;
      make_specimen();
      shear();
      on_root(ranks_, [&] { record_.result_digests = result_digests(folder_); });
    } catch (Stopped const&) {
      return stopped();
    } catch (Diverged const& problem) {
      return fail(ExitCode::diverged, fmt::format("diverged: {}", problem.what()));
    } catch (Refused const& problem) {
      return fail(ExitCode::refused, fmt::format("refused: {}", problem.what()));
    } catch (FileProblem const& problem) {
      return fail(problem.code, problem.what());
    } catch (std::bad_alloc const&) {
      return fail_here(ExitCode::refused, "refused: not enough memory");
    } catch (std::exception const& problem) {
      return fail_here(ExitCode::internal, fmt::format("internal fault, please report it: {}", problem.what()));
    }
    conclude(ExitCode::done, "finished");
    line_.repeat_warnings();
    print_result(summary_->text() + fmt::format("results   {}\n", folder_.string()));  // a closed stdout is no failure of the run
    return ExitCode::done;
  }

 private:
  void make_specimen() {
    if (specimen_) return;
    specimen_ = generate_recorded(scene_, show_stage(line_, ranks_), record_, ranks_);
    write_specimen(folder_ / "specimen.h5", *specimen_, ranks_);
  }

  /// Bonds, consolidates, shears and writes what comes out.
  void shear() {
    Speedometer const preparing;
    BiaxialTest test(scene_, *specimen_, show_stage(line_, ranks_), ranks_);
    specimen_.reset();
    record_.wall_seconds["prepare"] = preparing.seconds();
    record_.stages["prepare"] = test.preparation();
    record_.stages["plan"] = test.plan();
    for (std::string const& warning : test.warnings()) warn(warning);
    summary_.emplace(scene_.test.confining_stress, scene_.test.axial_strain);
    try {
      write_curves(test);
    } catch (...) {
      record_.stages["shear"] = summary_->numbers();
      throw;
    }
    record_.stages["shear"] = summary_->numbers();
    record_.state_hash = test.state_hash();
    write_specimen(folder_ / "final.h5", test.specimen(), ranks_);
  }

  void write_curves(BiaxialTest& test) {
    on_root(ranks_, [&] {
      history_.emplace(folder_ / "history.csv", scene_.output.energy);
      if (scene_.output.events && has_bonds(scene_)) events_.emplace(folder_ / "events.csv");
    });
    std::optional<SnapshotSeries> snapshots;
    if (scene_.output.snapshots > 0) snapshots.emplace(folder_, ranks_);
    Speedometer const clock;
    std::int64_t const steps_before = test.disc_steps();
    auto const write_all = [&] {
      write_row(test);
      if (snapshots) write_snapshot_if_due(test, *snapshots);
    };
    for (write_all(); !test.finished(); write_all()) {
      if (ranks_.any(interrupted())) throw Stopped("stopped by Ctrl-C");
      test.advance_to_next_record();
      record_.disc_steps = test.disc_steps() - steps_before;
      record_.wall_seconds["shear"] = clock.seconds();
      record_.disc_steps_per_second = static_cast<double>(record_.disc_steps) / clock.seconds();
      show(test, clock.text(test.strain_fraction(), record_.disc_steps));
    }
    on_root(ranks_, [&] {
      history_->close();
      if (events_) events_->close();
    });
  }

  void write_row(BiaxialTest& test) {
    last_ = test.record();
    summary_->add(last_);
    EnergyRow const energy = scene_.output.energy ? test.energy() : EnergyRow();
    if (scene_.output.energy) summary_->add(energy);
    std::vector<BreakEvent> const broken = test.take_events();
    on_root(ranks_, [&] {
      if (scene_.output.energy)
        history_->write(last_, energy);
      else
        history_->write(last_);
      if (events_) events_->write(broken);
      if (scene_.output.snapshots > 0) since_snapshot_.insert(since_snapshot_.end(), broken.begin(), broken.end());
    });
  }

  void write_snapshot_if_due(BiaxialTest& test, SnapshotSeries& snapshots) {
    double const next = static_cast<double>(snapshots_written_) / scene_.output.snapshots;
    if (test.strain_fraction() < next - 1e-9) return;
    Snapshot snapshot = test.snapshot();
    snapshot.events = std::exchange(since_snapshot_, {});
    snapshots.write(snapshot);
    ++snapshots_written_;
  }

  void show(BiaxialTest const& test, std::string const& speed) {
    std::string text = fmt::format("eps1 {:.1f}/{:g}% | {} | q {:.3g} MPa", last_.eps1 * 100, scene_.test.axial_strain * 100,
                                   speed, last_.q_Pa * 1e-6);
    if (last_.intact_initial_pct > 0) text += fmt::format(" | intact {:.0f}%", last_.intact_initial_pct);
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

  /// A fault that the other ranks may not have: they would wait for this one.
  ExitCode fail_here(ExitCode code, std::string const& reason) {
    if (!ranks_.alone()) end_all_ranks(ranks_, FileProblem(code, reason));
    return fail(code, reason);
  }

  ExitCode stopped() {
    conclude(ExitCode::interrupted, fmt::format("stopped by Ctrl-C at an axial strain of {:.3g} %", last_.eps1 * 100));
    line_.repeat_warnings();
    line_.note("clathra: " + record_.exit_reason + "; what was written so far is in " + folder_.string());
    return ExitCode::interrupted;
  }

  /// The first failure counts: that the record cannot be written either (full disk) changes neither message nor code.
  ExitCode fail(ExitCode code, std::string const& reason) {
    line_.repeat_warnings();
    line_.note("clathra: " + reason);
    try {
      conclude(code, reason);
    } catch (FileProblem const& problem) {
      line_.note(fmt::format("clathra: {}", problem.what()));
    }
    return code;
  }

  Ranks ranks_;
  Scene scene_;
  std::optional<Specimen> specimen_;
  std::optional<OutputFolder> lock_;    // on rank 0
  std::optional<HistoryFile> history_;  // on rank 0
  std::optional<EventsFile> events_;    // on rank 0
  std::filesystem::path folder_;
  RunRecord record_;
  ProgressLine line_;
  std::optional<Summary> summary_;
  HistoryRow last_;
  std::vector<BreakEvent> since_snapshot_;
  int snapshots_written_ = 0;
};

ExitCode run(RunOptions const& options) {
  std::vector<std::string> more;
  if (!options.output.empty()) more.push_back("output.folder=" + options.output);
  LoadedScene input = options.scene.load(more);
  if (!options.dry_run) settle_threads(input.scene.run.threads);
  RankSession const session;
  Ranks const& ranks = session.ranks();
  require_same_everywhere(ranks, input);
  std::optional<Specimen> specimen;
  Scene sized = input.scene;
  if (input.scene.sample.generator == Generator::file) {
    specimen = read_specimen(input.scene.sample.file, ranks);
    sized = sized_by(sized, *specimen, ranks.sum(static_cast<std::int64_t>(specimen->size())));
  }
  Forecast const cost = forecast(sized, 0);
  if (options.dry_run) {
    ExitCode const printed = print_result(forecast_text(sized, cost));
    refuse_if_needed(sized, cost);
    return printed;
  }
  refuse_if_needed(sized, cost);
  require_enough_discs(ranks, static_cast<std::int64_t>(cost.numbers.at("particles")));
  watch_for_interrupt();
  std::vector<std::string> const warnings = input.warnings;
  Run now(std::move(input), std::move(specimen), ranks);
  for (std::string const& warning : warnings) now.warn(warning);
  for (std::string const& warning : cost.warnings) now.warn(warning);
  if (sized.run.force)
    for (std::string const& refusal : cost.refusals) now.warn("forced: " + refusal);
  return now.run();
}

}  // namespace

void add_run(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<RunOptions>();
  CLI::App* const verb = program.add_subcommand("run", "Generate, consolidate and shear the specimen of a scene");
  options->scene.add_to(*verb);
  verb->add_option("--output", options->output, "folder of the results (output.folder)")->type_name("DIR");
  verb->add_flag("--dry-run", options->dry_run, "only say what the run will cost");
  verb->footer("Example: clathra run examples/quick.toml --set hydrate.saturation=\"41 %\" --output out/s41");
  verb->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace clathra
