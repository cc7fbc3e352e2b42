/// `clathra events`: which bonds broke, when and how.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "io/scene/scene_value.hpp"
#include "kernels/break_mode.hpp"
#include "run/break_table.hpp"
#include "terminal/json_text.hpp"
#include "terminal/option_value.hpp"
#include "terminal/print.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

double strain_of(char const* option, std::string const& text) {
  return option_value(option, [&] { return parse_share(text); });
}

struct EventsOptions {
  std::filesystem::path folder;
  std::string mode, from = "0 %", to = "100 %";  // axial strain
  int parts = 10;
  bool csv = false, json = false;

  double first() const { return strain_of("--from", from); }
  double last() const { return strain_of("--to", to); }
};

std::vector<std::string> mode_names() {
  std::vector<std::string> names;
  for (BreakModeNames const& m : break_modes) names.emplace_back(m.name);
  return names;
}

ExitCode show_events(EventsOptions const& options) {
  require_run_folder(options.folder);
  HistoryTable const history(options.folder / "history.csv");
  BreakTable const table = chosen_breaks(options.folder, history, {options.mode, options.first(), options.last()});
  if (options.csv) return print_result(csv_text(table));
  double const end = history["eps1"].back(), last = std::min(options.last(), end);
  if (options.first() > last)
    throw SceneProblems({{"--from", 0, 0,
                          fmt::format("lies above {}: the test ends at {:.4g} %",
                                      options.last() < options.first() ? "--to" : "all strains", 100 * end)}});
  std::vector<BreakPart> const parts = parts_of(table.rows, std::max(options.first(), 0.0), last, options.parts);
  if (options.json) return print_json(json_text({{"folder", options.folder.string()}, {"parts", count_json(parts)}}));
  return print_result(table.rows.empty() ? "no bond broke there\n" : count_text(parts));
}

}  // namespace

void add_events(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<EventsOptions>();
  CLI::App* const verb = program.add_subcommand("events", "Count or list the bonds that broke in a run");
  verb->add_option("folder", options->folder, "folder of a run")->required();
  verb->add_option("--mode", options->mode, "only those broken in this mode")->check(CLI::IsMember(mode_names()));
  verb->add_option("--from", options->from, "only from this axial strain on, 0.01 or \"1 %\"")->type_name("STRAIN");
  verb->add_option("--to", options->to, "only up to this axial strain")->type_name("STRAIN");
  verb->add_option("--parts", options->parts, "rows of the table of counts")->check(CLI::Range(1, 1000))->capture_default_str();
  CLI::Option* const csv =
      verb->add_flag("--csv", options->csv, "list them as CSV, with their axial strain, instead of counting");
  verb->add_flag("--json", options->json, "counts as one JSON object")->excludes(csv);
  verb->footer("Example: clathra events out/quick --mode shear --from \"1 %\" --to \"3 %\"");
  verb->callback([options, &chosen] { chosen = [options] { return show_events(*options); }; });
}

}  // namespace clathra
