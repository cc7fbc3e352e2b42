#pragma once
/// Copies of the discs that other ranks own near this rank's rectangle, kept as ghosts behind the owned discs.
///
/// Ghosts get the place and velocity of their discs each step and compute nothing. Both owners of a pair evaluate it from the
/// same numbers, so there is no second message with forces, and a pair across a cut has the bits of one inside.
#include <vector>

#include "domain/parallel/decomposition.hpp"

namespace clathra {

class Halo {
 public:
  /// Replaces the ghosts by all discs of other ranks within `reach` [m] (centre to edge) of this rank's rectangle, and tells
  /// these ranks to send them from now on.
  void rebuild(Ranks const& ranks, Decomposition const& decomposition, ParticleSoA& particles, Real reach);
  /// Gives every ghost the present place and velocity of its disc.
  void refresh(Ranks const& ranks, ParticleSoA const& particles) const;
  /// Gives every ghost the value of its disc.
  void refresh(Ranks const& ranks, ParticleSoA const& particles, AnyField const& field) const;
  std::size_t discs_sent() const { return source_.extent(0); }
  std::size_t bytes() const;

 private:
  void exchange_known(Ranks const& ranks, ParticleSoA const& particles, std::vector<AnyField> const& columns) const;

  Field<int> source_;                         ///< [sent] index of each disc that goes to another rank
  std::vector<BufferRange> sent_, received_;  ///< discs, by rank
};

}  // namespace clathra
