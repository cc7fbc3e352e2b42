#pragma once
/// history.csv: one row a record, units in the column names, numbers that read back to the same bits.
#include "domain/history_row.hpp"
#include "io/text_file.hpp"

namespace clathra {

class HistoryFile {
 public:
  /// Writes the header. @param energy  the columns of the energy ledger follow those of the record
  /// @throws FileProblem cannot_create or io_error
  HistoryFile(std::filesystem::path path, bool energy);

  /// One row, one write. @throws FileProblem io_error
  void write(HistoryRow const& row);
  void write(HistoryRow const& row, EnergyRow const& energy);
  void close() { file_.close(); }

 private:
  RowFile file_;
};

}  // namespace clathra
