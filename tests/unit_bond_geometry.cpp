#include "draw.hpp"
#include "golden_bonds.hpp"
#include "kernels/bond_geometry.hpp"
#include "printed_equations.hpp"
#include "printed_number.hpp"

namespace clathra {
namespace {

constexpr double micrometre = 1e-6;

TEST(BondGeometry, HasTheWidthThicknessAndAreaOfTheTable) {
  for (golden::Bond const& bond : golden::bonds) {
    SCOPED_TRACE(testing::Message() << "S = " << bond.saturation << " %, h/h_max = " << bond.share);
    double const h_max = h_max_of(bond.saturation), gap = bond.share * h_max;
    double const width = bond_width(golden::radius, h_max - gap);
    EXPECT_TRUE(agrees(gap / micrometre, bond.gap));
    EXPECT_TRUE(agrees(width / micrometre, bond.width));
    EXPECT_TRUE(agrees(effective_thickness(gap, h_max) / micrometre, bond.thickness));
    EXPECT_TRUE(agrees(bond_area(golden::radius, width, gap, h_max) / (micrometre * micrometre), bond.area));
  }
}

TEST(BondGeometry, HasTheNumbersOfTheUnequalPair) {
  double const h_max = h_max_of(41), r = common_radius(golden::unequal_r1, golden::unequal_r2);
  EXPECT_TRUE(agrees(r * 1e3, "0.075"));
  double const width = bond_width(r, h_max - golden::unequal_gap);
  EXPECT_TRUE(agrees(width / micrometre, golden::unequal.width));
  EXPECT_TRUE(agrees(effective_thickness(golden::unequal_gap, h_max) / micrometre, golden::unequal.thickness));
  EXPECT_TRUE(agrees(bond_area(r, width, golden::unequal_gap, h_max) / (micrometre * micrometre), golden::unequal.area));
}

TEST(BondGeometry, CommonRadiusIsTheHarmonicMeanOfBothRadii) {
  Draw draw(21);
  EXPECT_EQ(common_radius(golden::radius, golden::radius), golden::radius);
  EXPECT_EQ(common_radius(0.0, 0.0), 0.0);  // padding discs
  for (int n = 0; n < 10000; ++n) {
    double const a = draw.of_size(1e-6, 1e-2), b = draw.of_size(1e-6, 1e-2);
    ASSERT_TRUE(within(1e-15, common_radius(a, b), 2 / (1 / static_cast<long double>(a) + 1 / static_cast<long double>(b))));
    ASSERT_TRUE(same_bits(common_radius(a, b), common_radius(b, a)));
  }
}

TEST(BondGeometry, AgreesWithThePrintedEquationsForAnyBond) {
  Draw draw(22);
  for (int n = 0; n < 100000; ++n) {
    double const r = draw.of_size(1e-5, 1e-2), h_max = r * draw.of_size(1e-4, 1.99), gap = h_max * draw.between(0, 0.99);
    double const width = bond_width(r, h_max - gap);
    ASSERT_TRUE(within(1e-12, width, printed::width(r, h_max, gap))) << r << " " << h_max << " " << gap;
    ASSERT_TRUE(within(1e-12, effective_thickness(gap, h_max), (static_cast<long double>(gap) + h_max) / 2));
    ASSERT_TRUE(within(1e-12, bond_area(r, width, gap, h_max), printed::area(r, h_max, gap))) << r << " " << h_max << " " << gap;
  }
}

TEST(BondGeometry, WidthIsZeroWithoutRoomAndNeverMoreThanTheDisc) {
  double const r = golden::radius;
  EXPECT_EQ(bond_width(r, 0.0), 0);
  EXPECT_EQ(bond_width(r, -1e-6), 0);
  EXPECT_EQ(bond_width(r, 2 * r), 2 * r);
  EXPECT_EQ(bond_width(r, 3 * r), 2 * r);
  EXPECT_EQ(bond_width(0.0, 1e-6), 0);
  double last = 0;
  for (int n = 0; n <= 1000; ++n) {
    double const width = bond_width(r, n * 2e-3 * r);
    EXPECT_GE(width, last);
    EXPECT_LE(width, 2 * r);
    last = width;
  }
}

TEST(BondGeometry, AreaTendsToThatOfAHalfDiscBetweenTwoDiscsAsWideAsTheBond) {
  double const r = golden::radius, h_max = 2 * r;
  EXPECT_TRUE(within(1e-14, bond_area(r, 2 * r, 0, h_max), 4.0L * r * r - 3.14159265358979323846L * r * r));
  EXPECT_EQ(bond_area(r, 0, 1e-6, 1e-6), 0);
  EXPECT_EQ(bond_area(0, 0, 0, 1e-6), 0);
}

TEST(BondGeometry, AreaHasNoStepWhereItsSeriesChanges) {
  double const r = golden::radius, below = std::nextafter(r, 0.0), above = std::nextafter(r, 1.0);
  double const slope = (bond_area(r, 1.001 * r, 0, r) - bond_area(r, r, 0, r)) / (0.001 * r);
  EXPECT_NEAR(bond_area(r, above, 0, r) - bond_area(r, below, 0, r), slope * (above - below), 1e-14 * r * r);
}

TEST(BondGeometry, LanesGiveTheBitsOfTheScalar) {
  struct Pair {
    double r1, r2, room;
  };
  Draw draw(23);
  for (int n = 0; n < 20000; ++n) {
    LaneStates<Pair> pairs;
    for (Pair& pair : pairs) pair = {draw.of_size(1e-6, 1e-3), draw.of_size(1e-6, 1e-3), draw.between(-0.3, 1) * 2e-5};
    Lanes const r = common_radius(side_by_side(pairs, [](Pair const& p) { return p.r1; }),
                                  side_by_side(pairs, [](Pair const& p) { return p.r2; }));
    Lanes const room = side_by_side(pairs, [](Pair const& p) { return p.room; });
    Lanes const width = bond_width(r, room), thickness = effective_thickness(room, Lanes(1.7e-5));
    for (int l = 0; l < lane_count; ++l) {
      Pair const& pair = pairs[static_cast<std::size_t>(l)];
      double const alone = common_radius(pair.r1, pair.r2);
      ASSERT_TRUE(same_bits(lane(r, l), alone));
      ASSERT_TRUE(same_bits(lane(width, l), bond_width(alone, pair.room)));
      ASSERT_TRUE(same_bits(lane(thickness, l), effective_thickness(pair.room, 1.7e-5)));
    }
  }
}

}  // namespace
}  // namespace clathra
