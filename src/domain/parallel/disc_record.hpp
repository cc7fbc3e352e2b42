#pragma once
/// Discs by value, each with its auxiliary fields and its row, as a string of numbers: how they travel to other ranks and to
/// checkpoints.
///
/// One form for both, so that a field that travels is also a field that is saved: what a migration forgot a restart would forget
/// too, and the test of ranks finds it. A row goes with its disc because history belongs to it, not to a place in memory.
#include <string>
#include <vector>

namespace clathra {

/// Discs in a row of numbers. One record: the disc's fields from the id on, its auxiliary fields, the length of its row, and for
/// each entry the neighbour's id and the history.
struct DiscRecords {
  std::vector<std::size_t> begin{0};  ///< [discs + 1] where each record begins
  std::vector<double> numbers;
  std::size_t size() const { return begin.size() - 1; }
};

/// Which numbers a record holds.
struct RecordColumns {
  std::vector<std::string> discs;    ///< between the id and the length of the row
  std::vector<std::string> history;  ///< behind each neighbour's id
  bool operator==(RecordColumns const&) const = default;
};

}  // namespace clathra
