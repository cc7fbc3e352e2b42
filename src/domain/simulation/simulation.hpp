#pragma once
/// A specimen in motion: owns the discs, rows, walls and laws, and the one time step.
#include <string>
#include <vector>

#include "domain/scene/specimen.hpp"
#include "domain/scene/stage.hpp"
#include "domain/simulation/broken_bonds.hpp"
#include "domain/simulation/ghosts.hpp"
#include "domain/simulation/neighbour_list_upkeep.hpp"
#include "domain/simulation/simulation_laws.hpp"
#include "domain/simulation/simulation_state.hpp"
#include "domain/simulation/time_step_control.hpp"
#include "kernels/measures.hpp"
#include "kernels/rebuild_inputs.hpp"
#include "kernels/spectrum.hpp"
#include "kernels/step_state.hpp"

namespace clathra {

/// Verlet skin of a test that asks for none, in d50; discs get 1.2 times that on the average (verlet_skin.hpp). Where bonds break
/// all the time it was the fastest of 0.08, 0.10, 0.12 and 0.16; elsewhere it costs 2 % at most against 0.08
/// (docs/performance.md).
inline constexpr double chosen_skin = 0.12;

/// The same in metres, but not so far that small discs behind those that touch are listed, which lie 1.46 radii and more beyond.
/// @param smallest  diameter [m]
inline double usual_skin(double d50, double smallest) { return std::min(chosen_skin * d50, 0.5 * smallest); }

/// What stays as it is while an assembly moves.
struct AssemblyFacts {
  int discs = 0;
  Real d50 = 0, smallest_radius = 0, largest_radius = 0;  ///< [m]
  Real density = 0;                                       ///< of the grains [kg/m^3]
  Real solid_area = 0;                                    ///< [m^2]
  Real added_mass = 0;                                    ///< by MassScaling, over the mass of all discs
  Real critical_thickness = 0;                            ///< h_max of the bonds [m], 0 = none

  Real moving_density() const { return density * (1 + added_mass); }  ///< what inertia and wave number go by [kg/m^3]

  /// Visits the numbers: (name, number).
  template <class Visit>
  void for_each_number(Visit&& visit) {
    visit("discs", discs);
    visit("d50", d50);
    visit("smallest_radius", smallest_radius);
    visit("largest_radius", largest_radius);
    visit("density", density);
    visit("solid_area", solid_area);
    visit("added_mass", added_mass);
    visit("critical_thickness", critical_thickness);
  }
};

/// Several ranks may share a simulation: each owns the discs of a rectangle and keeps their rows. All calls but those that say
/// "of this rank" are then collective, and what they return is that of the whole specimen and the same on every rank.
class Simulation {
  struct StepsAtOnce {
    int count;
    bool may_search;  ///< in the last one
  };

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
  /// @param count  of steps, or fewer: the first after which the box is as low as `until_height` [m] is the last
  void step(std::int64_t count = 1, Real until_height = 0);

  /// The present state of this rank's discs on the host, ordered by id; of a pair of discs of two ranks, the one with the smaller
  /// id brings the contact.
  Specimen specimen() const;

  // Settings that may change between steps.
  Real time_step = 0;  ///< dt of the next step [s]; where none has been chosen below it stays as it is set
  Loading& loading() { return now_.loading; }
  Loading const& loading() const { return now_.loading; }
  /// From now on the time step follows the limit of stability (TimeStepControl).
  void choose_time_step(StepChoice const& choice);
  /// History that both laws need is kept.
  void set_laws(SimulationLaws const& laws);
  void set_skin(Real skin) {
    upkeep_.set_skin(skin);
    upkeep_.ask();
  }
  void set_ledger(bool on);         ///< opens the ledger with all losses at zero, or closes it
  void keep_break_events(bool on);  ///< from now on; without, only their numbers by mode are known
  void keep_break_details();        ///< of events, from now on, with strains that count from now
  void stop_discs() { stop_motion(particles_); }
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
  void request_search() { upkeep_.ask(); }
  void watch_deviator() { now_.largest = {}; }        ///< the largest one counts from now
  void mark_start();                                  ///< displacements count from here
  void set_decomposition(Decomposition const& cuts);  ///< from the next search on
  void evaluate_forces();                             ///< forces of the present state without advancing it

