#pragma once
/// Neighbour search: rows of nearby discs, with the history of contacts and bonds carried from the old rows to the new.
#include "kernels/contacts.hpp"
#include "kernels/reports.hpp"

namespace clathra {

/// The longest row; enough for size ratios up to about 15.
inline constexpr int longest_row = 64;

/// Where the discs of the old rows went.
struct Relocation {
  Field<int> old_index;  ///< [owned] the old index of each owned disc
  Field<int> new_index;  ///< [owned] the inverse
  Field<int> old_id;     ///< id by old index, ghosts included
};

/// Puts the discs in spatial order (by cell; within windows of a few slices by row length, which evens out the slices) and drops
/// the ghosts. `rows` still speaks of the old order afterwards; find_neighbours() needs the relocation to read it.
Relocation sort_in_space(ParticleSoA& particles, ContactRows const& rows, Real skin);

/// Replaces `rows` by rows of all pairs closer than `skin` [m] (surface to surface), plus all bonded pairs at any distance.
/// History is kept by the pair's ids.
/// @param bonded_gap  widest_bonded_gap() before the discs were sorted [m]
/// Row overflow (more than `longest_row` neighbours) is reported as a fault.
void find_neighbours(ParticleSoA const& particles, Real skin, Relocation const& relocation, ContactRows& rows,
                     Faults const& faults, Real bonded_gap);

/// Bytes that a search needs beside the rows themselves.
std::size_t search_bytes(ContactRows const& rows);

/// The widest gap of an intact bond [m] in the present state; 0 without bonds.
Real widest_bonded_gap(ParticleSoA const& particles, ContactRows const& rows);

}  // namespace clathra
