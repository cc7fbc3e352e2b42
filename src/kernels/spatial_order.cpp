#include "kernels/spatial_order.hpp"

#include "kernels/light_launch.hpp"

namespace clathra {

namespace {

/// The work on the row of each place of one slice: the entries that carry a history, which the contact kernel evaluates, and
/// among equals the length of the row.
struct WorkOfRows {
  ContactRows rows;
  int first;
  Field<int> work;  ///< [places] first + place is set

  KOKKOS_FUNCTION void operator()(int group) const {
    int const shift = rows.features.format.slice_shift(), begin = group * lane_count, slice = begin >> shift;
    bool const shear = rows.shear.extent(0) > 0, bonds = rows.formation_overlap.extent(0) > 0;
    Lanes carrying(0);
    for (int k = rows.slice_start(slice); k < rows.slice_start(slice + 1); ++k) {
      std::size_t const e = (static_cast<std::size_t>(k) << shift) | static_cast<std::size_t>(begin & ((1 << shift) - 1));
      Mask marked(false);
      if (shear) marked = load(rows.shear, e) != Lanes(no_force(rows.features.format));
      if (bonds) marked = marked || is_bonded(load(rows.formation_overlap, e));
      carrying += select(marked, Lanes(1), Lanes(0));
    }
    for (int l = 0; l < lane_count; ++l) {
      int const place = begin + l;
      if (place < static_cast<int>(rows.length.extent(0)))
        work(first + place) = static_cast<int>(lane(carrying, l)) * (longest_row + 1) + rows.length(place);
    }
  }
};

/// Windows of discs and what they are sorted by.
struct Window {
  Field<int> order;  ///< empty: the order of the storage
  Field<int> key;    ///< [discs] no two of a window are equal
  int size;          ///< a power of two
  KOKKOS_INLINE_FUNCTION int disc(int i) const { return order.extent(0) > 0 ? order(i) : i; }
};
struct SetKeys {
  Window window;
  Field<int> old_row, work;
  KOKKOS_FUNCTION void operator()(int i) const {
    int const at = old_row(window.disc(i)), behind = (window.size - 1) & ~i;
    window.key(i) = (at < 0 ? 0 : work(at)) * window.size + behind;
  }
};
static_assert((longest_row + 1) * (longest_row + 1) * slices_a_window * widest_slice < (1 << 30), "keys are ints");
/// Ranks the discs of a window by falling work; equal ones keep their order. Each disc counts those before it: that is more to do
/// than in a sort, but all of them do it side by side, and nothing is kept by any.
struct RankByWork {
  Window window;
  Field<int> ranked;
  KOKKOS_FUNCTION void operator()(int i) const {
    int const begin = i & ~(window.size - 1), discs = static_cast<int>(window.key.extent(0));
    int const end = begin + window.size < discs ? begin + window.size : discs;
    int const* const key = window.key.data();
    int const own = key[i];
    int rank = 0;
    for (int k = begin; k < end; ++k) rank += key[k] > own ? 1 : 0;
    ranked(begin + rank) = window.disc(i);
  }
};

Field<int> work_of_rows(OldRows const& old, Scratch& scratch) {
  auto const arrived = static_cast<int>(old.arrived.length.extent(0));
  Field<int> const work = scratch.take<int>("work_of_rows", static_cast<std::size_t>(old.rows_here + arrived));
  Kokkos::parallel_for("work_of_rows", light_launch(group_count(old.rows_here)), WorkOfRows{old.here, 0, work});
  if (arrived > 0)
    Kokkos::parallel_for("work_of_rows", light_launch(group_count(arrived)), WorkOfRows{old.arrived, old.rows_here, work});
  return work;
}

}  // namespace

Field<int> sort_in_space(ParticleSoA& particles, OldRows const& old, Field<int>& old_row,
                         std::optional<CellsOfOrder> const& cells, Scratch& scratch) {
  auto const discs = static_cast<std::size_t>(particles.owned);
  Field<int> const order = scratch.take<int>("order", discs);
  Window window{{}, scratch.take<int>("keys", discs), slices_a_window * old.here.features.format.slice_width()};
  if (cells) window.order = bin_particles(particles, particles.owned, cells->size, cells->bounds, scratch).disc;
  Kokkos::RangePolicy<ExecutionSpace> const each(0, particles.owned);
  Kokkos::parallel_for("set_keys", each, SetKeys{window, old_row, work_of_rows(old, scratch)});
  Kokkos::parallel_for("rank_by_work", each, RankByWork{window, order});
  permute(particles, order, scratch);
  old_row = permuted(old_row, order, discs, scratch);
  return order;
}

}  // namespace clathra
