#pragma once
/// A specimen in motion: owns the discs, rows, walls and laws, and the one time step.
#include <string>
#include <vector>

#include "domain/parallel/disc_packing.hpp"
#include "domain/parallel/halo.hpp"
#include "domain/scene/specimen.hpp"
#include "domain/scene/stage.hpp"
#include "domain/scene/step_choice.hpp"
#include "domain/simulation/broken_bonds.hpp"
#include "domain/simulation/periodic_images.hpp"
#include "domain/simulation/simulation_state.hpp"
#include "kernels/forces.hpp"
#include "kernels/measures.hpp"
#include "kernels/neighbours.hpp"
#include "kernels/spectrum.hpp"
#include "kernels/stability.hpp"
#include "kernels/step_state.hpp"
#include "kernels/survey.hpp"
#include "kernels/verlet_skin.hpp"
#include "kernels/walls.hpp"

namespace clathra {

/// Verlet skin of a test that asks for none, in d50; discs get 1.2 times that on the average (verlet_skin.hpp). Where bonds break
/// all the time it was the fastest of 0.08, 0.10, 0.12 and 0.16; elsewhere it costs 2 % at most against 0.08
/// (docs/performance.md).
inline constexpr double chosen_skin = 0.12;

/// The same in metres, but not so far that small discs behind those that touch are listed, which lie 1.46 radii and more beyond.
/// @param smallest  diameter [m]
inline double usual_skin(double d50, double smallest) { return std::min(chosen_skin * d50, 0.5 * smallest); }

/// Heavier discs than their size makes them, for longer time steps: what is quasi-static does not depend on masses.
struct MassScaling {
  Real inertia = 1;       ///< factor of all moments of inertia
  Real least_radius = 0;  ///< smaller discs have the mass of a disc of this radius [m], and its part in their moment of inertia
};

/// What the discs obey. Features follow from it: rolling moments, bonds, a separate bond history, a ledger exist only if asked
/// for here.
struct SimulationLaws {
  ContactLaws contact;
  WallLaw wall;
  MotionLaw motion;
  MassScaling scaling;  ///< of a specimen that is taken over
  Precision precision = Precision::full;
  ContactFeatures features() const {
    bool const shears = contact.grain.friction > 0 && contact.grain.shear_stiffness > 0;
    return {shears || contact.bond_kind == BondKind::replace,
            contact.grain.shape_factor > 0,
            contact.bond_kind != BondKind::none,
            contact.bond_kind == BondKind::parallel,
            {}};
  }
  LossKinds losses() const {
    ContactFeatures const f = features();
    return {f.shear || wall.friction > 0, f.rolling, contact.grain.damping_ratio > 0 || wall.damping_ratio > 0, f.bonds,
            motion.damping > 0};
  }
};

/// Several ranks may share a simulation: each owns the discs of a rectangle and keeps their rows. All calls but those that say
/// "of this rank" are then collective, and what they return is that of the whole specimen and the same on every rank.
class Simulation {
  /// How the time step follows the limit.
  struct StepFollowing {
    bool on = false;
    Real share = 0, ceiling = 0;  ///< dt = min(share * stable_limit(), ceiling)
    Real leeway = 1;              ///< share of its skin that a disc may stray before dt is chosen anew
    Real last = 0;                ///< dt of the step before, 0 before the first [s]
    std::int64_t age = 0;         ///< steps since the last choice
    bool due = false;
  };
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
  /// Chooses the time step from the springs to come and from then on follows the limit of stability (step_choice.hpp): renewed
  /// after each neighbour search, whenever a disc has strayed as far as the bound allows for, and every 1000 steps.
  void choose_time_step(StepChoice const& choice);
  /// History that both laws need is kept. Where the new ones may lower the limit of stability by more than the chosen step leaves
  /// room for, the step is chosen anew before the next one.
  void set_laws(SimulationLaws const& laws);
  void set_skin(Real skin) {
    skin_ = skin;
    rebuild_pending_ = true;
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
  void request_rebuild() { rebuild_pending_ = true; }
  void watch_deviator() { now_.largest = {}; }        ///< the largest one counts from now
  void mark_start();                                  ///< displacements count from here
  void set_decomposition(Decomposition const& cuts);  ///< from the next search on
  void evaluate_forces();                             ///< forces of the present state without advancing it

  // Reading.
  std::int64_t steps() const { return now_.step; }
  std::int64_t rebuilds() const { return rebuilds_; }
  std::int64_t graph_runs() const { return graph_.runs(); }    ///< of StepGraph::steps steps each
  double rebuild_seconds() const { return rebuild_seconds_; }  ///< wall time of all neighbour searches
  Real time() const { return now_.time; }
  int discs() const { return discs_; }
  Ranks const& ranks() const { return ranks_; }
  Decomposition const& decomposition() const { return decomposition_; }
  Walls const& walls() const { return now_.box.walls; }
  PeriodicCell const& cell() const { return now_.box.cell; }
  bool periodic() const { return now_.box.periodic(); }
  Real skin() const { return skin_; }                                   ///< of discs at rest [m]
  Real d50() const { return d50_; }                                     ///< [m]
  Real density() const { return density_; }                             ///< of the grains [kg/m^3]
  Real added_mass() const { return added_mass_; }                       ///< by MassScaling, over the mass of all discs
  Real moving_density() const { return density_ * (1 + added_mass_); }  ///< what inertia and wave number go by [kg/m^3]
  Real critical_thickness() const { return critical_thickness_; }       ///< h_max of the bonds [m], 0 = none
  Real area() const { return now_.box.width() * now_.box.height(); }
  Real solid_area() const { return solid_area_; }
  Real void_ratio() const { return area() / solid_area_ - 1; }  ///< nominal
  WallReactions const& reactions() const { return now_.reactions; }
  WallStress stress() const { return wall_stress(now_.box.walls, now_.reactions); }
  LargestDeviator const& largest_deviator() const { return now_.largest; }  ///< after any step since watch_deviator()
  Real boundary_work() const { return now_.boundary_work; }
  Measures measures() const;
  LossTotals losses() const;
  Real deepest_overlap() const { return ranks_.max(clathra::deepest_overlap(particles_, rows_)); }
  std::uint64_t hash() const;
  /// A safety factor times local_time_step(), but never above 0.95 of stable_limit() [s].
  Real stable_time_step(Real safety = 1) const;
  Real largest_frequency(int iterations = 40) const;  ///< of the present contact network [1/s]
  Real stable_limit() const;                          ///< clathra::stable_limit() of calm discs with the present damping [s]
  std::int64_t time_step_renewals() const { return renewals_; }
  SpringNetwork springs() const;  ///< for those who analyse it further, with across()
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
    return clathra::bytes(particles_) + clathra::bytes(rows_) + halo_.bytes() + clathra::bytes(losses_) + broken_bonds_.bytes() +
           (start_x_.span() + start_y_.span() + step_x_.span() + step_y_.span()) * sizeof(Coord) + search_bytes();
  }
  /// Those of them that only neighbour searches need, kept from one to the next.
  std::size_t search_bytes() const { return scratch_.bytes(); }
  // Of this rank:
  std::size_t contact_entries() const { return rows_.neighbour.extent(0); }
  ParticleSoA const& particles() const { return particles_; }
  ContactRows const& rows() const { return rows_; }
  WallContacts const& wall_contacts() const { return wall_contacts_; }
  EnergyLosses const& energy_losses() const { return losses_; }
  Field<Coord> const& start_x() const { return start_x_; }  ///< [owned] where mark_start() found the discs [m]
  Field<Coord> const& start_y() const { return start_y_; }
  /// Gives every ghost the value of its disc.
  void refresh_ghosts(AnyField const& field) const;
  void throw_if_unstable() const;

