#pragma once
/// The order in which discs are stored: near each other in memory what is near in space, and slices of equal work.
#include "kernels/neighbours.hpp"

namespace clathra {

/// Discs whose rows are evened out together; they stay near each other in space.
inline constexpr int sorting_window = 128;

/// The discs in their new order.
struct SpatialOrder {
  Field<int> before;  ///< [owned] the place that each disc had
  Field<int> held;    ///< [owned] the entries of its old row that carry a history: bonds, and contacts with friction
};

/// Puts the discs in spatial order (by cell; within windows of a few slices by the work on their rows, which evens out the
/// slices: first those with the most entries that carry a history, then those with the longest rows) and drops the ghosts.
/// @param slot  [owned] where the old row of each disc is; reordered with them
SpatialOrder sort_in_space(ParticleSoA& particles, OldRows const& old, Field<int>& slot, Real skin);

}  // namespace clathra
