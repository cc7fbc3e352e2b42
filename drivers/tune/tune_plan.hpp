#pragma once
/// Which settings of a scene `clathra tune` may run, on which specimens, and what each would cost the scene itself.
#include <string>
#include <vector>

#include "study/study_plan.hpp"
#include "tune/setting_search.hpp"

namespace clathra {

/// What of the solver is tuned; the model stays as it is.
struct TuneSetting {
  double inertial_number = 0;
  Precision precision = Precision::full;
  double dt_safety = 0;  ///< 0 = the usual one
  double inertia_scaling = 1, mass_scaling = 0;

  bool operator==(TuneSetting const&) const = default;
};

struct TunePlan {
  LoadedScene base;        ///< the scene with the overrides of the command line
  StudyGoal goal;          ///< the number, and how large its error may be
  std::int64_t discs = 0;  ///< of a level
  bool reduced = false;    ///< levels are smaller than the scene
  std::vector<TuneSetting> settings;
  std::size_t as_it_stands = 0;  ///< the setting of the scene, at the rate that it has
  StudyPlan study;               ///< groups are settings, members are levels of a seed
  double speed_of_mixed = 1;     ///< over that of double precision, in particle-steps a second on this machine

  /// The trials of a search among the settings, costs by prediction.
  std::vector<Trial> trials() const;
  /// W of a level at its rate. It grows with the height: the scene itself keeps to it by test.max_platen_wave_stress.
  double platen_wave_stress(std::size_t setting) const;
  /// The scene at full size with a setting.
  Scene scene_with(std::size_t setting) const;
  /// Cost of the scene at a setting over its cost as it stands: steps that it needs by the rates of both and by the time steps of
  /// the levels, where these were run, and the speed of precisions.
  double relative_cost(std::size_t setting) const;
  /// What is written into the scene for a setting, without comments.
  std::vector<Setting> keys_of(std::size_t setting) const;
};

/// Ladder: rates from 3e-3 on that fall to a third, in double precision with half the usual time step and no masses scaled; at
/// each rate the usual time step, moments of inertia times 3, small discs made heavier, mixed precision. @param discs  of a level
/// @throws SceneProblems, Refused
TunePlan plan_tune(std::filesystem::path const& scene, std::vector<std::string> const& overrides, StudyGoal const& goal,
                   std::int64_t discs, std::filesystem::path const& folder);

}  // namespace clathra
