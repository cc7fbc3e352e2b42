/// `clathra events`: which bonds broke, when and how.
#include "io/results/events.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "domain/scene/units.hpp"
#include "io/results/run_results.hpp"
#include "json_text.hpp"
#include "kernels/break_mode.hpp"
#include "print.hpp"
#include "verbs.hpp"

namespace clathra {
namespace {

/// @throws SceneProblems, named after the option
double strain_of(char const* option, std::string const& text) {
  try {
    double const strain = parse_quantity(text, Dimension::ratio);
    if (strain > 1) throw std::invalid_argument(fmt::format("must lie between 0 and 1, got {}; 15 % is \"15 %\" or 0.15", text));
    return strain;
  } catch (std::invalid_argument const& problem) {
    throw SceneProblems({{option, 0, 0, problem.what()}});
  }
}

struct EventsOptions {
  std::filesystem::path folder;
  std::string mode, from = "0 %", to = "100 %";  // axial strain
  int parts = 10;
  bool csv = false, json = false;

  double first() const { return strain_of("--from", from); }
  double last() const { return strain_of("--to", to); }
};

struct BreakRow {
  BreakEvent event;
  double eps1;
  BreakDetails details;
};

/// Rows in the order of the file.
struct BreakTable {
  bool detailed = false;
  std::vector<BreakRow> rows;
};

std::vector<std::string> mode_names() {
  std::vector<std::string> names;
  for (BreakModeNames const& m : break_modes) names.emplace_back(m.name);
  return names;
}

/// The axial strain at a step, between the records of the history.
double strain_at(HistoryTable const& history, double step) {
  auto const &steps = history["step"], &strains = history["eps1"];
  auto const after = static_cast<std::size_t>(std::lower_bound(steps.begin(), steps.end(), step) - steps.begin());
  if (after == 0) return strains.front();
  if (after == steps.size()) return strains.back();
  double const share = (step - steps[after - 1]) / (steps[after] - steps[after - 1]);
  return strains[after - 1] + share * (strains[after] - strains[after - 1]);
}

/// Its strain as the file says it, or else between the records of the history.
BreakRow row_of(BreakEvents const& events, std::size_t k, HistoryTable const& history) {
  BreakEvent const& event = events.rows[k];
  if (events.detailed) return {event, events.details[k].eps1, events.details[k]};
  return {event, strain_at(history, static_cast<double>(event.step)), {}};
}

BreakTable chosen_events(EventsOptions const& options, HistoryTable const& history) {
  std::error_code error;
  if (!std::filesystem::exists(options.folder / "events.csv", error))
    throw FileProblem(ExitCode::file_missing, options.folder,
                      "has no events.csv: the sand is clean, or output.events is false in its scene");
  BreakEvents const events = read_events(options.folder / "events.csv");
  BreakTable table{events.detailed, {}};
  double const first = options.first(), last = options.last();
  for (std::size_t k = 0; k < events.rows.size(); ++k) table.rows.push_back(row_of(events, k, history));
  std::erase_if(table.rows, [&](BreakRow const& row) {
    bool const other_mode = !options.mode.empty() && options.mode != break_mode_name(row.event.mode);
    return other_mode || row.eps1 < first || row.eps1 > last;
  });
  return table;
}

std::string csv_text(BreakTable const& table) {
  // eps1 stands in front with or without details.
  auto const more = std::span(break_detail_columns).subspan(table.detailed ? 1 : std::size(break_detail_columns));
  std::string text = "eps1,step,id_a,id_b,mode,x_m,y_m";
  for (BreakDetailColumn const& column : more) text += fmt::format(",{}", column.heading);
  text += '\n';
  for (BreakRow const& row : table.rows) {
    text += fmt::format("{},{},{},{},{},{},{}", row.eps1, row.event.step, row.event.id_a, row.event.id_b,
                        break_mode_name(row.event.mode), row.event.x, row.event.y);
    for (BreakDetailColumn const& column : more) text += fmt::format(",{}", row.details.*column.value);
    text += '\n';
  }
  return text;
}

/// Bonds that broke in a part of a range of axial strain.
struct BreakPart {
  double begin, end;
  BreakCounts counts;
};

std::vector<BreakPart> parts_of(std::vector<BreakRow> const& rows, double first, double last, int parts) {
  std::vector<BreakPart> all;
  double const width = std::max(last - first, 1e-12) / parts;
  for (int part = 0; part < parts; ++part) {
    double const begin = first + part * width, end = part == parts - 1 ? HUGE_VAL : begin + width;
    all.push_back({begin, begin + width, {}});
    for (BreakRow const& row : rows)
      if (row.eps1 >= begin && row.eps1 < end) ++all.back().counts[static_cast<BreakMode>(row.event.mode)];
  }
  return all;
}

std::string count_text(std::vector<BreakPart> const& parts) {
  std::string text = fmt::format("{:>16}", "eps1 [%]");
  for (BreakModeNames const& m : break_modes) text += fmt::format(" {:>12}", m.name);
  text += fmt::format(" {:>12}\n", "all");
  for (BreakPart const& part : parts) {
    text += fmt::format("{:>16}", fmt::format("{:.3g} - {:.3g}", part.begin * 100, part.end * 100));
    for (BreakModeNames const& m : break_modes) text += fmt::format(" {:>12}", part.counts[m.mode]);
    text += fmt::format(" {:>12}\n", part.counts.total());
  }
  return text;
}

nlohmann::ordered_json count_json(std::vector<BreakPart> const& parts) {
  nlohmann::ordered_json all = nlohmann::json::array();
  for (BreakPart const& part : parts) {
    nlohmann::ordered_json one = {{"eps1_from", part.begin}, {"eps1_to", part.end}};
    for (BreakModeNames const& m : break_modes) one[m.name] = part.counts[m.mode];
    one["all"] = part.counts.total();
    all.push_back(std::move(one));
  }
  return all;
}

ExitCode show_events(EventsOptions const& options) {
  HistoryTable const history(options.folder / "history.csv");
  BreakTable const table = chosen_events(options, history);
  if (options.csv) return print_result(csv_text(table));
  double const last = std::min(options.last(), history["eps1"].back());
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
