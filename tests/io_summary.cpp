#include <gtest/gtest.h>

#include "summary.hpp"

namespace clathra {
namespace {

constexpr double stress = 1e6;

/// 100 records of which `off` have a sigma3 that is larger by `part`.
Summary of_records(int off, double part) {
  Summary summary(stress);
  for (int n = 0; n < 100; ++n) {
    HistoryRow row;
    row.eps1 = 1e-3 * n;
    row.sigma3_Pa = stress * (n < off ? 1 + part : 1);
    row.sigma1_Pa = 3 * stress;
    row.q_Pa = row.sigma1_Pa - row.sigma3_Pa;
    summary.add(row);
  }
  return summary;
}

TEST(Summary, CountsRecordsWithinOnePercentAndWarnsWhereTheyAreTooFew) {
  Summary const shaken = of_records(10, 0.015);
  EXPECT_EQ(shaken.numbers().at("sigma3_held"), 0.9);
  EXPECT_NE(shaken.text().find("control   sigma3 within 1 % in 90.0 % of the records\n"), std::string::npos) << shaken.text();
  EXPECT_TRUE(shaken.warnings().empty());
  EXPECT_TRUE(of_records(11, 0.005).warnings().empty());
  for (double const part : {0.015, -0.015}) {
    std::vector<std::string> const warnings = of_records(11, part).warnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0],
              "sigma3 was within 1 % of 1 MPa in only 89.0 % of the records (fewer than 90 %): the servo walls did not hold it, "
              "lower the inertial number");
  }
}

}  // namespace
}  // namespace clathra
