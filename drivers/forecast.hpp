#pragma once
/// What a run will cost and whether it can be done, before it is done.
#include <string>
#include <vector>

#include "domain/biaxial/scene_cost.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen.hpp"
#include "domain/scene/stage.hpp"
#include "io/scene/scene_file.hpp"

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

/// Adds that a specimen from a file is too narrow, if it is: the checks of the scene know only those that are generated.
/// @param specimen  this rank's part
void check_size(Forecast& forecast, Specimen const& specimen, Ranks const& ranks = {});

/// Why there is not enough memory for a scene of these numbers, or nothing.
std::string memory_refusal(StageRecord const& numbers);

/// All that is wrong with a scene but does not stop it: what `check`, `run --dry-run` and `run` warn of before anything is
/// computed.
std::vector<std::string> warnings_of(LoadedScene const& input, Forecast const& forecast);
/// The same as lines.
std::string warnings_text(LoadedScene const& input, Forecast const& forecast);

/// The table that `check` and `--dry-run` print.
std::string forecast_text(Scene const& scene, Forecast const& forecast);

/// @throws Refused with all refusals, unless the scene is forced
void refuse_if_needed(Scene const& scene, Forecast const& forecast);

}  // namespace clathra
