#pragma once
/// Everything a running biaxial test knows; of the sources beside it alone.
#include <algorithm>
#include <cmath>
#include <optional>

#include "domain/biaxial/biaxial_test.hpp"
#include "domain/biaxial/dilation_watch.hpp"
#include "domain/biaxial/quasi_static.hpp"
#include "domain/biaxial/shear_watch.hpp"
#include "domain/biaxial/stage_place.hpp"
#include "domain/generation/equilibration.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/scene/scene.hpp"
#include "domain/simulation/simulation.hpp"

namespace clathra {

/// The laws of consolidation and shear: only what the scene needs. @param h_max  of the bonds [m], 0 = none
SimulationLaws test_laws(Scene const& scene, double d50, double h_max);

/// A motion of the box, closing positive [1/s].
struct StrainRates {
  double lateral = 0, vertical = 0;
};

/// Where a test stands in its consolidation.
struct Consolidation {
  bool over = false;         ///< the loading has begun
  bool ended = false;        ///< at rest, or given up: hydrate forms next, or the loading begins
  bool bonds_after = false;  ///< hydrate forms when it has ended
  bool bonded = false;       ///< it has formed so
  bool closing = false;      ///< discs and walls together
  std::int64_t closing_steps = 0;
  double closing_rate = 0, servo_speed_x = 0, servo_speed_y = 0;
  double made_under = 0, void_ratio = 0;  ///< stress of the specimen [Pa]; when this part of the consolidation began
  RestWatch rest;

  template <class Visit>
  void for_each_number(Visit&& visit) {
    visit("consolidation_over", over);
    visit("consolidation_ended", ended);
    visit("consolidation_bonds_after", bonds_after);
    visit("consolidation_bonded", bonded);
    visit("consolidation_closing", closing);
    visit("consolidation_closing_steps", closing_steps);
    visit("consolidation_closing_rate", closing_rate);
    visit("consolidation_servo_speed_x", servo_speed_x);
    visit("consolidation_servo_speed_y", servo_speed_y);
    visit("consolidation_made_under", made_under);
    visit("consolidation_void_ratio", void_ratio);
    rest.for_each_number(visit);
  }
};

struct BiaxialTest::State {
  Scene scene;
  std::vector<LoadingStage> stages;  // of the scene
  Ranks ranks;
  std::unique_ptr<Simulation> simulation;
  StageRecord preparation;
  std::vector<std::string> warnings;
  RateNumbers rate;  // of the stage
  double d50 = 0, height0 = 0, area0 = 0;
  std::string stage = shear_stage;  // that the test is in
  StagePlace place;                 // after the consolidation
  std::vector<StageResult> done;    // stages
  TestValues last_row;
  Consolidation consolidation;
  std::vector<HistoryRow> consolidation_rows;
  std::int64_t bonds0 = 0, records_due = 0, first_step = 0;
  double record_interval = 0, start_time = 0;  // of the path; of the stage [s]
  std::int64_t disc_steps = 0;
  int events_taken = 0;             // of those that this rank has seen
  bool began_quasi_static = false;  // when the loading began
  EnergyRow start;
  HydrateState hydrate;      // of now
  double dissolved = 0;      // elastic energy that bonds took along as they changed or left [J/m]
  double work_of_turns = 0;  // what it took to set the discs in motion anew where stages begin and rates turn round [J/m]
  ShearWatch watch;          // of the stage
  DilationWatch dilation;
  Measures measured;
  std::int64_t measured_after = -1;  ///< steps

  std::string text_of_scaling() const;
  MassScaling mass_scaling(std::vector<double> const& radii) const;

  // The consolidation (consolidation.cpp):
  void prepare(Specimen specimen);
  void start_simulation(Specimen specimen);
  void count_from_here(char const* stage_name);
  void begin_consolidation(char const* stage_name);
  void end_closing();
  bool consolidation_row_is_due() const;
  bool consolidate(std::int64_t most_steps);
  void come_to_rest();
  void end_consolidation();
  Progress consolidation_progress() const;
  void require_rest(std::int64_t steps);
  void warn_of_density(double before, double made_under);

  // The loading (loading.cpp):
  void begin_loading();
  void begin_stage(std::int64_t index);
  void set_in_motion(StrainRates const& present);
  StrainRates present_rates() const;
  double signed_rate(SideScene const& side) const;
  bool is_on(double stress, bool lateral) const;
  AxisDrive drive_of(SideScene const& side, double strain_rate, bool lateral, StrainRates const& present) const;
  void require_end_ahead() const;
  void put_increment_on();
  void reverse();
  LoadingStage const& now() const { return stages[static_cast<std::size_t>(place.index)]; }
  bool is_last() const { return place.index + 1 == static_cast<std::int64_t>(stages.size()); }

  // Hydrate that forms or changes (hydrate_course.cpp):
  void form_hydrate();
  HydrateScene hydrate_scene(HydrateState const& state) const;
  BondLaw bond_law_of(HydrateState const& state) const;
  HydrateState hydrate_at(double part) const;
  void put_hydrate_on();
  void change_hydrate(HydrateState const& next);
  double accounted_energy();
  std::string hydrate_words(HydrateState const& state) const;
  double stress_lost() const;
  bool has_lost_stress() const;
  bool is_last_increment() const { return now().hydrate.any() ? place.hydrate_part >= 1 : place.increment >= now().increments; }

  // How it goes on (stage_course.cpp):
  bool advance(std::int64_t most_steps, double pause_at);
  std::int64_t steps_to_look() const;
  StepLimits limits(double pause_at) const;
  bool look();
  void look_at_rest();
  void look_for_failure(double strain_rate);
  bool has_strained_far() const;
  void fail_here();
  bool turn_is_due() const;
  bool holds_lateral_stress() const;
  bool bears_dead_load() const { return now().vertical.has_stress() && (now().increments == 1 || now().hydrate.any()); }
  std::optional<std::string> end_reached() const;
  void end_stage(std::string const& ended_by);
  StageResult result(std::string const& ended_by) const;
  void add_failure(StageResult& result) const;
  double fraction() const;
  /// Whether walls that are steered move as they like: then somebody has to look every now and then.
  bool looks() const;

  void require_grains(double deep_share) const;
  double eps1() const { return std::log(height0 / simulation->assembly().walls().height()); }
  double eps_v() const { return std::log(area0 / simulation->assembly().area()); }
  double path() const { return place.path(eps1()); }
  TestValues values() const;
  double next_record() const { return static_cast<double>(records_due + 1) * record_interval * (1 - 1e-9); }
  bool record_is_due() const;
  void check();
  /// @param m  of the specimen as it stands;  @param strain_rate  [1/s], for I and W
  HistoryRow row(Measures const& m, double strain_rate) const;
  double rate_of_row() const;
  EnergyRow energy();
  /// Of the specimen as it stands after its last step: who asks for it first has it measured. Collective.
  Measures const& measures();
  double skin(std::vector<double> const& radii) const;  ///< of this rank's discs; collective
  template <class Visit>
  void for_each_number(Visit&& visit);
  void count_disc_steps() { disc_steps += simulation->assembly().steps() * simulation->assembly().discs(); }
};

}  // namespace clathra
