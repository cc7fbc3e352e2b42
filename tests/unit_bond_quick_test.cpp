/// The quick tests of the contact kernel, is_far_from_breaking() and is_surely_intact(), against the exact envelope.
#include <limits>
#include <vector>

#include "draw.hpp"
#include "golden_bonds.hpp"
#include "kernels/bond_quick_test.hpp"
#include "printed_equations.hpp"
#include "printed_number.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

/// The default law, the two other moment lengths, thm strengths, the plate law, rods clamped and scaled, and bounds as tight as a
/// scene may set them.
std::vector<BondLaw> various_laws() {
  std::vector<BondLaw> laws;
  for (long double saturation : {0.21L, 0.26L, 0.41L, 0.55L, 0.70L}) {
    BondLaw law;
    law.critical_thickness = law.thickness_partner = static_cast<double>(printed::critical_thickness(saturation, 0.1694e-3L));
    laws.push_back(law);
    law.least_shape_of_shear = shape_of_shear(law.critical_thickness);  // f_s and f_r fall over these gaps
    law.least_shape_of_rolling = shape_of_rolling(law.critical_thickness);
    laws.push_back(law);
    law.strength.moment_width_ratio = 0;
    law.strength.moment_length = 1;
    laws.push_back(law);
    law.strength.moment_length = 1e-3;
    law.strength.tensile_stress = 1.42648e7;
    laws.push_back(law);
    law.thickness_weight = 0;
    law.plate_thickness = law.thickness_partner = 0.3 * law.critical_thickness;
    laws.push_back(law);
    for (ThicknessMapping const rod : {ThicknessMapping::clamped, ThicknessMapping::scaled}) {
      Scene scene = hydrate_scene(static_cast<double>(saturation), ContactCoupling::replaces);
      scene.bond.thickness_mapping = rod;
      laws.push_back(make_bond_law(scene, grain_d50, law.critical_thickness));
    }
  }
  return laws;
}

bool passes_coarse_test(BondLaw const& law, BondForce<Real> const& bond) {
  return is_far_from_breaking(least_strength(law), bond);
}

/// Forces of any size around the envelope of a bond, often just at it.
BondForce<Real> any_state(Draw& draw, BondLaw const& law) {
  BondForce<Real> bond{};
  bond.thickness = law.bond_thickness(draw.between(-1, 0.1) * law.critical_thickness);
  bond.width = law.width(draw.of_size(2e-5, 4e-4), bond.thickness);
  BondStrength const strength = bond_strength(law.strength, bond.width, bond.thickness);
  bond.force.normal = draw.between(-1.1 * std::fabs(strength.tension), 1.1 * strength.compression);
  double const share = draw.between(0, 1) < 0.5 ? draw.between(0, 1.3) : draw.between(0.98, 1.02),
               angle = draw.between(0, 6.2832);
  bond.force.shear = share * std::cos(angle) * strength.shear(bond.force.normal);
  bond.force.moment = share * std::sin(angle) * strength.rolling(bond.force.normal);
  return bond;
}

TEST(BondQuickTest, NeverPassesABondThatIsBroken) {
  Draw draw(61);
  int broken = 0, intact = 0;
  std::vector<BondLaw> const laws = various_laws();
  for (int n = 0; n < 1000000; ++n) {
    BondLaw const& law = laws[static_cast<std::size_t>(n) % laws.size()];
    BondForce<Real> const bond = any_state(draw, law);
    BondStrength const strength = bond_strength(law.strength, bond.width, bond.thickness);
    BreakMode const mode = strength.test(bond.force.normal, bond.force.shear, bond.force.moment);
    (mode == BreakMode::none ? intact : broken) += 1;
    if (mode == BreakMode::none) continue;
    ASSERT_FALSE(is_surely_intact(law, bond)) << n << ": gap " << bond.thickness << " width " << bond.width << " F_n "
                                              << bond.force.normal << " F_s " << bond.force.shear << " M " << bond.force.moment;
    ASSERT_FALSE(passes_coarse_test(law, bond)) << n << ": gap " << bond.thickness << " width " << bond.width << " F_n "
                                                << bond.force.normal << " F_s " << bond.force.shear << " M " << bond.force.moment;
  }
  EXPECT_GT(broken, 300000);
  EXPECT_GT(intact, 300000);
}

