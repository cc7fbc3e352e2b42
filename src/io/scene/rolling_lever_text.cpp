#include "io/scene/rolling_lever_text.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "domain/scene/units.hpp"

namespace clathra {
namespace {

std::string_view without_spaces(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

/// "B/4" and "B" as well as "0.25 B".
double width_fraction(std::string_view text) {
  if (text.ends_with('B')) {
    std::string_view const factor = without_spaces(text.substr(0, text.size() - 1));
    return factor.empty() ? 1 : parse_number(factor);
  }
  std::string_view const rest = without_spaces(text.substr(1));
  if (!rest.starts_with('/')) throw std::invalid_argument(fmt::format("needs a part of B like \"B/4\", got {}", quote_of(text)));
  return 1 / parse_number(without_spaces(rest.substr(1)));
}

}  // namespace

RollingLever parse_rolling_lever(std::string_view text) {
  text = without_spaces(text);
  bool const has_width = text.starts_with('B') || text.ends_with('B');
  RollingLever lever;
  try {
    if (!has_width && text.find_first_not_of("0123456789+-.eE") == std::string_view::npos) throw std::invalid_argument("no unit");
    (has_width ? lever.width_fraction : lever.length) =
        has_width ? width_fraction(text) : parse_quantity(text, Dimension::length);
  } catch (std::invalid_argument const&) {
    throw std::invalid_argument(
        fmt::format("needs a length (\"1 mm\") or a part of the bond width B (\"0.25 B\", \"B/4\"), got {}{}", quote_of(text),
                    text.find(',') == text.npos ? "" : "; a number has a decimal point"));
  }
  bool const in_range = has_width ? lever.width_fraction >= least_width_fraction && lever.width_fraction <= most_width_fraction
                                  : lever.length >= shortest_lever && lever.length <= longest_lever;
  if (!in_range) throw std::invalid_argument(fmt::format("must lie in {}, got {}", rolling_lever_limits(), quote_of(text)));
  return lever;
}

std::string format_rolling_lever(RollingLever const& lever) {
  if (lever.length > 0) return format_quantity(lever.length, Dimension::length);
  return format_number(lever.width_fraction) + " B";
}

std::string rolling_lever_limits() {
  return fmt::format("{} to {}, or {} B to {} B", format_quantity(shortest_lever, Dimension::length),
                     format_quantity(longest_lever, Dimension::length), format_number(least_width_fraction),
                     format_number(most_width_fraction));
}

}  // namespace clathra
