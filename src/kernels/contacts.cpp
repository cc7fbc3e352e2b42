#include "kernels/contacts.hpp"

#include "kernels/bond_law.hpp"

namespace clathra {

void allocate_history(ContactRows& rows, std::size_t entries) {
  for_each_history(rows, [&](char const* name, Field<Real>& field, Real empty) {
    field = uninitialised<Real>(name, entries);
    Kokkos::deep_copy(field, empty);
  });
}

void change_features(ContactRows& rows, ContactFeatures features) {
  ContactRows changed = rows;
  changed.features = features;
  changed.shear = changed.moment = changed.equilibrium = changed.bond_shear = changed.bond_moment = Field<Real>();
  for_each_history(changed, [&](char const* name, Field<Real>& field, Real empty) {
    field = uninitialised<Real>(name, rows.neighbour.extent(0));
    Kokkos::deep_copy(field, empty);
  });
  // What both have is kept. The two lists are walked by name, since either may lack a field of the other.
  for_each_history(changed, [&](std::string const& name, Field<Real>& to, Real) {
    for_each_history(rows, [&](std::string const& old_name, Field<Real>& from, Real) {
      if (name == old_name) Kokkos::deep_copy(to, from);
    });
  });
  rows = changed;
}

std::size_t bytes(ContactRows const& rows) {
  std::size_t total = rows.active.span() * sizeof(std::uint64_t) +
                      (rows.slice_start.span() + rows.length.span() + rows.neighbour.span()) * sizeof(int);
  for (auto const* field : {&rows.shear, &rows.moment, &rows.equilibrium, &rows.width, &rows.bond_shear, &rows.bond_moment}) {
    total += field->span() * sizeof(Real);
  }
  return total;
}

}  // namespace clathra
