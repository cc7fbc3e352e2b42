#pragma once
/// What the user sees of a run: progress, warnings, and the numbers of its curves at the end.
#include <optional>
#include <string>

#include "domain/biaxial/biaxial_test.hpp"
#include "io/results/run_record.hpp"
#include "run/curve_summary.hpp"
#include "terminal/progress_line.hpp"

namespace clathra {

class RunReporter {
 public:
  ProgressLine& line() { return line_; }
  void warn(std::string const& text) { line_.warn(text); }

  void add(HistoryRow const& row);
  void add(EnergyRow const& row) { summary_.add(row); }
  HistoryRow const& last() const { return last_; }
  CurveSummary const& summary() const { return summary_; }

  /// How far the shear is. @param speed  in words
  void show(BiaxialTest const& test, double axial_strain, std::string const& speed);
  /// Warnings again, and the lines on start, peak, residual state and bonds.
  void say_end(RunRecord const& record, double confining_stress, std::filesystem::path const& folder);

 private:
  ProgressLine line_;
  CurveSummary summary_;
  HistoryRow last_;
};

}  // namespace clathra
