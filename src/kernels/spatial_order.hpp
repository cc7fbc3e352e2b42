#pragma once
/// The order in which discs are stored: near each other in memory what is near in space, and slices of equal work.
#include "kernels/neighbours.hpp"

namespace clathra {

/// Discs whose rows are evened out together; they stay near each other in space.
inline constexpr int sorting_window = 128;

/// Puts the discs in spatial order (by cell; within windows of a few slices by the work on their rows, which evens out the
/// slices: first those with the most entries that carry a history, then those with the longest rows) and drops the ghosts.
/// @param slot  [owned] where the old row of each disc is; reordered with them
/// @param anew  by cell; otherwise each disc stays in the window where it is, and only the work is sorted by
/// @return [owned] the place that each disc had before
Field<int> sort_in_space(ParticleSoA& particles, OldRows const& old, Field<int>& slot, Real skin, bool anew);

}  // namespace clathra
