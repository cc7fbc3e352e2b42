#pragma once
/// What the contact kernel reads of neighbours in double precision on a GPU: 48 bytes a disc, side by side. Its memory is read by
/// sectors of 32 bytes; numbers of six fields are six of them, those of a row two, wherever it begins. Rows are copies: the
/// fields are the record. On a processor, whose lanes gather field by field, there are none.
#include "kernels/real_field.hpp"

namespace clathra {

/// What is read of a disc: its centre [m], radius [m], velocity [m/s] and spin [rad/s].
struct DiscRow {
  Coord x, y;
  Real radius, vx, vy, omega;
};
static_assert(sizeof(DiscRow) == 48);

/// @tparam kept  whether there are rows
template <bool kept>
struct DiscRowsWhere {
  void resize(std::size_t) {}
  std::size_t bytes() const { return 0; }
  template <class... Numbers>
  KOKKOS_FORCEINLINE_FUNCTION void set(std::size_t, Numbers const&...) const {}
  KOKKOS_FORCEINLINE_FUNCTION DiscRow of(int) const;  // never called
};
template <>
struct DiscRowsWhere<true> {
  Field<DiscRow> rows;

  /// Drops what stood there.
  void resize(std::size_t discs) { rows = uninitialised<DiscRow>("disc_rows", discs); }
  std::size_t bytes() const { return rows.span() * sizeof(DiscRow); }
  KOKKOS_FORCEINLINE_FUNCTION void set(std::size_t i, Coord x, Coord y, Real radius, Real vx, Real vy, Real omega) const {
    rows(i) = {x, y, radius, vx, vy, omega};
  }
  KOKKOS_FORCEINLINE_FUNCTION DiscRow const& of(int disc) const { return rows(disc); }
};
using DiscRows = DiscRowsWhere<for_gpu>;

}  // namespace clathra
