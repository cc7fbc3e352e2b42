#include "kernels/neighbours.hpp"

#include <algorithm>
#include <type_traits>

#include "kernels/light_launch.hpp"
#ifdef CLATHRA_SIMD
#include "kernels/near_discs_on_processor.hpp"
#else
#include "kernels/near_discs_on_device.hpp"
#endif

namespace clathra {

namespace {

struct FirstOldRows {
  Field<int> old_row;
  int old_rows;
  KOKKOS_FUNCTION void operator()(int i) const { old_row(i) = i < old_rows ? i : -1; }
};

struct NameNeighbours {
  ParticleSoA p;
  ContactRows rows;
  KOKKOS_FUNCTION void operator()(int e) const { rows.neighbour(e) = p.id(rows.neighbour(e)); }
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
    OldRow before(search.old, search.old_row, i);
    int count = 0;
    search.for_each_near(i, before, [&](int j, bool in_touch) {
      if (count < Found::most) found.neighbour(i, count) = 2 * j + (in_touch ? 1 : 0);
      ++count;
    });
    if (count > longest_row) faults.report(Fault::row_overflow, search.p.id(i));
    length(i) = static_cast<RowLength>(count < longest_row ? count : longest_row);
  }
};

/// Where slices begin; behind the last one, their sum.
struct ScanSlices {
  Field<RowLength> length;
  Field<int> slice_start;
  Field<std::int64_t> sizes;
  int discs, slices, slice_width;
  KOKKOS_FUNCTION void operator()(int slice, std::int64_t& sum, bool const final) const {
    if (final) slice_start(slice) = static_cast<int>(sum);
    if (slice == slices) {
      if (final) sizes(0) = sum;
      return;
    }
    int longest = 0;
    for (int l = 0; l < slice_width; ++l) {
      int const i = slice * slice_width + l;
      if (i < discs && length(i) > longest) longest = length(i);
    }
    sum += longest;
  }
};

struct FillRows {
  Search search;
  Found found;
  ContactRows rows;
  Field<int> source;  // [entries] the old entry with the history of each new one, -1 for none

  KOKKOS_FUNCTION void operator()(int place) const {
    int const slice = place >> rows.features.format.slice_shift();
    int const width = rows.slice_start(slice + 1) - rows.slice_start(slice);
    bool const real = place < search.p.owned;
    int const used = real ? fill(place) : 0;
    for (int k = used; k < width; ++k) {
      std::size_t const e = rows.entry(place, k);
      rows.neighbour(e) = search.p.padding();
      source(e) = -1;
    }
  }

  KOKKOS_INLINE_FUNCTION int fill(int i) const {
    OldRow before(search.old, search.old_row, i);
    RowInOrder row(rows, source, i);
    auto const insert = [&](int j, bool in_touch) {
      int const id = search.p.id(j);
      row.insert(j, id, in_touch || before.was_bonded(id));
    };
    if (rows.length(i) <= Found::most) {
      for (int k = 0; k < rows.length(i); ++k) insert(found.neighbour(i, k) / 2, found.neighbour(i, k) % 2 == 1);
    } else {
      search.for_each_near(i, before, insert);
    }
    for (int k = 0; k < row.count(); ++k) {
      rows.neighbour(row.entry(k)) = row.disc(k);
      source(row.entry(k)) = before.entry(row.id(k));
    }
    return row.count();
  }
};

/// One field of the history in its new order.
template <class T>
struct CarryHistory {
  Field<T> here, arrived, to;
  Field<int> source;
  int entries_here;
  T empty;
  KOKKOS_FUNCTION void operator()(int e) const {
    int const from = source(e);
    to(e) = from < 0 ? empty : from < entries_here ? here(from) : arrived(from - entries_here);
  }
};

/// Brings the history of the old rows into the order of `found`, field by field through the storage that the one before left
/// free, so that a search needs room for one field and not for a second set of rows.
void carry_history(OldRows& old, ContactRows& found, Field<int> const& source, Scratch& scratch) {
  auto const carry = [&](HistoryField const& about, RealField& field, RealField const& arrived) {
    RealField const to =
        scratch.take_reals(about.name, found.neighbour.extent(0), kept(old.here.features.format, about.quantity));
    visit_as_kept(to, [&]<class T>(Field<T> const& numbers) {
      T const empty = std::is_same_v<T, float> ? static_cast<T>(RealField::to_single(about.empty)) : static_cast<T>(about.empty);
      Kokkos::parallel_for("carry_history", Kokkos::RangePolicy<ExecutionSpace>(0, found.entries),
                           CarryHistory<T>{field.as<T>(), arrived.as<T>(), numbers, source, old.entries_here, empty});
    });
    field = to;
  };
  for_each_history(old.here.features, carry, old.here, old.arrived);
  old.here.entries = found.entries;
  old.here.slice_start = found.slice_start;
  old.here.length = found.length;
  old.here.neighbour = found.neighbour;
  found = old.here;
}

/// Lists that only a search needs.
class Lists {
 public:
  /// In one piece of memory, which is large enough for a field of the history too: that is carried when the lists are done with.
  Lists(ParticleSoA const& particles, ContactRows const& rows, Scratch& scratch) {
    auto const owned = static_cast<std::size_t>(particles.owned);
    std::size_t const all = padded(static_cast<std::size_t>(particles.all()) + lane_count),
                      kept_of_count = padded(owned * Found::most);
    std::size_t history = 0;
    for_each_history(rows, [&](HistoryField const&, RealField const& field) {
      history = std::max(history, RealField::words(field.format(), field.extent(0)));
    });
    constexpr std::size_t of_a_candidate = (4 * sizeof(Real) + sizeof(int)) / sizeof(RealField::Word);
    memory_ = scratch.take<RealField::Word>("lists_of_search", std::max(of_a_candidate * all + kept_of_count, history));
    auto* at = reinterpret_cast<Real*>(memory_.data());
    for (Field<Real>* field : {&candidates.x, &candidates.y, &candidates.radius, &candidates.verlet_skin}) {
      *field = Field<Real>(at, all);
      at += all;
    }
    auto* const numbers = reinterpret_cast<int*>(at);
    candidates.disc = Field<int>(numbers, all);
    found.neighbour = decltype(found.neighbour)(numbers + all, owned, Found::most);
  }

