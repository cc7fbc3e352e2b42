#include "kernels/spatial_order.hpp"

#include "kernels/cell_grid.hpp"

namespace clathra {

namespace {

/// The work on the row of each slot of one slice: the entries that carry a history, which the contact kernel evaluates, and among
/// equals the length of the row.
struct WorkOfSlots {
  ContactRows rows;
  int first;
  Field<int> work;  ///< [slots] first + slot is set

  KOKKOS_FUNCTION void operator()(int group) const {
    int const shift = rows.features.format.slice_shift(), begin = group * lane_count, slice = begin >> shift;
    bool const shear = rows.shear.extent(0) > 0, bonds = rows.formation_overlap.extent(0) > 0;
    Lanes carrying(0);
    for (int k = rows.slice_start(slice); k < rows.slice_start(slice + 1); ++k) {
      std::size_t const e = (static_cast<std::size_t>(k) << shift) | static_cast<std::size_t>(begin & ((1 << shift) - 1));
      Mask marked(false);
      if (shear) marked = load(rows.shear, e) != Lanes(0);
      if (bonds) marked = marked || is_bonded(load(rows.formation_overlap, e));
      carrying += select(marked, Lanes(1), Lanes(0));
    }
    for (int l = 0; l < lane_count; ++l) {
      int const slot = begin + l;
      if (slot < static_cast<int>(rows.length.extent(0)))
        work(first + slot) = static_cast<int>(lane(carrying, l)) * (longest_row + 1) + rows.length(slot);
    }
  }
};

/// Sorts the discs of one window by falling work; equal ones keep their order.
struct SortByWork {
  static constexpr int most = slices_a_window * widest_slice;
  Field<int> order, slot, work;
  int discs, window_size;

  KOKKOS_FUNCTION void operator()(int window) const {
    int const begin = window * window_size, size = begin + window_size < discs ? window_size : discs - begin;
    int disc[most], by_length[most];
    for (int k = 0; k < size; ++k) disc[k] = order(begin + k);
    spread(disc, by_length, size, [this](int d) { return work_on(d) % (longest_row + 1); });
    spread(by_length, disc, size, [this](int d) { return work_on(d) / (longest_row + 1); });
    for (int k = 0; k < size; ++k) order(begin + k) = disc[k];
  }

  KOKKOS_INLINE_FUNCTION int work_on(int disc) const { return slot(disc) < 0 ? 0 : work(slot(disc)); }

  /// One pass of a counting sort, the largest digit first.
  template <class Digit>
  KOKKOS_INLINE_FUNCTION static void spread(int const* from, int* to, int size, Digit const& digit) {
    int place[longest_row + 1] = {};
    for (int k = 0; k < size; ++k) ++place[digit(from[k])];
    int next = 0;
    for (int d = longest_row; d >= 0; --d) {
      int const count = place[d];
      place[d] = next;
      next += count;
    }
    for (int k = 0; k < size; ++k) to[place[digit(from[k])]++] = from[k];
  }
};

Field<int> work_of_slots(OldRows const& old) {
  auto const arrived = static_cast<int>(old.arrived.length.extent(0));
  Field<int> const work = uninitialised<int>("work_of_slots", static_cast<std::size_t>(old.slots_here + arrived));
  Kokkos::parallel_for("work_of_slots", Kokkos::RangePolicy<ExecutionSpace>(0, group_count(old.slots_here)),
                       WorkOfSlots{old.here, 0, work});
  Kokkos::parallel_for("work_of_slots", Kokkos::RangePolicy<ExecutionSpace>(0, group_count(arrived)),
                       WorkOfSlots{old.arrived, old.slots_here, work});
  return work;
}

Field<int> by_cells(ParticleSoA const& particles, Real skin) {
  return bin_particles(particles, particles.owned, 2 * largest_radius(particles, particles.owned) + skin).disc;
}

struct Number {
  Field<int> order;
  KOKKOS_FUNCTION void operator()(int i) const { order(i) = i; }
};

Field<int> as_stored(ParticleSoA const& particles) {
  Field<int> const order = uninitialised<int>("order", static_cast<std::size_t>(particles.owned));
  Kokkos::parallel_for("as_stored", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned), Number{order});
  return order;
}

}  // namespace

Field<int> sort_in_space(ParticleSoA& particles, OldRows const& old, Field<int>& slot, Real skin, bool anew) {
  Field<int> const order = anew ? by_cells(particles, skin) : as_stored(particles);
  int const window = slices_a_window * old.here.features.format.slice_width();
  Kokkos::parallel_for("sort_by_work", Kokkos::RangePolicy<ExecutionSpace>(0, (particles.owned + window - 1) / window),
                       SortByWork{order, slot, work_of_slots(old), particles.owned, window});
  permute(particles, order);
  slot = permuted(slot, order, order.extent(0));
  return order;
}

}  // namespace clathra
