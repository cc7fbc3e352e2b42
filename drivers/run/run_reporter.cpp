#include "run/run_reporter.hpp"

#include <fmt/format.h>

#include "terminal/print.hpp"

namespace clathra {
namespace {

/// A line on a stage that is not a shear. @param end  where it ended, and by what
std::string stage_text(StageEnding const& end, StageRecord const& numbers) {
  return fmt::format(
      "{:<9} sigma1 {:.4g} MPa, sigma3 {:.4g} MPa, largest q {:.4g} MPa over a path of {:.3g} % of eps1, ended by {}\n",
      end.stage, numbers.at("end_sigma1_Pa") * 1e-6, numbers.at("end_sigma3_Pa") * 1e-6, numbers.at("largest_q_Pa") * 1e-6,
      numbers.at("path") * 100, end.ended_by);
}

}  // namespace

void RunReporter::say_new_warnings(BiaxialTest const& test) {
  for (; said_ < test.warnings().size(); ++said_) warn(test.warnings()[said_]);
}

void RunReporter::add(HistoryRow const& row) {
  last_ = row;
  if (is_consolidation(row.stage)) return;
  summaries_[row.stage].add(row);
}

int RunReporter::records() const {
  int records = 0;
  for (auto const& summary : summaries_) records += summary.second.records();
  return records;
}

void RunReporter::show(Progress const& progress, Speedometer const& clock, std::int64_t disc_steps_before) {
  line_.show(progress.stage, progress.fraction,
             progress.detail + " | " + clock.text(progress.fraction, progress.disc_steps - disc_steps_before));
}

void RunReporter::show(BiaxialTest const& test, std::string const& speed) {
  double const to = test.stage().until.axial_strain;
  std::string text = fmt::format("eps1 {:.1f}{}% | {} | q {:.3g} MPa", last_.eps1 * 100,
                                 is_given(to) ? fmt::format("/{:g}", to * 100) : " ", speed, last_.q_Pa * 1e-6);
  if (last_.bonds_intact_pct > 0) text += fmt::format(" | intact {:.0f}%", last_.bonds_intact_pct);
  line_.show(test.stage().name, test.fraction(), text + fmt::format(" | I {:.1g}", last_.inertial_number));
}

void RunReporter::say_end(RunRecord const& record, double confining_stress, std::filesystem::path const& folder) {
  line_.repeat_warnings();
  std::string text = start_text(record.stages.at("prepare"), confining_stress);
  for (StageEnding const& end : record.stage_ends) {
    StageRecord const& numbers = record.stages.at(end.stage);
    auto const held = numbers.find("sigma3_held");
    text += end.stage == shear_stage
                ? summary_of(end.stage).text(held == numbers.end() ? std::nullopt : std::optional(held->second))
                : stage_text(end, numbers);
  }
  print_result(text + fmt::format("results   {}\n", folder.string()));  // a closed stdout is no failure of the run
}

}  // namespace clathra
