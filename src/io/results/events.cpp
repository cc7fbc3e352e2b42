#include "io/results/events.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <stdexcept>

#include "domain/scene/csv_rows.hpp"
#include "domain/scene/units.hpp"
#include "io/errors/problems.hpp"
#include "kernels/break_mode.hpp"

namespace clathra {

namespace {

constexpr std::size_t plain_cells = 7, detailed_cells = plain_cells + std::size(break_detail_columns);

std::string header(bool detailed) {
  std::string text = "stage,step,id_a,id_b,mode,x_m,y_m";
  if (detailed)
    for (BreakDetailColumn const& column : break_detail_columns) text += fmt::format(",{}", column.heading);
  return text;
}

}  // namespace

EventsFile::EventsFile(std::filesystem::path path, bool detailed) : file_(std::move(path)) {
  file_.write(header(detailed) + "\n");
}

void EventsFile::write(std::string_view stage, BreakEvents const& events) {
  std::string rows;
  for (std::size_t k = 0; k < events.rows.size(); ++k) {
    BreakEvent const& event = events.rows[k];
    fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{},{}", stage, event.step, event.id_a, event.id_b,
                   break_mode_name(event.mode), event.x, event.y);
    if (events.detailed)
      for (BreakDetailColumn const& column : break_detail_columns)
        fmt::format_to(std::back_inserter(rows), ",{}", events.details[k].*column.value);
    rows += '\n';
  }
  if (!rows.empty()) file_.write(rows);
}

namespace {

constexpr std::size_t largest_events_file = std::size_t{4} << 30;

void add_event(std::vector<std::string_view> const& cells, BreakEvents& events) {
  std::size_t const wanted = events.detailed ? detailed_cells : plain_cells;
  if (cells.size() != wanted) throw std::invalid_argument(fmt::format("has {} cells, not {}", cells.size(), wanted));
  int mode = 1;
  while (mode < break_mode_count && cells[4] != break_mode_name(mode)) ++mode;
  if (mode == break_mode_count) throw std::invalid_argument("names no mode of breakage");
  auto const whole = [&](std::size_t k) { return static_cast<std::int64_t>(parse_number(cells[k])); };
  events.rows.push_back(
      {whole(1), static_cast<int>(whole(2)), static_cast<int>(whole(3)), mode, parse_number(cells[5]), parse_number(cells[6])});
  if (!events.detailed) return;
  BreakDetails details;
  std::size_t k = plain_cells;
  for (BreakDetailColumn const& column : break_detail_columns) details.*column.value = parse_number(cells[k++]);
  events.details.push_back(details);
}

}  // namespace

BreakEvents read_events(std::filesystem::path const& path) {
  std::string const text = read_text_file(path, largest_events_file);
  BreakEvents events;
  for (CsvRows rows(text); rows.next();) {
    if (rows.line() == 1) {
      events.detailed = rows.text() == header(true);
      if (!events.detailed && rows.text() != header(false))
        throw FileProblem(ExitCode::bad_input, path, "line 1 is not the header of an events.csv");
      continue;
    }
    try {
      add_event(rows.cells(), events);
    } catch (std::invalid_argument const& problem) {
      throw FileProblem(ExitCode::bad_input, path, fmt::format("line {} {}", rows.line(), problem.what()));
    }
  }
  return events;
}

}  // namespace clathra
