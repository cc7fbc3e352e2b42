/// `clathra reproduce`: every figure and claim of a paper, from scratch.
#include <fmt/format.h>
#include <stdlib.h>

#include <memory>

#include "io/report/figure.hpp"
#include "io/results/laboratory_data.hpp"
#include "io/results/output_folder.hpp"
#include "io/results/paper_file.hpp"
#include "machine/interrupt.hpp"
#include "reproduce/outcome.hpp"
#include "reproduce/reproduction.hpp"
#include "study/examples.hpp"
#include "study/study_forecast.hpp"
#include "study/study_run.hpp"
#include "terminal/duration.hpp"
#include "terminal/json_text.hpp"
#include "terminal/print.hpp"
#include "verbs/scene_options.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

struct ReproduceOptions {
  std::string paper, output, most_time;
  fs::path figures, data;
  std::vector<std::string> overrides;
  std::int64_t discs = 0;
  std::uint64_t first_seed = 1;
  int seeds = 0, parallel = 0, threads = 0;
  bool quick = false, dry_run = false, collect = false, json = false, screening = false, allow_mixed = false;
};

/// The file that was named, or the one that is built in.
Paper paper_of(ReproduceOptions const& options) {
  Paper paper = options.paper.empty() ? parse_paper(std::string(built_in_paper()), "jiang-2017.toml") : load_paper(options.paper);
  if (options.screening && paper.screening.empty())
    throw FileProblem(ExitCode::bad_input, paper.file, "has no 'screening': a list of groups to compare bond models by");
  if (options.quick && !paper.quick)
    throw FileProblem(ExitCode::bad_input, paper.file, "has no 'quick': particles and seeds for a first look");
  if (options.screening) keep_only(paper, paper.screening);
  return paper;
}

ReproductionSize size_of(ReproduceOptions const& options, Paper const& paper) {
  ReproductionSize size{options.quick ? *paper.quick : paper.size, options.first_seed};
  if (options.discs > 0) size.tests.particles = options.discs;
  if (options.seeds > 0) size.tests.seeds = options.seeds;
  return size;
}

fs::path folder_of(ReproduceOptions const& options, Paper const& paper) {
  return !options.output.empty() ? fs::path(options.output) : options.paper.empty() ? "out/reproduce" : "out" / paper.file.stem();
}

std::optional<LaboratoryData> data_of(ReproduceOptions const& options) {
  if (options.data.empty()) return {};
  return read_laboratory_data(options.data);
}

StudyPlan plan_of(ReproduceOptions const& options, Paper const& paper, fs::path const& scene) {
  Study study = reproduction_study(paper, size_of(options, paper), folder_of(options, paper), scene);
  override_study(study, options.overrides);
  StudyPlan plan = plan_study(std::move(study));
  add_members(plan);
  heed_guards(plan, false);
  return plan;
}

StudyLimits limits_of(ReproduceOptions const& options, StudyPlan const& plan) {
  StudyLimits limits = usual_limits(plan, options.parallel, options.threads, {});
  limits.options = {"--checkpoint-every", "10m"};
  limits.allow_mixed = options.allow_mixed;
  limits.most_seconds = options.most_time.empty() ? 0 : duration_of(options.most_time);
  return limits;
}

/// Leaves nothing behind: what all tests share lies in a folder of its own for as long as that takes.
ExitCode forecast_only(ReproduceOptions const& options, Paper const& paper) {
  std::string name = (fs::temp_directory_path() / ("clathra-" + std::string(6, 'X'))).string();  // mkdtemp() finds a free one
  if (!::mkdtemp(name.data())) throw FileProblem(ExitCode::cannot_create, name, "cannot be created");
  std::shared_ptr<void> const removed(nullptr, [&](void*) {
    std::error_code ignored;
    fs::remove_all(name, ignored);
  });
  StudyPlan const plan = plan_of(options, paper, fs::path(name) / "scene.toml");
  StudyLimits const limits = limits_of(options, plan);
  StudyForecast const forecast = study_forecast(plan, limits.parallel, limits.threads);
  return options.json ? print_json(json_text(study_forecast_json(plan, forecast)))
                      : print_result(study_forecast_text(plan, forecast));
}

