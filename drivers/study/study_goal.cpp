#include "study/study_goal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "io/results/interval_text.hpp"

namespace clathra {
namespace {

/// The seeds that a group has, in the order in which they came.
std::vector<std::uint64_t> seeds_of(StudyPlan const& plan, std::size_t group) {
  std::vector<std::uint64_t> seeds;
  for (MemberResult const& member : plan.members)
    if (member.group == group) seeds.push_back(member.seed);
  return seeds;
}

std::string number_text(GroupNumbers const& group, std::string const& name, std::string const& words, char const* unit,
                        double factor) {
  auto const found = group.values.find(name);
  if (found == group.values.end()) return {};
  std::string text = fmt::format("{} {} {}", words, interval_text(mean_interval(found->second), factor), unit);
  if (found->second.size() != group.seeds.size()) text += fmt::format(" (of {})", found->second.size());
  return text;
}

std::string rising_text(GroupNumbers const& group) {
  std::size_t const rising = group.without_peak();
  return rising == 0 ? "" : fmt::format(" (still rising in {} of {})", rising, group.seeds.size());
}

std::string line_of(GroupNumbers const& group, std::vector<std::string> const& parts) {
  std::string text;
  for (std::string const& part : parts)
    if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
  return fmt::format("{:<9} {} ({} seed{})\n", "", group.name + ": " + text, group.seeds.size(),
                     group.seeds.size() == 1 ? "" : "s");
}

/// Of tests that are not one compression: the axial strain of each stage, and the share that failed under its load.
std::vector<std::string> texts_of_stages(GroupNumbers const& group) {
  std::vector<std::string> texts;
  for (auto const& [name, values] : group.values) {
    std::size_t const dot = name.rfind('.');
    std::string const number = name.substr(dot == name.npos ? 0 : dot + 1),
                      stage = dot == name.npos ? "" : " of " + name.substr(0, dot);
    if (number == "strain_eps1") texts.push_back(number_text(group, name, "eps1" + stage, "%", 100));
    if (number == "failed") texts.push_back(number_text(group, name, "failed" + stage, "%", 100));
  }
  return texts;
}

}  // namespace

std::map<std::string, GoalSearch::Searched> GoalSearch::collect(StudyPlan const& plan) const {
  std::map<std::string, Searched> found;
  bool const of_envelope = goal_->number.ends_with("_cohesion_Pa") || goal_->number.ends_with("_friction_angle_deg");
  std::set<std::size_t> refused;
  for (MemberResult const& member : plan.members)
    if (is_refused(member)) refused.insert(member.group);
  for (std::size_t g = 0; g < plan.study.groups.size(); ++g) {
    StudyGroup const& group = plan.study.groups[g];
    if (refused.contains(g)) continue;
    Searched& searched =
        found.try_emplace(of_envelope ? group.material : group.name, Searched{{}, SequentialMean(goal_->width), {}})
            .first->second;
    searched.groups.push_back(g);
  }
  for (GroupNumbers const& numbers :
       of_envelope ? envelopes_by_material(plan.study, plan.members) : numbers_by_group(plan.study, plan.members))
    if (auto const values = numbers.values.find(goal_->number); values != numbers.values.end())
      found.at(numbers.name).values = values->second;
  return found;
}

bool GoalSearch::add_members(StudyPlan& plan, ProgressLine& line) {
  if (!goal_) return false;
  bool added = false;
  for (auto const& [name, searched] : collect(plan)) {
    SequentialMean& search = searches_.try_emplace(name, goal_->width).first->second;
    if (search.done()) continue;
    if (searched.values.empty()) {
      line.warn(fmt::format("{}: no seed gave {}", name, goal_->number));
      continue;
    }
    search.look(searched.values);
    if (search.done()) continue;
    std::vector<std::uint64_t> const seeds = seeds_of(plan, searched.groups.front());
    auto const count = static_cast<int>(seeds.size()),
               more = std::min(search.wanted() - static_cast<int>(searched.values.size()), max_seeds_ - count);
    if (more <= 0) {
      MeanInterval const now = mean_interval(searched.values);
      line.warn(fmt::format("{}: {} is known to {:.2g} % with {} seeds, not to {:.2g} %", name, goal_->number,
                            100 * now.half_width.value_or(0) / std::abs(now.mean), count, 100 * goal_->width));
      continue;
    }
    std::uint64_t const last = *std::max_element(seeds.begin(), seeds.end());
    for (std::size_t const group : searched.groups)
      for (int i = 1; i <= more; ++i) add_member(plan, group, last + static_cast<std::uint64_t>(i));
    added = true;
  }
  return added;
}

std::string statistics_text(StudyPlan const& plan) {
  std::string text;
  for (GroupNumbers const& group : numbers_by_group(plan.study, plan.members))
    text += group.values.contains("peak_q_Pa")
                ? line_of(group, {number_text(group, "peak_q_Pa", "peak q", "MPa", 1e-6) + rising_text(group),
                                  number_text(group, "residual_q_Pa", "residual q", "MPa", 1e-6) + rising_text(group)})
                : line_of(group, texts_of_stages(group));
  for (GroupNumbers const& material : envelopes_by_material(plan.study, plan.members))
    text += line_of(material, {number_text(material, "peak_cohesion_Pa", "c", "MPa", 1e-6),
                               number_text(material, "peak_friction_angle_deg", "φ", "°", 1)});
  return text.empty() ? text : "mean" + text.substr(4);
}

}  // namespace clathra
