#pragma once
/// Who owns which disc, and the copies that stand behind the owned ones: of discs that other ranks own nearby, and images across
/// the boundary of a periodic cell. They compute nothing.
#include "domain/parallel/disc_packing.hpp"
#include "domain/parallel/halo.hpp"
#include "domain/simulation/periodic_images.hpp"
#include "kernels/cell_grid.hpp"
#include "kernels/neighbours.hpp"

namespace clathra {

/// A periodic cell has one rank.
class Ghosts {
 public:
  explicit Ghosts(Ranks ranks) : ranks_(std::move(ranks)) {}

  Ranks const& ranks() const { return ranks_; }
  Decomposition const& decomposition() const { return decomposition_; }
  void set_decomposition(Decomposition const& cuts) { decomposition_ = cuts; }

  /// Gives every ghost the present place and velocity of its disc.
  void refresh(ParticleSoA const& particles, Box const& box) const;
  /// Gives every ghost the value of its disc.
  void refresh(ParticleSoA const& particles, Box const& box, AnyField const& field) const;

  // In a neighbour search:
  /// Sends the discs that have left this rank's rectangle, which moves with the box, to their owners, with their rows. The
  /// rectangles are cut anew when the time that ranks have waited for the slowest is well above what that costs.
  /// @param motion  of the box since the last search;  @param seconds_of_a_search  on this rank
  void migrate_discs(AffineFrame const& motion, double seconds_of_a_search, ParticleSoA& particles,
                     AuxiliaryFields const& with_discs, OldRows& old, Field<int>& old_row, Scratch& scratch);
  /// Where this rank's discs are when each has its owner. @param all  of the discs of all ranks
  Bounds own_bounds(Bounds const& all, Box const& box) const;
  /// Replaces the ghosts by copies of all discs within `reach` [m] of this rank's rectangle or of the edge of the cell; those of
  /// a cell are put into it.
  void rebuild(ParticleSoA& particles, Box const& box, Real reach);

  /// Time in which this rank computed, since the rectangles were cut [s].
  void add_busy_seconds(double seconds) { busy_seconds_ += seconds; }
  std::size_t bytes() const { return halo_.bytes(); }

 private:
  void rebalance_if_it_pays(ParticleSoA const& particles, double seconds_of_a_search);

  Ranks ranks_;
  Decomposition decomposition_;
  Halo halo_;
  PeriodicImages images_;
  double busy_seconds_ = 0;
};

}  // namespace clathra
