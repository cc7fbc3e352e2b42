#include "draw.hpp"
#include "golden_bonds.hpp"
#include "kernels/bond_geometry.hpp"
#include "kernels/bond_stiffness.hpp"
#include "printed_equations.hpp"
#include "printed_number.hpp"

namespace clathra {
namespace {

TEST(BondStiffness, HasTheNumbersOfTheTable) {
  for (golden::Bond const& bond : golden::bonds) {
    SCOPED_TRACE(testing::Message() << "S = " << bond.saturation << " %, h/h_max = " << bond.share);
    double const h_max = h_max_of(bond.saturation), gap = bond.share * h_max, h_0 = effective_thickness(gap, h_max);
    double const width = bond_width(golden::radius, h_max - gap);
    ContactStiffness<Real> const k = bond_stiffness(golden::k_n, golden::E_m, width, h_0);
    EXPECT_TRUE(agrees(k.normal, bond.k_bn));
    EXPECT_TRUE(agrees(k.shear, bond.k_bs));
    EXPECT_TRUE(agrees(k.rolling, bond.k_bm));
    EXPECT_TRUE(agrees(width > 0 ? 12 * k.rolling / (width * width) : 0, bond.k_mh));  // k_bm = k_mh B^2 / 12
  }
}

TEST(BondStiffness, HasTheNumbersOfTheUnequalPair) {
  double const h_max = h_max_of(41), r = common_radius(golden::unequal_r1, golden::unequal_r2);
  double const width = bond_width(r, h_max - golden::unequal_gap), h_0 = effective_thickness(golden::unequal_gap, h_max);
  ContactStiffness<Real> const k = bond_stiffness(golden::k_n, golden::E_m, width, h_0);
  EXPECT_TRUE(agrees(k.normal, golden::unequal.k_bn));
  EXPECT_TRUE(agrees(k.shear, golden::unequal.k_bs));
  EXPECT_TRUE(agrees(k.rolling, golden::unequal.k_bm));
  EXPECT_TRUE(agrees(12 * k.rolling / (width * width), golden::unequal.k_mh));
}

TEST(BondStiffness, AgreesWithThePrintedEquationsForAnyBond) {
  Draw draw(31);
  for (int n = 0; n < 100000; ++n) {
    double const k_n = draw.of_size(1e6, 1e10), E_m = draw.of_size(1e6, 1e10), B = draw.of_size(1e-8, 1e-2);
    double const h_0 = draw.of_size(1e-9, 1e-3);
    ContactStiffness<Real> const k = bond_stiffness(k_n, E_m, B, h_0);
    ASSERT_TRUE(within(1e-12, k.normal, printed::k_bn(k_n, printed::k_mh(B, E_m, h_0))));
    ASSERT_TRUE(within(1e-12, k.shear, printed::k_bs(k_n, printed::k_mh(B, E_m, h_0))));
    ASSERT_TRUE(within(1e-12, k.rolling, printed::k_bm(B, E_m, h_0)));
  }
}

TEST(BondStiffness, IsNeverMoreThanHalfThatOfAGrain) {
  Draw draw(32);
  for (int n = 0; n < 10000; ++n) {
    ContactStiffness<Real> const k = bond_stiffness(3e8, 2.89e8, draw.of_size(1e-8, 1e-2), draw.of_size(1e-12, 1e-3));
    ASSERT_GT(k.normal, 0);
    ASSERT_LT(k.normal, 1.5e8 * (1 + 1e-15));
  }
}

TEST(BondStiffness, IsZeroForABondOfNoWidthHoweverThin) {
  for (double thickness : {1e-6, 1e-300, 0.0}) {
    ContactStiffness<Real> const k = bond_stiffness(3e8, 2.89e8, 0.0, thickness);
    EXPECT_EQ(k.normal, 0);
    EXPECT_EQ(k.shear, 0);
    EXPECT_EQ(k.rolling, 0);
  }
}

TEST(BondStiffness, LanesGiveTheBitsOfTheScalar) {
  struct Bond {
    double width, thickness;
  };
  Draw draw(33);
  for (int n = 0; n < 20000; ++n) {
    LaneStates<Bond> bonds;
    for (Bond& bond : bonds) bond = {draw.between(0, 1) < 0.1 ? 0 : draw.of_size(1e-8, 1e-3), draw.of_size(1e-9, 1e-3)};
    ContactStiffness<Lanes> const k = bond_stiffness(3e8, 2.89e8, side_by_side(bonds, [](Bond const& b) { return b.width; }),
                                                     side_by_side(bonds, [](Bond const& b) { return b.thickness; }));
    for (int l = 0; l < lane_count; ++l) {
      Bond const& bond = bonds[static_cast<std::size_t>(l)];
      ContactStiffness<Real> const alone = bond_stiffness(3e8, 2.89e8, bond.width, bond.thickness);
      ASSERT_TRUE(same_bits(lane(k.normal, l), alone.normal));
      ASSERT_TRUE(same_bits(lane(k.shear, l), alone.shear));
      ASSERT_TRUE(same_bits(lane(k.rolling, l), alone.rolling));
    }
  }
}

}  // namespace
}  // namespace clathra
