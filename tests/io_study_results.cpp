/// What study.csv makes of members whose numbers are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "file_content.hpp"
#include "io/results/interval_text.hpp"
#include "io/results/study_results.hpp"

namespace clathra {
namespace {

/// Rows of a table by the names of its columns.
std::vector<std::map<std::string, std::string>> named_rows(std::string const& text) {
  std::vector<std::map<std::string, std::string>> rows;
  auto const cells = csv_rows(text);
  for (std::size_t r = 1; r < cells.size(); ++r) {
    EXPECT_EQ(cells[r].size(), cells[0].size()) << r;
    rows.emplace_back();
    for (std::size_t i = 0; i < std::min(cells[r].size(), cells[0].size()); ++i) rows.back()[cells[0][i]] = cells[r][i];
  }
  return rows;
}

/// Three groups at 1, 2 and 3 MPa of one material, three seeds each, whose envelopes are known. The last test of seed 3 has no
/// peak, and only two seeds have a dilation angle.
class PlantedStudy : public testing::Test {
 protected:
  void SetUp() override {
    study.file = "planted.toml";
    study.seeds = {1, 2, 3};
    study.keys = {"test.confining_stress"};
    for (int stress = 1; stress <= 3; ++stress) {
      std::string const name = std::to_string(stress) + "MPa";
      study.groups.push_back({name, {{"test.confining_stress", std::to_string(stress) + " MPa"}}, "sand"});
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        MemberResult member;
        member.group = static_cast<std::size_t>(stress) - 1;
        member.seed = seed;
        member.state = MemberState::finished;
        member.numbers["peak_q_Pa"] = 1e6 * stress + 1e5 * static_cast<double>(seed);
        if (seed < 3) member.numbers["dilation_angle_deg"] = 10.0 * static_cast<double>(seed);
        member.confining_stress = 1e6 * stress;
        double const n = 3;  // sin phi = 1/2
        if (stress < 3 || seed < 3) {
          member.peak = FailureStress{2 * cohesion(seed) * std::sqrt(n) + n * 1e6 * stress, 1e6 * stress};
          member.residual = member.peak;
        }
        members.push_back(member);
      }
    }
  }
  static double cohesion(std::uint64_t seed) { return 1e5 * static_cast<double>(seed * seed); }
  std::vector<std::map<std::string, std::string>> rows(std::string const& kind, std::string const& group) const {
    std::vector<std::map<std::string, std::string>> found;
    for (auto const& row : named_rows(study_csv(study, members)))
      if (row.at("row") == kind && row.at("group") == group) found.push_back(row);
    return found;
  }

  Study study;
  std::vector<MemberResult> members;
};

TEST_F(PlantedStudy, SaysOfHowManySeedsEachIntervalIs) {
  auto const means = rows("mean", "1MPa"), low = rows("interval_low", "1MPa");
  ASSERT_EQ(means.size(), 2u);
  EXPECT_EQ(means[0].at("n"), "3");
  EXPECT_DOUBLE_EQ(std::stod(means[0].at("peak_q_Pa")), 1.2e6);
  EXPECT_EQ(means[0].at("dilation_angle_deg"), "") << "has fewer values: a row of its own";
  EXPECT_EQ(means[1].at("n"), "2");
  EXPECT_EQ(means[1].at("peak_q_Pa"), "");
  EXPECT_DOUBLE_EQ(std::stod(means[1].at("dilation_angle_deg")), 15);
  EXPECT_DOUBLE_EQ(std::stod(low[1].at("dilation_angle_deg")), mean_interval({10, 20}).low());
  EXPECT_EQ(rows("member", "1MPa")[0].at("test.confining_stress"), "1000000");
}

TEST_F(PlantedStudy, AveragesEnvelopesOfCompleteSeedsOnly) {
  auto const seeds = rows("envelope", "sand"), means = rows("mean", "sand"), high = rows("interval_high", "sand");
  ASSERT_EQ(seeds.size(), 2u);
  EXPECT_EQ(seeds[0].at("seed") + seeds[1].at("seed"), "12") << "the third has no peak at 3 MPa";
  ASSERT_EQ(means.size(), 1u);
  EXPECT_EQ(means[0].at("n"), "2");
  MeanInterval const c = mean_interval({cohesion(1), cohesion(2)});
  EXPECT_NEAR(std::stod(means[0].at("peak_cohesion_Pa")), c.mean, 1e-3);
  EXPECT_NEAR(std::stod(high[0].at("peak_cohesion_Pa")), c.high(), 1e-3);
  EXPECT_NEAR(std::stod(means[0].at("peak_friction_angle_deg")), 30, 1e-9);
}

TEST(IntervalText, IsRoundedToTheSecondDigitOfTheInterval) {
  EXPECT_EQ(with_error(3.0449, 0.1234), "3.04 ± 0.12");
  EXPECT_EQ(with_error(1234.5, 113.7), "1230 ± 110");
  EXPECT_EQ(with_error(-0.3, 11.2), "0 ± 11");
  EXPECT_EQ(with_error(-12, 0.0996), "-12.00 ± 0.10");
  EXPECT_EQ(with_error(100, 0), "100 ± 0");
  EXPECT_EQ(interval_text(mean_interval({2.5e6}), 1e-6), "2.5");
  EXPECT_EQ(interval_text(mean_interval({1e6, 2e6}), 1e-6), "1.5 ± 6.4");
}

}  // namespace
}  // namespace clathra
