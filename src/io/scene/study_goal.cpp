#include "io/scene/study_goal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "domain/measurement/test_numbers.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"
#include "kernels/break_mode.hpp"

namespace clathra {
namespace {

/// Columns of study.csv, the one table of them.
std::vector<std::string> columns(NumbersOf of) {
  TestNumbers every;
  every.secant_modulus = every.dilation_angle = 0;
  std::vector<std::string> names;
  for (auto const& entry : record_of(every)) names.push_back(entry.first);
  for (BreakModeNames const& mode : break_modes) names.emplace_back(mode.broken);
  if (of == NumbersOf::envelopes)
    for (char const* const state : {"peak", "residual"})
      for (char const* const number : {"_cohesion_Pa", "_friction_angle_deg"}) names.push_back(std::string(state) + number);
  return names;
}

std::string without_unit(std::string const& name) {
  for (std::string_view const unit : {"_Pa", "_deg", "_pct"})
    if (name.ends_with(unit)) return name.substr(0, name.size() - unit.size());
  return name;
}

}  // namespace

std::vector<std::string> number_names(NumbersOf of) {
  std::vector<std::string> names = columns(of);
  std::transform(names.begin(), names.end(), names.begin(), without_unit);
  return names;
}

std::string number_of_name(std::string_view name, NumbersOf of) {
  for (std::string const& column : columns(of))
    if (name == column || name == without_unit(column)) return column;
  std::vector<std::string> const names = number_names(of);
  std::vector<std::string_view> const views(names.begin(), names.end());
  name = name.substr(0, 60);
  std::string hint = name_suggestion(name, views);
  if (hint.empty()) hint = fmt::format("; there are {}", fmt::join(names, ", "));
  throw std::invalid_argument(fmt::format("names no number of a test: '{}'{}", name, hint));
}

double goal_width(std::string_view text) {
  double const width = parse_share(text);
  if (width > 0 && width < 1) return width;
  throw std::invalid_argument(
      fmt::format("must lie above 0 and below 100 %, got {}{}", text, is_bare(text) ? percent_hint(width) : ""));
}

StudyGoal study_goal(std::string const& text) {
  auto const equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw std::invalid_argument("needs the form NUMBER=WIDTH, as in peak_q=2%");
  return {number_of_name(std::string_view(text).substr(0, equals), NumbersOf::envelopes),
          goal_width(std::string_view(text).substr(equals + 1))};
}

}  // namespace clathra
