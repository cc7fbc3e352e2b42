#pragma once
/// What the user sees of a run: progress, warnings, and the numbers of its curves at the end.
#include <map>
#include <string>

#include "domain/biaxial/biaxial_test.hpp"
#include "io/results/run_record.hpp"
#include "run/curve_summary.hpp"
#include "run/stage_progress.hpp"
#include "terminal/progress_line.hpp"

namespace clathra {

class RunReporter {
 public:
  ProgressLine& line() { return line_; }
  void warn(std::string const& text) { line_.warn(text); }
  /// What the test has to say since it was asked last.
  void say_new_warnings(BiaxialTest const& test);

  void add(HistoryRow const& row);  ///< of any stage; there are no summaries of consolidations
  void add(EnergyRow const& row) { summaries_[last_.stage].add(row); }  ///< after its record
  HistoryRow const& last() const { return last_; }
  int records() const;  ///< of the loading
  /// Of a stage; without records where there are none.
  CurveSummary const& summary_of(std::string const& stage) { return summaries_[stage]; }

  /// How far the consolidation is. @param clock  since it has done so many disc-steps
  void show(Progress const& progress, Speedometer const& clock, std::int64_t disc_steps_before);
  /// How far the loading is. @param speed  in words
  void show(BiaxialTest const& test, std::string const& speed);
  /// Warnings again, and lines on the start and on each stage: peak, residual state and bonds of a shear.
  void say_end(RunRecord const& record, double confining_stress, std::filesystem::path const& folder);

 private:
  ProgressLine line_;
  std::map<std::string, CurveSummary> summaries_;  // of the stages
  HistoryRow last_;
  std::size_t said_ = 0;  // warnings of the test
};

}  // namespace clathra
