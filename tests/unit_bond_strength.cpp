#include "draw.hpp"
#include "golden_bonds.hpp"
#include "kernels/bond_geometry.hpp"
#include "kernels/bond_strength.hpp"
#include "printed_equations.hpp"
#include "printed_number.hpp"

namespace clathra {
namespace {

/// The strength as printed: Eq. 15, and R_r / L_r in the place of R_r.
constexpr BondStrengthLaw printed_law{1.421e7, 2.571e7, 1, 0};

BondStrength strength_of(double saturation, double share) {
  double const h_max = h_max_of(saturation), gap = share * h_max;
  return bond_strength(printed_law, bond_width(golden::radius, h_max - gap), gap);
}

/// A bond of any size with R_t > 0.
struct AnyBond {
  double width, gap;
  BondStrength strength;
};
AnyBond any_bond(Draw& draw) {
  AnyBond bond{};
  do {
    bond.width = draw.of_size(1e-5, 1e-3);
    bond.gap = draw.between(0, 2e-5);
    bond.strength = bond_strength(printed_law, bond.width, bond.gap);
  } while (bond.strength.tension < 1);
  return bond;
}

TEST(BondStrength, HasTheTensionAndCompressionOfTheTable) {
  for (golden::Bond const& bond : golden::bonds) {
    SCOPED_TRACE(testing::Message() << "S = " << bond.saturation << " %, h/h_max = " << bond.share);
    BondStrength const strength = strength_of(bond.saturation, bond.share);
    EXPECT_TRUE(agrees(strength.tension, bond.R_t));
    EXPECT_TRUE(agrees(strength.compression, bond.R_c));
  }
}

TEST(BondStrength, HasTheEnvelopeOfTheTable) {
  for (golden::Envelope const& row : golden::envelopes) {
    SCOPED_TRACE(testing::Message() << "S = " << row.saturation << " %, h/h_max = " << row.share);
    BondStrength const strength = strength_of(row.saturation, row.share);
    EXPECT_TRUE(agrees(strength.shear(-strength.tension / 2), row.shear_half_tension));
    EXPECT_TRUE(agrees(strength.shear(0), row.shear_0));
    EXPECT_TRUE(agrees(strength.shear(100), row.shear_100));
    EXPECT_TRUE(agrees(strength.shear(200), row.shear_200));
    EXPECT_TRUE(agrees(strength.shear(500), row.shear_500));
    EXPECT_TRUE(agrees(strength.shear(1000), row.shear_1000));
    EXPECT_TRUE(agrees(strength.shear(strength.compression / 2), row.shear_half_compression));
    EXPECT_TRUE(agrees(strength.rolling(0), row.rolling_0));
    EXPECT_TRUE(agrees(strength.rolling(200), row.rolling_200));
    EXPECT_TRUE(agrees(strength.rolling(1000), row.rolling_1000));
    double const peak = std::exp(-0.59) * (strength.compression + strength.tension) - strength.tension;
    EXPECT_TRUE(agrees(peak, row.normal_at_peak));
    EXPECT_TRUE(agrees(strength.shear(peak), row.shear_peak));
    EXPECT_TRUE(agrees(strength.rolling(peak), row.rolling_peak));
  }
}

TEST(BondStrength, HasTheNumbersOfTheUnequalPair) {
  double const width = bond_width(common_radius(golden::unequal_r1, golden::unequal_r2), h_max_of(41) - golden::unequal_gap);
  BondStrength const strength = bond_strength(printed_law, width, golden::unequal_gap);
  EXPECT_TRUE(agrees(strength.tension, golden::unequal.R_t));
  EXPECT_TRUE(agrees(strength.compression, golden::unequal.R_c));
  EXPECT_TRUE(agrees(shape_of_shear(golden::unequal_gap), "1.812"));
  EXPECT_TRUE(agrees(shear_slope(golden::unequal_gap), "0.4099"));
  EXPECT_TRUE(agrees(shape_of_rolling(golden::unequal_gap), "1.804"));
  EXPECT_TRUE(agrees(rolling_slope(golden::unequal_gap), "0.8297"));
}

TEST(BondStrength, HasThePrintedShapesAndSlopes) {
  for (golden::Slopes const& row : golden::slopes) {
    SCOPED_TRACE(row.gap);
    EXPECT_TRUE(agrees(shape_of_shear(row.gap * 1e-3), row.f_s));
    EXPECT_TRUE(agrees(shear_slope(row.gap * 1e-3), row.K_s));
    EXPECT_TRUE(agrees(shape_of_rolling(row.gap * 1e-3), row.f_r));
    EXPECT_TRUE(agrees(rolling_slope(row.gap * 1e-3), row.K_r));
  }
}

TEST(BondStrength, OffsetsAreTheSlopesTimesThePrintedThicknessOfTheRods) {
  BondStrengthLaw const no_stress{0, 0, 0, 0};
  EXPECT_EQ(tensile_strength(no_stress, 1e-3, 0.0), -160.2);
  EXPECT_EQ(compressive_strength(no_stress, 1e-3, 0.0), 2508.0);
  EXPECT_NEAR(tensile_strength(no_stress, 1e-3, 0.6e-3), 0, 1e-12);
  EXPECT_NEAR(compressive_strength(no_stress, 1e-3, 0.6e-3), 0, 1e-12);
}

TEST(BondStrength, ShapesAreLeastAtTheirPrintedMinimum) {
  for (double gap = 0; gap < 6e-3; gap += 1e-6) {
    ASSERT_GE(shape_of_shear(gap), 1.16 * (1 - 1e-15));
    ASSERT_GE(shape_of_rolling(gap), 1.13 * (1 - 1e-15));
    ASSERT_LE(shape_of_shear(gap), 2.05);
    ASSERT_LE(shape_of_rolling(gap), 2.05);
  }
}

TEST(BondStrength, MomentLengthIsAConstantOrAShareOfTheWidth) {
  EXPECT_EQ(moment_length(BondStrengthLaw{0, 0, 1, 0}, 7e-5), 1);
  EXPECT_EQ(moment_length(BondStrengthLaw{0, 0, 1e-3, 0}, 7e-5), 1e-3);
  EXPECT_TRUE(within(1e-15, moment_length(BondStrengthLaw{}, 7e-5), 5e-6L));
  BondStrength const strength = bond_strength(BondStrengthLaw{}, 7e-5, 0.0);
  BondStrength const per_length = bond_strength(printed_law, 7e-5, 0.0);
  EXPECT_TRUE(within(1e-15, strength.rolling(200), per_length.rolling(200) * 5e-6L));
}

TEST(BondStrength, AgreesWithThePrintedEquationsForAnyBond) {
  Draw draw(41);
  for (int n = 0; n < 100000; ++n) {
    auto const [B, h, strength] = any_bond(draw);
    ASSERT_TRUE(within(1e-12, strength.tension, printed::R_t(B, h)));
    ASSERT_TRUE(within(1e-12, strength.compression, printed::R_c(B, h)));
    ASSERT_TRUE(within(1e-12, strength.shear_slope, printed::f_s(h) * printed::K_s(h)));
    ASSERT_TRUE(within(1e-12, strength.moment_slope, printed::f_r(h) * printed::K_r(h)));
    double const F_n = draw.between(0.002, 0.998) * (strength.compression + strength.tension) - strength.tension;
    ASSERT_TRUE(within(1e-12, strength.shear(F_n), printed::R_s(F_n, B, h))) << B << " " << h << " " << F_n;
    ASSERT_TRUE(within(1e-12, strength.rolling(F_n), printed::R_r(F_n, B, h))) << B << " " << h << " " << F_n;
  }
}

TEST(BondStrength, EnvelopePeaksWhereItsSlopeVanishes) {
  double const x = std::exp(-0.59);
  EXPECT_TRUE(agrees(x, "0.55433"));
  EXPECT_TRUE(agrees(envelope_shape(x), "0.40604"));
  for (double step : {1e-3, 1e-2, 0.1, 0.3}) {
    EXPECT_LT(envelope_shape(x - step), envelope_shape(x));
    EXPECT_LT(envelope_shape(x + step), envelope_shape(x));
  }
  // To the left and to the right of a smooth peak the loss is the same, up to the third order.
  double const h = 1e-3, left = envelope_shape(x) - envelope_shape(x - h), right = envelope_shape(x) - envelope_shape(x + h);
  EXPECT_NEAR(left / right, 1, 10 * h);
}

TEST(BondStrength, EnvelopeClosesAtBothEnds) {
  for (double x : {0.0, 1.0, -1.0, 2.0, -0.0}) EXPECT_EQ(envelope_shape(x), 0) << x;
  EXPECT_GT(envelope_shape(1e-300), 0);
  EXPECT_GT(envelope_shape(std::nextafter(1.0, 0.0)), 0);
  EXPECT_LT(envelope_shape(1e-12), 1e-10);
  EXPECT_LT(envelope_shape(1 - 1e-12), 1e-6);
}

TEST(BondStrength, BreaksOnAnEllipseAtFixedNormalForce) {
  BondStrength const strength = bond_strength(BondStrengthLaw{}, 7e-5, 1e-6);
  for (double normal : {-400.0, -1.0, 0.0, 300.0, 2000.0, 4000.0}) {
    double const R_s = strength.shear(normal), R_r = strength.rolling(normal);
    for (int degrees = 0; degrees < 360; degrees += 5) {
      double const angle = degrees * 3.141592653589793 / 180, shear = R_s * std::cos(angle), moment = R_r * std::sin(angle);
      EXPECT_EQ(strength.test(normal, 0.999999 * shear, 0.999999 * moment), BreakMode::none) << normal << " " << degrees;
      BreakMode const mode = strength.test(normal, 1.000001 * shear, 1.000001 * moment);
      if (degrees % 90 == 45) continue;  // shear and rolling are level
      bool const mostly_shear = degrees % 180 < 45 || degrees % 180 > 135;
      EXPECT_EQ(mode, mostly_shear ? BreakMode::shear : BreakMode::rolling) << normal << " " << degrees;
    }
  }
}

TEST(BondStrength, BreaksAtTheLimitItselfAndNotBeforeIt) {
  BondStrength const strength = bond_strength(BondStrengthLaw{}, 7e-5, 0.0);
  double const R_t = strength.tension, R_c = strength.compression;
  EXPECT_EQ(strength.test(0, 0, 0), BreakMode::none);
  EXPECT_EQ(strength.test(-R_t, 0, 0), BreakMode::tension);
  EXPECT_EQ(strength.test(std::nextafter(-R_t, 0.0), 0, 0), BreakMode::none);
  EXPECT_EQ(strength.test(R_c, 0, 0), BreakMode::compression);
  EXPECT_EQ(strength.test(R_c * (1 - 1e-15), 0, 0), BreakMode::none);
  double const R_s = strength.shear(100), R_r = strength.rolling(100);
  EXPECT_EQ(strength.test(100, R_s * (1 - 1e-14), 0), BreakMode::none);
  EXPECT_EQ(strength.test(100, -R_s * (1 + 1e-14), 0), BreakMode::shear);
  EXPECT_EQ(strength.test(100, 0, -R_r * (1 - 1e-14)), BreakMode::none);
  EXPECT_EQ(strength.test(100, 0, R_r * (1 + 1e-14)), BreakMode::rolling);
}

TEST(BondStrength, DoesNotSeeTheSignsOfShearAndMoment) {
  Draw draw(42);
  for (int n = 0; n < 100000; ++n) {
    BondStrength const strength = any_bond(draw).strength;
    double const normal = draw.between(-1.1 * strength.tension, 1.1 * strength.compression);
    double const shear = draw.between(0, 1.2) * strength.shear(normal), moment = draw.between(0, 1.2) * strength.rolling(normal);
    BreakMode const mode = strength.test(normal, shear, moment);
    ASSERT_EQ(strength.test(normal, -shear, moment), mode);
    ASSERT_EQ(strength.test(normal, shear, -moment), mode);
    ASSERT_EQ(strength.test(normal, -shear, -moment), mode);
  }
}

TEST(BondStrength, LowerBoundStaysBelowTheExactEnvelopeAndCloseToIt) {
  double deepest = 0;
  for (int n = 1; n < 400000; ++n) {
    double const x = n / 400000.0, exact = envelope_shape(x), bound = envelope_lower_bound(x, 1.0);
    ASSERT_LE(bound, exact) << x;
    if (x >= 0.05 && x <= 0.95) deepest = std::max(deepest, 1 - bound / exact);
  }
  EXPECT_LT(deepest, 0.15);
  for (double x = 1e-3; x > 1e-300; x *= 0.5) ASSERT_LE(envelope_lower_bound(x, 1.0), envelope_shape(x)) << x;
  for (double x = 1e-3; x > 1e-15; x *= 0.5) ASSERT_LE(envelope_lower_bound(1 - x, 1.0), envelope_shape(1 - x)) << x;
}

TEST(BondStrength, LowerBoundScalesWithTheEnvelopeAndIsNegativeOutside) {
  EXPECT_TRUE(within(1e-14, envelope_lower_bound(0.3 * 5000, 5000.0), 5000 * envelope_lower_bound(0.3, 1.0)));
  EXPECT_LT(envelope_lower_bound(-1.0, 5000.0), 0);
  EXPECT_LT(envelope_lower_bound(5001.0, 5000.0), 0);
  EXPECT_LE(envelope_lower_bound(0.0, 5000.0), 0);
  EXPECT_LE(envelope_lower_bound(5000.0, 5000.0), 0);
}

TEST(BondStrength, LanesGiveTheBitsOfTheScalar) {
  Draw draw(43);
  for (int n = 0; n < 20000; ++n) {
    LaneStates<AnyBond> bonds;
    for (AnyBond& bond : bonds) bond = any_bond(draw);
    Lanes const width = side_by_side(bonds, [](AnyBond const& b) { return b.width; });
    Lanes const gap = side_by_side(bonds, [](AnyBond const& b) { return b.gap; });
    BondStrengthLaw const law;
    Lanes const tension = tensile_strength(law, width, gap), scale = compressive_strength(law, width, gap) + tension;
    Lanes const of_shear = shear_slope(gap), of_rolling = rolling_slope(gap), length = moment_length(law, width);
    Lanes const bound = envelope_lower_bound(tension, scale);
    for (int l = 0; l < lane_count; ++l) {
      AnyBond const& bond = bonds[static_cast<std::size_t>(l)];
      double const alone = tensile_strength(law, bond.width, bond.gap);
      double const alone_scale = compressive_strength(law, bond.width, bond.gap) + alone;
      ASSERT_TRUE(same_bits(lane(tension, l), alone));
      ASSERT_TRUE(same_bits(lane(scale, l), alone_scale));
      BondStrength const exact = bond_strength(law, bond.width, bond.gap);  // side by side: here a compiler may fuse them
      ASSERT_TRUE(same_bits(exact.tension, alone));
      ASSERT_TRUE(same_bits(exact.compression + exact.tension, alone_scale));
      ASSERT_TRUE(same_bits(lane(of_shear, l), shear_slope(bond.gap)));
      ASSERT_TRUE(same_bits(lane(of_rolling, l), rolling_slope(bond.gap)));
      ASSERT_TRUE(same_bits(lane(length, l), moment_length(law, bond.width)));
      ASSERT_TRUE(same_bits(lane(bound, l), envelope_lower_bound(alone, alone_scale)));
    }
  }
}

}  // namespace
}  // namespace clathra
