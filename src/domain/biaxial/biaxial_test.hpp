#pragma once
/// A test of a specimen in a biaxial cell: bond, consolidate, and the stages of its loading.
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "domain/measurement/history_row.hpp"
#include "domain/measurement/snapshot.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/scene/loading_stage.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen.hpp"
#include "domain/scene/stage.hpp"
#include "domain/simulation/simulation_state.hpp"

namespace clathra {

struct TestState;

/// What a stage came to.
struct StageResult {
  std::string name;
  std::string ended_by;  ///< "axial strain", ...; empty while it goes on
  StageRecord numbers;
  std::vector<std::string> warnings;  ///< what was not quasi-static, or not reached
};

/// The stages of a scene (stages_of()) on a specimen (which is bonded first if the scene has hydrate and the specimen has no
/// bonds).
class BiaxialTest {
 public:
  /// At the beginning of its consolidation. @throws Refused
  /// @param specimen  this rank's share of it, whichever. All calls are collective.
  static BiaxialTest to_consolidate(Scene const& scene, Specimen specimen, Ranks const& ranks = {});
  /// After its consolidation. @throws Refused, Diverged, Stopped
  BiaxialTest(Scene const& scene, Specimen specimen, ProgressCallback const& progress, Ranks const& ranks = {});
  BiaxialTest(BiaxialTest&& other) noexcept;
  ~BiaxialTest();

  StageRecord const& preparation() const;  ///< numbers of bonding and consolidation, time step and its margin
  std::vector<std::string> const& warnings() const;
  bool consolidates() const;                ///< the loading has not begun
  Progress consolidation_progress() const;  ///< while it consolidates
  /// Rows of the consolidation of a test that was constructed after it: one wherever the mean stress has changed by a hundredth
  /// of the confining stress, and both ends.
  std::vector<HistoryRow> const& consolidation() const;

  /// Goes on from a state, on any number of ranks, with the bits of the test that gave it.
  BiaxialTest(Scene const& scene, TestState state, Ranks const& ranks);
  TestState state() const;

  bool finished() const;
  LoadingStage const& stage() const;  ///< of the loading, that it is in
  /// Makes at most so many steps towards the next history row; a stage has one at its beginning and one at its end.
  /// @param pause_at  path() at which it returns before
  /// @return whether the row is due;  @throws Diverged; Refused where a stage cannot come to its end
  bool advance(std::int64_t most_steps, double pause_at = std::numeric_limits<double>::infinity());
  HistoryRow record();          ///< measured now; what a row has of all steps since the row before begins anew
  EnergyRow energy();           ///< only with scene.output.energy
  BreakEvents take_events();    ///< broken bonds since the last call (none without output.events and snapshots), sorted
                                ///< by (step, id_a, id_b); on rank 0 only
  double axial_strain() const;  ///< eps_1 since the consolidation; of that, while it consolidates
  double path() const;          ///< of the axial strain, to and fro: it always grows
  double path_of_last_record() const;
  double fraction() const;  ///< of the stages that is done, as far as can be told
  /// The stages so far, the last one as far as it is: what was not quasi-static or overlapped too far, in words and in numbers
  /// (shear_watch.hpp). The checks have an interval of their own; preparation() holds the verdict `quasi_static`, 1 or 0, which
  /// they may take back.
  std::vector<StageResult> stage_results() const;
  BreakEvents events_after(std::int64_t step) const;  ///< those already taken that came later; on rank 0 only
  std::int64_t disc_steps() const;                    ///< of consolidation and shear
  std::int64_t loading_disc_steps() const;            ///< since the consolidation
  double search_seconds() const;  ///< wall time of the neighbour searches since the bonds were installed, or since resuming
  std::uint64_t state_hash() const;
  Specimen specimen() const;  ///< the present state, to go on from
  Snapshot snapshot() const;  ///< the present state, to look at, without events; only where the scene takes some
  StageRecord plan() const;   ///< steps, dt, strain rate, I, W, wall time guess inputs

 private:
  BiaxialTest();
  struct State;
  std::unique_ptr<State> state_;
};

/// What a test needs to go on to the bit; this rank's part of discs and events.
struct TestState {
  SimulationState simulation;
  std::size_t events_taken = 0;  ///< of simulation.broken, from the first on
  std::uint64_t hash = 0;        ///< of the whole simulation
  std::map<std::string, double> numbers;
  std::vector<StageResult> done;  ///< stages
  StageRecord preparation;
  std::vector<std::string> warnings;
};

}  // namespace clathra
