#pragma once
/// A stage of a test: what the two pairs of sides do, and when it ends. Stresses are effective, compression positive; the
/// vertical one is sigma_1, the lateral one sigma_3, whichever is larger. Strains are natural ones.
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace clathra {

struct Scene;

// Names of stages: of the consolidation, the second where hydrate forms after the first, and of what is sheared to failure.
inline constexpr char consolidation_stage[] = "consolidation", hydrate_consolidation_stage[] = "consolidation with hydrate",
                      shear_stage[] = "shear";
inline bool is_consolidation(std::string_view stage) {
  return stage == consolidation_stage || stage == hydrate_consolidation_stage;
}

inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();
inline bool is_given(double value) { return !std::isnan(value); }

/// Tests that are lists of stages with a name, and `list` for a scene that states its own.
enum class TestKind {
  biaxial,
  extension,
  isotropic,
  oedometer,
  constant_volume,
  constant_mean_stress,
  unload_reload,
  cyclic,
  creep,
  list
};

enum class Follow { nothing, constant_volume, constant_mean_stress };

/// What a pair of opposite sides does: exactly one of these is given.
struct SideScene {
  bool hold = false;           ///< they stand
  double inertial_number = 0;  ///< I, closing positive; test.max_platen_wave_stress bounds it
  double strain_rate = 0;      ///< [1/s], closing positive
  double stress = 0;           ///< to be reached and held [Pa]
  Follow follow = Follow::nothing;
  double fluid_modulus = 0;  ///< of the fluid that keeps a constant volume, K_w [Pa]; 0 = infinite

  bool has_rate() const { return inertial_number != 0 || strain_rate != 0; }
  bool has_stress() const { return stress != 0; }
  /// Of a rate: 1 closes, -1 opens.
  double sense() const { return inertial_number < 0 || strain_rate < 0 ? -1 : 1; }
  bool operator==(SideScene const&) const = default;
};

/// Where a rate turns round: none, or two of one kind, ascending.
struct StageTurn {
  std::vector<double> deviator_stress;  ///< q [Pa]
  std::vector<double> axial_strain;     ///< since the consolidation
  bool any() const { return !deviator_stress.empty() || !axial_strain.empty(); }
};

/// A stage ends where the first of these is reached, from whichever side. Strains count from the consolidation.
struct StageEnd {
  double axial_strain = not_given, volumetric_strain = not_given;
  double deviator_stress = not_given;  ///< q = sigma_1 - sigma_3 [Pa]
  double mean_stress = not_given;      ///< p = (sigma_1 + sigma_3) / 2 [Pa]
  double stress_ratio = not_given;     ///< q / p
  double path = 0;                     ///< of the axial strain within the stage, to and fro; 0 = not given
  int cycles = 0;                      ///< of two turns each; 0 = not given
  bool rest = false;                   ///< under the stresses that the sides hold
};

struct LoadingStage {
  std::string name;
  SideScene vertical, lateral;
  int increments = 1;            ///< in which stresses are put on, with rest after each but the last
  bool allow_unsettled = false;  ///< go on where the specimen does not come to rest
  StageTurn turn;
  StageEnd until;

  bool has_stress_only() const { return !vertical.has_rate() && !lateral.has_rate(); }
};

inline constexpr double longest_path = 0.5;  ///< of a stage that states none

/// The stages that follow the consolidation: those of the scene, or those that its test.kind stands for.
std::vector<LoadingStage> stages_of(Scene const& scene);

/// Of the axial strain, to and fro, through all stages as far as it is known beforehand; test.axial_strain where none is.
double planned_path(Scene const& scene);

}  // namespace clathra