  Candidates candidates;
  Found found;

 private:
  /// So that each list begins at a line of the caches.
  static std::size_t padded(std::size_t size) { return (size + 31) / 32 * 32; }

  Field<RealField::Word> memory_;
};

/// A search whose candidates stand in their cells.
Search prepared(ParticleSoA const& particles, SearchReach const& reach, Candidates const& candidates, OldRows const& old,
                Field<int> const& old_row, Scratch& scratch) {
  Real const bonded_reach = reach.bonded_gap * (1 + 1e-9), slack = rounding_slack(particles, reach.largest_radius);
  Real const cell = 2 * reach.largest_radius + lane_max(2 * reach.largest_skin + slack, bonded_reach);
  CellGrid const grid = bin_particles(particles, particles.all(), cell, reach.bounds, scratch);
  Kokkos::parallel_for("line_up", light_launch(particles.all() + lane_count), LineUp{particles, grid.disc, candidates});
  return {{particles, grid, candidates, bonded_reach, slack, old, old_row}};
}

/// Room for so many entries: a little more than needed, so that the next search finds fields of the right size; never nothing.
std::size_t room_for(std::size_t entries, std::size_t held, std::size_t slice_width) {
  std::size_t const wanted = std::max(entries, slice_width);
  return held >= wanted && held <= wanted + wanted / 16 ? held : wanted + wanted / 64;
}

}  // namespace

void name_neighbours(ParticleSoA const& particles, ContactRows const& rows) {
  Kokkos::parallel_for("name_neighbours", light_launch(rows.entries), NameNeighbours{particles, rows});
}

OldRows take_as_old(ParticleSoA const& particles, ContactRows& rows) {
  name_neighbours(particles, rows);
  OldRows old;
  old.rows_here = static_cast<int>(rows.length.extent(0));
  old.entries_here = rows.entries;
  old.here = rows;
  old.arrived.features = rows.features;
  rows = ContactRows();
  rows.features = old.here.features;
  return old;
}

Field<int> old_rows_of_discs(ParticleSoA const& particles, OldRows const& old, Scratch& scratch) {
  Field<int> const old_row = scratch.take<int>("old_row", static_cast<std::size_t>(particles.owned));
  Kokkos::parallel_for("first_old_rows", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                       FirstOldRows{old_row, old.rows_here});
  return old_row;
}

std::vector<std::int64_t> find_neighbours(ParticleSoA const& particles, SearchReach const& reach, OldRows& old,
                                          Field<int> const& old_row, ContactRows& rows, Faults const& faults,
                                          Field<std::int64_t> const& sizes, Scratch& scratch) {
  auto const owned = static_cast<std::size_t>(particles.owned);
  HistoryFormat const& format = old.here.features.format;
  int const slices = format.slice_count(particles.owned);
  auto const slice_width = static_cast<std::size_t>(format.slice_width());
  std::size_t const held = old.here.neighbour.extent(0);
  ContactRows found;
  found.features = old.here.features;
  found.length = scratch.take<RowLength>("rows.length", owned);
  found.slice_start = scratch.take<int>("rows.slice_start", static_cast<std::size_t>(slices) + 1);
  std::vector<std::int64_t> read;
  Field<int> source;
  {
    Lists const lists(particles, old.here, scratch);
    Search const search = prepared(particles, reach, lists.candidates, old, old_row, scratch);
    Kokkos::parallel_for("count_neighbours", light_launch(particles.owned),
                         CountNeighbours{search, lists.found, found.length, faults});
    Kokkos::parallel_scan("scan_slices", Kokkos::RangePolicy<ExecutionSpace>(0, slices + 1),
                          ScanSlices{found.length, found.slice_start, sizes, particles.owned, slices, format.slice_width()});
    read = on_host(sizes, sizes.extent(0));
    std::int64_t const blocks = read[0];
    require_countable(blocks * format.slice_width(), particles.all());
    std::size_t const entries = static_cast<std::size_t>(blocks) * slice_width, size = room_for(entries, held, slice_width);
    found.entries = static_cast<int>(entries);
    found.neighbour = scratch.take<int>("rows.neighbour", size);
    source = scratch.take<int>("rows.source", size);
    Kokkos::parallel_for("fill_rows", light_launch(slices * format.slice_width()), FillRows{search, lists.found, found, source});
  }
  carry_history(old, found, source, scratch);
  rows = found;
  return read;
}

}  // namespace clathra
