#pragma once
/// Neighbour rows and the history of contacts and bonds, as a structure of arrays.
///
/// Rows are full: both discs of a pair list it, keep its history and compute its force. That is twice the arithmetic of half
/// rows, and the faster way still: no force is written for another disc, so nothing needs an atomic, a second pass or a
/// colouring, each thread or GPU lane sums one disc in a fixed order, and ranks owe each other no forces. Bits then cannot depend
/// on who computes what. Half rows were measured at 0.92 of the speed unbonded and 1.05 to 1.17 bonded
/// (perf/reports/0.1/performance.md).
#include <cmath>
#include <type_traits>

#include "kernels/bond_law.hpp"
#include "kernels/countable.hpp"
#include "kernels/particles.hpp"

namespace clathra {

/// How the history of rows is kept: in mixed precision in single precision, and forces as those at the reference
/// (reference_configuration.hpp).
struct HistoryFormat {
  Precision precision = Precision::full;
  bool operator==(HistoryFormat const&) const = default;

  KOKKOS_INLINE_FUNCTION int slice_shift() const {
    return precision == Precision::full ? log2_of(slice_width_of<double>) : log2_of(slice_width_of<float>);
  }
  KOKKOS_INLINE_FUNCTION int slice_width() const { return 1 << slice_shift(); }
  KOKKOS_INLINE_FUNCTION int lanes() const { return precision == Precision::full ? lane_count_of<double> : lane_count_of<float>; }
  KOKKOS_INLINE_FUNCTION int slice_count(int discs) const { return (discs + slice_width() - 1) / slice_width(); }

 private:
  KOKKOS_INLINE_FUNCTION static constexpr int log2_of(int width) {
    int log = 0;
    while (width >> (log + 1) > 0) ++log;
    return log;
  }
};

/// What a scene needs stored for each row entry, and how.
struct ContactFeatures {
  bool shear = true;           ///< F_s of grain contacts with friction, or of bonds in their place (`replace`)
  bool rolling = true;         ///< contact moments
  bool bonds = false;          ///< bond formation_overlap
  bool separate_bond = false;  ///< `parallel`: the bond has a history of its own beside the grain contact
  HistoryFormat format;
  bool operator==(ContactFeatures const&) const = default;
};

/// The place of entry k of a disc's row among all entries.
CLATHRA_OF_THE_CALLERS_SIDE
template <class SliceStart>
KOKKOS_INLINE_FUNCTION std::size_t entry_in(SliceStart const& slice_start, HistoryFormat const& format, int disc, int k) {
  int const shift = format.slice_shift();
  return (static_cast<std::size_t>(slice_start(disc >> shift) + k) << shift) |
         static_cast<std::size_t>(disc & ((1 << shift) - 1));
}

/// How far ahead of a kernel that goes through rows discs are fetched. They stand in rows of cells across the box, and the first
/// to ask for a disc is a neighbour in the row before: in a box twice as high as wide 1.2 sqrt(N) discs away, and a sorting
/// window more.
inline std::size_t discs_ahead(int discs) {
  return static_cast<std::size_t>(512 + 2 * std::sqrt(static_cast<double>(discs))) / widest_slice * widest_slice;
}
/// Fetches a group of discs in fields of double precision. Past the last disc it asks for the first.
template <class... Fields>
KOKKOS_FORCEINLINE_FUNCTION void fetch_discs(std::size_t at, Fields const&... fields) {
  (prefetch(&fields(at < fields.extent(0) ? at : 0)), ...);
}

using RowLength = std::uint8_t;
static_assert(longest_row <= 255);

/// Full rows (each pair stands in both rows) in sliced ELLPACK: slice_width() discs form a slice, entry k of its discs lies side
/// by side. Rows are sorted: entries in touch or bonded first, each part by neighbour id, so that sums do not depend on where
/// discs are stored. Both sides of a pair hold equal `shear` and `formation_overlap` and exactly opposite `moment`. In mixed
/// precision forces and moments are those at the reference, no_bond where there is none: see history_forces().
struct ContactRows {
  ContactFeatures features;
  int entries = 0;              ///< of all slices; the fields below may have room for more
  Field<int> slice_start;       ///< [slices + 1] in units of slice_width() entries
  Field<RowLength> length;      ///< [owned] entries in use
  Field<int> neighbour;         ///< [entries] index of the other disc, or the padding disc
  RealField shear;              ///< [entries] F_s [N/m]; as the following, empty where no feature needs it
  RealField moment;             ///< [entries] M on the row's own disc [N m/m]
  RealField formation_overlap;  ///< [entries] u_0 of the bond [m], no_bond without one
  RealField bond_shear;         ///< [entries] F_s of a separate bond [N/m]
  RealField bond_moment;        ///< [entries] M of a separate bond [N m/m]
  RealField
      reference_branch;  ///< [entries] mixed precision: the branch that shear forces count from (reference_configuration.hpp)
  // Derived, not part of the state: set by prepare_rows().
  RealField width;              ///< [entries] B of the bond [m], 0 without one
  Field<std::uint64_t> active;  ///< [groups of lanes] bit k: entries k of the group may carry a history and must be evaluated

