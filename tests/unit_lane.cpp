#include <algorithm>
#include <limits>
#include <vector>

#include "draw.hpp"
#include "kernels/lane.hpp"
#include "printed_number.hpp"

namespace clathra {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double corners[] = {0.0, -0.0, 1.0, -1.0, 5e-324, -5e-324, 1e300, -1e300, infinity, -infinity, nan};

testing::AssertionResult same(Lanes const& lanes, double scalar) {
  for (int l = 0; l < lane_count; ++l) {
    if (scalar != scalar && lane(lanes, l) != lane(lanes, l)) continue;
    if (auto const equal = same_bits(lane(lanes, l), scalar); !equal) return equal;
  }
  return testing::AssertionSuccess();
}

TEST(Lane, GivesTheBitsOfTheScalarAtEveryCorner) {
  for (double a : corners) {
    EXPECT_TRUE(same(lane_abs(Lanes(a)), lane_abs(a))) << a;
    EXPECT_TRUE(same(lane_sqrt(Lanes(std::fabs(a))), lane_sqrt(std::fabs(a)))) << a;
    EXPECT_TRUE(same(lane_truncate(Lanes(a)), lane_truncate(a))) << a;
    for (double b : corners) {
      EXPECT_TRUE(same(lane_max(Lanes(a), Lanes(b)), lane_max(a, b))) << a << ", " << b;
      EXPECT_TRUE(same(lane_min(Lanes(a), Lanes(b)), lane_min(a, b))) << a << ", " << b;
      EXPECT_TRUE(same(select(Lanes(a) < Lanes(b), Lanes(a), Lanes(b)), select(a < b, a, b))) << a << ", " << b;
      if (a != a || b != b) continue;  // clamp_to() leaves NaN to the machine
      EXPECT_TRUE(same(clamp_to(Lanes(a), Lanes(std::fabs(b))), clamp_to(a, std::fabs(b)))) << a << " to " << b;
    }
  }
}

TEST(Lane, ClampsBothSignsAndIsOddToTheBit) {
  EXPECT_EQ(clamp_to(3.0, 2.0), 2.0);
  EXPECT_EQ(clamp_to(-3.0, 2.0), -2.0);
  EXPECT_EQ(clamp_to(1.5, 2.0), 1.5);
  EXPECT_EQ(clamp_to(2.0, 2.0), 2.0);
  for (double value : corners) {
    if (value != value) continue;
    for (double limit : {0.0, 5e-324, 1.0, 1e300}) {
      EXPECT_TRUE(same_bits(clamp_to(-value, limit), -clamp_to(value, limit))) << value << " to " << limit;
    }
  }
}

TEST(Lane, SelectsAndStoresLaneByLane) {
  double from[static_cast<std::size_t>(lane_count)], to[static_cast<std::size_t>(lane_count)];
  int index[static_cast<std::size_t>(lane_count)];
  for (int l = 0; l < lane_count; ++l) {
    from[l] = l + 0.5;
    index[l] = lane_count - 1 - l;
  }
  Lanes const up = load(from), down = gather(from, index);
  store(to, select(up < down, up, down));
  for (int l = 0; l < lane_count; ++l) {
    EXPECT_EQ(lane(down, l), from[lane_count - 1 - l]);
    EXPECT_EQ(to[l], std::min(from[l], from[lane_count - 1 - l]));
  }
  EXPECT_EQ(largest(up), lane_count - 0.5);
}

TEST(Lane, TruncatesTowardsZeroAndSumsAndCountsAllLanes) {
  EXPECT_EQ(lane_truncate(2.75), 2);
  EXPECT_EQ(lane_truncate(-2.75), -2);
  double number[lane_count];
  for (int l = 0; l < lane_count; ++l) number[l] = l + 1;
  Lanes const up = load(number);
  EXPECT_EQ(sum_of_lanes(up), lane_count * (lane_count + 1) / 2);
  for (int count = 0; count <= lane_count; ++count) EXPECT_EQ(count_set(up <= Lanes(count)), count);
}

// Every mask, beside the same one lane after the other.
TEST(Lane, PacksWhatIsSetInTheOrderOfLanes) {
  int from[lane_count];
  double number[lane_count];
  for (int l = 0; l < lane_count; ++l) from[l] = 100 + l;
  for (int bits = 0; bits < 1 << lane_count; ++bits) {
    std::vector<int> expected, visited;
    for (int l = 0; l < lane_count; ++l) {
      number[l] = bits >> l & 1;
      if (bits >> l & 1) expected.push_back(from[l]);
    }
    auto const mask = load(number) > Lanes(0);
    for_each_set(mask, [&](int l) { visited.push_back(from[l]); });
    EXPECT_EQ(visited, expected) << bits;
    int to[lane_count + 1];
    to[lane_count] = -7;
    int const count = pack_set(mask, from, to);
    EXPECT_EQ(std::vector<int>(to, to + count), expected) << bits;
    EXPECT_EQ(to[lane_count], -7);
  }
}

TEST(Lane, MasksTheFirstOnes) {
  for (int count = -3; count < lane_count + 3; ++count) {
    auto const mask = first_lanes(count);
    for (int l = 0; l < lane_count; ++l) EXPECT_EQ(lane(mask, l), l < count) << count;
    int from[lane_count] = {}, to[lane_count];
    EXPECT_EQ(pack_set(mask, from, to), std::clamp(count, 0, lane_count)) << count;
  }
}

TEST(Lane, FusesProductsAndSumsInSinglePrecisionOnly) {
  // (1 + u)(1 - u) - 1 = -u^2, of which nothing is left where the product is rounded.
  double const u = 0x1p-30;
  EXPECT_EQ(multiply_add(1 + u, 1 - u, -1.0), 0);
  EXPECT_EQ(negative_multiply_add(1 + u, 1 - u, 1.0), 0);
  EXPECT_EQ(fused_multiply_add(1 + u, 1 - u, -1.0), -u * u);
  float const v = 0x1p-14F;
  EXPECT_EQ(multiply_add(1 + v, 1 - v, -1.0F), -v * v);
  EXPECT_EQ(negative_multiply_add(1 + v, 1 - v, 1.0F), v * v);
  EXPECT_EQ(largest(multiply_add(Lanes(1 + u), Lanes(1 - u), Lanes(-1))), 0);
  EXPECT_EQ(largest(negative_multiply_add(Lanes(1 + u), Lanes(1 - u), Lanes(1))), 0);
  EXPECT_EQ(largest(fused_multiply_add(Lanes(1 + u), Lanes(1 - u), Lanes(-1))), -u * u);
  EXPECT_EQ(largest(multiply_add(FloatLanes(1 + v), FloatLanes(1 - v), FloatLanes(-1.0F))), -v * v);
  EXPECT_EQ(largest(negative_multiply_add(FloatLanes(1 + v), FloatLanes(1 - v), FloatLanes(1.0F))), v * v);
}

}  // namespace
}  // namespace clathra
