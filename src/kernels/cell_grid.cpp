#include "kernels/cell_grid.hpp"

#include <cmath>
#include <string>

#include "kernels/light_launch.hpp"

namespace clathra {

namespace {

struct ClearCells {
  Field<int> count;
  KOKKOS_FUNCTION void operator()(int cell) const { count(cell) = 0; }
};

struct CountCells {
  ParticleSoA p;
  CellGrid grid;
  Field<int> count;
  KOKKOS_FUNCTION void operator()(int i) const { Kokkos::atomic_fetch_add(&count(grid.cell_of(p.x(i), p.y(i))), 1); }
};

struct ScanCells {
  Field<int> count;
  Field<int> start;
  KOKKOS_FUNCTION void operator()(int c, int& sum, bool const final) const {
    if (final) start(c) = sum;
    sum += count(c);
    if (final && c + 1 == static_cast<int>(count.extent(0))) start(c + 1) = sum;
  }
};

struct FillCells {
  ParticleSoA p;
  CellGrid grid;
  Field<int> left;
  KOKKOS_FUNCTION void operator()(int i) const {
    int const cell = grid.cell_of(p.x(i), p.y(i));
    grid.disc(grid.start(cell) + Kokkos::atomic_fetch_sub(&left(cell), 1) - 1) = i;
  }
};

/// The atomics above fill a cell in any order; sorting by id (and by index among images of one disc) makes it one order.
struct SortCells {
  ParticleSoA p;
  CellGrid grid;
  KOKKOS_INLINE_FUNCTION bool before(int a, int b) const { return p.id(a) < p.id(b) || (p.id(a) == p.id(b) && a < b); }
  KOKKOS_FUNCTION void operator()(int cell) const {
    int const begin = grid.start(cell), end = grid.start(cell + 1);
    for (int k = begin + 1; k < end; ++k) {
      int const disc = grid.disc(k);
      int at = k;
      for (; at > begin && before(disc, grid.disc(at - 1)); --at) grid.disc(at) = grid.disc(at - 1);
      grid.disc(at) = disc;
    }
  }
};

}  // namespace

void require_countable(std::int64_t entries, std::int64_t discs) {
  constexpr std::int64_t most_entries = 2147483647, most_discs = 500000000;
  auto const refuse = [](std::int64_t number, char const* of_what, std::int64_t most) {
    throw TooManyToNumber(std::to_string(number) + of_what + " on one rank, at most " + std::to_string(most) +
                          " can be numbered: share the specimen among more ranks");
  };
  if (discs > most_discs) refuse(discs, " particles with those of the neighbours' ranks", most_discs);
  if (entries > most_entries) refuse(entries, " places in the rows of neighbours", most_entries);
}

CellGrid bin_particles(ParticleSoA const& particles, int discs, Real cell_size, Bounds const& bounds, Scratch& scratch) {
  require_countable(0, discs);
  Real const width = std::max(bounds.right - bounds.left, 0.0), height = std::max(bounds.top - bounds.bottom, 0.0);
  CellGrid grid;
  grid.x0 = bounds.left;
  grid.y0 = bounds.bottom;
  // At most about four cells a disc, whatever the extent.
  Real const fewest = std::sqrt((width + cell_size) * (height + cell_size) / (4.0 * discs + 64));
  grid.cell_size = std::max(cell_size, fewest);
  grid.columns = static_cast<int>(std::min(1e6, width / grid.cell_size)) + 1;
  grid.rows = static_cast<int>(std::min(1e6, height / grid.cell_size)) + 1;
  int const cells = grid.columns * grid.rows;
  grid.start = scratch.take<int>("grid.start", static_cast<std::size_t>(cells) + 1);
  grid.disc = scratch.take<int>("grid.particle", static_cast<std::size_t>(discs));
  Field<int> const count = scratch.take<int>("grid.count", static_cast<std::size_t>(cells));
  auto const each = light_launch(discs), each_cell = light_launch(cells);
  Kokkos::parallel_for("clear_cells", each_cell, ClearCells{count});  // deep_copy() would have the host wait
  Kokkos::parallel_for("count_cells", each, CountCells{particles, grid, count});
  Kokkos::parallel_scan("scan_cells", each_cell, ScanCells{count, grid.start});
  Kokkos::parallel_for("fill_cells", each, FillCells{particles, grid, count});
  Kokkos::parallel_for("sort_cells", each_cell, SortCells{particles, grid});
  return grid;
}

}  // namespace clathra
