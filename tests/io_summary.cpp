#include <gtest/gtest.h>

#include "run/curve_summary.hpp"

namespace clathra {
namespace {

/// A test of 100 records whose q rises to its peak between two of them, with a ledger of which a part is unaccounted for.
CurveSummary of_records(double unaccounted) {
  CurveSummary summary;
  for (int n = 0; n < 100; ++n) {
    HistoryRow row;
    row.eps1 = 1e-3 * n;
    row.sigma3_Pa = 1e6;
    row.q_Pa = n <= 20 ? 1e5 * n : 1e6;
    row.largest_q_Pa = n == 21 ? 2.5e6 : row.q_Pa;
    row.largest_q_eps1 = n == 21 ? 0.0205 : row.eps1;
    summary.add(row);
  }
  EnergyRow energy;  // of the first record, and of the last
  summary.add(energy);
  energy.boundary_work = 1;
  energy.residual = unaccounted;
  summary.add(energy);
  return summary;
}

TEST(CurveSummary, SaysPeakAndControlAndWarnsOfWorkThatIsUnaccountedFor) {
  CurveSummary const sound = of_records(-0.009);
  EXPECT_EQ(sound.numbers().at("peak_q_Pa"), 2.5e6);
  EXPECT_EQ(sound.numbers().at("peak_eps1"), 0.0205);
  EXPECT_EQ(sound.numbers().at("energy_residual"), 0.009);
  EXPECT_EQ(sound.numbers().at("records"), 100);
  EXPECT_NE(sound.text(0.9).find("control   sigma3 within 1 % in 90.0 % of the checks\n"), std::string::npos) << sound.text(0.9);
  EXPECT_TRUE(sound.warnings().empty());
  std::vector<std::string> const warnings = of_records(0.011).warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("1.1 % of the boundary work is unaccounted for"), std::string::npos) << warnings[0];
}

}  // namespace
}  // namespace clathra
