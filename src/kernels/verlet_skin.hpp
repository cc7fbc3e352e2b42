#pragma once
/// A Verlet skin for each disc: how far it may move beside the homogeneous motion of its box (its non-affine displacement) before
/// the neighbour rows are outdated.
#include "kernels/exact_sum.hpp"
#include "kernels/integrate.hpp"

namespace clathra {

/// The skin of discs at rest, and the most that a flying one may get [m].
struct SkinRange {
  Real least, most;
};

/// Gives each owned disc its skin h_i = min(h (1 + v_i / 5 v_mean), h_most), where v_i is its speed against the homogeneous
/// motion: the few discs that no contact holds fly far while all others hardly move, and would call for a search of all. Rows
/// that hold every pair nearer than h_i + h_j are complete until the non-affine displacement of some disc is its h_i. Does not
/// depend on the discs' order.
/// @return the greatest skin of this rank's discs [m], h without discs
Real assign_verlet_skins(ParticleSoA const& particles, AffineFrame const& frame, SkinRange const& range, Summation const& sums);

/// Remembers the present centres as those of a neighbour search.
void mark_reference(ParticleSoA const& particles);

/// Non-affine displacements since discs were at (x, y).
/// @param frame  the homogeneous motion since then
/// @return the largest (d / skin)^2 of this rank's discs, d the distance from where the homogeneous motion would have brought
/// one
Real largest_nonaffine_displacement2(ParticleSoA const& particles, Field<Coord> const& x, Field<Coord> const& y,
                                     AffineFrame const& frame);

}  // namespace clathra
