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

/// What one search needs to know about the old rows and the grid.
struct Search {
  ParticleSoA p;
  CellGrid grid;
  Real skin, bonded_reach;
  ContactRows old;
  Relocation moved;

  /// The entry of disc `id` in the old row of new disc `i`, or -1.
  KOKKOS_INLINE_FUNCTION long old_entry(int i, int id) const {
    int const before = moved.old_index(i);
    for (int k = 0; k < old.length(before); ++k) {
      std::size_t const e = old.entry(before, k);
      if (moved.old_id(old.neighbour(e)) == id) return static_cast<long>(e);
    }
    return -1;
  }
  KOKKOS_INLINE_FUNCTION bool was_bonded(int i, int id) const {
    if (old.equilibrium.extent(0) == 0) return false;
    long const e = old_entry(i, id);
    return e >= 0 && is_bonded(old.equilibrium(e));
  }

  /// Calls visit(j, in_touch) for every disc that belongs into the row of disc i.
  template <class Visit>
  KOKKOS_INLINE_FUNCTION void for_each_neighbour(int i, Visit const& visit) const {
    int const column = grid.column_of(p.x(i)), row = grid.row_of(p.y(i));
    for (int r = row > 0 ? row - 1 : 0; r <= row + 1 && r < grid.rows; ++r) {
      int const first = column > 0 ? column - 1 : 0, last = column + 1 < grid.columns ? column + 1 : column;
      int const end = grid.start(r * grid.columns + last + 1);
      for (int k = grid.start(r * grid.columns + first); k < end; ++k) {
        int const j = grid.disc(k);
        Real const dx = p.x(j) - p.x(i), dy = p.y(j) - p.y(i), sum = p.radius(i) + p.radius(j);
        Real const distance2 = dx * dx + dy * dy;
        Real const far = sum + bonded_reach;
        if (distance2 >= far * far || j == i) continue;
        if (distance2 < (sum + skin) * (sum + skin) || was_bonded(i, p.id(j))) visit(j, distance2 < sum * sum);
      }
    }
  }
};

struct CountNeighbours {
  Search search;
  Field<int> length;
  Faults faults;
  KOKKOS_FUNCTION void operator()(int i) const {
    int count = 0;
    search.for_each_neighbour(i, [&](int, bool) { ++count; });
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

  KOKKOS_FUNCTION void operator()(int slot) const {
    int const slice = slot / lane_count;
    int const width = rows.slice_start(slice + 1) - rows.slice_start(slice);
    bool const real = slot < search.p.owned;
    int const used = real ? fill(slot) : 0;
    for (int k = used; k < width; ++k) {
      std::size_t const e = rows.entry(slot, k);
      rows.neighbour(e) = search.p.padding();
      clear(e);
    }
  }

  KOKKOS_INLINE_FUNCTION int fill(int i) const {
    int disc[longest_row];
    std::int64_t key[longest_row];
    int count = 0;
    search.for_each_neighbour(i, [&](int j, bool in_touch) {
      if (count == longest_row) return;
      int const id = search.p.id(j);
      std::int64_t const rank = (in_touch || search.was_bonded(i, id) ? std::int64_t(0) : std::int64_t(1) << 32) + id;
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
      copy(e, search.old.length.extent(0) > 0 ? search.old_entry(i, search.p.id(disc[k])) : -1);
    }
    return count;
  }

  KOKKOS_INLINE_FUNCTION void clear(std::size_t e) const { copy(e, -1); }

  /// History of new entry e from old entry `from`, or none where that is -1.
  KOKKOS_INLINE_FUNCTION void copy(std::size_t e, long from) const {
    carry(rows.shear, search.old.shear, e, from, 0);
    carry(rows.moment, search.old.moment, e, from, 0);
    carry(rows.equilibrium, search.old.equilibrium, e, from, no_bond);
    carry(rows.bond_shear, search.old.bond_shear, e, from, 0);
    carry(rows.bond_moment, search.old.bond_moment, e, from, 0);
  }
  KOKKOS_INLINE_FUNCTION static void carry(Field<Real> const& to, Field<Real> const& old, std::size_t e, long from, Real empty) {
    if (to.extent(0) > 0) to(e) = from >= 0 ? old(from) : empty;
  }
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

/// Gives `spare` the features of `rows` and room for `entries`, reusing what it has.
void make_room(ContactRows& spare, ContactRows const& rows, std::size_t entries, std::size_t discs, std::size_t slices) {
  spare.features = rows.features;
  if (spare.length.extent(0) != discs) spare.length = uninitialised<int>("rows.length", discs);
  if (spare.slice_start.extent(0) != slices + 1) spare.slice_start = uninitialised<int>("rows.slice_start", slices + 1);
  if (entries == 0) return;
  std::size_t const room = entries + entries / 16;
  bool const fits = spare.neighbour.extent(0) >= entries && spare.neighbour.extent(0) <= 2 * room;
  if (!fits) spare.neighbour = uninitialised<int>("rows.neighbour", room);
  for (auto* field : {&spare.moment, &spare.equilibrium, &spare.bond_shear, &spare.bond_moment}) {
    bool const kept = fits && field->extent(0) > 0;
    if (!kept) *field = Field<Real>();
  }
  for_each_history(spare, [&](char const* name, Field<Real>& field, Real) {
    if (field.extent(0) != spare.neighbour.extent(0)) field = uninitialised<Real>(name, spare.neighbour.extent(0));
  });
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

Real widest_bonded_gap(ParticleSoA const& particles, ContactRows const& rows) {
  if (rows.equilibrium.extent(0) == 0 || rows.length.extent(0) == 0) return 0;
  Real widest = 0;
  Kokkos::parallel_reduce("widest_bonded_gap", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                          WidestBondedGap{particles, rows}, Kokkos::Max<Real>(widest));
  return lane_max(widest, Real(0));
}

void find_neighbours(ParticleSoA const& particles, Real skin, Relocation const& relocation, ContactRows& rows, ContactRows& spare,
                     Faults const& faults, Real bonded_gap) {
  auto const owned = static_cast<std::size_t>(particles.owned);
  auto const slices = static_cast<std::size_t>(slice_count(particles.owned));
  Real const bonded_reach = lane_max(skin, bonded_gap * (1 + 1e-9));
  Real const cell = 2 * largest_radius(particles, particles.all()) + bonded_reach;
  Search const search{particles, bin_particles(particles, particles.all(), cell), skin, bonded_reach, rows, relocation};
  make_room(spare, rows, 0, owned, slices);
  Kokkos::parallel_for("count_neighbours", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                       CountNeighbours{search, spare.length, faults});
  int total = 0;
  Kokkos::parallel_scan("scan_slices", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(slices)),
                        ScanSlices{spare.length, spare.slice_start, particles.owned}, total);
  make_room(spare, rows, std::max<std::size_t>(static_cast<std::size_t>(total), 1) * lane_count, owned, slices);
  Kokkos::parallel_for("fill_rows", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(slices) * lane_count),
                       FillRows{search, spare});
  std::swap(rows, spare);
  std::swap(rows.width, spare.width);  // set anew by prepare_rows(): one of each is enough
  std::swap(rows.active, spare.active);
}

}  // namespace clathra
