#include "kernels/neighbours.hpp"

#include <utility>

#include "kernels/bond_law.hpp"
#include "kernels/cell_grid.hpp"

namespace clathra {

namespace {

constexpr int sorting_window = 64;  // discs whose rows are evened out together; they stay near each other in space

struct SortByLength {
  Field<int> order;
  Field<int> length;  // by old index; empty at the first search
  int discs;
  KOKKOS_FUNCTION void operator()(int window) const {
    int const begin = window * sorting_window, end = begin + sorting_window < discs ? begin + sorting_window : discs;
    for (int k = begin + 1; k < end; ++k) {
      int const disc = order(k);
      int at = k;
      for (; at > begin && length(order(at - 1)) < length(disc); --at) order(at) = order(at - 1);
      order(at) = disc;
    }
  }
};

struct Invert {
  Field<int> of, inverse;
  KOKKOS_FUNCTION void operator()(int i) const { inverse(of(i)) = i; }
};

/// The row that a disc had before the search, its neighbours by id; read when first asked for.
class OldRow {
 public:
  KOKKOS_INLINE_FUNCTION OldRow(ContactRows const& old, Relocation const& moved, int disc)
      : rows_(old), moved_(moved), new_disc_(disc) {}

  /// The old entry of disc `other`, or -1.
  KOKKOS_INLINE_FUNCTION int entry(int other) {
    if (length_ < 0) read();
    for (int k = 0; k < length_; ++k) {
      if (id_[k] == other) return static_cast<int>(rows_.entry(disc_, k));
    }
    return -1;
  }
  KOKKOS_INLINE_FUNCTION bool was_bonded(int other) {
    if (rows_.equilibrium.extent(0) == 0) return false;
    int const e = entry(other);
    return e >= 0 && is_bonded(rows_.equilibrium(e));
  }

 private:
  KOKKOS_INLINE_FUNCTION void read() {
    length_ = 0;
    if (rows_.length.extent(0) == 0) return;
    disc_ = moved_.old_index(new_disc_);
    length_ = rows_.length(disc_);
    for (int k = 0; k < length_; ++k) id_[k] = moved_.old_id(rows_.neighbour(rows_.entry(disc_, k)));
  }

  ContactRows const& rows_;
  Relocation const& moved_;
  int new_disc_, disc_ = 0, length_ = -1;
  int id_[longest_row];
};

/// What one search needs to know about the old rows and the grid.
struct Search {
  ParticleSoA p;
  CellGrid grid;
  Real skin, bonded_reach;
  ContactRows old;
  Relocation moved;

  /// Calls visit(j, in_touch) for every disc that belongs into the row of disc i, whose old row is `before`.
  template <class Visit>
  KOKKOS_INLINE_FUNCTION void for_each_neighbour(int i, OldRow& before, Visit const& visit) const {
    int const column = grid.column_of(p.x(i)), row = grid.row_of(p.y(i));
    for (int r = row > 0 ? row - 1 : 0; r <= row + 1 && r < grid.rows; ++r) {
      int const first = column > 0 ? column - 1 : 0, last = column + 1 < grid.columns ? column + 1 : column;
      int const end = grid.start(r * grid.columns + last + 1);
      for (int k = grid.start(r * grid.columns + first); k < end; k += lane_count) visit_near(i, k, end, before, visit);
    }
  }

