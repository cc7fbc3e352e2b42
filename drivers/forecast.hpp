#pragma once
/// What a run will cost and whether it can be done, before it is done.
#include <string>
#include <vector>

#include "domain/experiment.hpp"

namespace clathra {

struct Forecast {
  StageRecord numbers;               ///< of predict()
  double disc_steps_per_second = 0;  ///< assumed
  std::vector<std::string> warnings;
  std::vector<std::string> refusals;  ///< what only --force overrides
};

/// @param disc_steps_per_second  0 = 15 million a thread, the floor that the program is held to
/// @param ranks  that will share the run
Forecast forecast(Scene const& scene, double disc_steps_per_second, int ranks);

/// Why there is not enough memory for a scene of these numbers, or nothing.
std::string memory_refusal(StageRecord const& numbers);

/// The table that `check` and `--dry-run` print.
std::string forecast_text(Scene const& scene, Forecast const& forecast);

/// @throws Refused with all refusals, unless the scene is forced
void refuse_if_needed(Scene const& scene, Forecast const& forecast);

}  // namespace clathra
