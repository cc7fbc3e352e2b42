#pragma once
/// Discs with their companions and rows made into records, and records made into discs.
#include <variant>
#include <vector>

#include "domain/parallel/disc_record.hpp"
#include "kernels/cell_grid.hpp"
#include "kernels/neighbours.hpp"

namespace clathra {

/// What goes with a disc beside its state: accounts, marks. [owned]
struct Companion {
  char const* name;
  std::variant<Field<float>*, Field<double>*> field;
};
using Companions = std::vector<Companion>;
inline Companions with(Companions some, Companions const& more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}
/// Calls visit(field) for each of them, as what it is.
template <class Visit>
void for_each_companion(Companions const& companions, Visit&& visit) {
  for (Companion const& companion : companions) std::visit([&](auto* field) { visit(*field); }, companion.field);
}

/// Records of the discs `which`, in this order.
/// @param rows  neighbours by id, slots = indices
DiscRecords pack_discs(ParticleSoA const& particles, Companions const& companions, ContactRows const& rows,
                       std::vector<int> const& which);

/// Those of discs with these companions and rows.
RecordColumns record_columns(Companions const& companions, ContactFeatures const& features);

/// Appends discs behind the owned ones and returns their rows, neighbours by id.
/// @param numbers  records, one behind the other
/// @param features  what the rows keep
ContactRows unpack_discs(std::vector<double> const& numbers, ContactFeatures const& features, ParticleSoA& particles,
                         Companions const& companions);

}  // namespace clathra
