#pragma once
/// A scene: everything a run is told, in SI units and after validation. io/scene_file fills it from TOML.
#include <cstdint>
#include <string>
#include <vector>

#include "domain/scene/loading_stage.hpp"
#include "domain/scene/step_choice.hpp"
#include "kernels/bond_kind.hpp"
#include "kernels/precision.hpp"

namespace clathra {

enum class Generator { under_compaction, compression };
enum class VoidRatioAt { preparation, test };
enum class BondLawKind { none, thickness_dependent, constant_thickness };
enum class ThicknessMapping { identity, clamped, scaled };
enum class StrengthFrom { printed, conditions };
enum class CriticalThicknessFrom { saturation, given, bond_area };
/// How bonds lose hydrate as the saturation falls (hydrate_loss.hpp).
enum class HydrateLoss { critical_thickness, recession, uniform };

/// L_r, the length that Eq. 9b lacks: a length of its own or a part of the width B of the bond, L_r = length + width_fraction B.
struct RollingLever {
  double length = 0;  ///< [m]
  double width_fraction = 0;
  bool operator==(RollingLever const&) const = default;
};

/// `[specimen]`: any three of particles, box (width and height), void ratio and grading fix the fourth; 0 or empty = not given.
struct SpecimenScene {
  Generator generator = Generator::under_compaction;
  std::int64_t particles = 0;
  double void_ratio = 0;                                 ///< nominal; 0 = not given (then 0.24 if it is not the fourth)
  VoidRatioAt void_ratio_at = VoidRatioAt::preparation;  ///< under preparation_stress, or consolidated at the start of the test
  double width = 0, height = 0;                          ///< [m]; one of them alone fixes the other by aspect_ratio
  double aspect_ratio = 2;                               ///< height / width
  double preparation_stress = 50e3;                      ///< isotropic, at which it is made and hydrate forms [Pa]
  int compaction_layers = 5;                             ///< at most (compaction_layers(Scene, SpecimenDesign))
  std::string file;                                      ///< specimen to read instead of making one

