#pragma once
/// What a study will cost.
#include <string>

#include "study_plan.hpp"

namespace clathra {

/// Members whose memory fits into this machine's side by side; one at least.
int parallel_in_memory(StudyPlan const& plan);

/// The table that `clathra study --dry-run` prints: members, specimens, time, disk, memory. Measures the speed of this machine if
/// that is not known. @param parallel  members at a time;  @param threads  of each
std::string study_forecast(StudyPlan const& plan, int parallel, int threads);

}  // namespace clathra
