#include "kernels/neighbours.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "kernels/cell_grid.hpp"

namespace clathra {

namespace {

struct FirstSlots {
  Field<int> slot;
  int slots;
  KOKKOS_FUNCTION void operator()(int i) const { slot(i) = i < slots ? i : -1; }
};

struct NameNeighbours {
  ParticleSoA p;
  ContactRows rows;
  KOKKOS_FUNCTION void operator()(int e) const { rows.neighbour(e) = p.id(rows.neighbour(e)); }
};

/// The row that a disc had before the search, its neighbours by id; read when first asked for.
class OldRow {
 public:
  KOKKOS_INLINE_FUNCTION OldRow(OldRows const& old, Field<int> const& slot, int disc) : old_(old), slot_(slot), disc_(disc) {}

  /// The old entry of disc `other`, or -1.
  KOKKOS_INLINE_FUNCTION int entry(int other) {
    if (length_ < 0) read();
    for (int k = 0; k < length_; ++k) {
      if (id_[k] == other) return old_.entry(at_, k);
    }
    return -1;
  }
  KOKKOS_INLINE_FUNCTION bool was_bonded(int other) {
    if (old_.here.formation_overlap.extent(0) == 0) return false;
    if (length_ < 0) read();
    int found = -1;
    for (int k = 0; k < length_; ++k) found = id_[k] == other ? k : found;  // without a branch that nothing foresees
    return found >= 0 && old_.bonded(old_.entry(at_, found));
  }

 private:
  KOKKOS_INLINE_FUNCTION void read() {
    at_ = slot_(disc_);
    length_ = old_.length(at_);
    for (int k = 0; k < length_; ++k) id_[k] = old_.neighbour_id(old_.entry(at_, k));
  }

  OldRows const& old_;
  Field<int> const& slot_;
  int disc_, at_ = 0, length_ = -1;
  int id_[longest_row];
};

/// Discs in the order of the grid's cells, so that candidates lie side by side; [discs + lane_count].
struct Candidates {
  Field<int> disc;
  Field<Coord> x, y;
  Field<Real> radius, verlet_skin;
};
std::size_t bytes(Candidates const& c) { return c.disc.span() * (sizeof(int) + 2 * sizeof(Coord) + 2 * sizeof(Real)); }

/// Discs listed in groups of lanes, hence the room behind them.
using DiscList = int[longest_row + 1 + lane_count];

/// The discs that a search finds near one.
struct Nearby {
  DiscList in_touch, apart;
  int touching, others;
  KOKKOS_INLINE_FUNCTION int count() const { return touching + others; }
};

struct LineUp {
  ParticleSoA p;
  Field<int> disc;
  Candidates to;
  KOKKOS_FUNCTION void operator()(int k) const {
    int const i = k < static_cast<int>(disc.extent(0)) ? disc(k) : p.padding();
    to.disc(k) = i;
    to.x(k) = p.x(i);
    to.y(k) = p.y(i);
    to.radius(k) = p.radius(i);
    to.verlet_skin(k) = p.verlet_skin(i);
  }
};

Candidates line_up(ParticleSoA const& particles, CellGrid const& grid) {
  Candidates candidates;
  std::size_t const size = grid.disc.extent(0) + lane_count;
  for (Field<Coord>* field : {&candidates.x, &candidates.y}) *field = uninitialised<Coord>("candidates", size);
  for (Field<Real>* field : {&candidates.radius, &candidates.verlet_skin}) *field = uninitialised<Real>("candidates", size);
  candidates.disc = uninitialised<int>("candidates", size);
  Kokkos::parallel_for("line_up", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(size)),
                       LineUp{particles, grid.disc, candidates});
  return candidates;
}

/// What one search needs to know about the old rows and the grid.
struct Search {
  ParticleSoA p;
  CellGrid grid;
  Candidates candidates;
  Real bonded_reach;  // beyond touching, of any bond [m]
  Real slack;         // rounding_slack()
  OldRows old;
  Field<int> slot;

  /// Finds every disc that belongs into the row of disc i, whose old row is `before`; of more than a row holds, at least one too
  /// many.
  KOKKOS_INLINE_FUNCTION void near_to(int i, OldRow& before, Nearby& found) const {
    int touching = 0, others = 0;  // not in `found`, where each store to a list might change them
    int const column = grid.column_of(p.x(i)), row = grid.row_of(p.y(i));
    for (int r = row > 0 ? row - 1 : 0; r <= row + 1 && r < grid.rows; ++r) {
      int const first = column > 0 ? column - 1 : 0, last = column + 1 < grid.columns ? column + 1 : column;
      int const end = grid.start(r * grid.columns + last + 1);
      for (int k = grid.start(r * grid.columns + first); k < end && touching + others <= longest_row + 1; k += lane_count)
        add_near(i, k, end, before, found, touching, others);
    }
    found.touching = without(i, found.in_touch, touching);
    found.others = others;
  }