  bool is_read() const { return !file.empty(); }
};

/// `[grains]`. What the numbers after a semicolon say of a key's trade was measured (docs/explanation/accuracy.md).
struct GrainScene {
  double density = 2600;  ///< [kg/m^3]
  double normal_stiffness = 3e8,
         shear_stiffness = 2e8;  ///< k_n, k_s [N/m per m]; k_n a third: 0.73 of the steps, peak of q -10 %
  double friction = 0.5;
  double rolling_width_factor = 1;  ///< beta
};

/// `[grading]`: a named table, a CSV file (diameter with unit in the header, percent finer), scaled to d50 if that is given.
struct GradingScene {
  std::string table = "toyoura";  ///< "toyoura" or "uniform" (all discs d50)
  std::string file;
  double d50 = 0;  ///< [m]; 0 = the table's own (0.1694 mm for toyoura)
};

/// `[hydrate]`
struct HydrateScene {
  double saturation = 0;         ///< S_MH as a fraction 0..1; 0 = clean sand
  double temperature = 5;        ///< [deg C]
  double pore_pressure = 8e6;    ///< sigma_w [Pa]
  double density = 900;          ///< [kg/m^3]
  double salinity = 35;          ///< of the pore water [ppt]
  double spread_of_loss = 0.02;  ///< saturation above 20 % over which the rest of bonds is lost, where Eq. 3 jumps
  double loss_exponent = 1;      ///< n of HydrateLoss::uniform
  HydrateLoss loss = HydrateLoss::critical_thickness;
};

/// `[bond]`
struct BondScene {
  std::string preset = "calibrated";  ///< of what the paper leaves open: io/scene/presets.hpp
  BondLawKind law = BondLawKind::thickness_dependent;
  ContactCoupling contact_coupling = ContactCoupling::parallel;
  double grain_stiffness_factor = 2;  ///< k_n of one grain (Eq. 16) over that of a contact: two grains in series make a contact
  RollingLever rolling_lever = {0, 1.0 / 4};
  ThicknessMapping thickness_mapping = ThicknessMapping::identity;
  bool friction_floor = false;  ///< R_s >= mu F_n, R_r >= F_n B_c / 6
  StrengthFrom strength_from = StrengthFrom::conditions;
  double strength_modulus = 0;      ///< Weibull's m of the strength from bond to bond; 0 = all alike
  std::uint64_t strength_seed = 1;  ///< of that
  CriticalThicknessFrom critical_thickness_from = CriticalThicknessFrom::saturation;
  double critical_thickness = 0;    ///< h_max for CriticalThicknessFrom::given [m]
  double constant_thickness = 0;    ///< t_0 of constant_thickness [m]; 0 = h_max / 2
  bool after_consolidation = true;  ///< bond at the confining stress instead
};

/// `[test]`: a kind of test in a biaxial cell, on a specimen that rests under confining_stress. Exactly one of inertial_number
/// and strain_rate drives it; max_platen_wave_stress bounds the first. What the numbers after a semicolon say of a key's trade
/// was measured (docs/explanation/accuracy.md).
struct TestScene {
  TestKind kind = TestKind::biaxial;  ///< stages_of()
  double confining_stress = 1e6;      ///< sigma_3 [Pa]
  double axial_strain = 0.15;         ///< to reach
  double inertial_number = 2e-4;  ///< I, 0 where strain_rate is given; 1e-3: peak of q of sand +5.6 +- 0.8 %, 2e-4: +0.7 +- 0.5 %
  double strain_rate = 0;         ///< [1/s]
  /// The rate of inertial_number is lowered until W is no larger, 0 = whatever it is; 20,000 discs at 55 %, 0.26: peak of q
  /// +1.4 +- 0.5 %, 0.2: +1.0 +- 0.5 %, 0.13: +0.3 +- 0.5 %.
  double max_platen_wave_stress = 0.13;
  double wall_friction = 0;
  int consolidation_steps = 200000;  ///< at most; likewise of each increment of a stress
  // Of kinds that ask for them:
  double largest_stress = 0;                   ///< of isotropic and oedometer tests [Pa]; 0 = four times the confining stress
  int increments = 20;                         ///< of these, on the way up and on the way down, and of hydrate
  std::vector<double> unload_at;               ///< axial strains, ascending; empty = half of axial_strain
  std::vector<double> cyclic_deviator_stress;  ///< two, ascending [Pa]; empty = between axial strains of 0 and axial_strain
  int cycles = 10;
  double fluid_modulus = 0;          ///< K_w of constant_volume [Pa]; 0 = infinite
  double dead_load = 0;              ///< deviator stress of a creep test, and while hydrate changes [Pa]
  double final_temperature = 15;     ///< of heating [deg C]
  double final_pore_pressure = 3e6;  ///< of depressurisation [Pa]
  double final_saturation = 0.2;     ///< of both
};

/// `[damping]`: parts of the model. What the numbers after a semicolon say was measured (docs/explanation/accuracy.md).
struct DampingScene {
  double local = 0.3;        ///< alpha of local damping in the shear stage; 0: peak of q at 55 % -12.7 +- 1.5 %
  double viscous_ratio = 0;  ///< of contacts, to the critical damping; 0.2 for local damping: peak of q at 55 % -5 to -7 %
};

/// `[run]`. What the numbers after a semicolon say of a key's trade was measured (docs/explanation/accuracy.md).
struct RunScene {
  std::string preset = "standard";  ///< a point of the trade of speed for accuracy: io/scene/presets.hpp
  std::uint64_t seed = 1;
  int threads = 0;                         ///< 0 = OMP_NUM_THREADS or all cores
  Precision precision = Precision::mixed;  ///< of consolidation and shear, not of generation; mixed: peak of q -0.2 +- 0.4 %
  TimeStepRule time_step_rule = TimeStepRule::adaptive;
  double time_step_safety = 0;  ///< 0 = the usual one of the rule; half of it: peak of q -0.3 +- 1.6 %
  static constexpr double usual_inertia_factor = 3;
  /// Moments of inertia over their own, in consolidation and shear; 3: peak of q 0.0 +- 0.6 % at I = 2e-4.
  double rotational_inertia_factor = usual_inertia_factor;
  /// Share of the discs, the smallest, that get the mass of the next one, likewise, 0 = none; 0.25: peak of q -0.1 +- 1.3 %.
  double mass_scaled_fraction = 0;
  double verlet_skin = 0;      ///< skin [m], 0 = chosen; moves rounding only
  bool ignore_guards = false;  ///< go on where a guard refuses; noted in run.json

  /// Beyond the usual moments of inertia, which move no number of a test that is as slow as usual (docs/explanation/accuracy.md).
  bool scales_masses_further() const { return rotational_inertia_factor > usual_inertia_factor || mass_scaled_fraction > 0; }
  StepChoice step_choice() const {
    double const usual = time_step_rule == TimeStepRule::adaptive ? usual_share_of_limit : usual_share_of_estimate;
    return {time_step_rule, time_step_safety > 0 ? time_step_safety : usual};
  }
};

/// `[output]`
struct OutputScene {
  std::string folder = "out";
  int records = 750;                 ///< history rows over the whole strain
  int snapshots = 15;                ///< over the whole strain, besides the one at its start; 0 = none at all
  std::vector<double> snapshots_at;  ///< axial strains of further snapshots, ascending, each once
  bool energy = false;               ///< keep the energy ledger
  bool events = true;                ///< events.csv: each broken bond
  bool event_details = false;        ///< with further columns; only with events
  bool lossless_snapshots = false;   ///< snapshots as they are computed, not rounded
  bool keep_checkpoint = true;       ///< of the end of a test, to extend it

  bool takes_event_details() const { return events && event_details; }
  bool takes_snapshots() const { return snapshots > 0 || !snapshots_at.empty(); }
};

struct Scene {
  SpecimenScene specimen;
  GrainScene grains;
  GradingScene grading;
  HydrateScene hydrate;
  BondScene bond;
  DampingScene damping;
  TestScene test;
  RunScene run;
  OutputScene output;
  std::vector<LoadingStage> stages;  ///< `[[stage]]`, of TestKind::list
};

}  // namespace clathra
