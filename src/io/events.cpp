#include "io/events.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <stdexcept>

#include "domain/units.hpp"
#include "io/problems.hpp"

namespace clathra {

namespace {
constexpr std::string_view header = "step,id_a,id_b,mode,x_m,y_m";
}

char const* break_mode_name(int mode) {
  switch (static_cast<BreakMode>(mode)) {
    case BreakMode::tension:
      return "tension";
    case BreakMode::compression:
      return "compression";
    case BreakMode::shear:
      return "shear";
    case BreakMode::rolling:
      return "rolling";
    case BreakMode::none:
      break;
  }
  return "none";
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

BreakEvent parse_event(std::string_view line) {
  std::array<std::string_view, 6> cells;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    auto const comma = line.find(',');
    if ((comma == std::string_view::npos) != (k + 1 == cells.size())) throw std::invalid_argument("has not six cells");
    cells[k] = line.substr(0, comma);
    line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
  }
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
  std::size_t line = 0;
  for (std::size_t from = 0, end; (end = text.find('\n', from)) != std::string::npos; from = end + 1) {
    std::string_view const row = std::string_view(text).substr(from, end - from);
    if (++line == 1) {
      if (row != header) throw FileProblem(ExitCode::bad_input, path, "line 1 is not the header of an events.csv");
      continue;
    }
    try {
      events.push_back(parse_event(row));
    } catch (std::invalid_argument const& problem) {
      throw FileProblem(ExitCode::bad_input, path, fmt::format("line {} {}", line, problem.what()));
    }
  }
  return events;
}

}  // namespace clathra
