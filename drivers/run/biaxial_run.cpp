#include "run/biaxial_run.hpp"

#include <fmt/format.h>

#include "io/errors/failure.hpp"
#include "io/errors/rank_errors.hpp"
#include "io/results/run_check.hpp"
#include "io/results/specimen_file.hpp"
#include "io/results/specimen_label.hpp"
#include "run/specimen_source.hpp"
#include "run/stage_progress.hpp"
#include "terminal/print.hpp"
#include "terminal/status.hpp"

namespace clathra {

BiaxialRun::BiaxialRun(LoadedScene input, std::optional<Specimen> specimen, RunLimits const& limits, Ranks const& ranks)
    : specimen_(std::move(specimen)),
      label_before_(specimen_ ? label_of(*specimen_) : specimen_label(input.scene, false)),
      strain_before_(specimen_ ? specimen_->axial_strain : 0),
      session_(std::move(input), limits, ranks, reporter_),
      loop_(session_, reporter_) {}

ExitCode BiaxialRun::run() {
  Ranks const& ranks = session_.ranks();
  if (session_.finished()) {
    if (!session_.keeps_checkpoint()) session_.settle_checkpoints();  // a kill came between
    return print_result(fmt::format("this run is finished: {}\n", session_.folder().string()));
  }
  session_.take_folder(false);
  try {
    make_test();
    on_root(ranks, [&] { session_.record().result_digests = result_digests(session_.folder()); });
  } catch (Stopped const& stop) {
    return stopped(stop.what());
  } catch (Diverged const& fault) {
    return diverged(fault);
  } catch (...) {
    Failure const failure = failure_in_flight();
    if (!failure.everywhere && !ranks.alone()) end_all_ranks(ranks, FileProblem(failure.code, failure.text));
    return fail(failure.code, failure.text);
  }
  session_.conclude(ExitCode::done, "finished");
  on_root(ranks, [&] { flush_run_folder(session_.folder()); });
  session_.settle_checkpoints();  // last: what is finished and on the disk needs them no more
  reporter_.say_end(session_.record(), session_.scene().test.confining_stress, session_.folder());
  return ExitCode::done;
}

/// Where the folder still holds an earlier run, its results stay until no guard of the preparation can refuse this one any more.
std::unique_ptr<BiaxialTest> BiaxialRun::test_to_go_on_with() {
  if (session_.resumes()) return std::move(session_.resume().test);
  Scene const& scene = session_.scene();
  if (!specimen_) {
    specimen_ = generate_recorded(scene, reporter_.line(), session_.record(), session_.ranks());
    write_specimen(session_.specimen_file(), *specimen_, session_.ranks());
  }
  auto test = session_.begun()
                  ? std::make_unique<BiaxialTest>(BiaxialTest::to_consolidate(scene, std::move(*specimen_), session_.ranks()))
                  : std::make_unique<BiaxialTest>(scene, std::move(*specimen_), show_stage(reporter_.line(), session_.ranks()),
                                                  session_.ranks());
  specimen_.reset();
  return_free_memory();
  session_.take_folder(true);
  return test;
}

/// Bonds, consolidates, loads and writes what comes out.
void BiaxialRun::make_test() {
  RunRecord& record = session_.record();
  Speedometer const preparing;
  std::unique_ptr<BiaxialTest> const test = test_to_go_on_with();
  bool const generated = !session_.resumed_from() && record.wall_seconds.contains("generate");
  record.wall_seconds["prepare"] += preparing.seconds() - (generated ? record.wall_seconds.at("generate") : 0);
  try {
    loop_.consolidate(*test);
    record.stages["prepare"] = test->preparation();
    record.stages["plan"] = session_.plan_of(*test);
    reporter_.say_new_warnings(*test);
    loop_.load(*test, preparing.seconds());
  } catch (...) {
    record_loading(*test);
    throw;
  }
  record_loading(*test);
  std::vector<StageResult> const stages = test->stage_results();
  for (StageResult const& stage : stages) {
    std::vector<std::string> warnings = stage.warnings, of_curves = reporter_.summary_of(stage.name).warnings();
    warnings.insert(warnings.end(), of_curves.begin(), of_curves.end());
    for (std::string const& warning : warnings)
      warn(stages.size() > 1 ? fmt::format("in stage '{}': {}", stage.name, warning) : warning);
  }
  record.state_hash = test->state_hash();
  return_free_memory();
  write_specimen(session_.folder() / "final.h5", sheared_specimen(*test), session_.ranks());
}

/// The numbers of the stages, and what they have made of the verdict on the whole.
void BiaxialRun::record_loading(BiaxialTest const& test) {
  RunRecord& record = session_.record();
  record.stages["prepare"] = test.preparation();
  if (test.loading_disc_steps() == 0) return;  // it has not begun
  record.stage_ends.clear();
  for (StageResult const& stage : test.stage_results()) {
    StageRecord& numbers = record.stages[stage.name] = reporter_.summary_of(stage.name).numbers();
    numbers.insert(stage.numbers.begin(), stage.numbers.end());
    for (LoadingStage const& asked : stages_of(session_.scene()))
      if (asked.name == stage.name) numbers.merge(loading_numbers(asked, reporter_.summary_of(stage.name).curves()));
    record.stage_ends.push_back({stage.name, stage.ended_by});
  }
}

Specimen BiaxialRun::sheared_specimen(BiaxialTest const& test) {
  Specimen specimen = test.specimen();
  specimen.axial_strain = strain_before_ + reporter_.last().eps1;
  specimen.provenance =
      provenance_text(session_.record(), label_after(label_before_, session_.scene(), specimen.critical_thickness > 0));
  return specimen;
}

/// All ranks diverge alike. What the disc was surrounded by is written for ParaView.
ExitCode BiaxialRun::diverged(Diverged const& fault) {
  std::string text = std::string("diverged: ") + fault.what();
  std::filesystem::path const folder = session_.folder() / "diverged";
  if (fault.around && session_.begun()) try {
      SnapshotSeries(folder, session_.ranks(), {}, SnapshotNumbers::full).write(*fault.around);
      text += fmt::format("; its surroundings are in {} (ParaView)", (folder / "particles.xdmf").string());
    } catch (FileProblem const& problem) {
      warn(fmt::format("the surroundings of the particle cannot be written: {}", problem.what()));
    }
  return fail(ExitCode::diverged, text);
}

ExitCode BiaxialRun::stopped(std::string const& cause) {
  bool const kept = session_.resumes() || session_.checkpoints().written() > 0;
  ExitCode const code = kept ? ExitCode::to_be_resumed : ExitCode::interrupted;
  std::string const where = !kept ? cause
                            : is_consolidation(reporter_.last().stage)
                                ? fmt::format("stopped {} in the consolidation", cause)
                                : fmt::format("stopped {} at an axial strain of {:.3g} %", cause, reporter_.last().eps1 * 100);
  session_.conclude(code, where);
  reporter_.line().repeat_warnings();
  reporter_.line().note("clathra: " + where + session_.what_remains() + (kept ? ", and --resume goes on" : ""));
  return code;
}

/// The first failure counts: that the record cannot be written either (full disk) changes neither message nor code.
ExitCode BiaxialRun::fail(ExitCode code, std::string const& reason) {
  reporter_.line().repeat_warnings();
  std::string const text = reason + (session_.begun() ? "" : session_.what_remains());
  reporter_.line().note("clathra: " + text);
  say_failure(text);
  try {
    session_.conclude(code, reason);
  } catch (FileProblem const& problem) {
    reporter_.line().note(fmt::format("clathra: {}", problem.what()));
  }
  return code;
}

}  // namespace clathra
