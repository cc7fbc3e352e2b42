/// `clathra check`: is a scene right, and what does it cost?
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "domain/measurement/specimen_facts.hpp"
#include "run/forecast.hpp"
#include "run/rank_checks.hpp"
#include "run/specimen_source.hpp"
#include "terminal/json_text.hpp"
#include "terminal/print.hpp"
#include "verbs/scene_options.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

struct CheckOptions {
  SceneOptions scene;
  double rate = 0;
  int ranks = 1;
  bool json = false;
};

/// Of a scene that can be read.
std::string verdict_of(Scene const& scene, Forecast const& result, std::vector<std::string> const& warnings) {
  if (!result.refusals.empty() && !scene.run.ignore_guards) return "refused";
  bool const ignored =
      std::any_of(warnings.begin(), warnings.end(), [](std::string const& text) { return text.starts_with(guard_ignored); });
  return ignored ? "guards ignored" : "valid";
}

std::string count_text(std::size_t warnings) {
  return warnings == 0 ? "" : fmt::format(", {} warning{}", warnings, warnings == 1 ? "" : "s");
}

ExitCode check(CheckOptions const& options) {
  LoadedScene input = options.scene.load();
  Scene const& scene = input.scene;
  bool const reads = scene.specimen.is_read();
  Forecast const result = forecast(scene, reads ? design_of(read_for_test(input)) : design_sample(scene), options.ranks);
  require_enough_discs(options.ranks, static_cast<std::int64_t>(result.numbers.at("particles")));
  MachineSpeed const speed = options.rate > 0 ? MachineSpeed{options.rate, "as given"}
                                              : machine_speed(scene, result.numbers.at("particles"), options.ranks, true);
  std::vector<std::string> const warnings = warnings_of(input, result);
  std::string const verdict = verdict_of(scene, result, warnings);
  ExitCode printed = ExitCode::done;
  if (options.json) {
    nlohmann::ordered_json json = {{"scene", options.scene.file}, {"verdict", verdict}};
    json.update(forecast_json(scene, result, speed));
    json["warnings"] = warnings;
    printed = print_json(json_text(json));
  } else {
    printed = print_result(fmt::format("{}: {}{}\n{}{}", options.scene.file, verdict,
                                       verdict == "refused" ? "" : count_text(warnings.size()),
                                       forecast_text(scene, result, speed), warnings_text(input, result)));
    if (is_quiet())
      for (std::string const& warning : warnings) print_error("warning: " + warning);
  }
  refuse_if_needed(scene, result);
  return printed;
}

}  // namespace

void add_check(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<CheckOptions>();
  CLI::App* const verb = program.add_subcommand("check", "Check a scene and say what its run will cost");
  options->scene.add_to(*verb);
  verb->add_option("--particle-steps-per-second", options->rate, "speed to assume (default: as measured on this machine, once)")
      ->check(CLI::PositiveNumber);
  verb->add_option("--ranks", options->ranks, "ranks that will share the run on this machine (mpirun -n N)")
      ->check(CLI::Range(1, 1000000));
  verb->add_flag("--json", options->json, "one JSON object, SI units");
  verb->footer("Example: clathra check examples/quick.toml --set test.strain_rate=\"5 %/min\"");
  verb->callback([options, &chosen] { chosen = [options] { return check(*options); }; });
}

}  // namespace clathra
