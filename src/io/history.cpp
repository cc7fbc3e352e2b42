#include "io/history.hpp"

#include <fmt/format.h>

#include <iterator>

namespace clathra {
namespace {

/// Appends values or names to a line, with commas between them.
struct Cells {
  std::string line;
  template <class Value>
  void operator()(char const*, Value const& value) {
    if (!line.empty()) line += ',';
    fmt::format_to(std::back_inserter(line), "{}", value);
  }
};
struct Names {
  std::string line;
  template <class Value>
  void operator()(char const* name, Value const&) {
    if (!line.empty()) line += ',';
    line += name;
  }
};

}  // namespace

HistoryFile::HistoryFile(std::filesystem::path path, bool energy) : file_(std::move(path)) {
  Names names;
  HistoryRow row;
  EnergyRow ledger;
  for_each_column(row, names);
  if (energy) for_each_energy_column(ledger, names);
  file_.write(names.line + '\n');
}

void HistoryFile::write(HistoryRow const& row) {
  Cells cells;
  for_each_column(row, cells);
  file_.write(cells.line + '\n');
}

void HistoryFile::write(HistoryRow const& row, EnergyRow const& energy) {
  Cells cells;
  for_each_column(row, cells);
  for_each_energy_column(energy, cells);
  file_.write(cells.line + '\n');
}

}  // namespace clathra