 private:
  /// The candidates `grid.disc(k .. k + lane_count)`, tested side by side.
  template <class Visit>
  KOKKOS_INLINE_FUNCTION void visit_near(int i, int k, int end, OldRow& before, Visit const& visit) const {
    int j[lane_count];
    for (int l = 0; l < lane_count; ++l) j[l] = k + l < end ? grid.disc(k + l) : i;
    Lanes const dx = gather(p.x.data(), j) - p.x(i), dy = gather(p.y.data(), j) - p.y(i);
    Lanes const sum = gather(p.radius.data(), j) + p.radius(i), far = sum + bonded_reach, distance2 = dx * dx + dy * dy;
    for_each_set(distance2 < far * far, [&](int l) {
      if (j[l] == i) return;
      Real const touch = lane(sum, l), reach = touch + skin, apart2 = lane(distance2, l);
      if (apart2 < reach * reach || before.was_bonded(p.id(j[l]))) visit(j[l], apart2 < touch * touch);
    });
  }
};

struct CountNeighbours {
  Search search;
  Field<int> length;
  Faults faults;
  KOKKOS_FUNCTION void operator()(int i) const {
    int count = 0;
    OldRow before(search.old, search.moved, i);
    search.for_each_neighbour(i, before, [&](int, bool) { ++count; });
    if (count > longest_row) {
      faults.report(Fault::row_overflow, search.p.id(i));
      count = longest_row;
    }
    length(i) = count;
  }
};

struct ScanSlices {
  Field<int> length, slice_start;
  int discs;
  KOKKOS_FUNCTION void operator()(int slice, int& sum, bool const final) const {
    int longest = 0;
    for (int l = 0; l < lane_count; ++l) {
      int const i = slice * lane_count + l;
      if (i < discs && length(i) > longest) longest = length(i);
    }
    if (final) slice_start(slice) = sum;
    sum += longest;
    if (final && (slice + 1) * lane_count >= discs) slice_start(slice + 1) = sum;
  }
};

/// Fills the row of one disc: entries in touch or bonded first, each part by id.
struct FillRows {
  Search search;
  ContactRows rows;
  Field<int> source;  // [entries] the old entry with the history of each new one, -1 for none

  KOKKOS_FUNCTION void operator()(int slot) const {
    int const slice = slot / lane_count;
    int const width = rows.slice_start(slice + 1) - rows.slice_start(slice);
    bool const real = slot < search.p.owned;
    int const used = real ? fill(slot) : 0;
    for (int k = used; k < width; ++k) {
      std::size_t const e = rows.entry(slot, k);
      rows.neighbour(e) = search.p.padding();
      source(e) = -1;
    }
  }

  KOKKOS_INLINE_FUNCTION int fill(int i) const {
    int disc[longest_row];
    std::int64_t key[longest_row];
    int count = 0;
    OldRow before(search.old, search.moved, i);
    search.for_each_neighbour(i, before, [&](int j, bool in_touch) {
      if (count == longest_row) return;
      int const id = search.p.id(j);
      std::int64_t const rank = (in_touch || before.was_bonded(id) ? std::int64_t(0) : std::int64_t(1) << 32) + id;
      int at = count++;
      for (; at > 0 && rank < key[at - 1]; --at) {
        key[at] = key[at - 1];
        disc[at] = disc[at - 1];
      }
      key[at] = rank;
      disc[at] = j;
    });
    for (int k = 0; k < count; ++k) {
      std::size_t const e = rows.entry(i, k);
      rows.neighbour(e) = disc[k];
      source(e) = before.entry(search.p.id(disc[k]));
    }
    return count;
  }
};

/// One field of the history in its new order.
struct CarryHistory {
  Field<Real> from, to;
  Field<int> source;
  Real empty;
  KOKKOS_FUNCTION void operator()(int e) const { to(e) = source(e) >= 0 ? from(source(e)) : empty; }
};

struct WidestBondedGap {
  ParticleSoA p;
  ContactRows rows;
  KOKKOS_FUNCTION void operator()(int i, Real& widest) const {
    for (int k = 0; k < rows.length(i); ++k) {
      std::size_t const e = rows.entry(i, k);
      if (!is_bonded(rows.equilibrium(e))) continue;
      int const j = rows.neighbour(e);
      Real const dx = p.x(j) - p.x(i), dy = p.y(j) - p.y(i);
      widest = lane_max(widest, lane_sqrt(dx * dx + dy * dy) - (p.radius(i) + p.radius(j)));
    }
  }
};

/// Brings the history of `rows` into the order of `found`, field by field through the storage that the one before left free, so
/// that a search needs room for one field and not for a second set of rows.
void carry_history(ContactRows& rows, ContactRows& found, Field<int> const& source, std::size_t entries) {
  std::size_t const size = found.neighbour.extent(0);
  Field<Real> room;
  for_each_history(rows, [&](char const* name, Field<Real>& field, Real empty) {
    if (room.extent(0) != size) {
      room = Field<Real>();
      room = uninitialised<Real>(name, size);
    }
    Kokkos::parallel_for("carry_history", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(entries)),
                         CarryHistory{field, room, source, empty});
    Kokkos::fence();
    std::swap(field, room);
  });
  rows.slice_start = found.slice_start;
  rows.length = found.length;
  rows.neighbour = found.neighbour;
}

}  // namespace

