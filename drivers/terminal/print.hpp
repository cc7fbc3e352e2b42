#pragma once
/// The two standard streams. Of several ranks only the first one speaks. Control characters, which may come from a scene or a
/// file, are written as "\x1b": a terminal would obey them.
#include <string>

#include "io/errors/problems.hpp"

namespace clathra {

/// Writes a verb's result, of any number of lines, to stdout. @return io_error, with a message, where it cannot be written (a
/// full disk); a reader that went away is none
ExitCode print_result(std::string const& text);

/// From now on print_result() and progress say nothing; warnings and errors are heard.
void be_quiet();
bool is_quiet();

/// Writes what a script reads, to stdout, quiet or not. @return as print_result()
ExitCode print_json(std::string const& text);
/// Whether it has written something.
bool has_printed_json();

/// Writes a line to stderr; failure is ignored, for there is nobody left to tell.
void print_error(std::string const& line);

}  // namespace clathra
