#pragma once
/// The order in which discs are stored: near each other in memory what is near in space, and slices of equal work.
#include <optional>

#include "kernels/cell_grid.hpp"
#include "kernels/neighbours.hpp"

namespace clathra {

/// Slices whose rows are evened out together; their discs stay near each other in space. Twice as many make fuller rows and are
/// slower all the same with 200,000 discs (perf/reports/0.1/performance.md).
inline constexpr int slices_a_window = 16;

/// Cells that discs are sorted by.
struct CellsOfOrder {
  Real size = 0;  ///< [m]
  Bounds bounds;
};

/// Puts the discs in spatial order (by cell; within windows of a few slices by the work on their rows, which evens out the
/// slices: first those with the most entries that carry a history, then those with the longest rows) and drops the ghosts.
/// @param old_row  [owned] where the old row of each disc is; reordered with them
/// @param cells  none: each disc stays in the window where it is, and only the work is sorted by
/// @return [owned] the place that each disc had before
Field<int> sort_in_space(ParticleSoA& particles, OldRows const& old, Field<int>& old_row,
                         std::optional<CellsOfOrder> const& cells, Scratch& scratch);

}  // namespace clathra
