#pragma once
/// The particles of a specimen with their neighbours, boundaries and laws: what a step moves and what can be read of it.
#include <memory>
#include <vector>

#include "domain/simulation/broken_bonds.hpp"
#include "domain/simulation/ghosts.hpp"
#include "domain/simulation/neighbour_list_upkeep.hpp"
#include "domain/simulation/rigid_walls.hpp"
#include "kernels/hydrate_change.hpp"
#include "kernels/measures.hpp"
#include "kernels/spectrum.hpp"

namespace clathra {

/// What stays as it is while an assembly moves.
struct AssemblyFacts {
  int discs = 0;
  Real d50 = 0, smallest_radius = 0, largest_radius = 0;  ///< [m]
  Real density = 0;                                       ///< of the grains [kg/m^3]
  Real solid_area = 0;                                    ///< [m^2]
  Real added_mass = 0;                                    ///< by MassScaling, over the mass of all discs
  Real critical_thickness = 0;                            ///< h_max of the bonds [m], 0 = none

  Real moving_density() const { return density * (1 + added_mass); }  ///< what inertia and the platen wave stress go by [kg/m^3]

  /// Visits the numbers: (name, number).
  template <class Visit>
  void for_each_number(Visit&& visit) {
    visit("particles", discs);
    visit("d50", d50);
    visit("smallest_radius", smallest_radius);
    visit("largest_radius", largest_radius);
    visit("density", density);
    visit("solid_area", solid_area);
    visit("added_mass", added_mass);
    visit("critical_thickness", critical_thickness);
  }
};

/// Several ranks may share an assembly: each owns the particles of a rectangle and keeps their rows. All calls but those that say
/// "of this rank" are then collective, and what they return is that of the whole specimen and the same on every rank.
struct Assembly {
  /// Without particles. @param skin  Verlet skin [m] (NeighbourListUpkeep);  @param periodic  whether a cell stands in the place
  /// of walls
  Assembly(SimulationLaws const& by_laws, Real skin, Ranks ranks, bool periodic);

  AssemblyFacts facts;
  SimulationLaws laws;
  StepState now;                                      ///< as it was after the last step that is done
  ParticleSoA particles;                              ///< of this rank, ghosts behind them
  ContactRows rows;                                   ///< of this rank: neighbour list and contact history
  Ghosts ghosts;                                      ///< with the ranks and who owns which particle
  std::vector<std::unique_ptr<Boundary>> boundaries;  ///< those with forces
  NeighbourListUpkeep upkeep;
  mutable BrokenBonds broken;               ///< of this rank, collected when they are asked for
  Dissipation dissipation;                  ///< of this rank, in the ledger
  Field<Coord> start_x, start_y;            ///< [owned] where Simulation::mark_start() found the particles [m]
  Faults faults;                            ///< of this rank
  mutable std::int64_t last_good_step = 0;  ///< of the last look for faults that found none
  Summation sums;
  Scratch scratch;  ///< of neighbour searches

  int discs() const { return facts.discs; }
  std::int64_t steps() const { return now.step; }
  Real time() const { return now.time; }  ///< [s]
  Ranks const& ranks() const { return ghosts.ranks(); }
  bool periodic() const { return now.periodic(); }
  Walls const& walls() const { return now.walls.place; }
  WallContacts wall_contacts() const;  ///< of this rank; none without rigid walls
  WallReactions const& reactions() const { return now.walls.reactions; }
  WallStress stress() const { return wall_stress(walls(), reactions()); }
  Real area() const { return now.box().area(); }  ///< of the box [m^2]
  /// clathra::force_of_leaving_bonds() of a next law of the hydrate [N].
  Real force_of_leaving_bonds(BondLaw const& next) const;
  Real void_ratio() const { return area() / facts.solid_area - 1; }  ///< nominal
  Real boundary_work() const { return now.walls.work; }              ///< [J/m]
  /// The homogeneous motion since the last neighbour search.
  AffineFrame frame() const { return frame_since(now.box(), now.at_search.box); }
  SkinRange skins(bool by_speed) const { return upkeep.skins(now.box(), facts.smallest_radius, facts.largest_radius, by_speed); }

  Measures measures() const;
  DissipationTotals losses() const;
  Real deepest_overlap() const { return ranks().max(clathra::deepest_overlap(particles, rows)); }
  std::uint64_t hash() const;
  SpringNetwork springs() const;  ///< for those who analyse it further, with across()
  AcrossRanks across() const;
  Real largest_frequency(int iterations = 40) const;  ///< of the present contact network [1/s]
  Real stable_limit() const;                          ///< clathra::stable_limit() of calm discs with the present damping [s]
  /// A safety factor times local_time_step(), but never above 0.95 of stable_limit() [s].
  Real stable_time_step(Real safety = 1) const;

  int broken_bonds() const { return static_cast<int>(break_counts().total()); }
  BreakCounts break_counts() const;  ///< so far
  /// Breaks that this rank has seen while events were kept, from the first-th on, sorted by (step, id_a, id_b). Each break is
  /// seen by one rank.
  std::vector<BreakEvent> break_events(int first) const { return detailed_break_events(first).rows; }
  BreakEvents detailed_break_events(int first) const;  ///< the same, with the details where these are kept

  /// Bytes of this rank's fields, with the ledger, the log of breaks and what neighbour searches need beside them.
  std::size_t bytes() const;
  /// Those of them that only neighbour searches need, kept from one to the next.
  std::size_t search_bytes() const { return scratch.bytes(); }
  std::size_t contact_entries() const { return rows.neighbour.extent(0); }  ///< of this rank

  void refresh_ghosts() const { ghosts.refresh(particles, now.box()); }  ///< all of their state
  /// Gives every ghost the value of its disc.
  void refresh_ghosts(AnyField const& field) const { ghosts.refresh(particles, now.box(), field); }

  void set_sums();
  /// Has room for the bonds that may break, before steps.
  void make_room_for_breaks();
  /// Whether the log of breaks has room until all bonds are broken.
  bool log_lasts() const;
  void keep_breaks(BreakRecord record);
  void mark_start();

  /// @throws Diverged where a kernel has reported a fault
  void throw_if_unstable() const;
  /// @param disc  [fault_count] the largest id of a disc of any rank that met each fault, or -1
  void throw_of(double const* disc) const;
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

 private:
  [[noreturn]] void throw_out_of_range(SumOutOfRange const& problem) const;
};

}  // namespace clathra
