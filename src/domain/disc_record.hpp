#pragma once
/// Discs by value, each with its companions and its row, as a string of numbers: how they travel to other ranks and to
/// checkpoints.
#include <string>
#include <vector>

#include "kernels/cell_grid.hpp"
#include "kernels/neighbours.hpp"

namespace clathra {

/// What goes with a disc beside its state: accounts, marks. [owned]
struct Companion {
  char const* name;
  Field<Accum>* field;
};
using Companions = std::vector<Companion>;
inline Companions with(Companions some, Companions const& more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}

/// The fields of a disc as columns of numbers: those of ParticleSoA but the id, and the companions.
struct DiscColumns {
  static constexpr int most = 26;  // 9 of the state, 5 accounts, 2 of the start, 4 of rough walls, 6 derived ones
  int count = 0;
  Field<Real> column[most];
  char const* name[most];
  DiscColumns(ParticleSoA const& particles, Companions const& companions);
};

/// The history of a row as columns.
struct RowColumns {
  static constexpr int most = 5;
  int count = 0;
  Field<Real> column[most];
  explicit RowColumns(ContactRows const& rows);
};

/// Discs in a row of numbers. One record: id, the disc's columns, the length of its row, and for each entry the neighbour's id
/// and the history columns.
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

/// Records of which only the columns `wanted` are left, in their order. @throws std::runtime_error where one is missing
DiscRecords with_columns(DiscRecords records, RecordColumns const& present, RecordColumns const& wanted);

/// Appends discs behind the owned ones and returns their rows, neighbours by id.
/// @param numbers  records, one behind the other
/// @param features  what the rows keep
ContactRows unpack_discs(std::vector<double> const& numbers, ContactFeatures const& features, ParticleSoA& particles,
                         Companions const& companions);

}  // namespace clathra
