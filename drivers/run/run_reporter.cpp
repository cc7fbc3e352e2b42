#include "run/run_reporter.hpp"

#include <fmt/format.h>

#include "terminal/print.hpp"

namespace clathra {

void RunReporter::add(HistoryRow const& row) {
  last_ = row;
  summary_.add(row);
}

void RunReporter::show(BiaxialTest const& test, double axial_strain, std::string const& speed) {
  std::string text =
      fmt::format("eps1 {:.1f}/{:g}% | {} | q {:.3g} MPa", last_.eps1 * 100, axial_strain * 100, speed, last_.q_Pa * 1e-6);
  if (last_.bonds_intact_pct > 0) text += fmt::format(" | intact {:.0f}%", last_.bonds_intact_pct);
  line_.show("shear", test.strain_fraction(), text + fmt::format(" | I {:.1g}", last_.inertial_number));
}

void RunReporter::say_end(RunRecord const& record, double confining_stress, std::filesystem::path const& folder) {
  line_.repeat_warnings();
  print_result(start_text(record.stages.at("prepare"), confining_stress) +
               summary_.text(record.stages.at("shear").at("sigma3_held")) +
               fmt::format("results   {}\n", folder.string()));  // a closed stdout is no failure of the run
}

}  // namespace clathra
