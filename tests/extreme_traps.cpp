/// The numerical traps of Jiang et al.'s (2017) bond and contact laws, each at the value that triggers it. The numbers in the
/// names are those of the project's table of traps; the ones left out concern the state of the hydrate.
#include <limits>

#include "extreme_rows.hpp"
#include "golden_bonds.hpp"
#include "kernels/bond_quick_test.hpp"
#include "printed_equations.hpp"
#include "printed_number.hpp"

namespace clathra {
namespace {

constexpr double micrometre = 1e-6, r = golden::radius;
constexpr double saturations[] = {26, 41, 55};

/// A bond between equal discs by the printed strength, R_r on the scale of the width.
BondStrength bond_of(double radius, double h_max, double gap) {
  return bond_strength(BondStrengthLaw{}, bond_width(radius, h_max - gap), gap);
}
BondStrength bond_at(double saturation) { return bond_of(r, h_max_of(saturation), 0); }

BondLaw law_with(double h_max) {
  BondLaw law;
  law.critical_thickness = law.thickness_partner = h_max;
  return law;
}

/// A bond made at an overlap, unloaded.
BondForce<Real> resting_bond(BondLaw const& law, double radius, double overlap) {
  return bond_contact(law, ContactMotion<Real>{overlap, 0, 0, 0, radius}, overlap, law.width_formed_at(radius, overlap), 0.0,
                      0.0);
}

TEST(Trap01, LogarithmBeyondCompressionIsNeverTaken) {
  double const limits[] = {3442, 4036.5, 4294.4};
  for (int n = 0; n < 3; ++n) {
    BondStrength const bond = bond_at(saturations[n]);
    for (double normal : {limits[n] + 0.1, 1e4, 1e9, 1e300}) {
      EXPECT_EQ(bond.test(normal, 0, 0), BreakMode::compression);
      EXPECT_EQ(bond.shear(normal), 0);
      EXPECT_EQ(bond.rolling(normal), 0);
    }
    EXPECT_EQ(bond.test(limits[n] - 0.2, 0, 0), BreakMode::none);
  }
}

TEST(Trap02, LogarithmBeyondTensionIsNeverTaken) {
  double const limits[] = {356, 684.6, 827.14};
  for (int n = 0; n < 3; ++n) {
    BondStrength const bond = bond_at(saturations[n]);
    for (double normal : {-limits[n] - 0.05, -1e4, -1e9, -1e300}) {
      EXPECT_EQ(bond.test(normal, 0, 0), BreakMode::tension);
      EXPECT_EQ(bond.shear(normal), 0);
      EXPECT_EQ(bond.rolling(normal), 0);
    }
    EXPECT_EQ(bond.test(-limits[n] + 0.05, 0, 0), BreakMode::none);
  }
}

TEST(Trap03, ExactlyTheTensileStrengthBreaksInTension) {
  for (double saturation : saturations) {
    BondStrength const bond = bond_at(saturation);
    EXPECT_EQ(bond.test(-bond.tension, 0, 0), BreakMode::tension);
    EXPECT_EQ(bond.shear(-bond.tension), 0);
    EXPECT_EQ(bond.rolling(-bond.tension), 0);
  }
}

TEST(Trap04, ABondWithoutTensileStrengthShowsItBySignAndCarriesNothing) {
  BondStrengthLaw const law;
  EXPECT_GT(tensile_strength(law, 11.275 * micrometre, 0.0), 0);
  EXPECT_LT(tensile_strength(law, 11.273 * micrometre, 0.0), 0);
  double const last_gap[] = {3.5695, 10.4119, 14.5476};
  for (int n = 0; n < 3; ++n) {
    double const h_max = h_max_of(saturations[n]);
    EXPECT_GT(bond_of(r, h_max, (last_gap[n] - 0.0001) * micrometre).tension, 0);
    BondStrength const beyond = bond_of(r, h_max, (last_gap[n] + 0.0001) * micrometre);
    EXPECT_LT(beyond.tension, 0);
    EXPECT_EQ(beyond.test(0, 0, 0), BreakMode::tension);
  }
}

TEST(Trap05, BondsOfFinesHaveNoTensileStrength) {
  double const h_max[] = {h_max_of(26), h_max_of(41), h_max_of(20.0000001)}, least_radius[] = {9.05, 5.64, 62.5};
  for (int n = 0; n < 3; ++n) {
    EXPECT_GT(bond_of(1.01 * least_radius[n] * micrometre, h_max[n], 0).tension, 0);
    EXPECT_LT(bond_of(0.99 * least_radius[n] * micrometre, h_max[n], 0).tension, 0);
  }
  // At 55 % the bond of these fines would be wider than the disc. Cut to its width, it needs discs of 11.274 / 2 micrometres.
  EXPECT_GT(bond_of(5.638 * micrometre, h_max_of(55), 0).tension, 0);
  EXPECT_LT(bond_of(5.636 * micrometre, h_max_of(55), 0).tension, 0);
  expect_row("a bond at R_t <= 0, which is not formed", "R_t of particles of 5 um at 55 % [N/m]",
             bond_of(5 * micrometre, h_max_of(55), 0).tension, -1e99, 0);
}

TEST(Trap06, ABondOfThickGapsWithoutCompressiveStrengthBreaksUnloaded) {
  double const width = 1e-3, last_gap = 0.6e-3 + 6.15 * width;
  BondStrengthLaw const law;
  EXPECT_GT(compressive_strength(law, width, last_gap * 0.999), 0);
  EXPECT_LT(compressive_strength(law, width, last_gap * 1.001), 0);
  BondStrength const crushed = bond_strength(law, width, last_gap * 1.001);
  EXPECT_EQ(crushed.test(0, 0, 0), BreakMode::compression);
  BondStrength const nothing{-100, 50, 0.7, 1e-6};  // R_c + R_t < 0
  for (double normal : {-200.0, 0.0, 49.0, 75.0, 100.0, 200.0}) {
    EXPECT_EQ(nothing.shear(normal), 0);
    EXPECT_EQ(nothing.rolling(normal), 0);
    EXPECT_NE(nothing.test(normal, 0, 0), BreakMode::none);
  }
}

TEST(Trap07, ANegativeSlopeOfTheEnvelopeIsNoStrength) {
  EXPECT_GT(rolling_slope(5.670e-3), 0);
  EXPECT_EQ(rolling_slope(5.672e-3), 0);
  EXPECT_GT(shear_slope(6.713e-3), 0);
  EXPECT_EQ(shear_slope(6.715e-3), 0);
  // Gravel of 80 mm, R_t and R_c > 0: the squares of negative slopes would pass as strength.
  BondLaw law = law_with(8e-3);
  for (double gap : {6e-3, 7e-3}) {
    BondForce<Real> const bond = resting_bond(law, 40e-3, -gap);
    BondStrength const strength = bond_strength(law.strength, bond.width, bond.thickness);
    ASSERT_GT(strength.tension, 0);
    ASSERT_GT(strength.compression, 0);
    EXPECT_NE(strength.test(0, 0, 0), BreakMode::none);
    EXPECT_FALSE(is_surely_intact(law, bond));
    EXPECT_FALSE(is_far_from_breaking(least_strength(law), bond));
  }
}

TEST(Trap08, APairFartherThanTheCriticalThicknessHasNoBondWidth) {
  for (double gap : {1.0000001, 2.0, 1e6}) EXPECT_EQ(bond_width(r, h_max_of(41) * (1 - gap)), 0);
}

TEST(Trap09, AtTheCriticalThicknessAllIsZeroAndTensionNegative) {
  char const* const tension[] = {"-159.15", "-157.32", "-156.22"};
  for (int n = 0; n < 3; ++n) {
    double const h_max = h_max_of(saturations[n]);
    BondForce<Real> const bond = resting_bond(law_with(h_max), r, -h_max);
    EXPECT_EQ(bond.width, 0);
    EXPECT_EQ(bond.stiffness.normal, 0);
    EXPECT_EQ(bond.stiffness.shear, 0);
    EXPECT_EQ(bond.stiffness.rolling, 0);
    EXPECT_TRUE(agrees(bond_of(r, h_max, h_max).tension, tension[n]));
  }
}

TEST(Trap10, WidthOfAVeryNarrowBondKeepsItsDigits) {
  for (double room = 1e-6; room > 1e-30; room *= 0.1) {
    long double const exact = std::sqrt(static_cast<long double>(room) * (4 * static_cast<long double>(r) - room));
    EXPECT_TRUE(within(1e-15, bond_width(r, room), exact)) << room;
  }
  double const room = 1e-12, as_printed = std::sqrt(4 * r * r - (2 * r - room) * (2 * r - room));
  EXPECT_FALSE(within(1e-10, as_printed, bond_width(r, room)));  // why the printed form is not used
}

TEST(Trap11, ABondIsNeverWiderThanItsDiscs) {
  double const plateau = 16.94 * micrometre;
  for (double radius : {8.46e-6, 5e-6, 1e-6}) {
    EXPECT_EQ(bond_width(radius, plateau), 2 * radius);
    long double const exact = 1.0L * radius * (plateau + 2.0L * radius - 3.14159265358979323846L * radius);
    EXPECT_TRUE(within(1e-14, bond_area(radius, 2 * radius, 0, plateau), exact));
  }
  EXPECT_LT(bond_width(8.48e-6, plateau), 2 * 8.48e-6);
}

TEST(Trap12, AreaOfANarrowBondKeepsItsDigits) {
  for (double share = 1e-3; share > 1e-13; share *= 0.1) {
    double const width = r * share, h_max = width * width / (4 * r);  // to first order the room of this width
    long double const q = 1.0L * share * share;
    long double const series = 0.5L * h_max * width - 1.0L * width * r * q * (1 / 24.0L + q * 3 / 640.0L);
    EXPECT_TRUE(within(1e-14, bond_area(r, width, 0, h_max), series)) << share;
  }
  double const width = 1e-5 * r, h_max = width * width / (4 * r);
  double const printed = 0.5 * h_max * width + width * r - 2 * r * r * std::atan(width / std::sqrt(4 * r * r - width * width));
  EXPECT_FALSE(within(1e-7, printed, bond_area(r, width, 0, h_max)));  // why the printed form is not used
}

TEST(Trap13, ABondOfNoThicknessDividesNothingByZero) {
  BondLaw const law = law_with(0);
  BondForce<Real> const bond = resting_bond(law, r, 0);
  EXPECT_EQ(bond.width, 0);
  EXPECT_EQ(bond.stiffness.normal, 0);
  EXPECT_EQ(bond.stiffness.shear, 0);
  EXPECT_EQ(bond.stiffness.rolling, 0);
  EXPECT_EQ(bond.force.normal, 0);
  EXPECT_FALSE(is_surely_intact(law, bond));
  EXPECT_FALSE(is_far_from_breaking(least_strength(law), bond));
}

TEST(Trap14, ABondOnAnOverlapCountsAsOneWithoutGap) {
  BondLaw const law = law_with(h_max_of(26));
  BondForce<Real> const touching = resting_bond(law, r, 0);
  for (double overlap : {1e-9, 3.94e-6, 8e-6, 2e-5}) {  // more than h_max = 3.94 micrometres too
    BondForce<Real> const pressed = resting_bond(law, r, overlap);
    EXPECT_EQ(pressed.thickness, 0);
    EXPECT_EQ(pressed.width, touching.width);
    EXPECT_EQ(pressed.stiffness.normal, touching.stiffness.normal);
    EXPECT_EQ(pressed.stiffness.shear, touching.stiffness.shear);
    EXPECT_EQ(pressed.stiffness.rolling, touching.stiffness.rolling);
    EXPECT_EQ(pressed.force.normal, 0);
  }
}

TEST(Trap15, StiffnessStaysBoundedWhileTheHydrateLayerVanishes) {
  for (double h_max = 1e-6; h_max > 1e-40; h_max *= 0.1) {
    BondForce<Real> const bond = resting_bond(law_with(h_max), r, 0);
    double const k_mh = 12 * bond.stiffness.rolling / (bond.width * bond.width);
    EXPECT_TRUE(within(h_max / r + 1e-14, k_mh, 4 * 2.89e8L * std::sqrt(1.0L * r / h_max))) << h_max;
    EXPECT_LT(bond.stiffness.normal, 1.5e8 * (1 + 1e-15));
    EXPECT_GT(bond.stiffness.normal, 1.4e8);
  }
  EXPECT_TRUE(within(1e-12, resting_bond(law_with(1e-40), r, 0).stiffness.normal, 1.5e8));
  // Just above 20 % the bonds are thin and narrow, and still softer in rolling than the grains: no smaller time step.
  BondForce<Real> const thin = resting_bond(law_with(h_max_of(20.0000001)), r, 0);
  EXPECT_NEAR(thin.width, 13e-6, 0.2e-6);
  EXPECT_LT(thin.stiffness.rolling, rolling_stiffness(GrainLaw{}, r));
}

TEST(Trap18, AGapInMillimetresGivesNoStrengthInsteadOfNonsense) {
  for (double gap : {0.0168, 1.0, 16.8, 1e300}) {
    EXPECT_EQ(shape_of_shear(gap), 2.05);
    EXPECT_EQ(shape_of_rolling(gap), 2.05);
    EXPECT_EQ(shear_slope(gap), 0);
    EXPECT_EQ(rolling_slope(gap), 0);
  }
  EXPECT_NE(bond_strength(BondStrengthLaw{}, 1e-2, 1.0).test(0, 0, 0), BreakMode::none);
}

TEST(Trap21, WithoutStressOnlyTheOffsetsAreLeftAndTheBondIsBrokenUnloaded) {
  BondStrength const bond = bond_strength(BondStrengthLaw{0, 0, 0, 1.0 / 14}, 70e-6, 0.0);
  EXPECT_EQ(bond.tension, -160.2);
  EXPECT_EQ(bond.compression, 2508);
  EXPECT_EQ(bond.test(0, 0, 0), BreakMode::tension);
  EXPECT_EQ(bond.test(160.2, 0, 0), BreakMode::tension);
  EXPECT_EQ(bond.test(-1000, 0, 0), BreakMode::tension);
}

TEST(Trap22, FrictionOfADampedContactIsNotTakenFromATensileForce) {
  GrainLaw const law;
  for (double overlap : {1e-9, -1e-9, 0.0}) {
    ContactMotion<Real> const parting{overlap, -10, 1e-7, 1e-3, r};
    ContactForce<Real> const force = grain_contact<true>(law, parting, 1.0, 1e-5, 1e4);
    EXPECT_EQ(force.normal, 0);
    EXPECT_EQ(force.shear, 0);
    EXPECT_EQ(force.moment, 0);
  }
}

TEST(Trap23, NothingIsDividedByTheVanishingStrengthAtTheEnds) {
  for (double saturation : saturations) {
    BondStrength const bond = bond_at(saturation);
    for (double distance : {1e-3, 1e-9, 1e-12}) {
      for (double normal : {-bond.tension + distance, bond.compression - distance}) {
        EXPECT_TRUE(std::isfinite(bond.shear(normal)) && bond.shear(normal) >= 0);
        EXPECT_EQ(bond.test(normal, 1e3, 0), BreakMode::shear);
        EXPECT_EQ(bond.test(normal, 0, 1e3), BreakMode::rolling);
        EXPECT_EQ(bond.test(normal, 1e150, 1.0), BreakMode::shear);
      }
    }
  }
}

TEST(Trap24, CommonRadiusIsGuardedAtZeroAndTwiceTheRadiusAtAWall) {
  EXPECT_EQ(common_radius(0.0, 0.0), 0);
  EXPECT_EQ(common_radius(r, 0.0), 0);
  EXPECT_TRUE(within(1e-12, common_radius(r, 1e-18), 2e-18L));
  EXPECT_TRUE(within(1e-12, common_radius(r, 1e9 * 1e3 * r), 2.0L * r));  // a disc so large that it is a wall
  ContactMotion<Real> const point{1e-9, 0, 0, 1, common_radius(r, 0.0)};
  EXPECT_EQ(grain_contact<true>(GrainLaw{}, point, 0.0, 0.0, 0.0).moment, 0);
  EXPECT_EQ(bond_area(0, 0, 0, 1e-6), 0);
}

TEST(Trap25, AStrengthThatFallsBelowThePresentTensionIsANormalTensileBreak) {
  BondLaw law = law_with(h_max_of(55));
  ContactMotion<Real> const stretched{-4.5e-6, 0, 0, 0, r};
  BondForce<Real> const bond = bond_contact(law, stretched, 0.0, law.width_formed_at(r, 0.0), 0.0, 0.0);
  auto const mode = [&] {
    return bond_strength(law.strength, bond.width, bond.thickness).test(bond.force.normal, bond.force.shear, bond.force.moment);
  };
  EXPECT_EQ(mode(), BreakMode::none);
  EXPECT_TRUE(is_surely_intact(law, bond));
  EXPECT_TRUE(is_far_from_breaking(least_strength(law), bond));
  law.strength.tensile_stress *= 0.88;  // the hydrate warms
  EXPECT_EQ(mode(), BreakMode::none);
  law.strength.tensile_stress *= 0.88;
  EXPECT_EQ(mode(), BreakMode::tension);
  EXPECT_FALSE(is_surely_intact(law, bond));
  EXPECT_FALSE(is_far_from_breaking(least_strength(law), bond));
}

}  // namespace
}  // namespace clathra
