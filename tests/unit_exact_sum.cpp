/// Sums without an order: their range, their units, and what happens outside.
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "draw.hpp"
#include "kernels/cell_grid.hpp"
#include "kernels/exact_sum.hpp"

namespace clathra {
namespace {

struct Values {
  Field<Real> value;
  KOKKOS_FUNCTION void operator()(int i, Real* out) const { out[0] = value(i); }
};

Field<Real> field_of(std::vector<double> const& values) {
  Field<Real> const field("values", values.size());
  auto host = Kokkos::create_mirror_view(Kokkos::HostSpace(), field);
  std::copy(values.begin(), values.end(), host.data());
  Kokkos::deep_copy(field, host);
  return field;
}

double sum_of(std::vector<double> const& values, double unit = 1) {
  Real sum = 0;
  exact_sums<1>("sum_of", static_cast<int>(values.size()), Values{field_of(values)}, {unit}, &sum);
  return sum;
}

TEST(ExactSum, IsThatOfExactArithmeticInAnyOrder) {
  Draw draw(1);
  std::vector<double> values;
  long double exact = 0;
  for (int n = 0; n < 2000; ++n) {
    values.push_back(draw.either_sign(draw.of_size(1e-9, 1e4)));
    exact += static_cast<long double>(values.back());
  }
  double const sum = sum_of(values);
  EXPECT_NEAR(sum, static_cast<double>(exact), 1e-16 * 1e4 * 45);
  std::vector<double> backwards(values.rbegin(), values.rend()), opposite = values;
  for (double& v : opposite) v = -v;
  EXPECT_EQ(sum_of(backwards), sum);
  EXPECT_EQ(sum_of(opposite), -sum);
}

TEST(ExactSum, KeepsATermThatIsSmallBesideTheOthers) {
  EXPECT_EQ(sum_of({1e6, 0x1p-80, -1e6}), 0x1p-80);
  EXPECT_EQ(sum_of({-1e6, -0x1p-80, 1e6}), -0x1p-80);
  EXPECT_EQ(sum_of({1, 0x1p-53, 0x1p-53}), 1 + 0x1p-52);
}

/// Two sums over groups of lanes, of which the second is of opposite terms.
struct ByLanes : ExactSums<2> {
  Field<Real> value;
  ByLanes(Field<Real> const& values, double unit) : ExactSums<2>({unit, unit}), value(values) {}
  KOKKOS_FUNCTION void operator()(int group, SumWord* sums) const {
    Lanes const terms = load(&value(static_cast<std::size_t>(group) * lane_count));
    add(0, terms, sums);
    add(1, -terms, sums);
  }
};

std::vector<SumWord> words_by_lanes(std::vector<double> const& values, double unit) {
  std::vector<SumWord> words(ByLanes::words);
  Kokkos::parallel_reduce(
      "by_lanes", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(values.size()) / lane_count),
      ByLanes(field_of(values), unit),
      Kokkos::View<SumWord*, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>(words.data(), words.size()));
  return words;
}

TEST(ExactSum, OfGroupsOfLanesHasTheDigitsOfTheSingleTerms) {
  constexpr double unit = 0x1p-10;
  Draw draw(4);
  std::vector<double> values;
  for (int n = 0; n < 32 * lane_count; ++n) values.push_back(draw.either_sign(draw.of_size(1e-9, 1e4)));
  std::vector<SumWord> const words = words_by_lanes(values, unit);
  std::int64_t digits[FixedPoint::words] = {};
  for (double const value : values) EXPECT_TRUE(FixedPoint::add(value / unit, digits));
  for (int k = 0; k < FixedPoint::words; ++k) {
    EXPECT_NE(digits[k], 0) << k;
    EXPECT_EQ(words[static_cast<std::size_t>(2 * k)], digits[k]) << k;
    EXPECT_EQ(words[static_cast<std::size_t>(2 * k + 1)], -digits[k]) << k;
  }
  EXPECT_EQ(ByLanes::total(words.data(), 0, unit), sum_of(values, unit));
  EXPECT_EQ(ByLanes::out_of_range(words.data()), 0);
}

TEST(ExactSum, OfGroupsOfLanesCountsTheTermsThatItCannotHold) {
  std::vector<double> values(2 * lane_count, 1.0);
  values[0] = std::numeric_limits<double>::quiet_NaN();
  values[2 * lane_count - 1] = 0x1p31;
  EXPECT_EQ(ByLanes::out_of_range(words_by_lanes(values, 1).data()), 4) << "two terms of either sum";
  values[0] = values[2 * lane_count - 1] = -0x1.fffffffffffffp30;
  std::vector<SumWord> const words = words_by_lanes(values, 1);
  EXPECT_EQ(ByLanes::out_of_range(words.data()), 0);
  EXPECT_EQ(ByLanes::total(words.data(), 0, 1), sum_of(values));
}

struct JustBelowOne {
  KOKKOS_FUNCTION void operator()(int, Real* out) const { out[0] = 1 - 0x1p-53; }
};

TEST(ExactSum, HoldsMoreThanAHundredMillionTermsWithAllTheirDigits) {
  constexpr int terms = 150'000'000;
  Real sum = 0;
  exact_sums<1>("many", terms, JustBelowOne{}, {1}, &sum);
  EXPECT_EQ(sum, terms - terms * 0x1p-53);
}

TEST(ExactSum, IsAboveEightTrillionAndKeepsItsSign) {
  std::vector<double> const large(10000, 2e9);
  EXPECT_EQ(sum_of(large), 2e13);
  EXPECT_EQ(sum_of(std::vector<double>(10000, -2e9)), -2e13);
  EXPECT_EQ(sum_of({3e20, -1e20}, 0x1p60), 2e20);
}

TEST(ExactSum, HasTheSameDigitsInAnyUnitOfItsTerms) {
  Draw draw(2);
  std::vector<double> values, scaled;
  for (int n = 0; n < 500; ++n) {
    values.push_back(draw.either_sign(draw.of_size(1e-3, 1e3)));
    scaled.push_back(values.back() * 0x1p40);
  }
  EXPECT_EQ(sum_of(scaled, 0x1p40), sum_of(values, 1) * 0x1p40);
}

TEST(ExactSum, RefusesTermsThatItCannotHoldWithTheirNumber) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (double const bad : {nan, infinity, -infinity, 0x1p31, -0x1p31}) {
    try {
      (void)sum_of({1, bad, 2});
      ADD_FAILURE() << bad << " was added";
    } catch (SumOutOfRange const& problem) {
      EXPECT_NE(std::string(problem.what()).find("sum_of: 1 of the terms"), std::string::npos) << problem.what();
    }
  }
  EXPECT_EQ(sum_of({0x1p31, -1e9}, 2), 0x1p31 - 1e9);
  ExactSum host(1);
  host.add(1);
  host.add(nan);
  EXPECT_THROW(host.over({}), SumOutOfRange);
}

