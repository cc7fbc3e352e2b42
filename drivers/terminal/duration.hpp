#pragma once
/// Times as people give them to a batch system.
#include <string>

namespace clathra {

/// "3h50m", "90s", "2h", "10 min", "1h5m30s" in seconds. @throws std::invalid_argument
double duration_of(std::string const& text);

/// What is wrong with such a text, or nothing.
std::string duration_problem(std::string const& text);
/// The same, of a time that cannot be 0.
std::string time_limit_problem(std::string const& text);

}  // namespace clathra
