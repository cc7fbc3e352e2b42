#pragma once
/// The biaxial test of a specimen: bond, consolidate, shear.
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "domain/measurement/history_row.hpp"
#include "domain/measurement/snapshot.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen.hpp"
#include "domain/scene/stage.hpp"
#include "domain/simulation/simulation_state.hpp"

namespace clathra {

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
  /// Rows of the stages before the shear: one wherever the mean stress has changed by a hundredth of the confining stress, and
  /// both ends. None of a test that goes on from a state.
  std::vector<HistoryRow> const& consolidation() const;

  /// Goes on from a state, on any number of ranks, with the bits of the test that gave it.
  BiaxialTest(Scene const& scene, TestState state, Ranks const& ranks);
  TestState state() const;

  bool finished() const;
  /// Makes at most so many steps towards the next history row. @param pause_at  axial strain at which it returns before
  /// @return whether the row is due;  @throws Diverged
  bool advance(std::int64_t most_steps, double pause_at = std::numeric_limits<double>::infinity());
  HistoryRow record();             ///< measured now; what a row has of all steps since the row before begins anew
  EnergyRow energy();              ///< only with scene.output.energy
  BreakEvents take_events();       ///< broken bonds since the last call (none without output.events and snapshots), sorted
                                   ///< by (step, id_a, id_b); on rank 0 only
  double axial_strain() const;     ///< eps_1
  double strain_fraction() const;  ///< eps_1 / target
  /// What was not quasi-static or overlapped too far in the shear so far, in words and in numbers (shear_watch.hpp). The checks
  /// have an interval of their own; preparation() holds the verdict `quasi_static`, 1 or 0, which they may take back.
  std::vector<std::string> shear_warnings() const;
  StageRecord shear_checks() const;
  BreakEvents events_after(std::int64_t step) const;  ///< those already taken that came later; on rank 0 only
  std::int64_t disc_steps() const;                    ///< of consolidation and shear
  std::int64_t shear_disc_steps() const;              ///< since the shear began
  double search_seconds() const;  ///< wall time of the neighbour searches since the bonds were installed, or since resuming
  std::uint64_t state_hash() const;
  Specimen specimen() const;  ///< the present state, to go on from
  Snapshot snapshot() const;  ///< the present state, to look at, without events; only where the scene takes some
  StageRecord plan() const;   ///< steps, dt, strain rate, I, W, wall time guess inputs

 private:
  bool advance_unobserved(std::int64_t most_steps, double pause_at);

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

}  // namespace clathra
