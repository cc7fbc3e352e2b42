#pragma once
/// What a run will cost and whether it can be done, before it is done.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "domain/biaxial/scene_cost.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen_design.hpp"
#include "domain/scene/stage.hpp"
#include "io/scene/scene_file.hpp"
#include "machine/machine_speed.hpp"

namespace clathra {

struct Forecast {
  StageRecord numbers;  ///< of predict()
  std::vector<std::string> warnings;
  std::vector<std::string> refusals;  ///< what only --ignore-guards overrides
  bool out_of_memory = false;         ///< one of these is the memory
};

/// @param design  of the specimen: as the scene asks for it, or as it was read
/// @param ranks  that will share the run
Forecast forecast(Scene const& scene, SpecimenDesign const& design, int ranks);

inline constexpr double usable_memory = 0.9;  ///< of what is free

/// Why there is not enough memory for a scene of these numbers, or nothing.
std::string memory_refusal(StageRecord const& numbers);

/// All that is wrong with a scene but does not stop it: what `check` and `run` warn of before anything is
/// computed.
std::vector<std::string> warnings_of(LoadedScene const& input, Forecast const& forecast);
/// The same as lines.
std::string warnings_text(LoadedScene const& input, Forecast const& forecast);

/// Discs that are packed have few contacts, no bonds and mixed precision: so many times as many particle-steps a second as in the
/// shear.
inline constexpr double generation_speedup = 2;

/// The table that `check` prints.
std::string forecast_text(Scene const& scene, Forecast const& forecast, MachineSpeed const& speed);

/// The same for scripts: numbers of the forecast in SI units, times in seconds, refusals.
nlohmann::ordered_json forecast_json(Scene const& scene, Forecast const& forecast, MachineSpeed const& speed);

/// @throws Refused with all refusals, OutOfMemory where memory is the only one, unless guards are ignored
void refuse_if_needed(Scene const& scene, Forecast const& forecast);

}  // namespace clathra
