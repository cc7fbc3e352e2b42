#pragma once
/// Binning of discs into square cells.

#include "kernels/countable.hpp"
#include "kernels/particles.hpp"

namespace clathra {

/// A rectangle that holds the discs [m].
struct Bounds {
  Coord left = 0, right = 0, bottom = 0, top = 0;
  Bounds grown(Coord by) const { return {left - by, right + by, bottom - by, top + by}; }
};

/// Discs sorted by cell, and by id within a cell.
struct CellGrid {
  Coord x0 = 0, y0 = 0;  ///< lower left corner [m]
  Real cell_size = 1;    ///< [m]
  int columns = 1, rows = 1;
  Field<int> start;  ///< [columns * rows + 1] where each cell's discs begin in `disc`
  Field<int> disc;   ///< disc indices

  KOKKOS_INLINE_FUNCTION int column_of(Coord x) const { return clamp_index(static_cast<int>((x - x0) / cell_size), columns); }
  KOKKOS_INLINE_FUNCTION int row_of(Coord y) const { return clamp_index(static_cast<int>((y - y0) / cell_size), rows); }
  KOKKOS_INLINE_FUNCTION int cell_of(Coord x, Coord y) const { return row_of(y) * columns + column_of(x); }

 private:
  KOKKOS_INLINE_FUNCTION static int clamp_index(int i, int n) { return i < 0 ? 0 : i >= n ? n - 1 : i; }
};

/// Bins the first `discs` discs by counting, scanning and filling. Cells are at least `cell_size` [m] wide; they grow where discs
/// are so scattered that there would be far more cells than discs.
/// @param bounds  what lies outside is put into the outermost cells
/// @throws TooManyToNumber by require_countable()
CellGrid bin_particles(ParticleSoA const& particles, int discs, Real cell_size, Bounds const& bounds, Scratch& scratch);

}  // namespace clathra
