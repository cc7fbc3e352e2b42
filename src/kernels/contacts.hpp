#pragma once
/// Neighbour rows and the history of contacts and bonds, as a structure of arrays.
#include "kernels/particles.hpp"

namespace clathra {

/// What a scene needs stored for each row entry.
struct ContactFeatures {
  bool shear = true;           ///< F_s of grain contacts with friction, or of bonds in their place (`replace`)
  bool rolling = true;         ///< contact moments
  bool bonds = false;          ///< bond equilibrium
  bool separate_bond = false;  ///< `parallel`: the bond has a history of its own beside the grain contact
  bool operator==(ContactFeatures const&) const = default;
};

/// Full rows (each pair stands in both rows) in sliced ELLPACK: `lane_count` discs form a slice, entry k of its discs lies side
/// by side. Rows are sorted: entries in touch or bonded first, each part by neighbour id, so that sums do not depend on where
/// discs are stored. Both sides of a pair hold equal `shear` and `equilibrium` and exactly opposite `moment`.
struct ContactRows {
  ContactFeatures features;
  Field<int> slice_start;   ///< [slices + 1] in units of lane_count entries
  Field<int> length;        ///< [owned] entries in use
  Field<int> neighbour;     ///< [entries] index of the other disc, or the padding disc
  Field<Real> shear;        ///< [entries] F_s [N/m]; as the following, empty where no feature needs it
  Field<Real> moment;       ///< [entries] M on the row's own disc [N m/m]
  Field<Real> equilibrium;  ///< [entries] u_0 of the bond [m], no_bond without one
  Field<Real> bond_shear;   ///< [entries] F_s of a separate bond [N/m]
  Field<Real> bond_moment;  ///< [entries] M of a separate bond [N m/m]
  // Derived, not part of the state: set by prepare_rows().
  Field<Real> width;            ///< [entries] B of the bond [m], 0 without one
  Field<std::uint64_t> active;  ///< [slices] bit k: entries k of the slice may carry a history, so they must be evaluated

  KOKKOS_INLINE_FUNCTION std::size_t entry(int disc, int k) const {
    return static_cast<std::size_t>(slice_start(disc / lane_count) + k) * lane_count +
           static_cast<std::size_t>(disc % lane_count);
  }
};

/// The history of an entry, field by field, with the value that an entry without history holds. Only fields that the features
/// need exist.
template <class Rows, class Visit>
void for_each_history(Rows& rows, Visit&& visit) {
  if (rows.features.shear) visit("shear", rows.shear, Real(0));
  if (rows.features.rolling || rows.features.bonds) visit("moment", rows.moment, Real(0));
  if (rows.features.bonds) visit("equilibrium", rows.equilibrium, Real(1e300));
  if (rows.features.separate_bond) {
    visit("bond_shear", rows.bond_shear, Real(0));
    visit("bond_moment", rows.bond_moment, Real(0));
  }
}

/// Allocates empty rows of `entries` row entries with the history that the features ask for.
void allocate_history(ContactRows& rows, std::size_t entries);

/// Adds or drops history fields on existing rows (bonds are installed on a consolidated specimen, say).
void change_features(ContactRows& rows, ContactFeatures features);

/// Bytes held by the rows.
std::size_t bytes(ContactRows const& rows);

}  // namespace clathra