ExitCode reproduce(ReproduceOptions const& options) {
  std::optional<LaboratoryData> const data = data_of(options);
  Paper const paper = paper_of(options);
  if (options.dry_run) return forecast_only(options, paper);
  OutputFolder const folder(folder_of(options, paper), "reproduce");
  StudyPlan plan = plan_of(options, paper, folder / "scene.toml");
  plan.figures = options.figures;
  if (!plan.figures.empty()) claim_figures(plan.figures);
  ReproductionOutcome const outcome{paper, size_of(options, paper), options.overrides, data, options.quick};
  StudyLimits const limits = limits_of(options, plan);
  if (options.collect) {
    if (!options.allow_mixed) require_one_program(plan);
    ProgressLine line;
    find_all_finished(plan);
    return conclude(plan, outcome, line);
  }
  print_result(study_forecast_text(plan, study_forecast(plan, limits.parallel, limits.threads)));
  watch_for_interrupt();
  StudyRun run(plan, limits, folder);
  ExitCode const code = run.run();
  ExitCode const concluded = conclude(plan, outcome, run.line());
  return code == ExitCode::done ? concluded : code;
}

void add_options(CLI::App& verb, ReproduceOptions& options) {
  verb.add_option("--paper", options.paper,
                  "file with tests, claims and figures of another paper (TOML; docs/reference/paper-file.md)")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
  verb.add_flag("--quick", options.quick, "fewer particles and seeds, as the paper's file says: a few minutes");
  verb.add_option("-o,--output", options.output, "folder of the results (default: out/reproduce, of another paper out/NAME)")
      ->type_name("DIR")
      ->check(CLI::Validator(name_problem, ""));
  verb.add_option("--particles", options.discs, "particles of each specimen (default: of the paper's file)")
      ->check(CLI::Range(100, 100000000))
      ->type_name("N");
  verb.add_option("--seeds", options.seeds, "seeds of each test (default: of the paper's file)")
      ->check(CLI::Range(1, 10000))
      ->type_name("N");
  verb.add_option("--first-seed", options.first_seed, "the first of the seeds, which follow one another")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000000))
      ->type_name("N");
  verb.add_option("--set", options.overrides, "override a key of the scene in all tests: may be repeated")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  add_data_option(verb, options.data);
  verb.add_flag("--screening", options.screening, "only the tests that the paper's file lists to compare presets by");
  verb.add_option("--jobs", options.parallel, "members at a time (default: as many as cores and memory allow)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  verb.add_option("--threads", options.threads, "threads of each member")->check(CLI::Range(1, 4096))->type_name("N");
  verb.add_option("--max-walltime", options.most_time, "stop after this time, members with a checkpoint (3h50m, 90s)")
      ->type_name("TIME")
      ->check(CLI::Validator(time_limit_problem, ""));
  verb.add_flag("--allow-mixed", options.allow_mixed, "take specimens and members that another program made");
  auto* const dry = verb.add_flag("--dry-run", options.dry_run, "only say what it will cost");
  verb.add_flag("--json", options.json, "one JSON object, SI units")->needs(dry);
  verb.add_flag("--collect", options.collect, "only scorecard and report of what there is")->excludes(dry);
  add_figures_option(verb, options.figures)->excludes(dry);
}

}  // namespace

void add_reproduce(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<ReproduceOptions>();
  CLI::App* const verb = program.add_subcommand(
      "reproduce", "Every figure and claim of Jiang et al. (2017), or of another paper, with intervals and a scorecard");
  add_options(*verb, *options);
  verb->footer("Example: clathra reproduce --quick");
  verb->callback([options, &chosen] { chosen = [options] { return reproduce(*options); }; });
}

}  // namespace clathra
