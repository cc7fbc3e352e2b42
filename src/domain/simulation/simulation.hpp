#pragma once
/// A specimen in motion: an assembly and the one time step.
#include "domain/scene/specimen.hpp"
#include "domain/simulation/assembly.hpp"
#include "domain/simulation/simulation_state.hpp"
#include "domain/simulation/time_step_control.hpp"
#include "kernels/rebuild_inputs.hpp"

namespace clathra {

/// Steps that the host need not look at.
struct StepsAtOnce {
  int count = 1;
  bool may_search = false;  ///< in the last one
};

/// Several ranks may share a simulation. All calls are then collective (Assembly).
class Simulation {
 public:
  /// Takes over a specimen with the history of its contacts, at rest or in motion. Forces are evaluated, the clock starts at 0.
  /// @param specimen  this rank's share of it: each disc and each contact on one rank, whichever
  /// @param skin  Verlet skin [m], surface to surface, of discs at rest; those that fly have more (verlet_skin.hpp)
  Simulation(Specimen const& specimen, SimulationLaws const& laws, Real skin, Ranks ranks = {});
  /// Goes on from a state, on any number of ranks, with the bits of the simulation that gave it.
  /// @param laws  those of that simulation
  Simulation(SimulationState state, SimulationLaws const& laws, Ranks ranks);
  /// All that is needed to go on; not of a periodic cell.
  SimulationState state();

  /// Time steps of leapfrog: afterwards positions, forces and history are those of the new time, velocities lie half a step
  /// behind. Many at once are cheaper on a GPU than one by one, and the same to the bit.
  /// @param count  of steps, or fewer: the first after which box or stresses have left the limits is the last
  void step(std::int64_t count = 1, StepLimits const& limits = {});
  void evaluate_forces();  ///< of the present state without advancing it

  // What can be read of it:
  /// The present state of this rank's discs on the host (specimen_of()).
  Specimen specimen() const;
  Assembly const& assembly() const { return assembly_; }
  TimeStepControl const& time_steps() const { return time_steps_; }
  std::int64_t graph_runs() const { return graph_.runs(); }  ///< of StepGraph::steps steps each
  std::size_t bytes() const;                                 ///< of this rank's fields

  // Settings that may change between steps:
  Real time_step = 0;  ///< dt of the next step [s]; where none has been chosen below it stays as it is set
  /// From now on the time step follows the limit of stability (TimeStepControl).
  void choose_time_step(StepChoice const& choice);
  Loading& loading() { return assembly_.now.walls.loading; }
  /// History that both laws need is kept.
  void set_laws(SimulationLaws const& laws);
  /// Bonds form in the present state. @param bonded  specimen(), with bonds;  @param laws  with those of the bonds
  void form_bonds(Specimen const& bonded, SimulationLaws const& laws);
  /// Bonds as their hydrate becomes between steps: narrower, of another strength, or gone (kernels/hydrate_change.hpp). Forces
  /// are those of the new state afterwards.
  void change_hydrate(BondLaw const& next);
  void set_skin(Real skin);
  void set_ledger(bool on);              ///< opens the ledger with all losses at zero, or closes it
  void keep_breaks(BreakRecord record);  ///< from now on
  void request_search() { assembly_.upkeep.ask(); }
  void set_decomposition(Decomposition const& cuts);           ///< from the next search on
  void mark_start() { assembly_.mark_start(); }                ///< displacements count from here
  void watch_deviator() { assembly_.now.walls.largest = {}; }  ///< the largest one counts from now

  // Motion that is not of its laws:
  void stop_discs() { stop_motion(assembly_.particles); }
  /// Adds a homogeneous motion to the discs, closing positive [1/s]; the walls keep theirs.
  void add_uniform_strain_rate(Real rate_x, Real rate_y);
  /// Gives the walls new drives and sets walls and discs in motion with the same step: where discs alone moved at once, the first
  /// step would take them away from the walls. @param rate_x,rate_y  added to the discs, as in add_uniform_strain_rate()
  void drive(AxisDrive const& x, AxisDrive const& y, Real rate_x, Real rate_y);
  /// Closes box and discs homogeneously at once, by these strains. A periodic cell keeps its lower left corner, walls their
  /// middle.
  void strain(Real x, Real y);
  /// The same by the height alone, and of the discs and the top wall above a height only; not for a periodic cell.
  void strain_above(Coord floor, Real y);

 private:
  void advance(StepsAtOnce const& steps);
  void upload_state(bool host_synchronous);
  void enqueue_steps(int steps);
  void enqueue_motion(int ahead, StepLaunches const& launches);
  void enqueue_forces(StepLaunches const& launches);
  void end_move(bool has_rebuild_inputs);
  void end_step();
  void rebuild(RebuildInputs const& all, AuxiliaryFields const& also = {});
  void update_time_step();

  Assembly assembly_;
  TimeStepControl time_steps_;
  DeviceSteps steps_;  // the state of the assembly on the device, where steps are under way
  StepGraph graph_;    // of many steps; dropped by whatever gives them other fields or laws
};

}  // namespace clathra