  // Reading.
  std::int64_t steps() const { return now_.step; }
  NeighbourListUpkeep const& upkeep() const { return upkeep_; }
  TimeStepControl const& time_steps() const { return time_steps_; }
  std::int64_t graph_runs() const { return graph_.runs(); }  ///< of StepGraph::steps steps each
  Real time() const { return now_.time; }
  AssemblyFacts const& facts() const { return facts_; }
  int discs() const { return facts_.discs; }
  Ranks const& ranks() const { return ghosts_.ranks(); }
  Decomposition const& decomposition() const { return ghosts_.decomposition(); }
  Walls const& walls() const { return now_.box.walls; }
  PeriodicCell const& cell() const { return now_.box.cell; }
  bool periodic() const { return now_.box.periodic(); }
  Real area() const { return now_.box.width() * now_.box.height(); }
  Real void_ratio() const { return area() / facts_.solid_area - 1; }  ///< nominal
  WallReactions const& reactions() const { return now_.reactions; }
  WallStress stress() const { return wall_stress(now_.box.walls, now_.reactions); }
  LargestDeviator const& largest_deviator() const { return now_.largest; }  ///< after any step since watch_deviator()
  Real boundary_work() const { return now_.boundary_work; }
  Measures measures() const;
  DissipationTotals losses() const;
  Real deepest_overlap() const { return ranks().max(clathra::deepest_overlap(particles_, rows_)); }
  std::uint64_t hash() const;
  /// A safety factor times local_time_step(), but never above 0.95 of stable_limit() [s].
  Real stable_time_step(Real safety = 1) const;
  Real largest_frequency(int iterations = 40) const;  ///< of the present contact network [1/s]
  Real stable_limit() const;                          ///< clathra::stable_limit() of calm discs with the present damping [s]
  SpringNetwork springs() const;                      ///< for those who analyse it further, with across()
  AcrossRanks across() const;
  SimulationLaws const& laws() const { return laws_; }
  int broken_bonds() const;
  BreakCounts break_counts() const;  ///< so far
  /// Breaks that this rank has seen while events were kept, from the first-th on, sorted by (step, id_a, id_b). Each break is
  /// seen by one rank.
  std::vector<BreakEvent> break_events(int first) const { return detailed_break_events(first).rows; }
  BreakEvents detailed_break_events(int first) const;  ///< the same, with the details where these are kept
  /// Bytes of this rank's fields, with the ledger, the log of breaks and what neighbour searches need beside them.
  std::size_t bytes() const {
    return clathra::bytes(particles_) + clathra::bytes(rows_) + ghosts_.bytes() + clathra::bytes(losses_) +
           broken_bonds_.bytes() +
           (start_x_.span() + start_y_.span() + time_steps_.places().x.span() + time_steps_.places().y.span()) * sizeof(Coord) +
           search_bytes();
  }
  /// Those of them that only neighbour searches need, kept from one to the next.
  std::size_t search_bytes() const { return scratch_.bytes(); }
  // Of this rank:
  std::size_t contact_entries() const { return rows_.neighbour.extent(0); }
  ParticleSoA const& particles() const { return particles_; }
  ContactRows const& rows() const { return rows_; }
  WallContacts const& wall_contacts() const { return wall_contacts_; }
  Dissipation const& energy_losses() const { return losses_; }
  Field<Coord> const& start_x() const { return start_x_; }  ///< [owned] where mark_start() found the discs [m]
  Field<Coord> const& start_y() const { return start_y_; }
  /// Gives every ghost the value of its disc.
  void refresh_ghosts(AnyField const& field) const;
  void throw_if_unstable() const;

 private:
  void refresh_ghosts() const;  // all of their state
  void rebuild(RebuildInputs const& all, bool skin_by_speed = true, AuxiliaryFields const& also = {});
  void find_rows_and_walls(SearchReach const& reach, OldRows& old, Field<int> const& slot, WallShear const& wall_shear);
  RebuildInputs rebuild_inputs_of_all() const;
  RebuildInputs checked(RebuildInputs of_this_rank) const;
  void upload_discs(Specimen const& specimen);
  void restore_history(Specimen const& specimen);
  AffineFrame frame() const { return frame_since(now_.box, now_.at_search.box); }
  SkinRange skins(bool by_speed) const {
    return upkeep_.skins(now_.box, facts_.smallest_radius, facts_.largest_radius, by_speed);
  }
  bool are_displaced(ReferenceState& reference, Field<Coord> const& x, Field<Coord> const& y, Real skin_fraction) const;
  bool host_synchronous() const { return !ranks().alone() || periodic() || upkeep_.is_asked(); }
  StepsAtOnce steps_at_once(std::int64_t most) const;
  void advance(StepsAtOnce const& steps);
  void upload_state(bool host_synchronous);
  void enqueue_steps(int steps);
  void enqueue_motion(int ahead, StepLaunches const& launches);
  void enqueue_forces(StepLaunches const& launches);
  void end_move(bool has_rebuild_inputs);
  void end_step();
  void update_time_step();
  AuxiliaryFields auxiliary_fields(WallShear& wall_shear);
  void set_sums();
  ContactFeatures features_of_rows() const;
  AuxiliaryFields forces();
  AuxiliaryFields derived();
  /// A sum over the specimen. A term that is out of its range is a fault, of the disc that another fault names if there is one.
  template <class Work>
  auto in_range(Work const& sum) const {
    try {
      return sum();
    } catch (SumOutOfRange const& problem) {
      throw_if_unstable();
      throw_out_of_range(problem);
    }
  }
  [[noreturn]] void throw_out_of_range(SumOutOfRange const& problem) const;
  std::vector<double> records_of_own_discs(DiscRecords discs);
  void find_listed_neighbours();
  void require_places_told_apart(Real reach) const;
  template <class Visit>
  void for_each_number(Visit&& visit);
  std::vector<SpecimenContact> contacts_by_id() const;
  bool log_lasts() const;  // until all bonds are broken
  void make_room_for_breaks();
  void throw_of(double const* disc) const;
  Real height() const { return now_.box.height(); }

  Ghosts ghosts_;  // with the ranks and who owns which disc
  Summation sums_;
  AssemblyFacts facts_;
  ParticleSoA particles_;
  ContactRows rows_;
  WallContacts wall_contacts_;
  SimulationLaws laws_;
  NeighbourListUpkeep upkeep_;
  TimeStepControl time_steps_;
  StepState now_;                     // as it was after the last step that is done
  DeviceSteps steps_;                 // the same on the device, where steps are under way
  StepGraph graph_;                   // of many steps; dropped by whatever gives them other fields or laws
  mutable BrokenBonds broken_bonds_;  // collected when they are asked for
  Dissipation losses_;
  Faults faults_;
  mutable std::int64_t last_good_step_ = 0;  // of the last look for faults that found none
  Field<Coord> start_x_, start_y_;
  Scratch scratch_;  // of neighbour searches
};

}  // namespace clathra
