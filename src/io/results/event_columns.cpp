#include "io/results/event_columns.hpp"

#include <fmt/format.h>

#include <cmath>

#include "kernels/break_mode.hpp"

namespace clathra {

namespace {

std::string name_of(BreakDetailColumn const& column) { return std::string("events/") + column.name; }

}  // namespace

void write_event_columns(Hdf5File& file, BreakEvents const& events) {
  std::vector<double> step;
  std::vector<std::int32_t> id_a, id_b;
  std::vector<std::uint8_t> mode;
  for (BreakEvent const& e : events.rows) {
    step.push_back(static_cast<double>(e.step));
    id_a.push_back(e.id_a);
    id_b.push_back(e.id_b);
    mode.push_back(static_cast<std::uint8_t>(e.mode));
  }
  file.write("events/step", step, "");
  file.write("events/id_a", id_a, "");
  file.write("events/id_b", id_b, "");
  std::string key;
  for (BreakModeNames const& m : break_modes)
    key += fmt::format("{}{} {}", key.empty() ? "" : ", ", static_cast<int>(m.mode), m.name);
  file.write("events/mode", mode, key.c_str());
  if (!events.detailed) return;
  for (BreakDetailColumn const& column : break_detail_columns) {
    std::vector<double> values;
    for (BreakDetails const& details : events.details) values.push_back(details.*column.value);
    file.write(name_of(column), values, column.unit);
  }
}

BreakEvents read_event_columns(Hdf5File const& file, RowRange const& rows) {
  auto const step = file.read<double>("events/step", rows);
  auto const id_a = file.read<std::int32_t>("events/id_a", rows), id_b = file.read<std::int32_t>("events/id_b", rows);
  auto const mode = file.read<std::uint8_t>("events/mode", rows);
  BreakEvents events;
  for (std::size_t k = 0; k < step.size(); ++k) {
    if (mode[k] < 1 || mode[k] >= break_mode_count)
      file.fail(ExitCode::bad_input, fmt::format("events/mode holds {}, which is no mode of breakage", mode[k]));
    events.rows.push_back({std::llround(step[k]), id_a[k], id_b[k], mode[k], 0, 0});
  }
  events.detailed = file.has(name_of(break_detail_columns[0]));
  if (!events.detailed) return events;
  events.details.resize(events.rows.size());
  for (BreakDetailColumn const& column : break_detail_columns) {
    auto const values = file.read<double>(name_of(column), rows);
    for (std::size_t k = 0; k < values.size(); ++k) events.details[k].*column.value = values[k];
  }
  return events;
}

}  // namespace clathra