/// As the kernel of mixed precision has it, in single numbers, and the exact test in double precision of those numbers.
struct InSinglePrecision {
  float normal, shear, moment, width, thickness;

  explicit InSinglePrecision(BondForce<Real> const& bond)
      : normal(static_cast<float>(bond.force.normal)),
        shear(static_cast<float>(bond.force.shear)),
        moment(static_cast<float>(bond.force.moment)),
        width(static_cast<float>(bond.width)),
        thickness(static_cast<float>(bond.thickness)) {}

  bool passes_coarse_test(BondLaw const& law) const {
    BondForce<FloatLanes> const bond{{normal, shear, moment}, {0.0F, 0.0F, 0.0F}, width, thickness};
    return lane(is_far_from_breaking(least_strength<float>(law), bond), 0);
  }
  bool holds(BondLaw const& law) const {
    BondStrength const strength = bond_strength(law.strength, static_cast<double>(width), static_cast<double>(thickness));
    return strength.test(static_cast<double>(normal), static_cast<double>(shear), static_cast<double>(moment)) == BreakMode::none;
  }
};

TEST(BondQuickTest, NeverPassesABondThatIsBrokenInMixedPrecision) {
  Draw draw(65);
  int broken = 0, passed = 0;
  std::vector<BondLaw> const laws = various_laws();
  for (int n = 0; n < 1000000; ++n) {
    BondLaw const& law = laws[static_cast<std::size_t>(n) % laws.size()];
    InSinglePrecision const bond(any_state(draw, law));
    bool const holds = bond.holds(law), far = bond.passes_coarse_test(law);
    broken += holds ? 0 : 1;
    passed += far ? 1 : 0;
    ASSERT_TRUE(holds || !far) << n << ": gap " << bond.thickness << " width " << bond.width << " F_n " << bond.normal << " F_s "
                               << bond.shear << " M " << bond.moment;
  }
  EXPECT_GT(broken, 300000);
  EXPECT_GT(passed, 50000);
}

/// Where the trapezoid and the envelope are the same: at the ends, of the thinnest and the thickest bond.
TEST(BondQuickTest, IsRoundedTowardsDoubtInMixedPrecision) {
  Draw draw(66);
  int far = 0;
  for (BondLaw const& law : various_laws()) {
    for (int n = 0; n < 100; ++n) {
      BondForce<Real> bond{};
      bond.thickness = law.bond_thickness(n % 2 == 0 ? 0 : -law.critical_thickness);
      bond.width = law.width(draw.of_size(2e-5, 4e-4), bond.thickness);
      BondStrength const strength = bond_strength(law.strength, bond.width, bond.thickness);
      for (double const end : {-strength.tension, strength.compression}) {
        for (int ulps = -300; ulps <= 300; ++ulps) {
          bond.force.normal = end * (1 + ulps * 0x1p-24);
          InSinglePrecision const single(bond);
          bool const passes = single.passes_coarse_test(law);
          far += passes ? 1 : 0;
          ASSERT_TRUE(!passes || single.holds(law)) << ulps << " ulps from " << end << ", width " << bond.width;
        }
      }
    }
  }
  EXPECT_GT(far, 10000);
}

TEST(BondQuickTest, NeverPassesABondAtTheEndsOfItsEnvelope) {
  Draw draw(62);
  for (BondLaw const& law : various_laws()) {
    for (int n = 0; n < 1000; ++n) {
      BondForce<Real> bond = any_state(draw, law);
      BondStrength const strength = bond_strength(law.strength, bond.width, bond.thickness);
      bond.force.shear = bond.force.moment = 0;
      for (double normal : {-strength.tension, std::nextafter(-strength.tension, -1e9), strength.compression,
                            std::nextafter(strength.compression, 1e9), -1e12, 1e12}) {
        bond.force.normal = normal;
        ASSERT_FALSE(is_surely_intact(law, bond)) << normal;
        ASSERT_FALSE(passes_coarse_test(law, bond)) << normal;
      }
    }
  }
}

