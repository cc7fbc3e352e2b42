#pragma once
/// Everything a running biaxial test knows; of biaxial_test.cpp and biaxial_records.cpp alone.
#include <algorithm>
#include <cmath>

#include "domain/biaxial/biaxial_test.hpp"
#include "domain/biaxial/dilation_watch.hpp"
#include "domain/biaxial/quasi_static.hpp"
#include "domain/biaxial/shear_watch.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/scene/scene.hpp"
#include "domain/simulation/simulation.hpp"

namespace clathra {

/// The laws of consolidation and shear: only what the scene needs. @param h_max  of the bonds [m], 0 = none
SimulationLaws test_laws(Scene const& scene, double d50, double h_max);

struct BiaxialTest::State {
  Scene scene;
  Ranks ranks;
  std::unique_ptr<Simulation> simulation;
  StageRecord preparation;
  std::vector<std::string> warnings;
  RateNumbers rate;
  double d50 = 0, height0 = 0, area0 = 0;
  std::string stage = shear_stage;        // that the test is in
  std::vector<HistoryRow> consolidation;  // of the stages before the shear
  std::int64_t bonds0 = 0, records_due = 0, first_step = 0;
  double record_interval = 0, start_time = 0;  // of axial strain; of the stage [s]
  std::int64_t disc_steps = 0;
  int events_taken = 0;                              // of those that this rank has seen
  bool at_rest = false, began_quasi_static = false;  // when the shear began
  EnergyRow start;
  ShearWatch watch;
  DilationWatch dilation;
  Measures measured;
  std::int64_t measured_after = -1;  ///< steps

  void bond_and_consolidate(Specimen specimen, ProgressCallback const& progress);
  std::string text_of_scaling() const;
  MassScaling mass_scaling(std::vector<double> const& radii) const;
  void begin_stage(char const* name);
  void consolidate(char const* stage_name, ProgressCallback const& progress);
  void approach(double stress, double closing_rate, std::int64_t most_steps, ProgressCallback const& progress);
  void record_consolidation(bool anyway);
  void require_rest(std::int64_t steps);
  void warn_of_density(double before, double made_under);
  void require_grains(double deep_share) const;
  void begin_shear();
  double next_record() const { return static_cast<double>(records_due + 1) * record_interval * (1 - 1e-9); }
  bool record_is_due() const { return eps1() >= next_record(); }
  /// Of the box [m]: above it there is nothing to be seen to. A hair too high for the rounding, which costs a look at most.
  double height_of_next_look(double pause_at) const {
    double const last = scene.test.axial_strain * (1 - 1e-9);
    return height0 * std::exp(-std::min({watch.next(), next_record(), last, pause_at})) * (1 + 1e-12);
  }
  double eps1() const { return std::log(height0 / simulation->assembly().walls().height()); }
  double eps_v() const { return std::log(area0 / simulation->assembly().area()); }
  void check();
  /// @param m  of the specimen as it stands;  @param strain_rate  [1/s], for I and W
  HistoryRow row(Measures const& m, double strain_rate) const;
  /// Of the specimen as it stands after its last step: who asks for it first has it measured. Collective.
  Measures const& measures();
  double skin(std::vector<double> const& radii) const;  ///< of this rank's discs; collective
  template <class Visit>
  void for_each_number(Visit&& visit);
  void count_disc_steps() { disc_steps += simulation->assembly().steps() * simulation->assembly().discs(); }
};

}  // namespace clathra
