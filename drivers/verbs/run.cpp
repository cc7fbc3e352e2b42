/// `clathra run`: from a scene file to a sheared specimen and its curves.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "domain/measurement/specimen_facts.hpp"
#include "machine/interrupt.hpp"
#include "machine/threads.hpp"
#include "run/biaxial_run.hpp"
#include "run/forecast.hpp"
#include "run/rank_checks.hpp"
#include "run/specimen_source.hpp"
#include "terminal/duration.hpp"
#include "terminal/print.hpp"
#include "verbs/scene_options.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

struct RunOptions {
  SceneOptions scene;
  std::string output;
  bool resume = false, overwrite = false;
  std::string most_time, checkpoint_every = "10m";
};

ExitCode run_on(Ranks const& ranks, RunOptions const& options, RunLimits const& limits, LoadedScene input) {
  require_same_everywhere(ranks, input);
  if (std::string warning = thread_warning(input.scene.run.threads); !warning.empty())
    input.warnings.push_back(std::move(warning));
  std::optional<Specimen> specimen;
  Scene const& scene = input.scene;
  if (scene.specimen.is_read()) specimen = read_for_test(input, ranks);
  Forecast cost = forecast(scene, specimen ? design_of(*specimen, ranks) : design_sample(scene), launched_ranks());
  share_refusals(ranks, cost.refusals);
  cost.out_of_memory = ranks.any(cost.out_of_memory);
  refuse_if_needed(scene, cost);
  require_enough_discs(ranks.count(), static_cast<std::int64_t>(cost.numbers.at("particles")));
  watch_for_interrupt();
  std::vector<std::string> const warnings = warnings_of(input, cost);
  KokkosSession const kokkos;
  BiaxialRun now(std::move(input), std::move(specimen), limits, ranks);
  for (std::string const& warning : warnings) now.warn(warning);
  return now.run();
}

ExitCode run(RunOptions const& options) {
  RunLimits const limits{options.resume, options.overwrite, options.most_time.empty() ? 0 : duration_of(options.most_time),
                         duration_of(options.checkpoint_every)};
  std::vector<std::string> more;
  if (!options.output.empty()) more.push_back("output.folder=" + options.output);
  LoadedScene input = options.scene.load(more);
  set_up_threads(input.scene.run.threads);
  RankSession const session;
  Ranks const& ranks = session.ranks();
  return guarded_on_all_ranks(ranks, [&] { return run_on(ranks, options, limits, std::move(input)); });
}

}  // namespace

void add_run(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<RunOptions>();
  CLI::App* const verb = program.add_subcommand("run", "Generate, consolidate and shear the specimen of a scene");
  options->scene.add_to(*verb);
  verb->add_option("-o,--output", options->output, "folder of the results (output.folder)")
      ->type_name("DIR")
      ->check(CLI::Validator(name_problem, ""));
  CLI::Option* const resume = verb->add_flag("--resume", options->resume,
                                             "go on from the newest checkpoint in the folder of the results, if there is one");
  verb->add_flag("--overwrite", options->overwrite,
                 "replace an earlier run in that folder, which is kept until the new one is ready to be sheared")
      ->excludes(resume);
  verb->add_option("--max-walltime", options->most_time, "stop after this time with a checkpoint (3h50m, 90s)")
      ->type_name("TIME")
      ->check(CLI::Validator(time_limit_problem, ""));
  verb->add_option("--checkpoint-every", options->checkpoint_every, "time between checkpoints, 0s for none")
      ->capture_default_str()
      ->type_name("TIME")
      ->check(CLI::Validator(duration_problem, ""));
  add_status_option(*verb);
  verb->footer("Example: clathra run examples/quick.toml --set hydrate.saturation=\"41 %\" --output out/s41");
  verb->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace clathra
