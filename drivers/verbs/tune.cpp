/// `clathra tune`: the cheapest setting of a scene whose measured error is within a tolerance.
#include <fmt/format.h>

#include <memory>

#include "io/formats/text_file.hpp"
#include "io/results/output_folder.hpp"
#include "machine/interrupt.hpp"
#include "terminal/duration.hpp"
#include "terminal/option_value.hpp"
#include "terminal/print.hpp"
#include "terminal/text.hpp"
#include "tune/tune_text.hpp"
#include "tune/tuning.hpp"
#include "verbs/verbs.hpp"

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

fs::path output_of(TuneOptions const& options) {
  return options.output.empty() ? fs::path(fs::path(options.scene).stem().string() + "-tuned.toml") : fs::path(options.output);
}

ExitCode conclude(Tuning const& tuning, fs::path const& output) {
  std::string text = tuning.table();
  std::optional<std::size_t> const choice = tuning.search().choice();
  if (tuning.misses_peaks() && tuning.plan().goal.number.starts_with("peak_"))
    print_error(
        "warning: in some tests q has not fallen after its largest value: test.axial_strain is too small to compare peaks");
  text += fmt::format("time      {} tests were made within the time allowed (--max-walltime {}){}\n", tuning.tests_made(),
                      duration_text(tuning.budget()), tuning.out_of_time() ? "; more time may change the choice" : "");
  if (!choice) {
    if (is_quiet()) print_error("clathra: " + tuning.undetermined());
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
  StudyGoal const goal{option_value("--quantity", [&] { return number_of_name(options.quantity, NumbersOf::tests); }),
                       option_value("--tolerance", [&] { return goal_width(options.tolerance); })};
  fs::path const output = output_of(options);
  require_no_file(output, "-o names another file");
  fs::path const folder =
      options.folder.empty() ? fs::path("out") / (fs::path(options.scene).stem().string() + "-tune") : fs::path(options.folder);
  TunePlan plan = plan_tune(options.scene, options.overrides, goal, options.discs, folder);
  OutputFolder const results(folder, "tune");
  watch_for_interrupt();
  Tuning tuning(std::move(plan), {duration_of(options.budget), options.parallel, options.allow_mixed});
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
  verb->add_option("--tolerance", options->tolerance, "largest error of the quantity, relative to a quasi-static test")
      ->capture_default_str()
      ->type_name("SHARE");
  verb->add_option("--quantity", options->quantity,
                   fmt::format("number that must be accurate: {}", fmt::join(number_names(NumbersOf::tests), ", ")))
      ->capture_default_str()
      ->type_name("NUMBER");
  verb->add_option("--max-walltime", options->budget, "time that its tests may take (10m, 2h)")
      ->capture_default_str()
      ->type_name("TIME")
      ->check(CLI::Validator(duration_problem, ""));
  verb->add_option("-o,--output", options->output, "scene file to write (default: NAME-tuned.toml in the current folder)")
      ->type_name("FILE")
      ->check(CLI::Validator(name_problem, ""));
  verb->add_option("--folder", options->folder, "folder of the tests (default: out/NAME-tune)")
      ->type_name("DIR")
      ->check(CLI::Validator(name_problem, ""));
  verb->add_option("--particles", options->discs,
                   "particles of a test; the scene's own number where that is smaller, more where they would be too few across")
      ->capture_default_str()
      ->check(CLI::Range(16, 1000000000))
      ->type_name("N");
  verb->add_option("--jobs", options->parallel, "tests at a time (default: as many as cores and memory allow)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  verb->add_flag("--allow-mixed", options->allow_mixed, "take specimens and tests that another program made");
  verb->footer("Example: clathra tune examples/quick.toml --tolerance \"5%\" --max-walltime \"10 min\" -o tuned.toml");
  verb->callback([options, &chosen] { chosen = [options] { return tune(*options); }; });
}

}  // namespace clathra
