/// The numbers of a test, against planted curves.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "domain/measurement/test_numbers.hpp"

namespace clathra {
namespace {

/// Contraction at a half of the axial strain up to 2 %, then dilation at a planted angle, with a burst in one record.
struct Planted {
  std::vector<double> eps1, eps_v, q, sigma3, intact, largest_q, largest_q_eps1, dilation;  // the last three: nothing is known
  explicit Planted(double psi, double end = 0.15) {
    double const s = std::sin(psi), slope = -2 * s / (1 - s);  // d eps_v / d eps_1 where -d eps_v / d (2 eps_1 - eps_v) = s
    for (int i = 0; i <= 300; ++i) {
      double const e = end * i / 300;
      eps1.push_back(e);
      eps_v.push_back(e < 0.02 ? e / 2 : 0.01 + slope * (e - 0.02));
      q.push_back(e < 0.02 ? 5e6 * e / 0.02 : 4e6);
      sigma3.push_back(1e6);
      intact.push_back(100.0 - i / 10.0);
      for (std::vector<double>* const column : {&largest_q, &largest_q_eps1, &dilation})
        column->push_back(std::numeric_limits<double>::quiet_NaN());
    }
  }
  TestCurves curves() const { return {eps1, eps_v, q, sigma3, intact, largest_q, largest_q_eps1, dilation}; }
};

TEST(TestNumbers, HaveTheDilationAngleThatWasPlanted) {
  for (double const psi : {0.0, 0.1, 0.3}) {
    Planted test(psi);
    EXPECT_NEAR(dilation_angle(test.eps1, test.eps_v).value(), psi, 1e-9);
    test.eps_v[200] -= 2e-4;  // a burst within a record
    EXPECT_NEAR(dilation_angle(test.eps1, test.eps_v).value(), psi, 0.02);
  }
  std::vector<double> const eps1{0, 0.01, 0.02}, contracting{0, 0.005, 0.009};
  EXPECT_NEAR(dilation_angle(eps1, contracting).value(), std::asin(-0.004 / 0.016), 1e-12) << "the least contraction";
}

TEST(TestNumbers, HaveNoDilationAngleOfAShortTest) {
  Planted const test(0.2, 0.009);
  EXPECT_FALSE(dilation_angle(test.eps1, test.eps_v));
  EXPECT_FALSE(dilation_angle({}, {}));
  std::vector<double> const unknown(test.eps1.size(), std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(dilation_angle(Planted(0.2).eps1, unknown));
}

TEST(TestNumbers, AreThoseOfAllStepsWhereTheRowsHaveThem) {
  Planted test(0.2);
  test.largest_q[41] = 5.5e6;
  test.largest_q_eps1[41] = 0.0203;  // between the rows at 2 and 2.05 %
  test.dilation[100] = 13, test.dilation[200] = 17;
  TestNumbers const n = test_numbers(test.curves());
  EXPECT_EQ(n.peak, 41u);
  EXPECT_EQ(n.peak_q, 5.5e6);
  EXPECT_EQ(n.peak_eps1, 0.0203);
  EXPECT_NEAR(n.intact_peak, 100 - 4.06, 1e-9) << "between the rows";
  EXPECT_NEAR(n.eps_v_peak, test.eps_v[40] + 0.6 * (test.eps_v[41] - test.eps_v[40]), 1e-12);
  EXPECT_NEAR(n.dilation_angle.value(), 17 * std::acos(-1.0) / 180, 1e-12);
}

TEST(TestNumbers, PassAPeakThatQHasFallenFromByAShare) {
  for (double const share : {0.981, 0.979}) {
    Planted test(0.2);
    double const peak = test_numbers(test.curves()).peak_q;
    for (std::size_t i = 40; i < test.q.size(); ++i) test.q[i] = share * peak;
    EXPECT_EQ(test_numbers(test.curves()).passed_peak, share < share_past_peak);
    test.q.back() = peak * (1 + 1e-9);
    EXPECT_FALSE(test_numbers(test.curves()).passed_peak) << "still rising";
  }
}

TEST(TestNumbers, AreRecordedByTheirNames) {
  Planted const test(0.2);
  TestNumbers const n = test_numbers(test.curves());
  StageRecord const record = record_of(n);
  EXPECT_NEAR(record.at("dilation_angle_deg"), 0.2 * 180 / std::acos(-1.0), 1e-6);
  EXPECT_NEAR(record.at("largest_eps_v"), 0.01, 1e-12);
  EXPECT_NEAR(record.at("largest_eps_v_eps1"), 0.02, 1e-12);
  EXPECT_NEAR(record.at("peak_q_Pa"), 4.875e6, 1);
  EXPECT_DOUBLE_EQ(record.at("peak_bonds_intact_pct"), 100 - 3.9);
  EXPECT_DOUBLE_EQ(record.at("residual_q_Pa"), 4e6);
  EXPECT_NEAR(record.at("secant_modulus_Pa"), 5e6 / 0.02, 1e-3);
  TestNumbers unknown = n;
  unknown.intact_end = std::numeric_limits<double>::quiet_NaN();
  unknown.secant_modulus.reset();
  EXPECT_EQ(record_of(unknown).count("end_bonds_intact_pct") + record_of(unknown).count("secant_modulus_Pa"), 0u);
}

}  // namespace
}  // namespace clathra
