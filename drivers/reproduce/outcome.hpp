#pragma once
/// What comes out of a reproduction: scorecard, study.csv and page, of what tests there are.
#include <optional>
#include <string>
#include <vector>

#include "io/results/laboratory_data.hpp"
#include "io/results/paper.hpp"
#include "reproduce/reproduction.hpp"
#include "study/study_plan.hpp"
#include "terminal/progress_line.hpp"

namespace clathra {

struct ReproductionOutcome {
  Paper paper;
  ReproductionSize size;
  std::vector<std::string> overrides;  ///< of all tests
  std::optional<LaboratoryData> data;  ///< drawn into the figures
  bool quick = false;                  ///< too small to decide much
};

/// Writes them into the study's folder and says how each claim fares. @return done only where every test is finished
ExitCode conclude(StudyPlan const& plan, ReproductionOutcome const& outcome, ProgressLine& line);

}  // namespace clathra
