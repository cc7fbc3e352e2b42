#pragma once
/// Seeds until a mean is known well enough, and what is known of all means.
#include <map>
#include <string>

#include "domain/measurement/confidence.hpp"
#include "study/study_plan.hpp"
#include "terminal/progress_line.hpp"

namespace clathra {

/// Follows the goal of a study, wave by wave: each group (each material, where the number is one of its envelopes) has its own
/// number of seeds. What it decides follows from the results alone, so a study that is resumed decides the same again.
class GoalSearch {
 public:
  explicit GoalSearch(Study const& study) : goal_(study.precision_target), max_seeds_(study.max_seeds) {}
  /// Looks at what is finished and adds the members of the next wave. @return false where there is none: every mean is known, or
  /// has as many seeds as it may, which is then a warning
  bool add_members(StudyPlan& plan, ProgressLine& line);

 private:
  struct Searched {
    std::vector<std::size_t> groups;  ///< whose seeds it shares
    SequentialMean search;
    std::vector<double> values;
  };
  std::map<std::string, Searched> collect(StudyPlan const& plan) const;

  std::optional<StudyGoal> goal_;
  int max_seeds_;
  std::map<std::string, SequentialMean> searches_;
};

/// A line for each group: peak and residual q with their intervals, and c and phi of each material.
std::string statistics_text(StudyPlan const& plan);

}  // namespace clathra
