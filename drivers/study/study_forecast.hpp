#pragma once
/// What a study will cost.
#include <nlohmann/json.hpp>
#include <string>

#include "study/study_plan.hpp"

namespace clathra {

/// Members whose memory fits into this machine's side by side; one at least.
int parallel_in_memory(StudyPlan const& plan);

struct StudyForecast {
  int parallel = 1, threads = 1;     ///< members at a time, and of each
  double disc_steps_per_second = 0;  ///< of all at once
  double generation_seconds = 0, shear_seconds = 0;
  double memory_bytes = 0, disk_bytes = 0;  ///< of the largest members at a time; of all
  std::string speed_origin;
};

/// Measures the speed of this machine if that is not known. @param parallel  members at a time;  @param threads  of each
StudyForecast study_forecast(StudyPlan const& plan, int parallel, int threads);

/// What `--dry-run` prints, for people and for scripts.
std::string study_forecast_text(StudyPlan const& plan, StudyForecast const& forecast);
nlohmann::ordered_json study_forecast_json(StudyPlan const& plan, StudyForecast const& forecast);

}  // namespace clathra
