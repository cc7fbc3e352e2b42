/// `clathra study`: a matrix of runs, their means and intervals.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>

#include "domain/scene/stage.hpp"
#include "io/formats/text_file.hpp"
#include "io/report/study_report.hpp"
#include "io/results/output_folder.hpp"
#include "machine/interrupt.hpp"
#include "study/array_jobs.hpp"
#include "study/study_forecast.hpp"
#include "study/study_goal.hpp"
#include "study/study_outcome.hpp"
#include "study/study_plan.hpp"
#include "study/study_run.hpp"
#include "terminal/duration.hpp"
#include "terminal/json_text.hpp"
#include "terminal/option_value.hpp"
#include "terminal/print.hpp"
#include "verbs/scene_options.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

struct StudyOptions {
  std::string file, output, precision_target, launcher, slurm;
  std::filesystem::path figures, data;
  std::vector<std::string> overrides;
  int seeds = 0, max_seeds = 0, parallel = 0, threads = 0, member = 0, specimen = 0;
  bool dry_run = false, collect = false, ignore_guards = false, json = false, skip_refused = false, allow_mixed = false;
  std::string most_time, checkpoint_every = "10m";
};

Study study_of(StudyOptions const& options) {
  Study study = load_study(options.file);
  if (!options.output.empty()) study.folder = options.output;
  if (options.seeds > 0) {
    study.seeds_stated = true;
    study.seeds.clear();
    for (int seed = 1; seed <= options.seeds; ++seed) study.seeds.push_back(static_cast<std::uint64_t>(seed));
  }
  if (!options.precision_target.empty())
    study.precision_target = option_value("--precision-target", [&] { return study_goal(options.precision_target); });
  if (options.max_seeds > 0 && !study.precision_target)
    throw SceneProblems({{"--max-seeds", 0, 0, "has no effect without --precision-target"}});
  if (options.max_seeds > 0) study.max_seeds = options.max_seeds;
  override_study(study, options.overrides);
  if (options.ignore_guards) ignore_guards(study);
  return study;
}

StudyLimits limits_of(StudyOptions const& options, StudyPlan const& plan) {
  StudyLimits limits = usual_limits(plan, options.parallel, options.threads, words_of(options.launcher));
  limits.options = {"--checkpoint-every", options.checkpoint_every};
  limits.allow_mixed = options.allow_mixed;
  limits.most_seconds = options.most_time.empty() ? 0 : duration_of(options.most_time);
  return limits;
}

SlurmJobs jobs_of(StudyOptions const& options) {
  return {options.slurm, options.launcher, options.threads, options.most_time, options.checkpoint_every, options.allow_mixed};
}

ExitCode collect(StudyPlan& plan, StudyOptions const& options) {
  claim_folder(plan.study.folder, "study");
  if (options.skip_refused) heed_guards(plan, true);
  ProgressLine line;
  find_all_finished(plan);
  return conclude(plan, line);
}

/// Everything, wave by wave. Whatever ends it, there are a table and a page of what was done.
ExitCode run_all(StudyPlan& plan, StudyLimits const& limits) {
  OutputFolder const folder(plan.study.folder, "study");
  watch_for_interrupt();
  StudyRun run(plan, limits, folder);
  ExitCode code = ExitCode::done;
  try {
    code = run.run();
    for (GoalSearch goal(plan.study); code == ExitCode::done && goal.add_members(plan, run.line());) code = run.run();
  } catch (std::exception const& problem) {
    try {
      conclude(plan, run.line());
    } catch (std::exception const& other) {
      run.line().note(fmt::format("clathra: {}", other.what()));
    }
    throw;
  }
  ExitCode const concluded = conclude(plan, run.line());
  return code == ExitCode::done ? concluded : code;
}

ExitCode print_forecast(StudyPlan const& plan, StudyLimits const& limits, bool json) {
  StudyForecast const forecast = study_forecast(plan, limits.parallel, limits.threads);
  return json ? print_json(json_text(study_forecast_json(plan, forecast))) : print_result(study_forecast_text(plan, forecast));
}

ExitCode study(StudyOptions const& options) {
  StudyPlan plan = plan_study(study_of(options));
  plan.figures = options.figures;
  if (!options.data.empty()) plan.data = read_laboratory_data(options.data);
  add_members(plan);
  // Before study.csv is touched; the waves of a study with a goal are asked again.
  bool const only_plans = options.dry_run || !options.slurm.empty();
  if (!only_plans && !options.allow_mixed) require_one_program(plan);
  if (!plan.figures.empty()) claim_figures(plan.figures);
  if (options.member > 0 || options.specimen > 0)
    return run_alone(plan, jobs_of(options), options.specimen > 0, options.specimen > 0 ? options.specimen : options.member);
  if (options.collect) return collect(plan, options);
  if (options.skip_refused) heed_guards(plan, true);
  StudyLimits const limits = limits_of(options, plan);
  if (options.dry_run)
    if (ExitCode const printed = print_forecast(plan, limits, options.json); printed != ExitCode::done) return printed;
  if (!options.skip_refused) heed_guards(plan, false);
  if (options.dry_run) return ExitCode::done;
  if (!options.slurm.empty()) return write_script(plan, jobs_of(options));
  return run_all(plan, limits);
}

