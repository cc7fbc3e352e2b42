#include "io/events.hpp"

#include <fmt/format.h>

#include <iterator>

namespace clathra {

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

EventsFile::EventsFile(std::filesystem::path path) : file_(std::move(path)) { file_.write("step,id_a,id_b,mode,x_m,y_m\n"); }

void EventsFile::write(std::vector<BreakEvent> const& events) {
  std::string rows;
  for (BreakEvent const& event : events)
    fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{}\n", event.step, event.id_a, event.id_b,
                   break_mode_name(event.mode), event.x, event.y);
  if (!rows.empty()) file_.write(rows);
}

}  // namespace clathra
