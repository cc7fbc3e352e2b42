#pragma once
/// Copies of the discs that other ranks own near this rank's rectangle, kept as ghosts behind the owned discs.
///
/// Ghosts get the place and velocity of their discs each step and compute nothing. Both owners of a pair evaluate it from the
/// same numbers, so there is no second message with forces, and a pair across a cut has the bits of one inside.
#include <vector>

#include "domain/parallel/decomposition.hpp"
#include "domain/parallel/exchange_buffer.hpp"

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
  std::size_t discs_sent() const { return total(sent_); }
  std::size_t bytes() const { return source_.span() * sizeof(int) + out_.bytes() + in_.bytes(); }

 private:
  /// Sends `columns` numbers of each disc on the list and puts those that came into the ghosts.
  template <class Columns>
  void exchange(Ranks const& ranks, ParticleSoA const& particles, Columns const& columns) const;
  void list_sent(Ranks const& ranks, Decomposition const& decomposition, ParticleSoA const& particles, Real reach);
  static std::size_t total(std::vector<BufferRange> const& stretches) {
    return stretches.empty() ? 0 : stretches.back().begin + stretches.back().size;
  }

  Field<int> source_;                         ///< [room] index of each disc that goes to another rank
  Field<std::int64_t> listed_;                ///< [near ranks] where the discs for each end on that list
  std::vector<BufferRange> sent_, received_;  ///< discs, by rank
  mutable ExchangeBuffer out_, in_;           ///< kept from step to step
};

}  // namespace clathra
