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
constexpr std::string_view header = "step,id_a,id_b,mode,x_m,y_m";
}

EventsFile::EventsFile(std::filesystem::path path) : file_(std::move(path)) { file_.write(std::string(header) + "\n"); }

void EventsFile::write(std::vector<BreakEvent> const& events) {
  std::string rows;
  for (BreakEvent const& event : events)
    fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{}\n", event.step, event.id_a, event.id_b,
                   break_mode_name(event.mode), event.x, event.y);
  if (!rows.empty()) file_.write(rows);
}

namespace {

constexpr std::size_t largest_events_file = std::size_t{4} << 30;

BreakEvent parse_event(std::vector<std::string_view> const& cells) {
  if (cells.size() != 6) throw std::invalid_argument("has not six cells");
  int mode = 1;
  while (mode < break_mode_count && cells[3] != break_mode_name(mode)) ++mode;
  if (mode == break_mode_count) throw std::invalid_argument("names no mode of breakage");
  auto const whole = [&](std::size_t k) { return static_cast<std::int64_t>(parse_number(cells[k])); };
  return {whole(0), static_cast<int>(whole(1)), static_cast<int>(whole(2)), mode, parse_number(cells[4]), parse_number(cells[5])};
}

}  // namespace

std::vector<BreakEvent> read_events(std::filesystem::path const& path) {
  std::string const text = read_text_file(path, largest_events_file);
  std::vector<BreakEvent> events;
  for (CsvRows rows(text); rows.next();) {
    if (rows.line() == 1) {
      if (rows.text() != header) throw FileProblem(ExitCode::bad_input, path, "line 1 is not the header of an events.csv");
      continue;
    }
    try {
      events.push_back(parse_event(rows.cells()));
    } catch (std::invalid_argument const& problem) {
      throw FileProblem(ExitCode::bad_input, path, fmt::format("line {} {}", rows.line(), problem.what()));
    }
  }
  return events;
}

}  // namespace clathra
