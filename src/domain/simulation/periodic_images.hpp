#pragma once
/// Images of discs across the boundary of a periodic cell, kept as ghosts behind the owned discs.
#include "kernels/box.hpp"
#include "kernels/particles.hpp"

namespace clathra {

/// The ghosts and the discs they are images of.
class PeriodicImages {
 public:
  /// Wraps the owned discs into the cell and appends images of all discs closer than `reach` [m] (centre to edge) to an edge.
  void rebuild(ParticleSoA& particles, Box const& cell, Real reach);
  /// Gives every image the present place and velocity of its disc.
  void refresh(ParticleSoA const& particles, Box const& cell) const;
  /// Gives every image the value of its disc.
  void refresh(ParticleSoA const& particles, AnyField const& field) const;

 private:
  void copy(ParticleSoA const& particles, Box const& cell, bool all) const;

  Field<int> source_;             // [room] owned index of each ghost
  Field<int> shift_x_, shift_y_;  // [room] in cell sizes
};

}  // namespace clathra
