#pragma once
/// What a neighbour search finds near one disc, on a device: one candidate after the other, of which nothing is kept, since the
/// stack of a thread lies in the slowest memory. near_discs_on_processor.hpp does the same on a processor.
#include "kernels/search_candidates.hpp"

namespace clathra {

/// The row that a disc had before the search, its neighbours by id; found when first asked for.
class OldRow {
 public:
  KOKKOS_INLINE_FUNCTION OldRow(OldRows const& old, Field<int> const& old_row, int disc)
      : old_(old), old_row_(old_row), disc_(disc) {}

  /// The old entry of disc `other`, or -1.
  KOKKOS_INLINE_FUNCTION int entry(int other) {
    if (length_ < 0) {
      at_ = old_row_(disc_);
      length_ = old_.length(at_);
    }
    for (int k = 0; k < length_; ++k) {
      if (old_.neighbour_id(old_.entry(at_, k)) == other) return old_.entry(at_, k);
    }
    return -1;
  }
  KOKKOS_INLINE_FUNCTION bool was_bonded(int other) {
    if (old_.here.formation_overlap.extent(0) == 0) return false;
    int const found = entry(other);
    return found >= 0 && old_.bonded(found);
  }

 private:
  OldRows const& old_;
  Field<int> const& old_row_;
  int disc_, at_ = 0, length_ = -1;
};

struct Search : SearchInputs {
  /// Calls visit(disc, whether in touch) for every disc that belongs into the row of disc i, whose old row is `before`, in any
  /// order; of more than a row holds, for at least one too many.
  template <class Visit>
  KOKKOS_INLINE_FUNCTION void for_each_near(int i, OldRow& before, Visit const& visit) const {
    int count = 0;
    for_each_candidate(i, [&](int k, int) {
      Reaches<Real> const at =
          reaches<Real>(i, candidates.x(k), candidates.y(k), candidates.radius(k), candidates.verlet_skin(k));
      int const j = candidates.disc(k);
      bool const in_touch = at.distance2 < at.touch * at.touch, near = at.distance2 < at.reach * at.reach;
      if (j == i || !(in_touch || near || (at.distance2 < at.bonded * at.bonded && before.was_bonded(p.id(j))))) return true;
      visit(j, in_touch);
      return ++count <= longest_row;
    });
  }
};

/// Fills a row in order (RowKey), sorted where it will stand.
class RowInOrder {
 public:
  /// @param source  [entries] keeps the keys until they are replaced
  KOKKOS_INLINE_FUNCTION RowInOrder(ContactRows const& rows, Field<int> const& source, int disc)
      : room_(rows.length(disc)),
        first_(rows.entry(disc, 0)),
        step_(static_cast<std::size_t>(rows.features.format.slice_width())),
        disc_(rows.neighbour.data() + first_),
        key_(source.data() + first_) {}
  KOKKOS_INLINE_FUNCTION int count() const { return count_; }
  KOKKOS_INLINE_FUNCTION std::size_t entry(int k) const { return first_ + place(k); }
  KOKKOS_INLINE_FUNCTION int disc(int k) const { return disc_[place(k)]; }
  KOKKOS_INLINE_FUNCTION int id(int k) const { return RowKey::id(key_[place(k)]); }

  KOKKOS_INLINE_FUNCTION void insert(int disc, int id, bool first_part) {
    if (count_ == room_) return;
    int const key = RowKey::of(id, first_part);
    int at = count_++;
    for (; at > 0 && key < key_[place(at - 1)]; --at) {
      key_[place(at)] = key_[place(at - 1)];
      disc_[place(at)] = disc_[place(at - 1)];
    }
    key_[place(at)] = key;
    disc_[place(at)] = disc;
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION std::size_t place(int k) const { return static_cast<std::size_t>(k) * step_; }

  int room_, count_ = 0;
  std::size_t first_, step_;
  int *disc_, *key_;
};

}  // namespace clathra
