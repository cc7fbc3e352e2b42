#include "io/results/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "domain/scene/csv_rows.hpp"
#include "domain/scene/units.hpp"
#include "io/errors/problems.hpp"

namespace clathra {
namespace {

struct HistoryNames {
  std::vector<std::string> columns;
  template <class Value>
  void operator()(char const* name, Value const&) {
    columns.emplace_back(name);
  }
};

/// Writes values into the cells of the columns that have their names.
struct Cells {
  std::vector<std::string> const& columns;
  std::vector<std::string> cells = std::vector<std::string>(columns.size());
  template <class Value>
  void operator()(char const* name, Value const& value) {
    auto const column = std::find(columns.begin(), columns.end(), name);
    if (column != columns.end()) cells[static_cast<std::size_t>(column - columns.begin())] = fmt::format("{}", value);
  }
  std::string line() const { return fmt::format("{}\n", fmt::join(cells, ",")); }
};

/// Takes values from the cells of the columns that have their names. Those that a file has not stay as they are.
struct Parse {
  std::vector<std::string> const& columns;
  std::vector<std::string_view> const& cells;
  void operator()(char const* name, double& value) {
    if (auto const at = place(name); at < cells.size()) value = parse_written_number(cells[at]);
  }
  void operator()(char const* name, std::int64_t& value) {
    if (auto const at = place(name); at < cells.size()) value = std::llround(parse_number(cells[at]));
  }
  void operator()(char const* name, std::string& value) {
    if (auto const at = place(name); at < cells.size()) value = cells[at];
  }
  std::size_t place(char const* name) const {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
  }
};

/// @throws FileProblem where a column of the record is missing
void require_columns(std::vector<std::string> const& columns, std::filesystem::path const& path) {
  HistoryNames wanted;
  HistoryRow const row;
  for_each_column(row, wanted);
  for (std::string const& name : wanted.columns)
    if (std::count(columns.begin(), columns.end(), name) == 0)
      throw FileProblem(ExitCode::bad_input, path, fmt::format("line 1: there is no column {}", name));
}

}  // namespace

std::vector<HistoryEntry> read_history(std::filesystem::path const& path, std::uintmax_t bytes) {
  std::string const text = read_text_file(path, bytes);
  std::vector<HistoryEntry> entries;
  std::vector<std::string> columns;
  bool ledger = false;
  for (CsvRows rows(text); rows.next();) {
    if (rows.line() == 1) {
      columns.assign(rows.cells().begin(), rows.cells().end());
      require_columns(columns, path);
      ledger = std::count(columns.begin(), columns.end(), "boundary_work_J_per_m") > 0;
      continue;
    }
    if (rows.cells().size() != columns.size())
      throw FileProblem(ExitCode::bad_input, path,
                        fmt::format("line {}: {} cells, the header has {}", rows.line(), rows.cells().size(), columns.size()));
    Parse parse{columns, rows.cells()};
    try {
      HistoryEntry& entry = entries.emplace_back();
      for_each_column(entry.row, parse);
      for_each_hydrate_column(entry.row, parse);
      if (ledger) for_each_energy_column(entry.energy.emplace(), parse);
    } catch (std::invalid_argument const& problem) {
      throw FileProblem(ExitCode::bad_input, path, fmt::format("line {}: {}", rows.line(), problem.what()));
    }
  }
  return entries;
}

HistoryFile::HistoryFile(std::filesystem::path path, bool energy, bool hydrate) : file_(std::move(path)) {
  HistoryNames names;
  HistoryRow const row;
  EnergyRow const ledger;
  for_each_column(row, names);
  if (hydrate) for_each_hydrate_column(row, names);
  if (energy) for_each_energy_column(ledger, names);
  columns_ = names.columns;
  file_.write(fmt::format("{}\n", fmt::join(columns_, ",")));
}

HistoryFile::HistoryFile(std::filesystem::path path, std::uintmax_t bytes) : file_(path, bytes) {
  std::string const text = read_text_file(path, bytes);
  CsvRows header(text);
  if (!header.next()) throw FileProblem(ExitCode::bad_input, path, "line 1: there are no names of columns");
  columns_.assign(header.cells().begin(), header.cells().end());
}

void HistoryFile::write(HistoryRow const& row) {
  Cells cells{columns_};
  for_each_column(row, cells);
  for_each_hydrate_column(row, cells);
  file_.write(cells.line());
}

void HistoryFile::write(HistoryRow const& row, EnergyRow const& energy) {
  Cells cells{columns_};
  for_each_column(row, cells);
  for_each_hydrate_column(row, cells);
  for_each_energy_column(energy, cells);
  file_.write(cells.line());
}

}  // namespace clathra
