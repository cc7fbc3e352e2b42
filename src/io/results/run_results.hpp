#pragma once
/// What a run left in its folder, as the report needs it.
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "domain/measurement/test_numbers.hpp"
#include "io/errors/problems.hpp"

namespace clathra {

/// The columns of a history.csv that the program knows; others are passed over. Numbers may be inf or nan where the run diverged.
/// Its rows are those of the loading: all but the consolidation.
class HistoryTable {
 public:
  /// A last line without its end is a row that is being written, and is left out.
  /// @throws FileProblem file_missing, or bad_input with the line: a row with too few or too many cells, a cell that is no
  /// number; step, eps1, or q_Pa together with what it could be made of (sigma1_Pa, sigma3_Pa) missing
  explicit HistoryTable(std::filesystem::path const& path);

  std::size_t rows() const { return rows_; }
  bool has(std::string const& column) const { return columns_.count(column) > 0; }
  bool has_all(std::vector<std::string> const& columns) const;
  /// A column; nan in each row where there is none of this name.
  std::vector<double> const& operator[](std::string const& column) const;
  /// The stage of each row.
  std::vector<std::string> const& stages() const { return stages_; }
  /// A column of the consolidation; empty where the history has none.
  std::vector<double> before(std::string const& column) const;
  TestCurves curves() const {
    return {(*this)["eps1"],
            (*this)["eps_v"],
            (*this)["q_Pa"],
            (*this)["sigma3_Pa"],
            (*this)["bonds_intact_pct"],
            (*this)["largest_q_Pa"],
            (*this)["largest_q_eps1"],
            (*this)["dilation_deg"]};
  }
  /// The columns that this one has not and of which something would be drawn; those of the energy ledger only if it has some.
  std::vector<std::string> missing() const;

 private:
  std::map<std::string, std::vector<double>> columns_, before_;  // of the loading, of the consolidation
  std::vector<std::string> stages_;
  std::vector<double> unknown_;
  std::size_t rows_ = 0;
};

/// The columns of histories that pages show as curves over the axial strain.
inline constexpr char const* curve_columns[] = {
    "q_Pa",         "eps_v",          "bonds_intact_pct",   "mechanical_coordination", "broken_tension", "broken_compression",
    "broken_shear", "broken_rolling", "bonded_contacts_pct"};

/// A folder that `clathra run` wrote.
struct RunResults {
  std::string name;  ///< of the folder
  std::filesystem::path folder;
  HistoryTable history;
  nlohmann::json record;                         ///< run.json
  std::vector<std::filesystem::path> snapshots;  ///< in the order of their steps

  /// @param at  a JSON pointer into run.json: "/scene/hydrate/saturation". Nothing where there is no such number or text.
  std::optional<double> number(std::string const& at) const;
  std::optional<std::string> text(std::string const& at) const;
  bool has_bonds() const;         ///< were any intact at the start?
  std::string test_kind() const;  ///< that of its scene: "biaxial"
  /// Whether its loading is one shear that closes: then it has a peak, and curves over the axial strain.
  bool has_peak() const;
  std::string bond_variant() const;  ///< law, coupling, rolling lever, ... with their keys, a line each
};

/// @throws FileProblem file_missing without the folder, its run.json or history.csv; bad_input where one of these is damaged or
/// the history has fewer than two rows
RunResults read_run(std::filesystem::path const& folder);

/// @throws FileProblem file_missing where there is no such folder, or it is that of a study, which is said
void require_run_folder(std::filesystem::path const& folder);

/// Reads several; those in folders of the same name are named by their whole path.
std::vector<RunResults> read_runs(std::vector<std::filesystem::path> const& folders);

}  // namespace clathra
