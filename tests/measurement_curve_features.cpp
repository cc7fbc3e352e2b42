/// What is read off curves of tests, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "domain/measurement/curve_features.hpp"

namespace clathra {
namespace {

constexpr int points = 1001;

/// f over 0 to 0.15, as a history has it.
template <class F>
std::vector<double> over(std::vector<double> const& x, F const& f) {
  std::vector<double> y;
  for (double const place : x) y.push_back(f(place));
  return y;
}
std::vector<double> strains() {
  std::vector<double> x;
  for (int i = 0; i < points; ++i) x.push_back(0.15 * i / (points - 1));
  return x;
}
constexpr double spacing = 0.15 / (points - 1);

TEST(CurveFeatures, AValueBetweenPointsIsOnTheStraightLine) {
  EXPECT_DOUBLE_EQ(value_at({0, 1, 3}, {2, 4, 0}, 2), 2);
  EXPECT_DOUBLE_EQ(value_at({0, 1, 3}, {2, 4, 0}, 0.25), 2.5);
  EXPECT_EQ(value_at({0, 1, 3}, {2, 4, 0}, -1), 2);
  EXPECT_EQ(value_at({0, 1, 3}, {2, 4, 0}, 9), 0);
}

TEST(CurveFeatures, TheMiddleOfATopIsThatOfASymmetricOneAndOfASkewOneBetweenItsLevels) {
  std::vector<double> const x = strains();
  EXPECT_NEAR(middle_of_top(x, over(x, [](double e) { return 3 - 200 * (e - 0.04) * (e - 0.04); }), 0.98), 0.04, spacing);
  // Rises by 100 e to 1 at 0.01, falls by 10 (e - 0.01): 0.98 at 0.0098 and 0.012.
  EXPECT_NEAR(middle_of_top(x, over(x, [](double e) { return std::min(100 * e, 1.1 - 10 * e); }), 0.98), 0.0109, spacing);
}

TEST(CurveFeatures, TheSlopeOverAStretchIsThatOfTheLineAndIgnoresTheRest) {
  std::vector<double> const x = strains();
  std::vector<double> const y = over(x, [](double e) { return e < 0.12 ? 77 : 5 - 3 * e; });
  EXPECT_NEAR(*slope_over(x, y, 0.12, 0.15), -3, 1e-9);
  EXPECT_FALSE(slope_over(x, y, 0.2, 0.3));
  EXPECT_FALSE(slope_over({1, 2}, {1, 2}, 1, 1.5));
}

TEST(CurveFeatures, AParabolaComesBack) {
  std::vector<double> const x{0, 26, 41, 55};
  double const mean = 30.5;
  std::vector<double> const y = over(x, [](double s) { return 2 + 0.3 * s - 0.004 * s * s; });
  auto const fit = fitted_parabola(x, y);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->bend, -0.004, 1e-12);
  EXPECT_NEAR(fit->slope, 0.3 - 2 * 0.004 * mean, 1e-12);
  EXPECT_NEAR(fit->at_mean, 2 + 0.3 * mean - 0.004 * mean * mean, 1e-10);
  EXPECT_FALSE(fitted_parabola({1, 2}, {3, 4}));
  EXPECT_FALSE(fitted_parabola({1, 1, 1}, {3, 4, 5}));
  EXPECT_FALSE(fitted_parabola({1, 1, 2}, {3, 4, 5}));  // two places
}

TEST(CurveFeatures, GrowthIsFastestInTheMiddleOfASigmoid) {
  std::vector<double> const x = strains();
  EXPECT_NEAR(*fastest_growth(x, over(x, [](double e) { return std::tanh((e - 0.06) / 0.01); }), 0.005), 0.06, spacing);
  EXPECT_FALSE(fastest_growth(x, over(x, [](double) { return 1.0; }), 0.005));
  EXPECT_FALSE(fastest_growth({0, 0.001}, {0, 1}, 0.005));
}

TEST(CurveFeatures, AFallEndsWhereItsShareIsLost) {
  std::vector<double> const x = strains();
  // Peak 4 at 0.02, then 1 + 3 exp(-(e - 0.02) / 0.01): 95 % of the way to 1 after 0.01 ln 20.
  std::vector<double> const y = over(x, [](double e) { return e < 0.02 ? 200 * e : 1 + 3 * std::exp(-(e - 0.02) / 0.01); });
  EXPECT_NEAR(*end_of_fall(x, y, 1, 0.95), 0.02 + 0.01 * std::log(20), spacing);
  EXPECT_FALSE(end_of_fall(x, y, 0, 0.95));
}

}  // namespace
}  // namespace clathra
