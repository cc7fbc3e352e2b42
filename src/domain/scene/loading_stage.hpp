#pragma once
/// A stage of a test: what the two pairs of sides do, and when it ends. Stresses are effective, compression positive; the
/// vertical one is sigma_1, the lateral one sigma_3, whichever is larger. Strains are natural ones.
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
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
  heating,
  depressurisation,
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

  static SideScene held() {
    SideScene side;
    side.hold = true;
    return side;
  }
  static SideScene at_inertial_number(double closing) {
    SideScene side;
    side.inertial_number = closing;
    return side;
  }
  static SideScene at_stress(double stress) {
    SideScene side;
    side.stress = stress;
    return side;
  }
  static SideScene following(Follow follow) {
    SideScene side;
    side.follow = follow;
    return side;
  }

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

/// Where the saturation of a stage comes from: it is `given`, or hydrate beyond the boundary of stability goes at once
/// (`instant`), or at a rate that was measured (dissociation.hpp).
enum class Dissociation { given, instant, clarke_2001, kim_1987, slow };

/// What temperature, pore pressure and saturation come to by the end of a stage, in straight lines from where they are. What is
/// not given stays.
struct HydrateChange {
  double temperature = not_given;      ///< [deg C]
  double pore_pressure = not_given;    ///< [Pa]
  double saturation = not_given;       ///< 0..1, not above that of formation
  bool constant_total_stress = false;  ///< effective stresses of the sides fall as the pore pressure rises
  bool undrained = false;  ///< likewise; the pressure stays until the boundary of stability, and follows that from there
  Dissociation dissociation = Dissociation::given;
  double duration = 0;  ///< of the stage, for a rate of dissociation; 0 = not given [s]

  bool any() const { return is_given(temperature) || is_given(pore_pressure) || is_given(saturation) || dissociates(); }
  bool dissociates() const { return dissociation != Dissociation::given; }
  bool has_rate() const { return dissociates() && dissociation != Dissociation::instant; }
  bool holds_total_stress() const { return constant_total_stress || undrained; }
};

/// A stage ends where the first of these is reached, from whichever side. Strains count from the consolidation.
struct StageEnd {
  double axial_strain = not_given, volumetric_strain = not_given;
  double deviator_stress = not_given;  ///< q = sigma_1 - sigma_3 [Pa]
  double mean_stress = not_given;      ///< p = (sigma_1 + sigma_3) / 2 [Pa]
  double stress_ratio = not_given;     ///< q / p
  double path = 0;                     ///< of the axial strain within the stage, to and fro; 0 = not given
  double strain_rate = 0;              ///< of the faster sides under stresses, to fall below [1/s]; 0 = not given
  int cycles = 0;                      ///< of two turns each; 0 = not given
  bool rest = false;                   ///< under the stresses that the sides hold

  bool any() const {
    return is_given(axial_strain) || is_given(volumetric_strain) || is_given(deviator_stress) || is_given(mean_stress) ||
           is_given(stress_ratio) || path > 0 || strain_rate > 0 || cycles > 0 || rest;
  }
};

struct LoadingStage {
  LoadingStage() = default;
  LoadingStage(std::string by_name, SideScene const& vertical_side, SideScene const& lateral_side)
      : name(std::move(by_name)), vertical(vertical_side), lateral(lateral_side) {}

  std::string name;
  SideScene vertical, lateral;
  int increments = 1;            ///< in which stresses are put on, with rest after each but the last; of hydrate, at least
  bool allow_unsettled = false;  ///< go on where the specimen does not come to rest
  bool forms_hydrate = false;    ///< at its beginning, under the stresses that then act, and not in the consolidation
  HydrateChange hydrate;
  StageTurn turn;
  StageEnd until;

  /// Whether stresses end it or turn it round.
  bool minds_stress() const {
    return is_given(until.deviator_stress) || is_given(until.mean_stress) || is_given(until.stress_ratio) ||
           !turn.deviator_stress.empty();
  }
  bool has_stress_only() const { return !vertical.has_rate() && !lateral.has_rate(); }
};

/// Whether hydrate forms in one of them, and not in the consolidation.
bool forms_hydrate(std::vector<LoadingStage> const& stages);
/// Whether any of them changes the hydrate.
bool changes_hydrate(std::vector<LoadingStage> const& stages);

inline constexpr double longest_path = 0.5;  ///< of a stage that states none

/// The stages that follow the consolidation: those of the scene, or those that its test.kind stands for.
std::vector<LoadingStage> stages_of(Scene const& scene);

/// Of the axial strain, back and forth, through all stages as far as it is known beforehand; test.axial_strain where none is.
double planned_path(Scene const& scene);
/// Time steps of the stages: of that path at a rate [1/s], and of stresses that are put on. @param time_step  [s]
double planned_steps(Scene const& scene, double strain_rate, double time_step);

}  // namespace clathra
