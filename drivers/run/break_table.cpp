#include "run/break_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace clathra {
namespace {

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

}  // namespace

BreakTable chosen_breaks(std::filesystem::path const& folder, HistoryTable const& history, BreakChoice const& choice) {
  std::error_code error;
  if (!std::filesystem::exists(folder / "events.csv", error))
    throw FileProblem(ExitCode::file_missing, folder,
                      "has no events.csv: the sand is clean, or output.events is false in its scene");
  BreakEvents const events = read_events(folder / "events.csv");
  BreakTable table{events.detailed, {}};
  for (std::size_t k = 0; k < events.rows.size(); ++k) table.rows.push_back(row_of(events, k, history));
  std::erase_if(table.rows, [&](BreakRow const& row) {
    bool const other_mode = !choice.mode.empty() && choice.mode != break_mode_name(row.event.mode);
    return other_mode || row.eps1 < choice.first || row.eps1 > choice.last;
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
  bool const dissolved =
      std::any_of(parts.begin(), parts.end(), [](BreakPart const& part) { return part.counts[BreakMode::dissolved] > 0; });
  std::vector<BreakModeNames> modes;
  for (BreakModeNames const& m : break_modes)
    if (m.mode != BreakMode::dissolved || dissolved) modes.push_back(m);
  std::string text = fmt::format("{:>16}", "eps1 [%]");
  for (BreakModeNames const& m : modes) text += fmt::format(" {:>12}", m.name);
  text += fmt::format(" {:>12}\n", "all");
  for (BreakPart const& part : parts) {
    text += fmt::format("{:>16}", fmt::format("{:.3g} - {:.3g}", part.begin * 100, part.end * 100));
    for (BreakModeNames const& m : modes) text += fmt::format(" {:>12}", part.counts[m.mode]);
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

}  // namespace clathra
