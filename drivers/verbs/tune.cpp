/// `clathra tune`: the cheapest setting of a scene whose measured error is within a tolerance.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "domain/scene/stage.hpp"
#include "duration.hpp"
#include "forecast.hpp"
#include "interrupt.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/output_folder.hpp"
#include "machine_speed.hpp"
#include "print.hpp"
#include "study_run.hpp"
#include "tune_text.hpp"
#include "verbs.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

struct TuneOptions {
  std::string scene, quantity = "peak_q", tolerance = "1%", budget = "10m", output, folder;
  std::vector<std::string> overrides;
  std::int64_t discs = 1000;
  int parallel = 0;
  bool allow_mixed = false;
};

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

fs::path output_of(TuneOptions const& options) {
  return options.output.empty() ? fs::path(fs::path(options.scene).stem().string() + "-tuned.toml") : fs::path(options.output);
}

/// The search and its runs.
class Tuning {
 public:
  Tuning(TunePlan plan, TuneOptions const& options)
      : plan_(std::move(plan)),
        search_(plan_.goal.tolerance, plan_.trials()),
        failures_(plan_.settings.size()),
        budget_(duration_of(options.budget)),
        begin_(now()) {
    speed_ = speed_of(Precision::full);
    plan_.speed_of_mixed = speed_of(Precision::mixed) / speed_;
    add({{plan_.as_it_stands}, SettingSearch::first_seeds});
    request_ = *search_.next();
    add(request_);
    limits_ = usual_limits(plan_.study, options.parallel, 0, {});
    limits_.most_seconds = budget_;
    limits_.options = {"--checkpoint-every", "1m"};
    limits_.allow_mixed = options.allow_mixed;
  }

