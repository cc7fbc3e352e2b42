#include "run/forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "domain/biaxial/quasi_static.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/scene/hydrate.hpp"
#include "domain/scene/specimen_design.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"
#include "machine/available_memory.hpp"
#include "machine/threads.hpp"
#include "run/expected_error.hpp"
#include "terminal/progress_line.hpp"
#include "terminal/text.hpp"

namespace clathra {
namespace {

constexpr double paper_rate = 0.05 / 60;  // "5 %/min" [1/s]

std::string bytes_text(double bytes) {
  if (bytes >= 1e12) return fmt::format("{:.3g} TB", bytes * 1e-12);
  return bytes < 1e9 ? fmt::format("{:.3g} MB", bytes * 1e-6) : fmt::format("{:.3g} GB", bytes * 1e-9);
}

std::string bonds_text(HydrateScene const& hydrate) {
  return fmt::format("saturation {:.4g} %, {:.4g} degC, pore pressure {:.4g} MPa", hydrate.saturation * 100, hydrate.temperature,
                     hydrate.pore_pressure * 1e-6);
}

/// "biaxial: shear", "list: compression, shear"
std::string test_text(Scene const& scene) {
  std::string stages, kind = unquoted(value_text(*find_key("test.kind"), scene));
  for (LoadingStage const& stage : stages_of(scene)) stages += (stages.empty() ? "" : ", ") + stage.name;
  return kind + ": " + stages;
}

RateNumbers rate_of(StageRecord const& n) {
  return {n.at("strain_rate_per_s"), n.at("inertial_number"), n.at("platen_wave_stress"), n.at("rate_share")};
}

std::string expected_error_text(Scene const& scene, StageRecord const& numbers) {
  ExpectedError const expected = expected_error(scene, rate_of(numbers));
  if (!expected.peak_q) return "not measured: " + expected.range;
  return fmt::format("{:+.1f} ± {:.1f} % against slow shear in double precision ({})", 100 * expected.peak_q->error,
                     100 * expected.peak_q->half_width, expected.range);
}

double generation_seconds(StageRecord const& n, MachineSpeed const& speed) {
  return n.at("generation_particle_steps") / (generation_speedup * speed.disc_steps_per_second);
}

/// Of the file system that the results would go to, or nothing where it cannot be asked.
std::string disk_warning(Scene const& scene, StageRecord const& numbers) {
  std::filesystem::path folder = std::filesystem::absolute(scene.output.folder);
  std::error_code error;
  while (folder.has_relative_path() && !std::filesystem::exists(folder, error)) folder = folder.parent_path();
  std::filesystem::space_info const space = std::filesystem::space(folder, error);
  double const needed = numbers.at("disk_bytes"), free = static_cast<double>(space.available);
  if (error || needed <= free) return {};
  return fmt::format("its results take about {} of disk, {} are free", bytes_text(needed), bytes_text(free));
}

}  // namespace

Forecast forecast(Scene const& scene, SpecimenDesign const& design, int ranks) {
  Forecast result;
  result.numbers = predict(scene, design, ranks);
  RateNumbers const rate = rate_of(result.numbers);
  result.warnings = rate_warnings(scene, rate);
  result.refusals = rate_refusals(scene, rate);
  if (std::string const warning = disk_warning(scene, result.numbers); !warning.empty()) result.warnings.push_back(warning);
  if (std::string const refusal = memory_refusal(result.numbers); !refusal.empty())
    result.refusals.push_back(refusal), result.out_of_memory = true;
  if (!scene.specimen.is_read()) return result;
  // The checks of the scene know only what is generated. One that was wide enough as designed is a little narrower at rest.
  constexpr double settled = 0.95;
  Grading const& grading = design.grading;
  for (std::string const& problem : {narrowness(design.width, design.height, grading.largest(), settled * fewest_grains_across),
                                     crowding(grading.smallest(), grading.largest(), reach_of_bonds(scene, grading.d50())),
                                     wide_skin(grading, scene.run.verlet_skin)})
    if (!problem.empty()) result.refusals.push_back(problem);
  return result;
}

std::string memory_refusal(StageRecord const& numbers) {
  double const memory = numbers.at("memory_bytes") * launched_ranks_here() / launched_ranks(),
               available = usable_memory * available_memory();
  if (memory <= available) return {};
  return fmt::format("it needs about {} of memory, {} are free", bytes_text(memory), bytes_text(available));
}

std::vector<std::string> warnings_of(LoadedScene const& input, Forecast const& forecast) {
  std::vector<std::string> warnings = input.warnings;
  warnings.insert(warnings.end(), forecast.warnings.begin(), forecast.warnings.end());
  if (input.scene.run.ignore_guards)
    for (std::string const& refusal : forecast.refusals) warnings.push_back(guard_ignored + refusal);
  return warnings;
}

std::string warnings_text(LoadedScene const& input, Forecast const& forecast) {
  std::string text;
  for (std::string const& warning : warnings_of(input, forecast)) text += "warning: " + warning + "\n";
  return text;
}

std::string forecast_text(Scene const& scene, Forecast const& forecast, MachineSpeed const& speed) {
  StageRecord const& n = forecast.numbers;
  auto const hours = [&](double disc_steps) { return duration_text(disc_steps / speed.disc_steps_per_second); };
  std::string text;
  text += table_row("particles", fmt::format("{:.0f}", n.at("particles")));
  text += table_row("box", fmt::format("{:.4g} mm x {:.4g} mm, void ratio {:.4g}", n.at("width_m") * 1e3, n.at("height_m") * 1e3,
                                       n.at("void_ratio")));
  text += table_row("d50", fmt::format("{:.4g} mm", n.at("d50_m") * 1e3));
  text += table_row("bonds", has_bonds(scene) ? bonds_text(scene.hydrate) : "none");
  text += table_row("test", test_text(scene));
  text += table_row("confining stress", fmt::format("{:.4g} MPa", scene.test.confining_stress * 1e-6));
  std::string const rotation = scene.run.rotational_inertia_factor == 1
                                   ? ""
                                   : fmt::format(", moments of inertia times {:g}", scene.run.rotational_inertia_factor);
  text += table_row(
      "time step",
      fmt::format("{:.3g} s ({:g} of {}{})", n.at("time_step_s"), scene.run.step_choice().safety,
                  scene.run.time_step_rule == TimeStepRule::adaptive ? "the limit of stability" : "the estimate", rotation));
  text += table_row("strain rate",
                    fmt::format("{:.4g} 1/s, up to {:.4g} % axial strain", n.at("strain_rate_per_s"), planned_path(scene) * 100));
  std::string const lowered =
      n.at("rate_share") < 1 ? fmt::format("lowered from {:.3g} by test.max_platen_wave_stress; ", scene.test.inertial_number)
                             : "";
  text += table_row("inertial number I",
                    fmt::format("{:.3g} ({}quasi-static below {:g})", n.at("inertial_number"), lowered, inertial_warning(scene)));
  text += table_row("wave stress W", fmt::format("{:.3g} (quasi-static below {:g})", n.at("platen_wave_stress"), wave_limit));
  text += table_row("error of peak q", expected_error_text(scene, n));
  text +=
      table_row("steps", fmt::format("{} ({} particle-steps)", short_count(n.at("steps")), short_count(n.at("particle_steps"))));
  double const generation = generation_seconds(n, speed);
  if (generation > 0) text += table_row("generation", fmt::format("about {}", duration_text(generation)));
  text += table_row("shear", fmt::format("{} at {} particle-steps/s ({})", hours(n.at("particle_steps")),
                                         short_count(speed.disc_steps_per_second), speed.origin));
  double const literal = scene.test.axial_strain / (paper_rate * n.at("time_step_s"));
  text += table_row("at 5 %/min", fmt::format("{} steps, {}", short_count(literal), hours(literal * n.at("particles"))));
  text += table_row("memory", bytes_text(n.at("memory_bytes")));
  text += table_row("disk", bytes_text(n.at("disk_bytes")));
  return text;
}

nlohmann::ordered_json forecast_json(Scene const& scene, Forecast const& forecast, MachineSpeed const& speed) {
  StageRecord const& n = forecast.numbers;
  ExpectedError const expected = expected_error(scene, rate_of(n));
  nlohmann::ordered_json json = {{"forecast", n},
                                 {"particle_steps_per_second", speed.disc_steps_per_second},
                                 {"generation_seconds", generation_seconds(n, speed)},
                                 {"shear_seconds", n.at("particle_steps") / speed.disc_steps_per_second},
                                 {"refusals", forecast.refusals}};
  json["error_of_peak_q"] = nullptr;
  if (expected.peak_q)
    json["error_of_peak_q"] = {
        {"mean", expected.peak_q->error}, {"half_width", expected.peak_q->half_width}, {"measured_on", expected.range}};
  else
    json["error_of_peak_q_not_measured"] = expected.range;
  return json;
}

void refuse_if_needed(Scene const& scene, Forecast const& forecast) {
  if (forecast.refusals.empty() || scene.run.ignore_guards) return;
  std::string text;
  for (std::string const& refusal : forecast.refusals) text += (text.empty() ? "" : "; ") + refusal;
  text += ignore_hint;
  if (forecast.out_of_memory && forecast.refusals.size() == 1) throw OutOfMemory(text);
  throw Refused(text);
}

}  // namespace clathra