TEST(ExactSum, OnTheHostIsThatOfTheKernel) {
  Draw draw(3);
  std::vector<double> values;
  ExactSum sum(0x1p-20);
  for (int n = 0; n < 300; ++n) {
    values.push_back(draw.either_sign(draw.of_size(1e-9, 1e-5)));
    sum.add(values.back());
  }
  EXPECT_EQ(sum.over({}), sum_of(values, 0x1p-20));
}

TEST(SumUnits, ArePowersOfTwoThatFollowTheSpecimen) {
  SumUnits const sand = SumUnits::of(0.1694e-3, 3e8, 2600), gravel = SumUnits::of(0.1694e-3 * 256, 3e8, 2600);
  EXPECT_EQ(sand.length, 0x1p-13);
  EXPECT_EQ(gravel.force(), 256 * sand.force());
  EXPECT_EQ(gravel.energy(), 65536 * sand.energy());
  EXPECT_EQ(gravel.speed(), sand.speed());
  EXPECT_EQ(SumUnits::near(0), 1);
}

TEST(Countable, AreNoMorePlacesInRowsThanThirtyTwoBitsNumber) {
  EXPECT_NO_THROW(require_countable(2147483647, 500000000));
  for (auto const& [entries, discs, number] : {std::tuple{std::int64_t{2147483648}, std::int64_t{1}, "2147483648"},
                                               std::tuple{std::int64_t{1}, std::int64_t{500000001}, "500000001"}}) {
    try {
      require_countable(entries, discs);
      ADD_FAILURE() << number;
    } catch (std::length_error const& problem) {
      EXPECT_NE(std::string(problem.what()).find(number), std::string::npos) << problem.what();
    }
  }
}

}  // namespace
}  // namespace clathra
