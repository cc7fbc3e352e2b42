#pragma once
/// The bonds that broke in a run: which, when and how; counts of them over the axial strain.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/results/events.hpp"
#include "io/results/run_results.hpp"
#include "kernels/break_mode.hpp"

namespace clathra {

struct BreakRow {
  BreakEvent event;
  double eps1;
  BreakDetails details;
};

/// Rows in the order of the file.
struct BreakTable {
  bool detailed = false;
  std::vector<BreakRow> rows;
};

/// Which of them.
struct BreakChoice {
  std::string mode;            ///< "shear"; empty for all
  double first = 0, last = 1;  ///< axial strain, both included
};

/// @throws FileProblem file_missing where the run has no events.csv
BreakTable chosen_breaks(std::filesystem::path const& folder, HistoryTable const& history, BreakChoice const& choice);

/// One line a bond, with its axial strain.
std::string csv_text(BreakTable const& table);

/// Bonds that broke in a part of a range of axial strain.
struct BreakPart {
  double begin, end;
  BreakCounts counts;
};

/// The range from `first` to `last` in equal parts; the last one takes all that broke later.
std::vector<BreakPart> parts_of(std::vector<BreakRow> const& rows, double first, double last, int parts);

std::string count_text(std::vector<BreakPart> const& parts);
nlohmann::ordered_json count_json(std::vector<BreakPart> const& parts);

}  // namespace clathra
