#include "study/study_forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "machine/available_memory.hpp"
#include "machine/machine_speed.hpp"
#include "run/forecast.hpp"
#include "terminal/progress_line.hpp"
#include "terminal/text.hpp"

namespace clathra {

int parallel_in_memory(StudyPlan const& plan) {
  double const most = largest_memory(plan);
  return most > 0 ? std::max(1, static_cast<int>(std::min(4096.0, usable_memory * available_memory() / most))) : 1;
}

namespace {

/// The first member of a group, whatever its guards say.
LoadedScene unguarded_scene(StudyPlan const& plan, StudyGroup group) {
  group.settings.emplace_back("run.ignore_guards", "true");
  return member_scene(plan.study, group, plan.study.seeds.front());
}

/// What the scenes of the groups are warned of, once each.
std::vector<std::string> scene_warnings(StudyPlan const& plan) {
  std::map<std::string, std::vector<std::string>> groups;
  for (StudyGroup const& group : plan.study.groups)
    for (std::string const& warning : unguarded_scene(plan, group).warnings)
      if (!warning.starts_with(guard_ignored)) groups[warning].push_back(group.name);
  std::vector<std::string> texts;
  for (auto const& [warning, names] : groups)
    texts.push_back(names.size() == plan.study.groups.size() ? warning
                                                             : fmt::format("{} (in the groups {})", warning, listed(names)));
  return texts;
}

}  // namespace

StudyForecast study_forecast(StudyPlan const& plan, int parallel, int threads) {
  double runs = 0, specimens = 0;
  StudyForecast forecast{parallel, threads};
  for (StudyTask const& task : plan.runs) runs += task.disc_steps, forecast.disk_bytes += task.disk;
  for (StudyTask const& task : plan.specimens) specimens += task.disc_steps;
  Scene scene = unguarded_scene(plan, plan.study.groups.back()).scene;
  scene.run.threads = threads;
  auto const fewest = std::min_element(plan.runs.begin(), plan.runs.end(),
                                       [](StudyTask const& a, StudyTask const& b) { return a.particles < b.particles; });
  MachineSpeed const speed = machine_speed(scene, fewest == plan.runs.end() ? 0 : fewest->particles, 1, true);
  forecast.disc_steps_per_second = speed.disc_steps_per_second * parallel;
  forecast.speed_origin = speed.origin;
  forecast.generation_seconds = specimens / (generation_speedup * forecast.disc_steps_per_second);
  forecast.shear_seconds = runs / forecast.disc_steps_per_second;
  forecast.memory_bytes = largest_memory(plan) * parallel;
  return forecast;
}

std::string study_forecast_text(StudyPlan const& plan, StudyForecast const& forecast) {
  std::string text = fmt::format("{}: {} groups of {} seed{}\n", plan.study.file.string(), plan.study.groups.size(),
                                 plan.study.seeds.size(), plan.study.seeds.size() == 1 ? "" : "s");
  auto const refused = std::count_if(plan.members.begin(), plan.members.end(), is_refused);
  text += table_row("members", fmt::format("{}, {} at a time with {} thread{} each{}", std::ssize(plan.runs) - refused,
                                           forecast.parallel, forecast.threads, forecast.threads == 1 ? "" : "s",
                                           refused > 0 ? fmt::format("; {} refused by guards and left out", refused) : ""));
  text += table_row("specimens", sharing_text(plan));
  text += table_row("generation", duration_text(forecast.generation_seconds));
  text += table_row("shear", fmt::format("{} at {} particle-steps/s ({})", duration_text(forecast.shear_seconds),
                                         short_count(forecast.disc_steps_per_second), forecast.speed_origin));
  text += table_row("memory", fmt::format("{:.3g} GB", forecast.memory_bytes * 1e-9));
  text += table_row("disk", fmt::format("{:.3g} GB", forecast.disk_bytes * 1e-9));
  if (plan.study.precision_target)
    text += table_row("target",
                      fmt::format("{} is known to {:.3g} % of its mean, at most {} seeds", plan.study.precision_target->number,
                                  plan.study.precision_target->width * 100, plan.study.max_seeds));
  for (std::string const& warning : scene_warnings(plan)) text += "warning: " + warning + "\n";
  return text;
}

nlohmann::ordered_json study_forecast_json(StudyPlan const& plan, StudyForecast const& forecast) {
  nlohmann::ordered_json members = nlohmann::json::array();
  for (std::size_t i = 0; i < plan.runs.size(); ++i)
    members.push_back({{"name", plan.runs[i].name},
                       {"left_out", is_refused(plan.members[i])},
                       {"particle_steps", plan.runs[i].disc_steps},
                       {"memory_bytes", plan.runs[i].memory},
                       {"disk_bytes", plan.runs[i].disk},
                       {"refusals", plan.runs[i].refusals}});
  return {{"study", plan.study.file.string()},
          {"groups", plan.study.groups.size()},
          {"seeds", plan.study.seeds.size()},
          {"specimens", plan.specimens.size()},
          {"parallel", forecast.parallel},
          {"threads", forecast.threads},
          {"particle_steps_per_second", forecast.disc_steps_per_second},
          {"generation_seconds", forecast.generation_seconds},
          {"shear_seconds", forecast.shear_seconds},
          {"memory_bytes", forecast.memory_bytes},
          {"disk_bytes", forecast.disk_bytes},
          {"warnings", scene_warnings(plan)},
          {"members", std::move(members)}};
}

}  // namespace clathra
