#include "tune/tuning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "domain/biaxial/scene_cost.hpp"
#include "machine/interrupt.hpp"
#include "machine/machine_speed.hpp"
#include "run/forecast.hpp"
#include "terminal/text.hpp"
#include "tune/tune_text.hpp"

namespace clathra {
Tuning::Tuning(TunePlan plan, TuneLimits const& limits)
    : plan_(std::move(plan)),
      search_(plan_.goal.width, plan_.trials()),
      failures_(plan_.settings.size()),
      budget_(limits.budget),
      begin_(clock_seconds()) {
  speed_ = speed_of(Precision::full);
  plan_.speed_of_mixed = speed_of(Precision::mixed) / speed_;
  add({{plan_.as_it_stands}, SettingSearch::first_seeds});
  request_ = *search_.next();
  add(request_);
  limits_ = usual_limits(plan_.study, limits.parallel, 0, {});
  limits_.most_seconds = budget_;
  limits_.options = {"--checkpoint-every", "1m"};
  limits_.allow_mixed = limits.allow_mixed;
}

ExitCode Tuning::run(OutputFolder const& folder) {
  out_of_time_ = seconds_of(request_) > budget_;
  if (out_of_time_) return ExitCode::done;
  StudyRun runs(plan_.study, limits_, folder);
  while (true) {
    ExitCode const code = runs.run();
    if (code != ExitCode::done && interrupted()) return code;
    take_results();
    out_of_time_ = code != ExitCode::done;
    if (out_of_time_) break;
    std::optional<RunRequest> next = search_.next();
    if (next && !fits(*next)) {
      out_of_time_ = true;
      search_.stop_growing();
      next = search_.next();
    }
    if (!next || !fits(*next)) break;
    add(*next);
  }
  search_.stop_growing();
  (void)search_.next();
  runs.line().repeat_warnings();
  return ExitCode::done;
}

std::string Tuning::undetermined() const {
  if (search_.trials_of_limit_failed()) return "undetermined: the slow rates that the error is counted from cannot be run";
  if (plan_.study.members.empty() || !search_.error(search_.fast()))
    return fmt::format("undetermined: the first {} seeds need about {}, the time allowed is {}", SettingSearch::first_seeds,
                       duration_text(seconds_of(request_)), duration_text(budget_));
  if (auto const open = search_.undecided()) {
    auto const [trial, seeds] = *open;
    double seconds = 0;
    for (std::size_t const i : {search_.fast(), search_.slow(), trial})
      seconds += seconds_of(i) * std::max(0, seeds - static_cast<int>(values_of(i)));
    return fmt::format("undetermined: needs about {} seeds ({} more at I = {:g})", seeds,
                       duration_text(seconds / limits_.parallel), plan_.settings[trial].inertial_number);
  }
  SettingError const slowest = *search_.error(search_.slow());
  return fmt::format("undetermined: at I = {:g}, the slowest rate that was run, {}; {}",
                     plan_.settings[search_.slow()].inertial_number, measured_text(plan_, slowest),
                     "a slower one needs a larger --max-walltime or a larger --tolerance");
}

double Tuning::speed_of(Precision precision) const {
  Scene scene = plan_.base.scene;
  scene.run.threads = 1;
  scene.run.precision = precision;
  return machine_speed(scene, static_cast<double>(plan_.discs), 1, true).disc_steps_per_second;
}

void Tuning::add(RunRequest const& request) {
  for (std::size_t const trial : request.trials) {
    TuneSetting const& setting = plan_.settings[trial];
    bool const tried =
        has_member(trial, 1) || (setting.inertia_scaling <= RunScene::usual_inertia_factor && setting.mass_scaling == 0);
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(tried ? request.seeds : 1); ++seed)
      if (!has_member(trial, seed)) {
        add_member(plan_.study, trial, seed);
        find_finished(plan_.study, plan_.study.members.size() - 1);
      }
  }
}

bool Tuning::has_member(std::size_t trial, std::uint64_t seed) const {
  return std::any_of(plan_.study.members.begin(), plan_.study.members.end(),
                     [&](MemberResult const& m) { return m.group == trial && m.seed == seed; });
}

void Tuning::take_results() {
  for (MemberResult const& member : plan_.study.members) {
    Trial& trial = search_.trials()[member.group];
    auto const found = member.numbers.find(plan_.goal.number);
    if (member.state == MemberState::finished && found != member.numbers.end()) {
      trial.values[member.seed] = found->second;
    } else if (member.state != MemberState::waiting) {
      trial.failed = true;
      failures_[member.group] = member.state == MemberState::failed ? member.message.substr(0, member.message.find(" ("))
                                                                    : "its test has no " + plan_.goal.number;
    }
  }
  for (std::size_t i = 0; i < plan_.settings.size(); ++i) search_.trials()[i].cost = plan_.relative_cost(i);
}

double Tuning::seconds_of(std::size_t trial) const {
  double sum = 0, steps = 0;
  int count = 0;
  for (std::size_t i = 0; i < plan_.study.members.size(); ++i) {
    MemberResult const& member = plan_.study.members[i];
    if (member.group != trial) continue;
    steps = plan_.study.runs[i].disc_steps;
    if (member.state == MemberState::finished) sum += member.wall_seconds, ++count;
  }
  constexpr double of_a_program = 1;  // to read, to come to rest, to write a report
  if (count > 0) return sum / count + 0.5 * of_a_program;
  if (steps == 0) steps = disc_steps_of(trial);
  return steps / speed_ + of_a_program;
}

double Tuning::disc_steps_of(std::size_t trial) const {
  Study const& study = plan_.study.study;
  return predict(member_scene(study, study.groups[trial], 1).scene).at("particle_steps");
}

double Tuning::seconds_of(RunRequest const& request) const {
  double seconds = 0;
  int seeds_before = 0;
  for (std::size_t const trial : request.trials) {
    int runs = 0;
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(request.seeds); ++seed)
      runs += has_result(trial, seed) ? 0 : 1;
    seconds += runs * seconds_of(trial);
    seeds_before = std::max(seeds_before, static_cast<int>(values_of(trial)));
  }
  double specimen = 0;
  for (StudyTask const& task : plan_.study.specimens) specimen = std::max(specimen, task.disc_steps);
  seconds += std::max(0, request.seeds - seeds_before) * specimen / (generation_speedup * speed_);
  return seconds / std::max(1, limits_.parallel);
}

bool Tuning::has_result(std::size_t trial, std::uint64_t seed) const {
  return std::any_of(plan_.study.members.begin(), plan_.study.members.end(), [&](MemberResult const& m) {
    return m.group == trial && m.seed == seed && m.state != MemberState::waiting;
  });
}

std::size_t Tuning::tests_made() const {
  return static_cast<std::size_t>(std::count_if(plan_.study.members.begin(), plan_.study.members.end(),
                                                [](MemberResult const& m) { return m.state == MemberState::finished; }));
}

bool Tuning::misses_peaks() const {
  return std::any_of(plan_.study.members.begin(), plan_.study.members.end(), [](MemberResult const& member) {
    auto const passed = member.numbers.find("peak_passed");
    return passed != member.numbers.end() && passed->second == 0;
  });
}

std::string Tuning::table() const { return tune_table(plan_, search_, failures_); }

bool Tuning::fits(RunRequest const& request) const { return clock_seconds() - begin_ + seconds_of(request) <= budget_; }

}  // namespace clathra
