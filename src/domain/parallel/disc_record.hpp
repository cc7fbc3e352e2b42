#pragma once
/// Discs by value, each with its auxiliary fields and its row, as a string of numbers: how they travel to other ranks and to
/// checkpoints.
///
/// One form for both, so that a field that travels is also a field that is saved: what a migration forgot a restart would forget
/// too, and the test of ranks finds it. A row goes with its disc because history belongs to it, not to a place in memory.
#include <cstdint>
#include <functional>
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

/// The same discs by column, as files hold them. Those of a simulation are made one at a time, when they are asked for: a sample
/// that fills the memory does not fit into it twice. They are those of the simulation until it goes on.
struct DiscColumns {
  struct Column {
    std::string name;
    std::function<std::vector<double>()> numbers;
  };
  using Integers = std::function<std::vector<std::int32_t>()>;
  Integers id, row_length;      ///< [discs]
  Integers neighbour;           ///< [entries of all rows] its id
  std::vector<Column> discs;    ///< [discs]
  std::vector<Column> history;  ///< [entries of all rows]

  RecordColumns names() const;
};

/// The records of columns, which lose theirs one after the other.
DiscRecords records_of(DiscColumns columns);

}  // namespace clathra