  KOKKOS_INLINE_FUNCTION std::size_t entry(int disc, int k) const { return entry_in(slice_start, features.format, disc, k); }
};

/// What there is to know of a field of the history beside its values.
struct HistoryField {
  enum class Quantity { force, moment, length, branch };
  char const* name;
  Quantity quantity;
  Real empty = 0;    ///< value of an entry without history
  bool odd = false;  ///< the two sides of a pair hold opposite values, else equal ones
};
/// The force or moment of an entry that remembers none, as rows hold it.
KOKKOS_INLINE_FUNCTION Real no_force(HistoryFormat const& format) { return format.precision == Precision::full ? 0 : no_bond; }

/// How a field of the history is kept.
inline NumberFormat kept(HistoryFormat const& format, HistoryField::Quantity quantity) {
  if (format.precision == Precision::full) return {};
  return {quantity == HistoryField::Quantity::branch ? Storage::as_int : Storage::as_float};
}

/// The history of an entry, field by field, here and in kernels: visit(HistoryField, whether the features need it, the field of
/// each of the rows, which have the same features). It drives allocation, the way through a neighbour search, the hash of the
/// state, files, other ranks and byte counts.
CLATHRA_OF_THE_CALLERS_SIDE
template <class Visit, class... Rows>
KOKKOS_INLINE_FUNCTION void for_each_possible_history(ContactFeatures const& f, Visit&& visit, Rows&... rows) {
  using enum HistoryField::Quantity;
  bool const references = f.format.precision == Precision::mixed;
  Real const none = no_force(f.format);
  visit(HistoryField{"shear", force, none}, f.shear, rows.shear...);
  visit(HistoryField{"moment", moment, none, true}, f.rolling || f.bonds, rows.moment...);
  visit(HistoryField{"formation_overlap", length, no_bond}, f.bonds, rows.formation_overlap...);
  visit(HistoryField{"bond_shear", force, none}, f.separate_bond, rows.bond_shear...);
  visit(HistoryField{"bond_moment", moment, none, true}, f.separate_bond, rows.bond_moment...);
  visit(HistoryField{"reference_branch", branch}, references && (f.shear || f.bonds), rows.reference_branch...);
}

/// Visits what is needed.
template <class Visit>
struct WhereNeeded {
  Visit& visit;
  CLATHRA_OF_THE_CALLERS_SIDE
  template <class... Fields>
  KOKKOS_INLINE_FUNCTION void operator()(HistoryField const& about, bool needed, Fields&... fields) const {
    if (needed) visit(about, fields...);
  }
};

/// Those that the features need, visit(HistoryField, field...). No other exists.
CLATHRA_OF_THE_CALLERS_SIDE
template <class Visit, class... Rows>
KOKKOS_INLINE_FUNCTION void for_each_history(ContactFeatures const& features, Visit&& visit, Rows&... rows) {
  for_each_possible_history(features, WhereNeeded<std::remove_reference_t<Visit>>{visit}, rows...);
}
CLATHRA_OF_THE_CALLERS_SIDE
template <class Rows, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_history(Rows& rows, Visit&& visit) {
  for_each_history(rows.features, visit, rows);
}

/// Allocates empty rows of `entries` row entries with the history that the features ask for.
void allocate_history(ContactRows& rows, std::size_t entries);

/// Adds or drops history fields on existing rows (bonds are installed on a consolidated specimen, say).
void change_features(ContactRows& rows, ContactFeatures features);

/// Bytes held by the rows.
std::size_t bytes(ContactRows const& rows);

}  // namespace clathra