 private:
  /// The candidates k .. k + lane_count, those before `end`, tested side by side.
  KOKKOS_FORCEINLINE_FUNCTION void add_near(int i, int k, int end, OldRow& before, Nearby& found, int& touching,
                                            int& others) const {
    Lanes const dx = load(&candidates.x(k)) - p.x(i), dy = load(&candidates.y(k)) - p.y(i);
    Lanes const touch = load(&candidates.radius(k)) + p.radius(i), distance2 = dx * dx + dy * dy;
    Lanes const reach = touch + (load(&candidates.verlet_skin(k)) + p.verlet_skin(i) + slack), bonded = touch + bonded_reach;
    auto const candidate = first_lanes(end - k), in_touch = candidate && distance2 < touch * touch;
    auto const apart = candidate && !in_touch && distance2 < reach * reach;
    touching += pack_set(in_touch, &candidates.disc(k), found.in_touch + touching);
    others += pack_set(apart, &candidates.disc(k), found.apart + others);
    for_each_set(candidate && !in_touch && !apart && distance2 < bonded * bonded, [&](int l) {
      int const j = candidates.disc(k + l);
      if (before.was_bonded(p.id(j))) found.apart[others++] = j;
    });
  }

  /// Takes a disc out of a list. @return the new length
  KOKKOS_INLINE_FUNCTION static int without(int disc, int* list, int length) {
    int kept = 0;
    for (int k = 0; k < length; ++k) {
      list[kept] = list[k];
      kept += list[k] != disc ? 1 : 0;
    }
    return kept;
  }
};

/// What a count has found, so that filling the rows need not search again: neighbours of a disc that has no more than `most`.
struct Found {
  static constexpr int most = 8;
  Kokkos::View<int**, MemorySpace> neighbour;  // [discs][most] twice the index, plus one in touch
};

struct CountNeighbours {
  Search search;
  Found found;
  Field<RowLength> length;
  Faults faults;
  KOKKOS_FUNCTION void operator()(int i) const {
    OldRow before(search.old, search.slot, i);
    Nearby near;
    search.near_to(i, before, near);
    if (near.count() > longest_row) faults.report(Fault::row_overflow, search.p.id(i));
    length(i) = static_cast<RowLength>(near.count() < longest_row ? near.count() : longest_row);
    if (near.count() > Found::most) return;
    for (int k = 0; k < near.touching; ++k) found.neighbour(i, k) = 2 * near.in_touch[k] + 1;
    for (int k = 0; k < near.others; ++k) found.neighbour(i, near.touching + k) = 2 * near.apart[k];
  }
};

struct ScanSlices {
  Field<RowLength> length;
  Field<int> slice_start;
  int discs, slice_width;
  KOKKOS_FUNCTION void operator()(int slice, std::int64_t& sum, bool const final) const {
    int longest = 0;
    for (int l = 0; l < slice_width; ++l) {
      int const i = slice * slice_width + l;
      if (i < discs && length(i) > longest) longest = length(i);
    }
    if (final) slice_start(slice) = static_cast<int>(sum);
    sum += longest;
    if (final && (slice + 1) * slice_width >= discs) slice_start(slice + 1) = static_cast<int>(sum);
  }
};

/// Fills the row of one disc: entries in touch or bonded first, each part by id.
struct FillRows {
  Search search;
  Found found;
  ContactRows rows;
  Field<int> source;  // [entries] the old entry with the history of each new one, -1 for none

  KOKKOS_FUNCTION void operator()(int slot) const {
    int const slice = slot >> rows.features.format.slice_shift();
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
    OldRow before(search.old, search.slot, i);
    auto const insert = [&](int j, bool in_touch) {
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
    };
    if (rows.length(i) <= Found::most) {
      for (int k = 0; k < rows.length(i); ++k) insert(found.neighbour(i, k) / 2, found.neighbour(i, k) % 2 == 1);
    } else {
      Nearby near;
      search.near_to(i, before, near);
      for (int k = 0; k < near.touching; ++k) insert(near.in_touch[k], true);
      for (int k = 0; k < near.others; ++k) insert(near.apart[k], false);
    }
    for (int k = 0; k < count; ++k) {
      std::size_t const e = rows.entry(i, k);
      rows.neighbour(e) = disc[k];
      source(e) = before.entry(search.p.id(disc[k]));
    }
    return count;
  }
};

/// One field of the history in its new order.
template <class T>
struct CarryHistory {
  Field<T> here, arrived, to;
  Field<int> source;
  int entries_here;
  T empty;
  Field<int> neighbour, id;
  Faults faults;
  KOKKOS_FUNCTION void operator()(int e) const {
    int const from = source(e);
    T const value = from < 0 ? empty : from < entries_here ? here(from) : arrived(from - entries_here);
    to(e) = value;
    if constexpr (std::is_integral_v<T>) {
      constexpr T most = static_cast<T>(most_units);
      if (value > most || value < -most) faults.report(Fault::out_of_range, id(neighbour(e)));
    }
  }
};

/// Brings the history of the old rows into the order of `found`, field by field through the storage that the one before left
/// free, so that a search needs room for one field and not for a second set of rows.
void carry_history(OldRows old, ContactRows& found, Field<int> const& source, std::size_t entries, Field<int> const& id,
                   Faults const& faults) {
  std::size_t const size = found.neighbour.extent(0);
  std::vector<RealField> free;  // one of each format
  auto const carry = [&](HistoryField const& about, RealField& field, RealField const& arrived) {
    NumberFormat const format = kept(old.here.features.format, about.quantity);
    auto room = std::find_if(free.begin(), free.end(), [&](RealField const& f) { return f.format() == format; });
    if (room == free.end()) room = free.insert(free.end(), RealField("", 0, format));
    if (room->extent(0) != size) {
      *room = RealField("", 0, format);
      *room = RealField(about.name, size, format, false);
    }
    visit_as_kept(*room, [&]<class T>(Field<T> const& to) {
      T const empty = std::is_same_v<T, float> ? static_cast<T>(RealField::to_single(about.empty)) : static_cast<T>(about.empty);
      Kokkos::parallel_for(
          "carry_history", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(entries)),
          CarryHistory<T>{field.as<T>(), arrived.as<T>(), to, source, old.entries_here, empty, found.neighbour, id, faults});
    });
    Kokkos::fence();
    std::swap(field, *room);
  };
  for_each_history(old.here.features, carry, old.here, old.arrived);
  old.here.slice_start = found.slice_start;
  old.here.length = found.length;
  old.here.neighbour = found.neighbour;
  found = old.here;
}

}  // namespace

