#include "draw.hpp"
#include "golden_bonds.hpp"
#include "kernels/bond_quick_test.hpp"
#include "printed_equations.hpp"
#include "printed_number.hpp"

namespace clathra {
namespace {

/// The thickness-dependent law of the paper at a saturation [%], with R_r on the scale of the bond width.
BondLaw law_at(double saturation) {
  BondLaw law;
  law.critical_thickness = law.thickness_partner = h_max_of(saturation);
  return law;
}

/// A bond made at some overlap and loaded since then.
struct Bond {
  ContactMotion<Real> motion;
  double formation_overlap, shear, moment;
};

BondForce<Real> force_of(BondLaw const& law, Bond const& bond) {
  double const width = law.width_formed_at(bond.motion.common_radius, bond.formation_overlap);
  return bond_contact(law, bond.motion, bond.formation_overlap, width, bond.shear, bond.moment);
}

BreakMode test_of(BondLaw const& law, BondForce<Real> const& bond) {
  return bond_strength(law.strength, bond.width, bond.thickness).test(bond.force.normal, bond.force.shear, bond.force.moment);
}

/// The last intact and the first broken state of a bond that is loaded by the same small motion again and again.
struct Failure {
  BreakMode mode;
  BondForce<Real> before, at;
  BondStrength strength;
};
Failure load_until_broken(BondLaw const& law, Bond bond, double stretch, double shear_increment, double relative_rotation) {
  Failure failure{};
  failure.at = force_of(law, bond);
  failure.strength = bond_strength(law.strength, failure.at.width, failure.at.thickness);
  for (int step = 0; step < 1000000; ++step) {
    bond.motion.overlap -= stretch;
    bond.motion.shear_increment = shear_increment;
    bond.motion.relative_rotation = relative_rotation;
    failure.before = failure.at;
    failure.at = force_of(law, bond);
    bond.shear = failure.at.force.shear;
    bond.moment = failure.at.force.moment;
    failure.mode = test_of(law, failure.at);
    if (failure.mode != BreakMode::none) break;
  }
  return failure;
}

Bond resting(double overlap) { return {{overlap, 0, 0, 0, golden::radius}, overlap, 0, 0}; }

TEST(BondLaw, IsFreeOfStressWhereItWasMade) {
  for (double overlap : {0.0, 1e-6, -1e-6, -3e-6}) {
    BondForce<Real> const bond = force_of(law_at(26), resting(overlap));
    EXPECT_EQ(bond.force.normal, 0);
    EXPECT_EQ(bond.force.shear, 0);
    EXPECT_EQ(bond.force.moment, 0);
  }
}

TEST(BondLaw, HasTheGeometryAndStiffnessOfTheTable) {
  for (golden::Bond const& row : golden::bonds) {
    SCOPED_TRACE(testing::Message() << "S = " << row.saturation << " %, h/h_max = " << row.share);
    BondLaw const law = law_at(row.saturation);
    BondForce<Real> const bond = force_of(law, resting(-row.share * law.critical_thickness));
    EXPECT_TRUE(agrees(bond.thickness * 1e6, row.gap));
    EXPECT_TRUE(agrees(bond.width * 1e6, row.width));
    EXPECT_TRUE(agrees(bond.stiffness.normal, row.k_bn));
    EXPECT_TRUE(agrees(bond.stiffness.shear, row.k_bs));
    EXPECT_TRUE(agrees(bond.stiffness.rolling, row.k_bm));
  }
}

TEST(BondLaw, PushesAndPullsByItsStiffnessAcrossAGapAndInContact) {
  BondLaw const law = law_at(55);
  for (double made_at : {-5e-6, 0.0, 2e-6}) {
    double const k_bn = force_of(law, resting(made_at)).stiffness.normal;
    for (double change : {-3e-6, 1e-9, 4e-6}) {
      Bond bond = resting(made_at);
      bond.motion.overlap += change;
      EXPECT_TRUE(within(1e-9, force_of(law, bond).force.normal, static_cast<long double>(k_bn) * change));
    }
  }
}

TEST(BondLaw, AddsSlipAndTurnByItsStiffness) {
  Bond bond{{1e-6, 5, 1e-8, -1e-4, golden::radius}, 0, 10, 1e-4};
  BondForce<Real> const loaded = force_of(law_at(41), bond);
  EXPECT_TRUE(within(1e-14, loaded.force.shear, 10 + 1e-8L * loaded.stiffness.shear));
  EXPECT_TRUE(within(1e-12, loaded.force.moment, 1e-4L - 1e-4L * loaded.stiffness.rolling));
  bond.motion.shear_increment = bond.motion.relative_rotation = 0;
  EXPECT_EQ(force_of(law_at(41), bond).force.shear, 10);
  EXPECT_EQ(force_of(law_at(41), bond).force.moment, 1e-4);
}

TEST(BondLaw, ReturnsToRestAfterAClosedPath) {
  BondLaw const law = law_at(41);
  Draw draw(51);
  for (int path = 0; path < 100; ++path) {
    Bond bond = resting(-2e-6);
    double shear_increments[20], relative_rotations[20], last = 0;
    for (int n = 0; n < 40; ++n) {
      double& shear_increment = shear_increments[n % 20];
      double& relative_rotation = relative_rotations[n % 20];
      shear_increment = n < 20 ? draw.between(-1, 1) * 1e-7 : -shear_increment;
      relative_rotation = n < 20 ? draw.between(-1, 1) * 1e-4 : -relative_rotation;
      bond.motion.shear_increment = shear_increment;
      bond.motion.relative_rotation = relative_rotation;
      bond.motion.overlap = n < 39 ? draw.between(-3e-6, 0) : -2e-6;
      BondForce<Real> const now = force_of(law, bond);
      bond.shear = now.force.shear;
      bond.moment = now.force.moment;
      last = now.force.normal;
    }
    EXPECT_EQ(last, 0);
    EXPECT_NEAR(bond.shear, 0, 1e-11);
    EXPECT_NEAR(bond.moment, 0, 1e-16);
  }
}

TEST(BondLaw, BreaksInTensionAtItsTensileStrength) {
  for (double saturation : {26.0, 41.0, 55.0}) {
    Failure const failure = load_until_broken(law_at(saturation), resting(0), 1e-9, 0, 0);
    EXPECT_EQ(failure.mode, BreakMode::tension);
    EXPECT_GT(failure.before.force.normal, -failure.strength.tension);
    EXPECT_NEAR(failure.at.force.normal, -failure.strength.tension, 1e-9 * failure.at.stiffness.normal);
  }
}

TEST(BondLaw, BreaksInCompressionAtItsCompressiveStrength) {
  for (double made_at : {0.0, -1.9e-6}) {
    Failure const failure = load_until_broken(law_at(26), resting(made_at), -1e-9, 0, 0);
    EXPECT_EQ(failure.mode, BreakMode::compression);
    EXPECT_LT(failure.before.force.normal, failure.strength.compression);
    EXPECT_NEAR(failure.at.force.normal, failure.strength.compression, 1e-9 * failure.at.stiffness.normal);
  }
}

TEST(BondLaw, BreaksInShearAtTheEnvelope) {
  for (double pressed : {-1e-6, 0.0, 2e-6}) {
    for (double direction : {1.0, -1.0}) {
      Bond bond = resting(0);
      bond.motion.overlap = pressed;
      Failure const failure = load_until_broken(law_at(41), bond, 0, direction * 1e-9, 0);
      double const limit = failure.strength.shear(failure.at.force.normal);
      EXPECT_EQ(failure.mode, BreakMode::shear);
      EXPECT_LT(std::fabs(failure.before.force.shear), limit);
      EXPECT_NEAR(failure.at.force.shear, direction * limit, 1e-9 * failure.at.stiffness.shear);
    }
  }
}

TEST(BondLaw, BreaksInRollingAtTheEnvelope) {
  for (double pressed : {-1e-6, 0.0, 2e-6}) {
    for (double direction : {1.0, -1.0}) {
      Bond bond = resting(0);
      bond.motion.overlap = pressed;
      Failure const failure = load_until_broken(law_at(41), bond, 0, 0, direction * 1e-6);
      double const limit = failure.strength.rolling(failure.at.force.normal);
      EXPECT_EQ(failure.mode, BreakMode::rolling);
      EXPECT_LT(std::fabs(failure.before.force.moment), limit);
      EXPECT_NEAR(failure.at.force.moment, direction * limit, 1e-6 * failure.at.stiffness.rolling);
    }
  }
}

TEST(BondLaw, KeepsTheForceOfALoadedContactWithMemoryAndDropsItWithout) {
  BondLaw law = law_at(41);
  EXPECT_EQ(force_of(law, resting(1e-6)).force.normal, 0);
  law.preload_stiffness = 3e8;
  EXPECT_TRUE(within(1e-15, force_of(law, resting(1e-6)).force.normal, 300));
  EXPECT_EQ(force_of(law, resting(-1e-6)).force.normal, 0);
  Bond bond = resting(1e-6);
  bond.motion.overlap = 2e-6;
  BondForce<Real> const loaded = force_of(law, bond);
  EXPECT_TRUE(within(1e-12, loaded.force.normal, 300 + 1e-6L * loaded.stiffness.normal));
}

TEST(BondLaw, ConstantThicknessMakesAllBondsOfOneRadiusAlike) {
  BondLaw law = law_at(41);
  law.thickness_weight = 0;
  law.plate_thickness = law.thickness_partner = 1e-6;
  for (double made_at : {-5e-6, 0.0, 3e-6}) {
    BondForce<Real> const bond = force_of(law, resting(made_at));
    EXPECT_EQ(bond.thickness, 1e-6);
    EXPECT_TRUE(within(1e-12, bond.width, printed::width(golden::radius, law.critical_thickness, 1e-6)));
    EXPECT_TRUE(within(1e-12, bond.stiffness.rolling, printed::k_bm(bond.width, golden::E_m, 1e-6)));
  }
}

TEST(BondLaw, KnowsWhatIsBonded) {
  EXPECT_FALSE(is_bonded(no_bond));
  for (double formation_overlap : {0.0, 1e-3, -1e-3}) EXPECT_TRUE(is_bonded(formation_overlap));
}

TEST(BondLaw, SwappingThePairGivesExactOpposites) {
  Draw draw(52);
  BondLaw const law = law_at(55);
  for (int n = 0; n < 100000; ++n) {
    double const made_at = draw.between(-1.4e-5, 3e-6), overlap = made_at + draw.between(-5e-6, 5e-6);
    double const r1 = draw.of_size(1e-5, 1e-3), r2 = draw.of_size(1e-5, 1e-3), relative_rotation = draw.between(-1, 1) * 1e-2;
    Bond const seen_from_a{{overlap, 0, draw.between(-1, 1) * 1e-6, relative_rotation, common_radius(r1, r2)},
                           made_at,
                           draw.between(-500, 500),
                           draw.between(-1, 1) * 1e-2};
    Bond seen_from_b = seen_from_a;
    seen_from_b.motion.common_radius = common_radius(r2, r1);
    seen_from_b.motion.relative_rotation = -relative_rotation;
    seen_from_b.moment = -seen_from_a.moment;
    BondForce<Real> const on_a = force_of(law, seen_from_a), on_b = force_of(law, seen_from_b);
    ASSERT_TRUE(same_bits(on_a.force.normal, on_b.force.normal));
    ASSERT_TRUE(same_bits(on_a.force.shear, on_b.force.shear));
    ASSERT_TRUE(exact_opposites(on_a.force.moment, on_b.force.moment));
    ASSERT_EQ(is_surely_intact(law, on_a), is_surely_intact(law, on_b));
    ASSERT_EQ(is_far_from_breaking(least_strength(law), on_a), is_far_from_breaking(least_strength(law), on_b));
    ASSERT_EQ(test_of(law, on_a), test_of(law, on_b));
  }
}

TEST(BondLaw, LanesGiveTheBitsOfTheScalarAlsoBesideUnbondedLanes) {
  Draw draw(53);
  BondLaw const law = law_at(55);
  for (int n = 0; n < 20000; ++n) {
    LaneStates<Bond> bonds;
    for (Bond& bond : bonds) {
      double const made_at = draw.between(-1.4e-5, 3e-6);
      bond.motion = {made_at + draw.between(-5e-6, 5e-6), 0, draw.between(-1, 1) * 1e-6, draw.between(-1, 1) * 1e-3,
                     draw.of_size(1e-5, 1e-3)};
      bond.formation_overlap = draw.between(0, 1) < 0.2 ? no_bond : made_at;
      bond.shear = draw.between(-900, 900);
      bond.moment = draw.between(-1, 1) * 1e-2;
    }
    auto const row = [&](auto number) { return side_by_side(bonds, number); };
    ContactMotion<Lanes> const motion{row([](Bond const& b) { return b.motion.overlap; }), Lanes(0),
                                      row([](Bond const& b) { return b.motion.shear_increment; }),
                                      row([](Bond const& b) { return b.motion.relative_rotation; }),
                                      row([](Bond const& b) { return b.motion.common_radius; })};
    Lanes const formation_overlap = row([](Bond const& b) { return b.formation_overlap; });
    Lanes const width = law.width_formed_at(motion.common_radius, formation_overlap);
    BondForce<Lanes> const trial = bond_contact(law, motion, formation_overlap, width, row([](Bond const& b) { return b.shear; }),
                                                row([](Bond const& b) { return b.moment; }));
    auto const intact = is_surely_intact(law, trial), far = is_far_from_breaking(least_strength(law), trial);
    for (int l = 0; l < lane_count; ++l) {
      Bond const& bond = bonds[static_cast<std::size_t>(l)];
      BondForce<Real> const alone = force_of(law, bond);
      ASSERT_EQ(lane(is_bonded(formation_overlap), l), is_bonded(bond.formation_overlap));
      ASSERT_EQ(lane(intact, l), is_surely_intact(law, alone));
      ASSERT_EQ(lane(far, l), is_far_from_breaking(least_strength(law), alone));
      ASSERT_TRUE(same_bits(lane(trial.force.normal, l), alone.force.normal));
      ASSERT_TRUE(same_bits(lane(trial.force.shear, l), alone.force.shear));
      ASSERT_TRUE(same_bits(lane(trial.force.moment, l), alone.force.moment));
      ASSERT_TRUE(same_bits(lane(trial.width, l), alone.width));
      ASSERT_TRUE(same_bits(lane(trial.thickness, l), alone.thickness));
    }
  }
}

}  // namespace
}  // namespace clathra
