#pragma once
/// Numbers and lines as the program prints them; the clock that it takes times by.
#include <string>
#include <vector>

namespace clathra {

/// "41 s", "3 min 05 s", "2 h 10 min", "12 days"; "?" where the time is not known.
std::string duration_text(double seconds);

/// "a", "a and b", "a, b and 3 more".
std::string listed(std::vector<std::string> const& names);

/// "31 M": a number with the prefix that makes it short.
std::string short_count(double value);

/// A line of a table: two blanks, its name, its value.
std::string table_row(std::string const& name, std::string const& value);

/// Seconds of a clock that never goes back.
double clock_seconds();

}  // namespace clathra
