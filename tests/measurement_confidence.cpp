/// Means, their intervals and how many values they need, against planted numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "domain/measurement/confidence.hpp"

namespace clathra {
namespace {

TEST(MeanInterval, IsThatOfTextbooks) {
  MeanInterval const m = mean_interval({1, 2, 3, 4, 5});
  EXPECT_DOUBLE_EQ(m.mean, 3);
  EXPECT_DOUBLE_EQ(*m.deviation, std::sqrt(2.5));
  EXPECT_NEAR(*m.half_width, 2.7764451051977987 * std::sqrt(2.5 / 5), 1e-12) << "t for 4 degrees of freedom, 97.5 %";
  EXPECT_NEAR(*mean_interval({0, 2}).half_width, 12.706204736174698, 1e-10);
}

TEST(MeanInterval, OfOneValueIsNoInterval) {
  MeanInterval const m = mean_interval({7});
  EXPECT_EQ(m.mean, 7);
  EXPECT_FALSE(m.half_width || m.deviation);
  EXPECT_EQ(m.low(), 7);
  EXPECT_EQ(mean_interval({4, 4, 4}).half_width, 0);
}

TEST(MeanInterval, HoldsTheTruthIn95PercentOfPlantedStudies) {
  std::mt19937_64 random(20261123);
  for (int const seeds : {3, 5, 12}) {
    constexpr int studies = 2000;
    int holding = 0;
    for (int study = 0; study < studies; ++study) {
      std::normal_distribution<double> value(4e6, 3e5);
      std::vector<double> values;
      for (int i = 0; i < seeds; ++i) values.push_back(value(random));
      MeanInterval const m = mean_interval(values);
      holding += m.low() <= 4e6 && 4e6 <= m.high() ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(holding) / studies, 0.95, 0.02) << seeds << " seeds";
  }
}

/// A study that adds seeds until it knows its mean. @return all values
template <class Next>
std::vector<double> until_known(double width, Next const& next, std::size_t most = 400) {
  std::vector<double> values;
  SequentialMean search(width);
  for (int i = 0; i < 5; ++i) values.push_back(next());
  for (search.look(values); !search.done() && values.size() < most; search.look(values))
    while (static_cast<int>(values.size()) < search.wanted()) values.push_back(next());
  return values;
}

TEST(SequentialMean, HoldsTheTruthInAtLeast92PercentOfPlantedStudies) {
  std::mt19937_64 random(1);
  for (double const scatter : {0.02, 0.03, 0.04, 0.06, 0.1}) {
    constexpr int studies = 2000;
    int holding = 0;
    for (int study = 0; study < studies; ++study) {
      std::normal_distribution<double> value(1, scatter);
      MeanInterval const m = mean_interval(until_known(0.02, [&] { return value(random); }));
      ASSERT_LE(*m.half_width, 0.02 * m.mean * (1 + 1e-12));
      holding += m.low() <= 1 && 1 <= m.high() ? 1 : 0;
    }
    EXPECT_GE(static_cast<double>(holding) / studies, 0.92) << "scatter " << scatter;
  }
}

TEST(SequentialMean, StopsAtTheRightNumberOfValues) {
  // -d, d, -d, d, ... about 1: the deviation of n values is known, so is the first n that is enough.
  for (double const d : {0.01, 0.03, 0.05, 0.1}) {
    int first = 5;
    auto const value = [d](int i) { return 1 + (i % 2 == 0 ? d : -d); };
    for (std::vector<double> values;; ++first) {
      values.clear();
      for (int i = 0; i < first; ++i) values.push_back(value(i));
      MeanInterval const m = mean_interval(values);
      if (*m.half_width <= 0.02 * m.mean) break;
    }
    int i = 0;
    auto const count = static_cast<int>(until_known(0.02, [&] { return value(i++); }).size());
    EXPECT_GT(count, first) << "a second look confirms the first narrow one";
    EXPECT_LE(count, first + 2 + first / 10) << "d = " << d;
  }
}

TEST(SequentialMean, TakesValuesThatAreAllEqualForKnownAndAMeanOfZeroForUnknown) {
  EXPECT_EQ(until_known(0.02, [] { return 3.0; }).size(), 6u);
  EXPECT_EQ(until_known(0.02, [] { return 0.0; }).size(), 6u);
  int i = 0;
  EXPECT_GE(until_known(
                0.02, [&i] { return ++i % 2 == 0 ? 1.0 : -1.0; }, 60)
                .size(),
            60u);
}

}  // namespace
}  // namespace clathra
