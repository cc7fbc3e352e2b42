#include "terminal/duration.hpp"

#include <cctype>
#include <charconv>
#include <stdexcept>
#include <string_view>

namespace clathra {

double duration_of(std::string const& text) {
  auto const refuse = [&] {
    throw std::invalid_argument("'" + text.substr(0, 40) + "' is not a time; examples: 3h50m, 45m, 90s");
  };
  double seconds = 0, smallest = 1e9;
  char const *at = text.data(), *const end = at + text.size();
  if (text.empty()) refuse();
  while (at < end) {
    double number = 0;
    auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc() || !(number >= 0)) refuse();
    while (next < end && *next == ' ') ++next;
    if (next == end) refuse();
    double const unit = *next == 'h' ? 3600 : *next == 'm' ? 60 : *next == 's' ? 1 : 0;
    if (unit == 0 || unit >= smallest) refuse();  // each unit once, the large ones first
    smallest = unit;
    seconds += number * unit;
    at = next + (std::string_view(next, static_cast<std::size_t>(end - next)).starts_with("min") ? 3 : 1);
    while (at < end && *at == ' ') ++at;
  }
  if (!(seconds < 1e9)) refuse();
  return seconds;
}

std::string duration_problem(std::string const& text) {
  try {
    (void)duration_of(text);
  } catch (std::invalid_argument const& problem) {
    return problem.what();
  }
  return {};
}

std::string time_limit_problem(std::string const& text) {
  std::string const problem = duration_problem(text);
  return problem.empty() && duration_of(text) == 0 ? "'" + text.substr(0, 40) + "' leaves no time; leave it out for no limit"
                                                   : problem;
}

}  // namespace clathra
