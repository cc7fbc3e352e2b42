#pragma once
/// Discs by value, each with its companions and its row, as a string of numbers: how they travel to other ranks and to
/// checkpoints.
#include <string>
#include <variant>
#include <vector>

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

/// Discs in a row of numbers. One record: the disc's fields from the id on, its companions, the length of its row, and for each
/// entry the neighbour's id and the history.
struct DiscRecords {
  std::vector<std::size_t> begin{0};  ///< [discs + 1] where each record begins
  std::vector<double> numbers;
  std::size_t size() const { return begin.size() - 1; }
};

/// Records of the discs `which`, in this order.
/// @param rows  neighbours by id, slots = indices
DiscRecords pack_discs(ParticleSoA const& particles, Companions const& companions, ContactRows const& rows,
                       std::vector<int> const& which);

/// Which numbers a record holds.
struct RecordColumns {
  std::vector<std::string> discs;    ///< between the id and the length of the row
  std::vector<std::string> history;  ///< behind each neighbour's id
  bool operator==(RecordColumns const&) const = default;
};
/// Those of discs with these companions and rows.
RecordColumns record_columns(Companions const& companions, ContactFeatures const& features);

/// Records of which only the columns `wanted` are left, in their order. @throws std::runtime_error where one is missing
DiscRecords with_columns(DiscRecords records, RecordColumns const& present, RecordColumns const& wanted);

/// Appends discs behind the owned ones and returns their rows, neighbours by id.
/// @param numbers  records, one behind the other
/// @param features  what the rows keep
ContactRows unpack_discs(std::vector<double> const& numbers, ContactFeatures const& features, ParticleSoA& particles,
                         Companions const& companions);

}  // namespace clathra
