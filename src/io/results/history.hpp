#pragma once
/// history.csv: one row a record, units in the column names, numbers that read back to the same bits.
#include <optional>
#include <string>
#include <vector>

#include "domain/measurement/history_row.hpp"
#include "io/formats/text_file.hpp"

namespace clathra {

class HistoryFile {
 public:
  /// Writes the header. @param energy,hydrate  the columns of the energy ledger, and before them those of hydrate that changes,
  /// follow those of the record
  /// @throws FileProblem cannot_create or io_error
  HistoryFile(std::filesystem::path path, bool energy, bool hydrate = false);
  /// Goes on with the file behind its first `bytes`, with the columns that it has. @throws FileProblem
  HistoryFile(std::filesystem::path path, std::uintmax_t bytes);

  /// One row, one write. @throws FileProblem io_error
  void write(HistoryRow const& row);
  void write(HistoryRow const& row, EnergyRow const& energy);
  void close() { file_.close(); }
  RowsWritten flushed() const { return file_.flushed(); }

 private:
  RowFile file_;
  std::vector<std::string> columns_;
};

/// A row and, with the ledger, its energies.
struct HistoryEntry {
  HistoryRow row;
  std::optional<EnergyRow> energy;
};
/// The rows of a history.csv, up to its first `bytes`. @throws FileProblem file_missing, or bad_input with the line
std::vector<HistoryEntry> read_history(std::filesystem::path const& path, std::uintmax_t bytes);

}  // namespace clathra
