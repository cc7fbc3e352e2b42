/// `clathra check`: is a scene right, and what does it cost?
#include <fmt/format.h>

#include <memory>

#include "domain/measurement/specimen_facts.hpp"
#include "forecast.hpp"
#include "print.hpp"
#include "rank_checks.hpp"
#include "scene_options.hpp"
#include "specimen_source.hpp"
#include "verbs.hpp"

namespace clathra {
namespace {

struct CheckOptions {
  SceneOptions scene;
  double rate = 0;
  int ranks = 1;
};

ExitCode check(CheckOptions const& options) {
  LoadedScene input = options.scene.load();
  Scene const& scene = input.scene;
  bool const reads = scene.specimen.is_read();
  Forecast const result = forecast(scene, reads ? design_of(read_for_test(input)) : design_sample(scene), options.ranks);
  require_enough_discs(options.ranks, static_cast<std::int64_t>(result.numbers.at("particles")));
  MachineSpeed const speed =
      options.rate > 0 ? MachineSpeed{options.rate, "as given"} : machine_speed(scene, options.ranks, true);
  ExitCode const printed = print_result(fmt::format("{}: the scene is right\n{}{}", options.scene.file,
                                                    forecast_text(scene, result, speed), warnings_text(input, result)));
  refuse_if_needed(scene, result);
  return printed;
}

}  // namespace

void add_check(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<CheckOptions>();
  CLI::App* const verb = program.add_subcommand("check", "Check a scene and say what its run will cost");
  options->scene.add_to(*verb);
  verb->add_option("--disc-steps-per-second", options->rate, "speed to assume (default: as measured on this machine, once)")
      ->check(CLI::PositiveNumber);
  verb->add_option("--ranks", options->ranks, "ranks that will share the run on this machine (mpirun -n N)")
      ->check(CLI::Range(1, 1000000));
  verb->footer("Example: clathra check examples/quick.toml --set test.strain_rate=\"5 %/min\"");
  verb->callback([options, &chosen] { chosen = [options] { return check(*options); }; });
}

}  // namespace clathra
