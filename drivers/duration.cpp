#include "duration.hpp"

#include <cctype>
#include <charconv>
#include <stdexcept>

namespace clathra {

double duration_of(std::string const& text) {
  auto const refuse = [&] { throw std::invalid_argument("'" + text.substr(0, 40) + "' is no time; examples: 3h50m, 45m, 90s"); };
  double seconds = 0, smallest = 1e9;
  char const *at = text.data(), *const end = at + text.size();
  if (text.empty()) refuse();
  while (at < end) {
    double number = 0;
    auto const [next, error] = std::from_chars(at, end, number);
    if (error != std::errc() || next == end || !(number >= 0)) refuse();
    double const unit = *next == 'h' ? 3600 : *next == 'm' ? 60 : *next == 's' ? 1 : 0;
    if (unit == 0 || unit >= smallest) refuse();  // each unit once, the large ones first
    smallest = unit;
    seconds += number * unit;
    at = next + 1;
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

}  // namespace clathra