/// Options of how members are started, and what they may do that is else refused.
void add_members_options(CLI::App& verb, StudyOptions& options) {
  verb.add_option("--launcher", options.launcher, "starts each member: \"mpirun -n 2\", \"srun -n 4\"")
      ->type_name("COMMAND")
      ->check(CLI::Validator(words_problem, ""));
  verb.add_flag("--ignore-guards", options.ignore_guards, "run members although a guard refuses; their run.json says so");
  verb.add_flag("--skip-refused", options.skip_refused, "leave out the groups that `check` would refuse");
  verb.add_flag("--allow-mixed", options.allow_mixed, "take specimens and members that another program made");
}

/// Options that do only a part of the work, one of them at a time.
void add_parts(CLI::App& verb, StudyOptions& options) {
  auto* const dry = verb.add_flag("--dry-run", options.dry_run, "only say what the study will cost");
  verb.add_flag("--json", options.json, "one JSON object, SI units")->needs(dry);
  auto* const slurm = verb.add_option("--slurm", options.slurm, "only write a script that runs the study as arrays of Slurm")
                          ->type_name("FILE")
                          ->check(CLI::Validator(name_problem, ""));
  // For the jobs of an array (--slurm): one member, or one specimen, counted from 1.
  auto const from_1 = [](std::string const& text) {
    int number = 0;
    bool const is_one = CLI::detail::lexical_cast(text, number) && number >= 1 && number <= static_cast<int>(most_members);
    return is_one ? std::string() : fmt::format("--member and --specimen count from 1 to {}, got {}", most_members, text);
  };
  auto* const member = verb.add_option("--member", options.member)->check(from_1)->group("");
  auto* const specimen = verb.add_option("--specimen", options.specimen)->check(from_1)->group("");
  auto* const collected = verb.add_flag("--collect", options.collect, "only write study.csv and the page of what there is");
  for (auto* const one : {dry, slurm, member, specimen, collected})
    for (auto* const other : {dry, slurm, member, specimen, collected})
      if (one != other) one->excludes(other);
  for (auto* const of_page : {add_figures_option(verb, options.figures), add_data_option(verb, options.data)})
    for (auto* const one : {dry, slurm, member, specimen}) of_page->excludes(one);
}

}  // namespace

void add_study(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<StudyOptions>();
  CLI::App* const verb =
      program.add_subcommand("study", "Run a matrix of scenes and seeds; means, intervals and one page on all");
  auto const time = CLI::Validator(duration_problem, "");
  verb->add_option("study", options->file, "study file (TOML)")->required();
  verb->add_option("--set", options->overrides, "set a key of the scene in all members, above the study file; may be repeated")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  verb->add_option("-o,--output", options->output, "folder of the results ('folder' of the study)")
      ->type_name("DIR")
      ->check(CLI::Validator(name_problem, ""));
  verb->add_option("--seeds", options->seeds, "seeds 1 to N of each group ('seeds' of the study)")
      ->check(CLI::Range(1, 10000))
      ->type_name("N");
  verb->add_option("--precision-target", options->precision_target,
                   "add seeds until the 95 % interval of the mean of a number is that narrow: peak_q=2%; " +
                       fmt::format("{}", fmt::join(number_names(NumbersOf::envelopes), ", ")))
      ->type_name("NUMBER=WIDTH");
  verb->add_option("--max-seeds", options->max_seeds, "with --precision-target: stop at so many seeds of a group (default: 40)")
      ->check(CLI::Range(2, 10000))
      ->type_name("N");
  verb->add_option("--jobs", options->parallel,
                   "members at a time (default: as many as cores and memory allow; 1 with --launcher)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  verb->add_option("--threads", options->threads, "threads of each member (default: one, more where cores are left over)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  add_members_options(*verb, *options);
  verb->add_option("--max-walltime", options->most_time, "stop after this time, members with a checkpoint (3h50m, 90s)")
      ->type_name("TIME")
      ->check(CLI::Validator(time_limit_problem, ""));
  verb->add_option("--checkpoint-every", options->checkpoint_every, "time between checkpoints of a member, 0s for none")
      ->capture_default_str()
      ->type_name("TIME")
      ->check(time);
  add_parts(*verb, *options);
  verb->footer("Example: clathra study examples/studies/saturations.toml --precision-target peak_q=5% --output out/study");
  verb->callback([options, &chosen] { chosen = [options] { return study(*options); }; });
}

}  // namespace clathra