 private:
  void refresh_ghosts() const;  // all of their state
  void rebuild(Survey const& all, bool skin_by_speed = true, AuxiliaryFields const& also = {});
  void find_rows_and_walls(SearchReach const& reach, OldRows& old, Field<int> const& slot, WallShear const& wall_shear);
  Survey survey_discs() const;
  Survey checked(Survey of_this_rank) const;
  Bounds own_bounds(Bounds const& all) const;
  void upload_discs(Specimen const& specimen);
  void restore_history(Specimen const& specimen);
  AffineFrame frame() const { return frame_since(now_.box, now_.search.box); }
  SkinRange skin_range(bool by_speed) const;
  Real reach_in_skins() const { return 2 * largest_radius_ / skin_ + 1; }
  bool have_strayed(Mark& mark, Field<Coord> const& x, Field<Coord> const& y, Real leeway) const;
  bool host_goes_along() const { return !ranks_.alone() || periodic() || rebuild_pending_; }
  StepsAtOnce steps_at_once(std::int64_t most) const;
  void advance(StepsAtOnce const& steps);
  void hand_over(bool host_goes_along);
  void ask_for(int steps);
  void move_discs(int ahead, StepLaunches const& launches);
  void push_discs(StepLaunches const& launches);
  void end_move(bool surveyed);
  void end_step();
  void renew_time_step();
  bool sorting_is_due();
  void rebalance_if_it_pays();
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
  void require_places_told_apart() const;
  template <class Visit>
  void for_each_number(Visit&& visit);
  std::vector<SpecimenContact> contacts_by_id() const;
  bool log_lasts() const;  // until all bonds are broken
  void make_room_for_breaks();
  void throw_of(double const* disc) const;
  Real height() const { return now_.box.height(); }

  Ranks ranks_;
  Summation sums_;
  Decomposition decomposition_;
  ParticleSoA particles_;
  ContactRows rows_;
  SimulationLaws laws_;
  SimulationLaws laws_of_choice_;  // under which the time step was chosen
  StepState now_;                  // as it was after the last step that is done
  DeviceSteps steps_;              // the same on the device, where steps are under way
  StepGraph graph_;                // of many steps; dropped by whatever gives them other fields or laws
  WallContacts wall_contacts_;
  PeriodicImages images_;
  Halo halo_;
  mutable BrokenBonds broken_bonds_;  // collected when they are asked for
  EnergyLosses losses_;
  Faults faults_;
  Real skin_ = 0, reach_ = 0, solid_area_ = 0, largest_radius_ = 0;
  Real density_ = 0, d50_ = 0, critical_thickness_ = 0, added_mass_ = 0;
  std::int64_t rebuilds_ = 0, searched_at_ = 0;  // the step of the last
  mutable std::int64_t last_good_step_ = 0;      // of the last look for faults that found none
  double rebuild_seconds_ = 0;
  int discs_ = 0;
  Field<Coord> start_x_, start_y_;
  int searches_until_sorting_ = 0;  // in space; the first sorts
  StepFollowing following_;
  Field<Coord> step_x_, step_y_;  // [owned] where that choice found the discs [m]; empty where no step was chosen
  std::int64_t renewals_ = 0;
  double busy_seconds_ = 0;  // of this rank since the cuts were made
  bool rebuild_pending_ = true;
  Scratch scratch_;  // of neighbour searches
};

}  // namespace clathra
