#include "study_forecast.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "available_memory.hpp"
#include "forecast.hpp"
#include "machine_speed.hpp"
#include "progress_line.hpp"

namespace clathra {
namespace {

double largest_memory(StudyPlan const& plan) {
  double most = 0;
  for (StudyTask const& task : plan.runs) most = std::max(most, task.memory);
  for (StudyTask const& task : plan.specimens) most = std::max(most, task.memory);
  return most;
}

std::string row(std::string const& name, std::string const& value) { return fmt::format("  {:<18} {}\n", name, value); }

}  // namespace

int parallel_in_memory(StudyPlan const& plan) {
  double const most = largest_memory(plan);
  return most > 0 ? std::max(1, static_cast<int>(std::min(4096.0, usable_memory * available_memory() / most))) : 1;
}

std::string study_forecast(StudyPlan const& plan, int parallel, int threads) {
  double runs = 0, specimens = 0, disk = 0;
  for (StudyTask const& task : plan.runs) runs += task.disc_steps, disk += task.disk;
  for (StudyTask const& task : plan.specimens) specimens += task.disc_steps;
  Scene scene = member_scene(plan.study, plan.study.groups.back(), plan.study.seeds.front()).scene;
  scene.run.threads = threads;
  MachineSpeed const speed = machine_speed(scene, 1, true);
  double const rate = speed.disc_steps_per_second * parallel;
  std::string text =
      fmt::format("{}: {} groups of {} seeds\n", plan.study.file.string(), plan.study.groups.size(), plan.study.seeds.size());
  text += row("members", fmt::format("{}, {} at a time with {} thread{} each", plan.runs.size(), parallel, threads,
                                     threads == 1 ? "" : "s"));
  text += row("specimens", sharing_text(plan));
  text += row("generation", duration_text(specimens / (generation_speedup * rate)));
  text += row("shear", fmt::format("{} at {} disc-steps/s ({})", duration_text(runs / rate), short_count(rate), speed.origin));
  text += row("memory", fmt::format("{:.3g} GB", largest_memory(plan) * parallel * 1e-9));
  text += row("disk", fmt::format("{:.3g} GB", disk * 1e-9));
  if (plan.study.precision_target)
    text +=
        row("target", fmt::format("{} is known to {:.3g} % of its mean, at most {} seeds", plan.study.precision_target->number,
                                  plan.study.precision_target->width * 100, plan.study.max_seeds));
  return text;
}

}  // namespace clathra
