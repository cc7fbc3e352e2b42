#pragma once
/// What a neighbour search finds near one disc, on a processor: several candidates at a time, listed on the stack of a thread.
/// near_discs_on_device.hpp does the same where a stack lies in the slowest memory.
#include "kernels/search_candidates.hpp"

namespace clathra {

/// The row that a disc had before the search, its neighbours by id; read when first asked for.
class OldRow {
 public:
  OldRow(OldRows const& old, Field<int> const& old_row, int disc) : old_(old), old_row_(old_row), disc_(disc) {}

  /// The old entry of disc `other`, or -1.
  int entry(int other) {
    if (length_ < 0) read();
    for (int k = 0; k < length_; ++k) {
      if (id_[k] == other) return old_.entry(at_, k);
    }
    return -1;
  }
  bool was_bonded(int other) {
    if (old_.here.formation_overlap.extent(0) == 0) return false;
    if (length_ < 0) read();
    int found = -1;
    for (int k = 0; k < length_; ++k) found = id_[k] == other ? k : found;  // without a branch that nothing foresees
    return found >= 0 && old_.bonded(old_.entry(at_, found));
  }

 private:
  void read() {
    at_ = old_row_(disc_);
    length_ = old_.length(at_);
    for (int k = 0; k < length_; ++k) id_[k] = old_.neighbour_id(old_.entry(at_, k));
  }

  OldRows const& old_;
  Field<int> const& old_row_;
  int disc_, at_ = 0, length_ = -1;
  int id_[longest_row];
};

struct Search : SearchInputs {
  /// Calls visit(disc, whether in touch) for every disc that belongs into the row of disc i, whose old row is `before`, in any
  /// order; of more than a row holds, for at least one too many.
  template <class Visit>
  KOKKOS_INLINE_FUNCTION void for_each_near(int i, OldRow& before, Visit const& visit) const {
    Nearby found;
    near_to(i, before, found);
    for (int k = 0; k < found.touching; ++k) visit(found.in_touch[k], true);
    for (int k = 0; k < found.others; ++k) visit(found.apart[k], false);
  }

 private:
  /// Discs listed in groups of lanes, hence the room behind them.
  using DiscList = int[longest_row + 1 + lane_count];
  struct Nearby {
    DiscList in_touch, apart;
    int touching, others;
  };
  KOKKOS_INLINE_FUNCTION void near_to(int i, OldRow& before, Nearby& found) const {
    int touching = 0, others = 0;  // not in `found`, where each store to a list might change them
    for_each_candidate(i, [&](int k, int end) {
      add_near(i, k, end, before, found, touching, others);
      return touching + others <= longest_row + 1;
    });
    found.touching = without(i, found.in_touch, touching);
    found.others = others;
  }

  /// The candidates k .. k + lane_count, those before `end`, tested side by side.
  KOKKOS_FORCEINLINE_FUNCTION void add_near(int i, int k, int end, OldRow& before, Nearby& found, int& touching,
                                            int& others) const {
    Reaches<Lanes> const at =
        reaches(i, load(&candidates.x(k)), load(&candidates.y(k)), load(&candidates.radius(k)), load(&candidates.verlet_skin(k)));
    auto const candidate = first_lanes(end - k), in_touch = candidate && at.distance2 < at.touch * at.touch;
    auto const apart = candidate && !in_touch && at.distance2 < at.reach * at.reach;
    touching += pack_set(in_touch, &candidates.disc(k), found.in_touch + touching);
    others += pack_set(apart, &candidates.disc(k), found.apart + others);
    for_each_set(candidate && !in_touch && !apart && at.distance2 < at.bonded * at.bonded, [&](int l) {
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

/// Fills a row in order (RowKey), sorted on the stack.
class RowInOrder {
 public:
  RowInOrder(ContactRows const& rows, Field<int> const& /*source*/, int disc)
      : room_(rows.length(disc)),
        first_(rows.entry(disc, 0)),
        step_(static_cast<std::size_t>(rows.features.format.slice_width())) {}
  int count() const { return count_; }
  std::size_t entry(int k) const { return first_ + static_cast<std::size_t>(k) * step_; }
  int disc(int k) const { return disc_[k]; }
  int id(int k) const { return RowKey::id(key_[k]); }

  void insert(int disc, int id, bool first_part) {
    if (count_ == room_) return;
    int const key = RowKey::of(id, first_part);
    int at = count_++;
    for (; at > 0 && key < key_[at - 1]; --at) {
      key_[at] = key_[at - 1];
      disc_[at] = disc_[at - 1];
    }
    key_[at] = key;
    disc_[at] = disc;
  }

 private:
  int room_, count_ = 0;
  std::size_t first_, step_;
  int disc_[longest_row], key_[longest_row];
};

}  // namespace clathra