TEST(BondQuickTest, SparesNearlyEveryLightlyLoadedBondTheExactTest) {
  Draw draw(63);
  int intact = 0, passed = 0, passed_coarse = 0;
  for (BondLaw const& law : various_laws()) {
    for (int n = 0; n < 10000; ++n) {
      BondForce<Real> bond = any_state(draw, law);
      BondStrength const strength = bond_strength(law.strength, bond.width, bond.thickness);
      if (strength.tension < 50) continue;
      bond.force.normal = draw.between(-0.3 * strength.tension, 0.5 * strength.compression);
      bond.force.shear = draw.between(-0.4, 0.4) * strength.shear(bond.force.normal);
      bond.force.moment = draw.between(-0.4, 0.4) * strength.rolling(bond.force.normal);
      ++intact;
      passed += is_surely_intact(law, bond);
      passed_coarse += passes_coarse_test(law, bond);
    }
  }
  EXPECT_GT(intact, 100000);
  EXPECT_GT(passed, 0.8 * intact);
  EXPECT_GT(passed_coarse, 0.8 * intact);
  EXPECT_LT(passed_coarse, passed);
  RecordProperty("passed_per_mille", static_cast<int>(1000.0 * passed / intact));
}

TEST(BondQuickTest, PassesNoBondWithNanForces) {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  BondLaw const law = various_laws()[0];
  BondForce<Real> bond{{0, 0, 0}, {0, 0, 0}, 3e-5, 0};
  EXPECT_TRUE(is_surely_intact(law, bond));
  EXPECT_TRUE(passes_coarse_test(law, bond));
  for (double ContactForce<Real>::*part :
       {&ContactForce<Real>::normal, &ContactForce<Real>::shear, &ContactForce<Real>::moment}) {
    bond.force = {0, 0, 0};
    bond.force.*part = nan;
    EXPECT_FALSE(is_surely_intact(law, bond));
    EXPECT_FALSE(passes_coarse_test(law, bond));
  }
}

TEST(BondQuickTest, LeastStrengthsLieBelowThoseOfEveryBondButNotFar) {
  Draw draw(64);
  for (BondLaw const& law : various_laws()) {
    LeastStrength const least = least_strength(law);
    for (int n = 0; n < 10000; ++n) {
      double const gap = law.bond_thickness(-draw.between(0, 1) * law.critical_thickness),
                   width = law.width(draw.of_size(2e-5, 4e-4), gap);
      BondStrength const exact = bond_strength(law.strength, width, gap);
      // The trapezoid is 1.28 (F_n + R_t), 0.28 (R_c + R_t) and 2.02 (R_c - F_n), times the slope.
      double const tension = least.rising.of(width) / least.rising_per_normal,
                   compression = least.falling.of(width) / least.falling_per_normal, moment_slope = least.moment.of(width);
      ASSERT_NEAR(least.rising_per_normal, 1.28 * least.shear_slope, 1e-15);
      ASSERT_NEAR(least.falling_per_normal, 2.02 * least.shear_slope, 1e-15);
      ASSERT_NEAR(least.flat.of(width), 0.28 * least.shear_slope * (compression + tension),
                  1e-12 * (compression + lane_abs(tension)));
      ASSERT_LT(tension, exact.tension);
      ASSERT_LT(compression, exact.compression);
      ASSERT_LT(least.shear_slope, exact.shear_slope);
      ASSERT_LE(moment_slope, exact.moment_slope);
      ASSERT_TRUE(moment_slope < exact.moment_slope || exact.moment_slope == 0);
      double const range = rod_thickness(law.strength, law.critical_thickness) * share_of_addends(law.strength, width);
      ASSERT_GT(tension, exact.tension - 2.7e5 * range - 1e-5);
      ASSERT_GT(compression, exact.compression - 4.2e6 * range - 1e-5);
      ASSERT_GT(least.shear_slope, 0.45 * exact.shear_slope);
      ASSERT_GE(moment_slope, 0.45 * exact.moment_slope);
    }
  }
}

}  // namespace
}  // namespace clathra
