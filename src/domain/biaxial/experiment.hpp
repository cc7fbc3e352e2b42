#pragma once
/// From a scene to a sheared specimen: generate, bond, consolidate, shear. What the drivers call.
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "domain/measurement/history_row.hpp"
#include "domain/measurement/snapshot.hpp"
#include "domain/scene/progress.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen.hpp"
#include "domain/simulation/simulation.hpp"

namespace clathra {

/// Named numbers of a stage, for run.json and the screen.
using StageRecord = std::map<std::string, double>;

/// A generated specimen with the proof of its quality: void ratio (whole, each layer, standard deviation), distance to the
/// grading, d50, friction used, stress and unbalanced ratio.
struct GeneratedSpecimen {
  Specimen specimen;
  StageRecord record;
  std::vector<double> layer_void_ratios;
};

/// Generates by scene.sample.generator (not `file`). Same scene, same bits, for any thread count.
/// @throws Refused where the void ratio cannot be reached, Diverged, Stopped
/// @return this rank's share of the specimen, and the record of the whole
GeneratedSpecimen generate_specimen(Scene const& scene, ProgressCallback const& progress, Ranks const& ranks = {});

/// Installs bonds on a resting, unbonded specimen by scene.bond and scene.hydrate.
/// The record holds bonds, bonds_per_disc, h_max, geometric (areal) saturation, rejected_no_tension, rejected_out_of_fit.
/// @param specimen  this rank's share as Simulation::specimen() or by_place() give it; gains the bonds
void bond_specimen(Scene const& scene, Specimen& specimen, StageRecord& record, Ranks const& ranks = {});

struct TestState;

/// Biaxial compression of a specimen (which is bonded first if the scene has hydrate and the specimen has no bonds).
class BiaxialTest {
 public:
  /// Bonds and consolidates. @throws Refused, Diverged, Stopped
  /// @param specimen  this rank's share of it, whichever. All calls are collective.
  BiaxialTest(Scene const& scene, Specimen specimen, ProgressCallback const& progress, Ranks const& ranks = {});
  BiaxialTest(BiaxialTest&& other) noexcept;
  ~BiaxialTest();

  StageRecord const& preparation() const;  ///< numbers of bonding and consolidation, time step and its margin
  std::vector<std::string> const& warnings() const;

  /// Goes on from a state, on any number of ranks, with the bits of the test that gave it.
  BiaxialTest(Scene const& scene, TestState state, Ranks const& ranks);
  TestState state() const;

  bool finished() const;
  /// Makes at most so many steps towards the next history row. @return whether it is due;  @throws Diverged
  bool advance(std::int64_t most_steps);
  HistoryRow record();                    ///< measured now
  EnergyRow energy();                     ///< only with scene.output.energy
  std::vector<BreakEvent> take_events();  ///< broken bonds since the last call (none without output.events and snapshots), sorted
                                          ///< by (step, id_a, id_b); on rank 0 only
  double strain_fraction() const;         ///< eps_1 / target
  /// What was not quasi-static or overlapped too far in the shear so far, in words and in numbers (shear_watch.hpp). The looks
  /// have an interval of their own; preparation() holds the verdict `quasi_static`, 1 or 0, which they may take back.
  std::vector<std::string> shear_warnings() const;
  StageRecord shear_looks() const;
  std::vector<BreakEvent> events_after(std::int64_t step) const;  ///< those already taken that came later; on rank 0 only
  std::int64_t disc_steps() const;
  double search_seconds() const;  ///< wall time of the neighbour searches since the bonds were installed, or since resuming
  std::uint64_t state_hash() const;
  Specimen specimen() const;  ///< the present state, to go on from
  Snapshot snapshot() const;  ///< the present state, to look at, without events; only with scene.output.snapshots
  StageRecord plan() const;   ///< steps, dt, strain rate, I, W, wall time guess inputs

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What a test needs to go on to the bit; this rank's part of discs and events.
struct TestState {
  SimulationState simulation;
  std::size_t events_taken = 0;  ///< of simulation.broken, from the first on
  std::uint64_t hash = 0;        ///< of the whole simulation
  std::map<std::string, double> numbers;
  StageRecord preparation;
  std::vector<std::string> warnings;
};

/// What a scene will cost, without running it: particles, width, height, time step estimate, strain rate, steps, inertial_number,
/// wave_number, memory_bytes (of all ranks at their peak), disk_bytes, disc_steps.
/// @param ranks  that will share it
StageRecord predict(Scene const& scene, int ranks = 1);

}  // namespace clathra
