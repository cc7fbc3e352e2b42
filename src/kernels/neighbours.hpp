#pragma once
/// Neighbour search: rows of nearby discs, with the history of contacts and bonds carried from the old rows to the new.
#include <vector>

#include "kernels/bond_law.hpp"
#include "kernels/cell_grid.hpp"
#include "kernels/contacts.hpp"
#include "kernels/countable.hpp"
#include "kernels/reports.hpp"

namespace clathra {

/// The rows before a search, with neighbours by id: those of the discs that were here, and behind them those of discs that came
/// from other ranks. An old row is known by its place in this list, -1 that of a disc that had no row yet; entries are numbered
/// through likewise.
struct OldRows {
  ContactRows here, arrived;
  int rows_here = 0;
  int entries_here = 0;

  KOKKOS_INLINE_FUNCTION int length(int old_row) const {
    if (old_row < 0) return 0;
    return old_row < rows_here ? here.length(old_row) : arrived.length(old_row - rows_here);
  }
  KOKKOS_INLINE_FUNCTION int entry(int old_row, int k) const {
    return old_row < rows_here ? static_cast<int>(here.entry(old_row, k))
                               : entries_here + static_cast<int>(arrived.entry(old_row - rows_here, k));
  }
  KOKKOS_INLINE_FUNCTION int neighbour_id(int entry) const {
    return entry < entries_here ? here.neighbour(entry) : arrived.neighbour(entry - entries_here);
  }
  KOKKOS_INLINE_FUNCTION bool bonded(int entry) const {
    if (here.formation_overlap.extent(0) == 0) return false;
    return is_bonded(entry < entries_here ? here.formation_overlap(entry) : arrived.formation_overlap(entry - entries_here));
  }
};

/// Replaces the neighbours' indices in the rows by their ids.
void name_neighbours(ParticleSoA const& particles, ContactRows const& rows);

/// The rows with neighbours named; what they were taken from has none any more.
OldRows take_as_old(ParticleSoA const& particles, ContactRows& rows);

/// [owned] the old row of each disc, before discs move: its index.
Field<int> old_rows_of_discs(ParticleSoA const& particles, OldRows const& old, Scratch& scratch);

/// How far a search looks, the same on all ranks.
struct SearchReach {
  Real largest_radius, largest_skin;  ///< [m]
  Real bonded_gap;                    ///< the widest of an intact bond before the search [m]
  Bounds bounds;                      ///< of the discs and ghosts; not of all of them if need be
};

/// Makes rows of all pairs closer than the sum of their skins (surface to surface), plus all bonded pairs at any distance.
/// History is kept by the pair's ids.
/// @param old  loses its history;  @param old_row  [owned] where the old row of each disc is
/// @param sizes  what the host then reads at once: the first becomes the number of blocks of slice_width() entries, the others
/// have been set by what was enqueued before
/// @return these
/// Row overflow (more than `longest_row` neighbours) is reported as a fault.
/// @throws TooManyToNumber by require_countable()
std::vector<std::int64_t> find_neighbours(ParticleSoA const& particles, SearchReach const& reach, OldRows& old,
                                          Field<int> const& old_row, ContactRows& rows, Faults const& faults,
                                          Field<std::int64_t> const& sizes, Scratch& scratch);

/// Intact bonds whose break this rank would report: those of its discs to discs with a larger id.
int count_own_bonds(ParticleSoA const& particles, ContactRows const& rows);

}  // namespace clathra
