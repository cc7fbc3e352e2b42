#pragma once
/// events.csv: each broken bond once.
#include <string_view>
#include <vector>

#include "domain/simulation/break_event.hpp"
#include "io/formats/text_file.hpp"

namespace clathra {

class EventsFile {
 public:
  /// Writes the header. @param detailed  with the columns of BreakDetails;  @throws FileProblem cannot_create or io_error
  explicit EventsFile(std::filesystem::path path, bool detailed = false);

  /// Goes on with the file behind its first `bytes`.
  EventsFile(std::filesystem::path path, std::uintmax_t bytes) : file_(std::move(path), bytes) {}

  /// One row an event: the stage of the test, step, ids of the discs, how the bond broke, where [m], and its details where the
  /// events are detailed, as they must be in a file that is. @throws FileProblem io_error
  void write(std::string_view stage, BreakEvents const& events);
  void close() { file_.close(); }
  RowsWritten flushed() const { return file_.flushed(); }

 private:
  RowFile file_;
};

/// The events of an events.csv, in its order, detailed where the file is. A last line without its end is being written, and is
/// left out.
/// @throws FileProblem file_missing, or bad_input with the line that is no event
BreakEvents read_events(std::filesystem::path const& path);

}  // namespace clathra
