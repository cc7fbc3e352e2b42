#pragma once
/// How far a disc may stray from the homogeneous motion of its box before the neighbour rows are outdated.
#include "kernels/exact_sum.hpp"
#include "kernels/integrate.hpp"

namespace clathra {

/// The leeway of discs at rest, and the most that a flying one may get [m].
struct LeewayRange {
  Real least, most;
};

/// Gives each owned disc its leeway h_i = min(h (1 + v_i / 5 v_mean), h_most), where v_i is its speed against the homogeneous
/// motion: the few discs that no contact holds fly far while all others hardly move, and would call for a search of all. Rows
/// that hold every pair nearer than h_i + h_j are complete until some disc has strayed by its h_i. Does not depend on the discs'
/// order.
/// @return the greatest leeway of this rank's discs [m], h without discs
Real give_leeway(ParticleSoA const& particles, AffineFrame const& frame, LeewayRange const& range, Summation const& sums);

/// Remembers the present centres as those of a neighbour search.
void mark_reference(ParticleSoA const& particles);

/// How far discs have strayed since.
/// @return the largest (d / leeway)^2 of this rank's discs, d the distance from where the homogeneous motion would have brought
/// one
Real largest_stray2(ParticleSoA const& particles, AffineFrame const& frame);

}  // namespace clathra
