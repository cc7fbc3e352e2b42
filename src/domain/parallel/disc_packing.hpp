#pragma once
/// Discs with their auxiliary fields and rows made into records, and records made into discs.
#include <variant>
#include <vector>

#include "domain/parallel/disc_record.hpp"
#include "kernels/cell_grid.hpp"
#include "kernels/neighbours.hpp"

namespace clathra {

/// What goes with a disc beside its state: accounts, marks. [owned]
struct AuxiliaryField {
  char const* name;
  std::variant<Field<float>*, Field<double>*, RealField*> field;
};
using AuxiliaryFields = std::vector<AuxiliaryField>;
inline AuxiliaryFields with(AuxiliaryFields some, AuxiliaryFields const& more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}
/// Calls visit(field) for each of them, as what it is.
template <class Visit>
void for_each_auxiliary_field(AuxiliaryFields const& auxiliary, Visit&& visit) {
  for (AuxiliaryField const& one : auxiliary) std::visit([&](auto* field) { visit(*field); }, one.field);
}

/// The first numbers of a field, whatever it holds.
inline std::vector<double> numbers_on_host(RealField const& field, std::size_t size) { return on_host(field, size); }
template <class T>
std::vector<double> numbers_on_host(Field<T> const& field, std::size_t size) {
  std::vector<T> const numbers = on_host(field, size);
  return {numbers.begin(), numbers.end()};
}

/// Records of the discs `which`, in this order.
/// @param rows  of all discs, by their index; neighbours by id
DiscRecords pack_discs(ParticleSoA const& particles, AuxiliaryFields const& auxiliary, ContactRows const& rows,
                       std::vector<int> const& which);

/// All owned discs by column; the columns share the fields.
DiscColumns disc_columns(ParticleSoA const& particles, AuxiliaryFields const& auxiliary, ContactRows const& rows);

/// Those of discs with these auxiliary fields and rows.
RecordColumns record_columns(AuxiliaryFields const& auxiliary, ContactFeatures const& features);

/// Appends discs behind the owned ones and returns their rows, neighbours by id.
/// @param numbers  records, one behind the other
/// @param features  what the rows keep
ContactRows unpack_discs(std::vector<double> const& numbers, ContactFeatures const& features, ParticleSoA& particles,
                         AuxiliaryFields const& auxiliary);

}  // namespace clathra
