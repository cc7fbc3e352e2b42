/// What is defined once for all tables: how their rows are read, where the peak and the residual state are, the names of modes.
#include <gtest/gtest.h>

#include <limits>

#include "domain/measurement/test_phases.hpp"
#include "domain/scene/csv_rows.hpp"
#include "kernels/break_mode.hpp"

namespace clathra {
namespace {

TEST(CsvRows, AreCutAtCommasAndEndsOfLines) {
  CsvRows rows("a,b,\r\n\n1,,3\n4,5");
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.text(), "a,b,");
  EXPECT_EQ(rows.cells(), (std::vector<std::string_view>{"a", "b", ""}));
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.cells(), std::vector<std::string_view>{""});
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.cells(), (std::vector<std::string_view>{"1", "", "3"}));
  EXPECT_EQ(rows.line(), 3u);
  EXPECT_FALSE(rows.next()) << "a line without its end may be in writing";
  ASSERT_TRUE(rows.next_or_rest());
  EXPECT_EQ(rows.cells(), (std::vector<std::string_view>{"4", "5"}));
  EXPECT_FALSE(rows.next_or_rest());
}

TEST(ResidualState, IsTheRestBehindTwelvePercentOrTheLastFifth) {
  EXPECT_EQ(residual_from(0.15), 0.12);
  EXPECT_EQ(residual_from(0.1401), 0.12);
  EXPECT_DOUBLE_EQ(residual_from(0.14), 0.112);
  EXPECT_DOUBLE_EQ(residual_from(0.06), 0.048);
}

TEST(Peak, IsTheFirstOfTheLargestFiniteValues) {
  double const nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(peak_row({1, 3, 2, 3}), 1u);
  EXPECT_EQ(peak_row({nan, 3, inf, 4, nan}), 3u);
  EXPECT_EQ(peak_row({-2, -3}), 0u);
}

TEST(BreakModes, AreListedByTheirNumbersWithNamesOfTheirOwn) {
  for (int mode = 1; mode < break_mode_count; ++mode) {
    EXPECT_EQ(static_cast<int>(break_modes[mode - 1].mode), mode);
    EXPECT_STREQ(break_mode_name(mode), break_modes[mode - 1].name);
    EXPECT_EQ(break_modes[mode - 1].broken, std::string("broken_") + break_modes[mode - 1].name);
  }
  EXPECT_STREQ(break_mode_name(0), "none");
  EXPECT_STREQ(break_mode_name(break_mode_count), "none");
  BreakCounts counts;
  counts[BreakMode::shear] = 2;
  counts[BreakMode::rolling] = 5;
  EXPECT_EQ(counts.total(), 7);
}

}  // namespace
}  // namespace clathra
