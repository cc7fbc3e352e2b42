#include "io/results/history.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <stdexcept>

#include "domain/scene/csv_rows.hpp"
#include "domain/scene/units.hpp"
#include "io/errors/problems.hpp"

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

/// Takes the cells of a row, one after the other.
struct Parse {
  std::vector<std::string_view> const& cells;
  std::size_t at = 0;
  void operator()(char const*, double& value) { value = parse_number(next()); }
  void operator()(char const*, std::int64_t& value) { value = std::llround(parse_number(next())); }
  std::string_view next() { return at < cells.size() ? cells[at++] : std::string_view(); }
};

}  // namespace

std::vector<HistoryEntry> read_history(std::filesystem::path const& path, std::uintmax_t bytes) {
  std::string const text = read_text_file(path, bytes);
  std::vector<HistoryEntry> entries;
  for (CsvRows rows(text); rows.next();) {
    if (rows.line() == 1) continue;  // the header
    Parse parse{rows.cells()};
    try {
      HistoryEntry& entry = entries.emplace_back();
      for_each_column(entry.row, parse);
      if (parse.at < rows.cells().size()) for_each_energy_column(entry.energy.emplace(), parse);
    } catch (std::invalid_argument const& problem) {
      throw FileProblem(ExitCode::bad_input, path, fmt::format("line {}: {}", rows.line(), problem.what()));
    }
  }
  return entries;
}

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
