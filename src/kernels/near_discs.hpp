#pragma once
/// What a neighbour search finds near one disc. On a processor a thread lists it on its stack, several candidates at a time; on a
/// device, where a stack lies in the slowest memory, it asks for one candidate after the other and keeps nothing.
#include "kernels/cell_grid.hpp"
#include "kernels/neighbours.hpp"

namespace clathra {

/// The row that a disc had before the search, its neighbours by id; read when first asked for.
class OldRow {
 public:
  KOKKOS_INLINE_FUNCTION OldRow(OldRows const& old, Field<int> const& slot, int disc) : old_(old), slot_(slot), disc_(disc) {}

  /// The old entry of disc `other`, or -1.
  KOKKOS_INLINE_FUNCTION int entry(int other) {
    if (length_ < 0) read();
    for (int k = 0; k < length_; ++k) {
      if (id(k) == other) return old_.entry(at_, k);
    }
    return -1;
  }
  KOKKOS_INLINE_FUNCTION bool was_bonded(int other) {
    if (old_.here.formation_overlap.extent(0) == 0) return false;
    if (length_ < 0) read();
    int found = -1;
    for (int k = 0; k < length_; ++k) found = id(k) == other ? k : found;  // without a branch that nothing foresees
    return found >= 0 && old_.bonded(old_.entry(at_, found));
  }

 private:
  OldRows const& old_;
  Field<int> const& slot_;
  int disc_, at_ = 0, length_ = -1;
#ifdef CLATHRA_SIMD
  int id_[longest_row];
  KOKKOS_INLINE_FUNCTION int id(int k) const { return id_[k]; }
  KOKKOS_INLINE_FUNCTION void read() {
    at_ = slot_(disc_);
    length_ = old_.length(at_);
    for (int k = 0; k < length_; ++k) id_[k] = old_.neighbour_id(old_.entry(at_, k));
  }
#else
  KOKKOS_INLINE_FUNCTION int id(int k) const { return old_.neighbour_id(old_.entry(at_, k)); }
  KOKKOS_INLINE_FUNCTION void read() {
    at_ = slot_(disc_);
    length_ = old_.length(at_);
  }
#endif
};

/// Discs in the order of the grid's cells, so that candidates lie side by side; [discs + lane_count].
struct Candidates {
  Field<int> disc;
  Field<Coord> x, y;
  Field<Real> radius, verlet_skin;
};

/// What one search needs to know about the old rows and the grid.
struct Search {
  ParticleSoA p;
  CellGrid grid;
  Candidates candidates;
  Real bonded_reach;  // beyond touching, of any bond [m]
  Real slack;         // rounding_slack()
  OldRows old;
  Field<int> slot;

  /// Calls visit(disc, whether in touch) for every disc that belongs into the row of disc i, whose old row is `before`, in any
  /// order; of more than a row holds, for at least one too many.
  template <class Visit>
  KOKKOS_INLINE_FUNCTION void for_each_near(int i, OldRow& before, Visit const& visit) const {
#ifdef CLATHRA_SIMD
    Nearby found;
    near_to(i, before, found);
    for (int k = 0; k < found.touching; ++k) visit(found.in_touch[k], true);
    for (int k = 0; k < found.others; ++k) visit(found.apart[k], false);
#else
    int count = 0;
    for_each_candidate(i, [&](int k, int) {
      Reaches<Real> const at = reaches(i, k);
      int const j = candidates.disc(k);
      bool const in_touch = at.distance2 < at.touch * at.touch, near = at.distance2 < at.reach * at.reach;
      if (j == i || !(in_touch || near || (at.distance2 < at.bonded * at.bonded && before.was_bonded(p.id(j))))) return true;
      visit(j, in_touch);
      return ++count <= longest_row;
    });
#endif
  }

 private:
  /// Calls visit(k, end) for the candidates from k on that lie before `end`, lane_count at a time, until it is false.
  template <class Visit>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_candidate(int i, Visit const& visit) const {
    int const column = grid.column_of(p.x(i)), row = grid.row_of(p.y(i));
    for (int r = row > 0 ? row - 1 : 0; r <= row + 1 && r < grid.rows; ++r) {
      int const first = column > 0 ? column - 1 : 0, last = column + 1 < grid.columns ? column + 1 : column;
      int const end = grid.start(r * grid.columns + last + 1);
      for (int k = grid.start(r * grid.columns + first); k < end; k += lane_count) {
        if (!visit(k, end)) return;
      }
    }
  }

  /// How far candidates are from a disc, and how near they must be to touch it, to be listed, and to be listed if bonded [m].
  template <class L>
  struct Reaches {
    L distance2, touch, reach, bonded;
  };
  KOKKOS_FORCEINLINE_FUNCTION Reaches<Lanes> reaches(int i, int k) const {
    Lanes const dx = load(&candidates.x(k)) - p.x(i), dy = load(&candidates.y(k)) - p.y(i);
    Lanes const touch = load(&candidates.radius(k)) + p.radius(i);
    return {dx * dx + dy * dy, touch, touch + (load(&candidates.verlet_skin(k)) + p.verlet_skin(i) + slack),
            touch + bonded_reach};
  }

#ifdef CLATHRA_SIMD
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
    Reaches<Lanes> const at = reaches(i, k);
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
#endif
};

/// Fills a row in order: entries in touch or bonded first, each part by id. On a device it is sorted where it will stand.
class RowInOrder {
 public:
  /// @param source  [entries] keeps the keys until they are replaced
  KOKKOS_INLINE_FUNCTION RowInOrder(ContactRows const& rows, [[maybe_unused]] Field<int> const& source, int disc)
      : room_(rows.length(disc)),
        first_(rows.entry(disc, 0)),
        step_(static_cast<std::size_t>(rows.features.format.slice_width()))
#ifndef CLATHRA_SIMD
        ,
        disc_(rows.neighbour.data() + first_),
        key_(source.data() + first_)
#endif
  {
  }
  KOKKOS_INLINE_FUNCTION int count() const { return count_; }
  KOKKOS_INLINE_FUNCTION std::size_t entry(int k) const { return first_ + static_cast<std::size_t>(k) * step_; }
  KOKKOS_INLINE_FUNCTION int disc(int k) const { return disc_[place(k)]; }
  KOKKOS_INLINE_FUNCTION int id(int k) const { return key_[place(k)] & most_id; }

  KOKKOS_INLINE_FUNCTION void insert(int disc, int id, bool first_part) {
    if (count_ == room_) return;
    int const key = first_part ? id | ~most_id : id;  // below zero in the first part
    int at = count_++;
    for (; at > 0 && key < key_[place(at - 1)]; --at) {
      key_[place(at)] = key_[place(at - 1)];
      disc_[place(at)] = disc_[place(at - 1)];
    }
    key_[place(at)] = key;
    disc_[place(at)] = disc;
  }

 private:
  static constexpr int most_id = 0x7fffffff;
  int room_, count_ = 0;
  std::size_t first_, step_;
#ifdef CLATHRA_SIMD
  int disc_[longest_row], key_[longest_row];
  KOKKOS_FORCEINLINE_FUNCTION static std::size_t place(int k) { return static_cast<std::size_t>(k); }
#else
  int *disc_, *key_;
  KOKKOS_FORCEINLINE_FUNCTION std::size_t place(int k) const { return static_cast<std::size_t>(k) * step_; }
#endif
};

}  // namespace clathra