  /// @return done, also where nothing was found; to_be_resumed where a signal stopped it
  ExitCode run(OutputFolder const& folder) {
    if (seconds_of_wish() > budget_) return ExitCode::done;
    StudyRun runs(plan_.study, limits_, folder);
    while (true) {
      ExitCode const code = runs.run();
      if (code != ExitCode::done && interrupted()) return code;
      take_results();
      if (code != ExitCode::done) break;  // the budget is spent
      std::optional<RunRequest> next = search_.next();
      if (next && !fits(*next)) {
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

  /// The table and what follows from it. @return whether a setting was found
  std::string table() const { return tune_table(plan_, search_, failures_); }
  SettingSearch const& search() const { return search_; }
  TunePlan const& plan() const { return plan_; }

  /// Why there is no choice, and what would give one.
  std::string undetermined() const {
    if (search_.trials_of_limit_failed()) return "undetermined: the slow rates that the error is counted from cannot be run";
    if (plan_.study.members.empty() || !search_.error(search_.fast()))
      return fmt::format("undetermined: the first {} seeds need about {}, the budget is {}", SettingSearch::first_seeds,
                         duration_text(seconds_of_wish()), duration_text(budget_));
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

 private:
  /// Disc-steps a second of one thread.
  double speed_of(Precision precision) const {
    Scene scene = plan_.base.scene;
    scene.run.threads = 1;
    scene.run.precision = precision;
    return machine_speed(scene, 1, true).disc_steps_per_second;
  }

  std::size_t values_of(std::size_t trial) const { return search_.trials()[trial].values.size(); }

  /// Masses scaled further than usual, which a guard may refuse at the rate, are tried with one seed first.
  void add(RunRequest const& request) {
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

  bool has_member(std::size_t trial, std::uint64_t seed) const {
    return std::any_of(plan_.study.members.begin(), plan_.study.members.end(),
                       [&](MemberResult const& m) { return m.group == trial && m.seed == seed; });
  }

  void take_results() {
    for (MemberResult const& member : plan_.study.members) {
      Trial& trial = search_.trials()[member.group];
      auto const found = member.numbers.find(plan_.goal.quantity);
      if (member.state == MemberState::finished && found != member.numbers.end()) {
        trial.values[member.seed] = found->second;
      } else if (member.state != MemberState::waiting) {
        trial.failed = true;
        failures_[member.group] = member.state == MemberState::failed ? member.message.substr(0, member.message.find(" ("))
                                                                      : "its test has no " + plan_.goal.quantity;
      }
    }
    for (std::size_t i = 0; i < plan_.settings.size(); ++i) search_.trials()[i].cost = plan_.relative_cost(i);
  }

  /// Wall time of one run of a setting: as measured, else by prediction.
  double seconds_of(std::size_t trial) const {
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

  double disc_steps_of(std::size_t trial) const {
    Study const& study = plan_.study.study;
    return predict(member_scene(study, study.groups[trial], 1).scene).at("disc_steps");
  }

  /// Of what is not run yet.
  double seconds_of(RunRequest const& request) const {
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
  double seconds_of_wish() const { return seconds_of(request_); }

  bool has_result(std::size_t trial, std::uint64_t seed) const {
    return std::any_of(plan_.study.members.begin(), plan_.study.members.end(), [&](MemberResult const& m) {
      return m.group == trial && m.seed == seed && m.state != MemberState::waiting;
    });
  }

  bool fits(RunRequest const& request) const { return now() - begin_ + seconds_of(request) <= budget_; }

  TunePlan plan_;
  SettingSearch search_;
  std::vector<std::string> failures_;
  StudyLimits limits_;
  RunRequest request_;  // the first one
  double budget_, begin_, speed_ = 1;
};

ExitCode conclude(Tuning const& tuning, fs::path const& output) {
  std::string text = tuning.table();
  std::optional<std::size_t> const choice = tuning.search().choice();
  if (!choice) {
    ExitCode const printed = print_result(text + tuning.undetermined() + "\n");
    return printed == ExitCode::done ? ExitCode::undetermined : printed;
  }
  TunePlan const& plan = tuning.plan();
  replace_text_file(output, tuned_scene(plan, tuning.search(), *choice, output.parent_path()));
  text += fmt::format("choice    {}; {:.3g} of the cost as it stands\n", measured_text(plan, *tuning.search().error(*choice)),
                      plan.relative_cost(*choice));
  return print_result(text + fmt::format("{} is written; run it with: clathra run {}\n", output.string(), output.string()));
}

ExitCode tune(TuneOptions const& options) {
  TuneGoal const goal = tune_goal(options.quantity, options.tolerance);
  fs::path const output = output_of(options);
  require_no_file(output, "-o names another file");
  fs::path const folder =
      options.folder.empty() ? fs::path("out") / (fs::path(options.scene).stem().string() + "-tune") : fs::path(options.folder);
  TunePlan plan = plan_tune(options.scene, options.overrides, goal, options.discs, folder);
  OutputFolder const results(folder, "tune");
  watch_for_interrupt();
  Tuning tuning(std::move(plan), options);
  ExitCode const code = tuning.run(results);
  if (code != ExitCode::done) {
    print_error(fmt::format("clathra: stopped; the same command goes on from {}", folder.string()));
    return code;
  }
  return conclude(tuning, output);
}

}  // namespace

void add_tune(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<TuneOptions>();
  CLI::App* const verb =
      program.add_subcommand("tune", "Find the cheapest setting of a scene whose measured error is within a tolerance");
  verb->add_option("scene", options->scene, "scene file (TOML)")->required();
  verb->add_option("--set", options->overrides, "override a key of the scene; may be repeated")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  verb->add_option("--tolerance", options->tolerance, "error to stay within, of the number at vanishing rate")
      ->capture_default_str()
      ->type_name("SHARE");
  verb->add_option("--quantity", options->quantity, "the number that is looked at: peak_q, residual_q, secant_modulus, ...")
      ->capture_default_str()
      ->type_name("NUMBER");
  verb->add_option("--max-walltime", options->budget, "time that its runs may take (10m, 2h)")
      ->capture_default_str()
      ->type_name("TIME")
      ->check(CLI::Validator(duration_problem, ""));
  verb->add_option("-o,--output", options->output, "scene file to write (default: NAME-tuned.toml in the current folder)")
      ->type_name("FILE")
      ->check(CLI::Validator(name_problem, ""));
  verb->add_option("--folder", options->folder, "folder of the runs (default: out/NAME-tune)")
      ->type_name("DIR")
      ->check(CLI::Validator(name_problem, ""));
  verb->add_option("--particles", options->discs,
                   "particles of a test; the scene's own number where that is smaller, more where they would be too few across")
      ->capture_default_str()
      ->check(CLI::Range(16, 1000000000))
      ->type_name("N");
  verb->add_option("--jobs", options->parallel, "runs at a time (default: as many as cores and memory allow)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  verb->add_flag("--allow-mixed", options->allow_mixed, "take specimens and tests that another program made");
  verb->footer("Example: clathra tune examples/quick.toml --tolerance \"5%\" --max-walltime \"10 min\" -o tuned.toml");
  verb->callback([options, &chosen] { chosen = [options] { return tune(*options); }; });
}

}  // namespace clathra
