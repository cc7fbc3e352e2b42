#pragma once
/// Neighbour rows and the history of contacts and bonds, as a structure of arrays.
///
/// Rows are full: both discs of a pair list it, keep its history and compute its force. That is twice the arithmetic of half
/// rows, and the faster way still: no force is written for another disc, so nothing needs an atomic, a second pass or a
/// colouring, each thread or GPU lane sums one disc in a fixed order, and ranks owe each other no forces. Bits then cannot depend
/// on who computes what. Half rows were measured at 0.92 of the speed unbonded and 1.05 to 1.17 bonded (docs/performance.md).
#include "kernels/bond_law.hpp"
#include "kernels/particles.hpp"

namespace clathra {

/// What a scene needs stored for each row entry.
struct ContactFeatures {
  bool shear = true;           ///< F_s of grain contacts with friction, or of bonds in their place (`replace`)
  bool rolling = true;         ///< contact moments
  bool bonds = false;          ///< bond formation_overlap
  bool separate_bond = false;  ///< `parallel`: the bond has a history of its own beside the grain contact
  bool operator==(ContactFeatures const&) const = default;
};

/// The place of entry k of a disc's row among all entries.
template <class SliceStart>
KOKKOS_INLINE_FUNCTION std::size_t entry_in(SliceStart const& slice_start, int disc, int k) {
  return static_cast<std::size_t>(slice_start(disc / slice_width) + k) * slice_width +
         static_cast<std::size_t>(disc % slice_width);
}

/// Full rows (each pair stands in both rows) in sliced ELLPACK: `slice_width` discs form a slice, entry k of its discs lies side
/// by side. Rows are sorted: entries in touch or bonded first, each part by neighbour id, so that sums do not depend on where
/// discs are stored. Both sides of a pair hold equal `shear` and `formation_overlap` and exactly opposite `moment`.
struct ContactRows {
  ContactFeatures features;
  Field<int> slice_start;         ///< [slices + 1] in units of slice_width entries
  Field<int> length;              ///< [owned] entries in use
  Field<int> neighbour;           ///< [entries] index of the other disc, or the padding disc
  Field<Real> shear;              ///< [entries] F_s [N/m]; as the following, empty where no feature needs it
  Field<Real> moment;             ///< [entries] M on the row's own disc [N m/m]
  Field<Real> formation_overlap;  ///< [entries] u_0 of the bond [m], no_bond without one
  Field<Real> bond_shear;         ///< [entries] F_s of a separate bond [N/m]
  Field<Real> bond_moment;        ///< [entries] M of a separate bond [N m/m]
  // Derived, not part of the state: set by prepare_rows().
  Field<Real> width;            ///< [entries] B of the bond [m], 0 without one
  Field<std::uint64_t> active;  ///< [groups of lanes] bit k: entries k of the group may carry a history and must be evaluated

  KOKKOS_INLINE_FUNCTION std::size_t entry(int disc, int k) const { return entry_in(slice_start, disc, k); }
};

/// What there is to know of a field of the history beside its values.
struct HistoryField {
  char const* name;
  Real empty = 0;    ///< value of an entry without history
  bool odd = false;  ///< the two sides of a pair hold opposite values, else equal ones
};

/// The history of an entry, field by field, here and in kernels: visit(HistoryField, whether the features need it, the field of
/// each of the rows, which have the same features). It drives allocation, the way through a neighbour search, the hash of the
/// state, files, other ranks and byte counts.
template <class Visit, class... Rows>
KOKKOS_INLINE_FUNCTION void for_each_possible_history(ContactFeatures const& f, Visit&& visit, Rows&... rows) {
  visit(HistoryField{"shear"}, f.shear, rows.shear...);
  visit(HistoryField{"moment", 0, true}, f.rolling || f.bonds, rows.moment...);
  visit(HistoryField{"formation_overlap", no_bond}, f.bonds, rows.formation_overlap...);
  visit(HistoryField{"bond_shear"}, f.separate_bond, rows.bond_shear...);
  visit(HistoryField{"bond_moment", 0, true}, f.separate_bond, rows.bond_moment...);
}

/// Those that the features need, visit(HistoryField, field...). No other exists.
template <class Visit, class... Rows>
KOKKOS_INLINE_FUNCTION void for_each_history(ContactFeatures const& features, Visit&& visit, Rows&... rows) {
  for_each_possible_history(
      features,
      [&](HistoryField const& about, bool needed, auto&... fields) {
        if (needed) visit(about, fields...);
      },
      rows...);
}
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
