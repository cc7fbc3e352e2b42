#include "io/results/run_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "domain/measurement/history_row.hpp"
#include "domain/scene/csv_rows.hpp"
#include "domain/scene/units.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/snapshot_file.hpp"

namespace clathra {
namespace {

constexpr std::size_t largest_result = std::size_t{1} << 30;
constexpr char stage_column[] = "stage";

double number_in(std::string_view cell, std::string const& column, std::size_t line, std::filesystem::path const& path) {
  try {
    return parse_written_number(cell);
  } catch (std::invalid_argument const&) {
    throw FileProblem(ExitCode::bad_input, path, fmt::format("line {}: '{}' in column {} is no number", line, cell, column));
  }
}

/// Names of the columns of a history that are of use here.
struct ColumnNames {
  std::vector<std::string> names;
  template <class Value>
  void operator()(char const* name, Value const&) {
    names.push_back(name);
  }
};

std::vector<std::string> columns_of_records() {
  ColumnNames columns;
  HistoryRow const row;
  for_each_column(row, columns);
  for_each_hydrate_column(row, columns);
  return columns.names;
}

std::vector<std::string> columns_of_the_ledger() {
  ColumnNames columns;
  EnergyRow const row;
  for_each_energy_column(row, columns);
  return columns.names;
}

/// Whether each column of the header is one of those names. @throws FileProblem where two have the same one of them
std::vector<bool> known_columns(std::vector<std::string> const& header, std::filesystem::path const& path) {
  std::vector<std::string> names = columns_of_records(), ledger = columns_of_the_ledger();
  names.insert(names.end(), ledger.begin(), ledger.end());
  std::vector<bool> known;
  for (std::string const& name : header) {
    known.push_back(std::count(names.begin(), names.end(), name) > 0);
    if (known.back() && std::count(header.begin(), header.end(), name) > 1)
      throw FileProblem(ExitCode::bad_input, path, fmt::format("line 1: two columns have the name '{}'", name));
  }
  return known;
}

/// @throws FileProblem where a column is missing without which there is nothing to draw
void require_essentials(std::vector<std::string> const& header, std::filesystem::path const& path) {
  auto const has = [&](char const* name) { return std::count(header.begin(), header.end(), name) > 0; };
  for (char const* const name : {"step", "eps1"})
    if (!has(name)) throw FileProblem(ExitCode::bad_input, path, fmt::format("line 1: there is no column {}", name));
  if (!has("q_Pa") && !(has("sigma1_Pa") && has("sigma3_Pa")))
    throw FileProblem(ExitCode::bad_input, path, "line 1: there is no column q_Pa, nor sigma1_Pa and sigma3_Pa to make it of");
}

std::filesystem::path without_slash(std::filesystem::path const& folder) {
  std::filesystem::path const plain = folder.lexically_normal();
  return plain.has_filename() ? plain : plain.parent_path();
}

std::string folder_name(std::filesystem::path const& folder) {
  std::error_code error;
  std::filesystem::path const name = without_slash(folder).filename();
  if (name != "." && name != "..") return name.string();
  return std::filesystem::canonical(folder, error).filename().string();
}

nlohmann::json read_record(std::filesystem::path const& path) {
  nlohmann::json record = nlohmann::json::parse(read_text_file(path, largest_result), nullptr, false);
  if (!record.is_object()) throw FileProblem(ExitCode::bad_input, path, "is not a record of a run");
  return record;
}

nlohmann::json const* find(nlohmann::json const& record, std::string const& at) {
  nlohmann::json::json_pointer const pointer(at);
  return record.contains(pointer) ? &record.at(pointer) : nullptr;
}

}  // namespace

HistoryTable::HistoryTable(std::filesystem::path const& path) {
  std::string const text = read_text_file(path, largest_result);
  std::vector<std::string> names;
  std::vector<bool> known;
  auto stage = names.end();
  for (CsvRows rows(text); rows.next();) {
    std::vector<std::string_view> const& cells = rows.cells();
    if (rows.line() == 1) {
      for (std::string_view const cell : cells) names.emplace_back(cell);
      known = known_columns(names, path);
      require_essentials(names, path);
      stage = std::find(names.begin(), names.end(), stage_column);
      continue;
    }
    if (cells.size() != names.size())
      throw FileProblem(ExitCode::bad_input, path,
                        fmt::format("line {}: {} cells, the header has {}", rows.line(), cells.size(), names.size()));
    std::string const of =
        stage == names.end() ? shear_stage : std::string(cells[static_cast<std::size_t>(stage - names.begin())]);
    bool const loading = !is_consolidation(of);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (known[i] && names[i] != stage_column)
        (loading ? columns_ : before_)[names[i]].push_back(number_in(cells[i], names[i], rows.line(), path));
    if (loading) stages_.push_back(of);
    rows_ += loading ? 1 : 0;
  }
  if (rows_ < 2) throw FileProblem(ExitCode::bad_input, path, "has fewer than two rows of the loading, there is nothing to draw");
  if (!has("q_Pa")) {
    std::vector<double>& q = columns_["q_Pa"] = columns_["sigma1_Pa"];
    for (std::size_t i = 0; i < rows_; ++i) q[i] -= columns_["sigma3_Pa"][i];
  }
  unknown_.assign(rows_, std::numeric_limits<double>::quiet_NaN());
}

std::vector<double> HistoryTable::before(std::string const& column) const {
  auto const found = before_.find(column);
  return found == before_.end() ? std::vector<double>() : found->second;
}

std::vector<double> const& HistoryTable::operator[](std::string const& column) const {
  auto const found = columns_.find(column);
  return found == columns_.end() ? unknown_ : found->second;
}

bool HistoryTable::has_all(std::vector<std::string> const& columns) const {
  return std::all_of(columns.begin(), columns.end(), [this](std::string const& column) { return has(column); });
}

std::vector<std::string> HistoryTable::missing() const {
  std::vector<std::string> names{"eps_v", "sigma3_Pa", "void_ratio", "bonds_intact", "bonds_intact_pct"};
  for (BreakModeNames const& m : break_modes) names.emplace_back(m.broken);
  std::vector<std::string> const ledger = columns_of_the_ledger();
  if (std::any_of(ledger.begin(), ledger.end(), [this](std::string const& name) { return has(name); }))
    names.insert(names.end(), ledger.begin(), ledger.end());
  std::erase_if(names, [this](std::string const& name) { return has(name); });
  return names;
}

std::optional<double> RunResults::number(std::string const& at) const {
  nlohmann::json const* const value = find(record, at);
  return value && value->is_number() ? std::optional(value->get<double>()) : std::nullopt;
}

std::optional<std::string> RunResults::text(std::string const& at) const {
  nlohmann::json const* const value = find(record, at);
  return value && value->is_string() ? std::optional(value->get<std::string>()) : std::nullopt;
}

std::string RunResults::test_kind() const { return text("/scene/test/kind").value_or("biaxial"); }

bool RunResults::has_peak() const {
  std::vector<std::string> const& stages = history.stages();
  bool const one =
      std::all_of(stages.begin(), stages.end(), [](std::string const& one_stage) { return one_stage == shear_stage; });
  return one && history["eps1"].back() > history["eps1"].front();
}

bool RunResults::has_bonds() const {
  for (char const* const column : {"bonds_intact", "bonds_intact_pct"})
    if (history.has(column)) return *std::max_element(history[column].begin(), history[column].end()) > 0;
  return number("/stages/prepare/bonds").value_or(number("/scene/hydrate/saturation").value_or(0)) > 0;
}

std::string RunResults::bond_variant() const {
  std::string variant;
  for (char const* const key : {"law", "contact_coupling", "rolling_lever", "thickness_mapping", "strength_from"})
    variant += fmt::format("{}{} {}", variant.empty() ? "" : "\n", key, text(std::string("/scene/bond/") + key).value_or("?"));
  return variant;
}

void require_run_folder(std::filesystem::path const& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw FileProblem(ExitCode::file_missing, folder, "is not the folder of a run");
  if (!std::filesystem::exists(folder / "run.json", error) && std::filesystem::exists(folder / "study.csv", error))
    throw FileProblem(ExitCode::file_missing, folder,
                      "is the folder of a study: name a run among its members, " + (folder / "members" / "...").string());
}

RunResults read_run(std::filesystem::path const& folder) {
  require_run_folder(folder);
  return {folder_name(folder), folder, HistoryTable(folder / "history.csv"), read_record(folder / "run.json"),
          snapshot_files(folder)};
}

std::vector<RunResults> read_runs(std::vector<std::filesystem::path> const& folders) {
  std::vector<RunResults> runs;
  for (std::filesystem::path const& folder : folders) runs.push_back(read_run(folder));
  std::map<std::string, int> uses;
  for (RunResults const& run : runs) ++uses[run.name];
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (uses[runs[i].name] > 1) runs[i].name = without_slash(folders[i]).string();
  return runs;
}

}  // namespace clathra
