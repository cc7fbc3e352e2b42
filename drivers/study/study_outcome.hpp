#pragma once
/// What comes out of a study: study.csv and the page of what members there are.
#include "io/errors/problems.hpp"
#include "study/study_plan.hpp"
#include "terminal/progress_line.hpp"

namespace clathra {

/// A line for each member that failed; those whose specimen could not be made stand below that, once.
std::string failures_text(StudyPlan const& plan);

/// Writes them into the study's folder and says how many members there are. @return done only where every member is finished
ExitCode conclude(StudyPlan const& plan, ProgressLine& line);

}  // namespace clathra