OldRows take_as_old(ParticleSoA const& particles, ContactRows const& rows) {
  OldRows old;
  old.here = rows;
  old.arrived.features = rows.features;
  old.slots_here = static_cast<int>(rows.length.extent(0));
  if (old.slots_here > 0) {
    HistoryFormat const& format = rows.features.format;
    Kokkos::deep_copy(old.entries_here, Kokkos::subview(rows.slice_start, format.slice_count(old.slots_here)));
    old.entries_here *= format.slice_width();
  }
  Kokkos::parallel_for("name_neighbours", Kokkos::RangePolicy<ExecutionSpace>(0, old.entries_here),
                       NameNeighbours{particles, rows});
  return old;
}

Field<int> slots_of_discs(ParticleSoA const& particles, OldRows const& old) {
  Field<int> const slot = uninitialised<int>("slot", static_cast<std::size_t>(particles.owned));
  Kokkos::parallel_for("first_slots", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned), FirstSlots{slot, old.slots_here});
  return slot;
}

std::size_t find_neighbours(ParticleSoA const& particles, Real largest_skin, OldRows const& old, Field<int> const& slot,
                            ContactRows& rows, Faults const& faults, Real bonded_gap) {
  auto const owned = static_cast<std::size_t>(particles.owned);
  HistoryFormat const& format = old.here.features.format;
  auto const slices = static_cast<std::size_t>(format.slice_count(particles.owned));
  std::size_t const slice_width = static_cast<std::size_t>(format.slice_width());
  Real const bonded_reach = bonded_gap * (1 + 1e-9);
  Real const radius = largest_radius(particles, particles.all()), slack = rounding_slack(particles, radius);
  Real const cell = 2 * radius + lane_max(2 * largest_skin + slack, bonded_reach);
  Search search{particles, bin_particles(particles, particles.all(), cell), {}, bonded_reach, slack, old, slot};
  search.candidates = line_up(particles, search.grid);
  Found near;
  near.neighbour = Kokkos::View<int**, MemorySpace>(Kokkos::view_alloc("found", Kokkos::WithoutInitializing), owned, Found::most);
  ContactRows found;
  found.features = old.here.features;
  found.length = uninitialised<RowLength>("rows.length", owned);
  found.slice_start = uninitialised<int>("rows.slice_start", slices + 1);
  Kokkos::parallel_for("count_neighbours", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                       CountNeighbours{search, near, found.length, faults});
  std::int64_t total = 0;
  Kokkos::parallel_scan("scan_slices", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(slices)),
                        ScanSlices{found.length, found.slice_start, particles.owned, format.slice_width()}, total);
  require_countable(total * format.slice_width(), particles.all());
  std::size_t const entries = static_cast<std::size_t>(total) * slice_width, held = rows.neighbour.extent(0);
  // A little more than needed, so that the next search finds fields of the right size; never nothing.
  std::size_t const wanted = std::max<std::size_t>(entries, slice_width);
  std::size_t const size = held >= wanted && held <= wanted + wanted / 16 ? held : wanted + wanted / 64;
  found.neighbour = uninitialised<int>("rows.neighbour", size);
  Field<int> const source = uninitialised<int>("rows.source", size);
  Kokkos::parallel_for("fill_rows", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(slices * slice_width)),
                       FillRows{search, near, found, source});
  std::size_t const lists = near.neighbour.span() * sizeof(int) + bytes(search.candidates) + bytes(search.grid);
  near = Found();
  search = Search();
  carry_history(old, found, source, entries, particles.id, faults);
  rows = found;
  std::size_t const room = rows.features.format.precision == Precision::full ? sizeof(double) : 2 * sizeof(float);
  return size * 2 * sizeof(int) + std::max(lists, size * room);  // the lists are gone when the history is carried
}

}  // namespace clathra
