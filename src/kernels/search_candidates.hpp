#pragma once
/// What a neighbour search looks at for one disc: the candidates of the cells around it, and the row that it had before.
#include "kernels/cell_grid.hpp"
#include "kernels/neighbours.hpp"

namespace clathra {

/// Discs in the order of the grid's cells, so that candidates lie side by side; [discs + lane_count].
struct Candidates {
  Field<int> disc;
  Field<Coord> x, y;
  Field<Real> radius, verlet_skin;
};

/// What one search needs to know about the old rows and the grid.
struct SearchInputs {
  ParticleSoA p;
  CellGrid grid;
  Candidates candidates;
  Real bonded_reach;  // beyond touching, of any bond [m]
  Real slack;         // rounding_slack()
  OldRows old;
  Field<int> old_row;

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
  /// @param x,y,radius,skin  of candidates, one or as many as lanes
  template <class L>
  KOKKOS_FORCEINLINE_FUNCTION Reaches<L> reaches(int i, L const& x, L const& y, L const& radius, L const& skin) const {
    L const dx = x - p.x(i), dy = y - p.y(i), touch = radius + p.radius(i);
    return {dx * dx + dy * dy, touch, touch + (skin + p.verlet_skin(i) + slack), touch + bonded_reach};
  }
};

/// The place in a row of a neighbour by id, and which of the two parts of a row it belongs to: entries in touch or bonded come
/// first, each part by id.
struct RowKey {
  static constexpr int most_id = 0x7fffffff;
  /// Below zero in the first part.
  static KOKKOS_INLINE_FUNCTION int of(int id, bool first_part) { return first_part ? id | ~most_id : id; }
  static KOKKOS_INLINE_FUNCTION int id(int key) { return key & most_id; }
};

}  // namespace clathra
