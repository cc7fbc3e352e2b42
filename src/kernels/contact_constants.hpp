#pragma once
/// The laws as the contact kernel takes them.
#include "kernels/bond_quick_test.hpp"
#include "kernels/forces.hpp"

namespace clathra {

/// Numbers of the laws. The kernel works on a copy on its stack, which no store can change, so that what follows from them is
/// computed once a group.
template <class R>
struct ContactConstants {
  GrainLawOf<R> grain;
  BondLawOf<R> bond;
  LeastStrengthOf<R> least;
  R dt;
  R tick, per_tick;  ///< mixed precision: what differences of places count in [m], and one over it
  bool ledger;       ///< whether energy losses are added up
};

/// The laws as the kernel takes them, in numbers R: what is within the strength of the weakest bond breaks none.
template <class R>
ContactConstants<R> constants_in(ContactLaws const& laws, Real dt, Real tick) {
  BondLaw const bond = weakest(laws.bond);
  return {cast<R>(laws.grain), cast<R>(bond), least_strength<R>(bond), R(dt), R(tick), R(1 / tick), laws.ledger};
}

}  // namespace clathra
