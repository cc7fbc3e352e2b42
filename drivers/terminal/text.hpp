#pragma once
/// Numbers and lines as the program prints them; the clock that it takes times by.
#include <string>

namespace clathra {

/// "41 s", "3 min 05 s", "2 h 10 min", "12 days"; "?" where the time is not known.
std::string duration_text(double seconds);

/// "31 M": a number with the prefix that makes it short.
std::string short_count(double value);

/// A line of a table: two blanks, its name, its value.
std::string table_row(std::string const& name, std::string const& value);

/// Seconds of a clock that never goes back.
double clock_seconds();

}  // namespace clathra
