/// `clathra reproduce`: every figure and claim of Jiang et al. (2017), from scratch.
#include <fmt/format.h>
#include <stdlib.h>

#include <memory>

#include "io/results/laboratory_data.hpp"
#include "io/results/output_folder.hpp"
#include "machine/interrupt.hpp"
#include "reproduce/outcome.hpp"
#include "reproduce/reproduction.hpp"
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
  std::string output = "out/reproduce", data, most_time;
  std::vector<std::string> overrides;
  std::int64_t discs = 0;
  std::uint64_t first_seed = 1;
  int seeds = 0, parallel = 0, threads = 0;
  bool quick = false, dry_run = false, collect = false, json = false, screening = false, allow_mixed = false;
};

ReproductionSize size_of(ReproduceOptions const& options) {
  ReproductionSize size = options.quick ? quick_size : full_size;
  if (options.discs > 0) size.discs = options.discs;
  if (options.seeds > 0) size.seeds = options.seeds;
  size.first_seed = options.first_seed;
  return size;
}

/// Four tests of bonded sand with their sands: enough to compare presets by.
PaperDesign design_of(ReproduceOptions const& options) {
  return options.screening ? PaperDesign{{26, 55}, {1, 3}, {}} : PaperDesign{};
}

std::optional<LaboratoryData> data_of(ReproduceOptions const& options) {
  if (options.data.empty()) return {};
  return read_laboratory_data(options.data);
}

ReproductionOutcome outcome_of(ReproduceOptions const& options, std::optional<LaboratoryData> const& data) {
  return {design_of(options), size_of(options), options.overrides, data, options.quick};
}

StudyPlan plan_of(ReproduceOptions const& options, fs::path const& scene) {
  Study study = reproduction_study(design_of(options), size_of(options), options.output, scene);
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
ExitCode forecast_only(ReproduceOptions const& options) {
  std::string name = (fs::temp_directory_path() / ("clathra-" + std::string(6, 'X'))).string();  // mkdtemp() finds a free one
  if (!::mkdtemp(name.data())) throw FileProblem(ExitCode::cannot_create, name, "cannot be created");
  std::shared_ptr<void> const removed(nullptr, [&](void*) {
    std::error_code ignored;
    fs::remove_all(name, ignored);
  });
  StudyPlan const plan = plan_of(options, fs::path(name) / "scene.toml");
  StudyLimits const limits = limits_of(options, plan);
  StudyForecast const forecast = study_forecast(plan, limits.parallel, limits.threads);
  return options.json ? print_json(json_text(study_forecast_json(plan, forecast)))
                      : print_result(study_forecast_text(plan, forecast));
}

ExitCode reproduce(ReproduceOptions const& options) {
  std::optional<LaboratoryData> const data = data_of(options);
  if (options.dry_run) return forecast_only(options);
  OutputFolder const folder(options.output, "reproduce");
  StudyPlan plan = plan_of(options, folder / "scene.toml");
  StudyLimits const limits = limits_of(options, plan);
  if (options.collect) {
    if (!options.allow_mixed) require_one_program(plan);
    ProgressLine line;
    find_all_finished(plan);
    return conclude(plan, outcome_of(options, data), line);
  }
  print_result(study_forecast_text(plan, study_forecast(plan, limits.parallel, limits.threads)));
  watch_for_interrupt();
  StudyRun run(plan, limits, folder);
  ExitCode const code = run.run();
  ExitCode const concluded = conclude(plan, outcome_of(options, data), run.line());
  return code == ExitCode::done ? concluded : code;
}

void add_options(CLI::App& verb, ReproduceOptions& options) {
  verb.add_flag("--quick", options.quick, "2,000 particles and two seeds: a few minutes");
  verb.add_option("-o,--output", options.output, "folder of the results; called again, it goes on where it was stopped")
      ->capture_default_str()
      ->type_name("DIR")
      ->check(CLI::Validator(name_problem, ""));
  verb.add_option("--particles", options.discs, "particles of each specimen (default: 20000)")
      ->check(CLI::Range(100, 100000000))
      ->type_name("N");
  verb.add_option("--seeds", options.seeds, "seeds of each test (default: 5)")->check(CLI::Range(1, 10000))->type_name("N");
  verb.add_option("--first-seed", options.first_seed, "the first of the seeds, which follow one another")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000000))
      ->type_name("N");
  verb.add_option("--set", options.overrides, "override a key of the scene in all tests: may be repeated")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  verb.add_option("--data", options.data,
                  "points of your own laboratory to be drawn into the figures (CSV; docs/howto/reproduce-a-paper.md)")
      ->type_name("FILE");
  verb.add_flag("--screening", options.screening, "only 26 and 55 % at 1 and 3 MPa with their sands, to compare presets");
  verb.add_option("--jobs", options.parallel, "members at a time (default: as many as cores and memory allow)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  verb.add_option("--threads", options.threads, "threads of each member")->check(CLI::Range(1, 4096))->type_name("N");
  verb.add_option("--max-walltime", options.most_time, "stop after this time, members with a checkpoint (3h50m, 90s)")
      ->type_name("TIME")
      ->check(CLI::Validator(time_limit_problem, ""));
  verb.add_flag("--allow-mixed", options.allow_mixed, "take specimens and members that another program made");
  auto* const dry = verb.add_flag("--dry-run", options.dry_run, "only say what it will cost");
  verb.add_flag("--json", options.json, "with --dry-run: one JSON object, SI units")->needs(dry);
  verb.add_flag("--collect", options.collect, "only scorecard and report of what there is")->excludes(dry);
}

}  // namespace

void add_reproduce(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<ReproduceOptions>();
  CLI::App* const verb =
      program.add_subcommand("reproduce", "Every figure and claim of Jiang et al. (2017), with intervals and a scorecard");
  add_options(*verb, *options);
  verb->footer("Example: clathra reproduce --quick");
  verb->callback([options, &chosen] { chosen = [options] { return reproduce(*options); }; });
}

}  // namespace clathra