Relocation sort_in_space(ParticleSoA& particles, ContactRows const& rows, Real skin) {
  Kokkos::RangePolicy<ExecutionSpace> const each(0, particles.owned);
  auto const owned = static_cast<std::size_t>(particles.owned);
  CellGrid const grid = bin_particles(particles, particles.owned, 2 * largest_radius(particles, particles.owned) + skin);
  Relocation moved;
  moved.old_index = grid.disc;
  if (rows.length.extent(0) == owned) {
    Kokkos::parallel_for("sort_by_length",
                         Kokkos::RangePolicy<ExecutionSpace>(0, (particles.owned + sorting_window - 1) / sorting_window),
                         SortByLength{grid.disc, rows.length, particles.owned});
  }
  moved.new_index = uninitialised<int>("new_index", owned);
  Kokkos::parallel_for("invert", each, Invert{moved.old_index, moved.new_index});
  moved.old_id = uninitialised<int>("old_id", particles.id.extent(0));
  Kokkos::deep_copy(moved.old_id, particles.id);
  permute(particles, moved.old_index);
  return moved;
}

std::size_t search_bytes(ContactRows const& rows) { return rows.neighbour.span() * (2 * sizeof(int) + sizeof(Real)); }

Real widest_bonded_gap(ParticleSoA const& particles, ContactRows const& rows) {
  if (rows.equilibrium.extent(0) == 0 || rows.length.extent(0) == 0) return 0;
  Real widest = 0;
  Kokkos::parallel_reduce("widest_bonded_gap", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                          WidestBondedGap{particles, rows}, Kokkos::Max<Real>(widest));
  return lane_max(widest, Real(0));
}

void find_neighbours(ParticleSoA const& particles, Real skin, Relocation const& relocation, ContactRows& rows,
                     Faults const& faults, Real bonded_gap) {
  auto const owned = static_cast<std::size_t>(particles.owned);
  auto const slices = static_cast<std::size_t>(slice_count(particles.owned));
  Real const bonded_reach = lane_max(skin, bonded_gap * (1 + 1e-9));
  Real const cell = 2 * largest_radius(particles, particles.all()) + bonded_reach;
  Search const search{particles, bin_particles(particles, particles.all(), cell), skin, bonded_reach, rows, relocation};
  ContactRows found;
  found.length = uninitialised<int>("rows.length", owned);
  found.slice_start = uninitialised<int>("rows.slice_start", slices + 1);
  Kokkos::parallel_for("count_neighbours", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                       CountNeighbours{search, found.length, faults});
  int total = 0;
  Kokkos::parallel_scan("scan_slices", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(slices)),
                        ScanSlices{found.length, found.slice_start, particles.owned}, total);
  std::size_t const entries = static_cast<std::size_t>(total) * lane_count, held = rows.neighbour.extent(0);
  // A little more than needed, so that the next search finds fields of the right size; never nothing.
  std::size_t const wanted = std::max<std::size_t>(entries, lane_count);
  std::size_t const size = held >= wanted && held <= wanted + wanted / 8 ? held : wanted + wanted / 16;
  found.neighbour = uninitialised<int>("rows.neighbour", size);
  Field<int> const source = uninitialised<int>("rows.source", size);
  Kokkos::parallel_for("fill_rows", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(slices) * lane_count),
                       FillRows{search, found, source});
  carry_history(rows, found, source, entries);
}

}  // namespace clathra
