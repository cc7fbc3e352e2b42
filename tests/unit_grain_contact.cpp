#include <limits>

#include "draw.hpp"
#include "kernels/bond_geometry.hpp"
#include "kernels/grain_contact.hpp"
#include "printed_number.hpp"

namespace clathra {
namespace {

constexpr GrainLaw sand{3e8, 2e8, 0.5, 2, 0};
constexpr double radius = 0.0847e-3;
constexpr double no_dashpot = 0;

/// A contact of two equal grains of sand that overlap by F_n / k_n.
ContactMotion<Real> pressed(double normal_force) { return {normal_force / sand.normal_stiffness, 0, 0, 0, radius}; }

/// A contact with its history, anything a run may meet.
struct Contact {
  ContactMotion<Real> motion;
  double shear, moment, dashpot;
};

Contact any_contact(Draw& draw) {
  Contact contact;
  contact.motion.overlap = draw.between(-1, 3) * 1e-6;
  contact.motion.closing_velocity = draw.between(-0.1, 0.1);
  contact.motion.shear_increment = draw.between(-1, 1) * 1e-6;
  contact.motion.relative_rotation = draw.between(-1, 1) * 1e-2;
  contact.motion.common_radius = draw.of_size(1e-5, 1e-3);
  contact.shear = draw.between(-400, 400);
  contact.moment = draw.between(-1, 1) * 1e-2;
  contact.dashpot = draw.between(0, 1e4);
  return contact;
}

ContactForce<Real> force_of(Contact const& c) { return grain_contact<true>(sand, c.motion, c.shear, c.moment, c.dashpot); }

TEST(GrainContact, PushesInProportionToTheOverlap) {
  ContactMotion<Real> motion = pressed(0);
  for (double overlap : {1e-12, 1e-9, 0.56e-6, 1e-5}) {
    motion.overlap = overlap;
    EXPECT_TRUE(within(1e-15, grain_contact<true>(sand, motion, 0.0, 0.0, no_dashpot).normal, 3e8L * overlap));
  }
}

TEST(GrainContact, CarriesNothingAtZeroOverlapAndAcrossAGap) {
  for (double overlap : {0.0, -0.0, -5e-324, -1e-6}) {
    ContactMotion<Real> motion{overlap, 10, 1e-6, 1e-2, radius};
    ContactForce<Real> const force = grain_contact<true>(sand, motion, 50.0, 1e-3, 1e4);
    EXPECT_EQ(force.normal, 0) << overlap;
    EXPECT_EQ(force.shear, 0) << overlap;
    EXPECT_EQ(force.moment, 0) << overlap;
  }
}

TEST(GrainContact, ForgetsItsHistoryOnSeparation) {
  ContactMotion<Real> motion = pressed(169.4);
  ContactForce<Real> force = grain_contact<true>(sand, motion, 40.0, 1e-3, no_dashpot);
  EXPECT_EQ(force.shear, 40.0);
  motion.overlap = -1e-9;
  force = grain_contact<true>(sand, motion, force.shear, force.moment, no_dashpot);
  motion = pressed(169.4);
  force = grain_contact<true>(sand, motion, force.shear, force.moment, no_dashpot);
  EXPECT_GT(force.normal, 0);
  EXPECT_EQ(force.shear, 0);
  EXPECT_EQ(force.moment, 0);
}

TEST(GrainContact, KeepsItsForcesWithoutSlipAndSpin) {
  for (double shear : {0.0, 20.0, -84.0}) {
    for (double moment : {0.0, 4e-3, -4e-3}) {
      ContactForce<Real> const force = grain_contact<true>(sand, pressed(169.4), shear, moment, no_dashpot);
      EXPECT_EQ(force.shear, shear);
      EXPECT_EQ(force.moment, moment);
    }
  }
}

TEST(GrainContact, AddsSlipAndTurnByTheirStiffness) {
  ContactMotion<Real> motion = pressed(169.4);
  motion.shear_increment = 1e-8;
  motion.relative_rotation = -1e-4;
  ContactForce<Real> const force = grain_contact<true>(sand, motion, 5.0, 1e-3, no_dashpot);
  EXPECT_TRUE(within(1e-14, force.shear, 5.0L + 2e8L * 1e-8L));
  EXPECT_TRUE(within(1e-14, force.moment, 1e-3L - 1e-4L * 3e8L * 4 / 12 * radius * radius));
}

TEST(GrainContact, HasTheStiffnessAndLimitsOfTheWorkedExample) {
  EXPECT_TRUE(agrees(sand.shape_factor * radius * 1e3, "0.1694"));
  EXPECT_TRUE(agrees(rolling_stiffness(sand, radius), "0.7174"));
  ContactMotion<Real> motion = pressed(169.4);
  motion.shear_increment = motion.relative_rotation = 1;
  ContactForce<Real> const force = grain_contact<true>(sand, motion, 0.0, 0.0, no_dashpot);
  EXPECT_TRUE(agrees(force.normal, "169.4"));
  EXPECT_TRUE(agrees(force.shear, "84.7"));
  EXPECT_TRUE(agrees(force.moment, "4.783e-3"));
}

TEST(GrainContact, SlidesAtTheCoulombLimitAndNeverPulls) {
  ContactMotion<Real> motion = pressed(100);
  for (double direction : {1.0, -1.0}) {
    double shear = 0;
    motion.shear_increment = direction * 1e-8;  // 2 N/m a step
    for (int step = 0; step < 40; ++step) {
      ContactForce<Real> const force = grain_contact<true>(sand, motion, shear, 0.0, no_dashpot);
      EXPECT_LE(std::fabs(force.shear), sand.friction * force.normal);
      EXPECT_GE(force.normal, 0);
      shear = force.shear;
      double const sticking = 2.0 * (step + 1);
      EXPECT_NEAR(shear, direction * std::min(sticking, 50.0), 1e-9);
    }
    EXPECT_EQ(shear, direction * (sand.friction * (sand.normal_stiffness * motion.overlap)));
  }
}

TEST(GrainContact, RollsAtASixthOfForceTimesWidthInBothDirections) {
  ContactMotion<Real> motion = pressed(100);
  long double const limit = 100.0L * (2 * static_cast<long double>(radius)) / 6;
  for (double direction : {1.0, -1.0}) {
    motion.relative_rotation =
        direction * 3.0 * 100 / (sand.normal_stiffness * radius);  // three times the turn at which rolling starts
    ContactForce<Real> const force = grain_contact<true>(sand, motion, 0.0, 0.0, no_dashpot);
    EXPECT_TRUE(within(1e-14, force.moment, direction * limit));
  }
  // The plastic limit is reached at the turn 2 F_n / (k_n B_c), where the first of the springs under the width lets go.
  motion.relative_rotation = 2 * 100 / (sand.normal_stiffness * 2 * radius);
  EXPECT_TRUE(within(1e-14, rolling_stiffness(sand, radius) * motion.relative_rotation, limit));
}

TEST(GrainContact, RollingResistanceGrowsWithTheSquareOfTheShapeFactorAndItsLimitInProportion) {
  GrainLaw angular = sand;
  angular.shape_factor = 3;
  EXPECT_TRUE(within(1e-15, rolling_stiffness(angular, radius) / rolling_stiffness(sand, radius), 2.25L));
  ContactMotion<Real> motion = pressed(100);
  motion.relative_rotation = 1;
  double const limit = grain_contact<true>(sand, motion, 0.0, 0.0, no_dashpot).moment;
  EXPECT_TRUE(within(1e-15, grain_contact<true>(angular, motion, 0.0, 0.0, no_dashpot).moment / limit, 1.5L));
  angular.shape_factor = 0;
  EXPECT_EQ(grain_contact<true>(angular, motion, 0.0, 1e-3, no_dashpot).moment, 0);
}

TEST(GrainContact, WithoutRollingResistanceCarriesNoMoment) {
  ContactMotion<Real> motion = pressed(100);
  motion.shear_increment = 1e-8;
  motion.relative_rotation = 1;
  ContactForce<Real> const force = grain_contact<false>(sand, motion, 3.0, 1e-3, no_dashpot);
  EXPECT_EQ(force.moment, 0);
  EXPECT_TRUE(within(1e-15, force.shear, 5));
}

TEST(GrainContact, DashpotResistsApproachAndNeverPulls) {
  ContactMotion<Real> motion = pressed(100);
  motion.closing_velocity = 0.01;
  EXPECT_TRUE(within(1e-14, grain_contact<true>(sand, motion, 0.0, 0.0, 2000.0).normal, 120));
  motion.closing_velocity = -0.01;
  EXPECT_TRUE(within(1e-14, grain_contact<true>(sand, motion, 0.0, 0.0, 2000.0).normal, 80));
  motion.closing_velocity = -0.06;
  ContactForce<Real> const parting = grain_contact<true>(sand, motion, 40.0, 1e-3, 2000.0);
  EXPECT_EQ(parting.normal, 0);
  EXPECT_EQ(parting.shear, 0);
  EXPECT_EQ(parting.moment, 0);
}

TEST(GrainContact, DashpotIsTheWantedShareOfCriticalDamping) {
  GrainLaw damped = sand;
  damped.damping_ratio = 0.2;
  double const mass_a = 5.860e-5, mass_b = 2e-5;
  long double const effective = 1.0L * mass_a * mass_b / (static_cast<long double>(mass_a) + mass_b);
  EXPECT_TRUE(within(1e-15, dashpot_coefficient(damped, 1 / mass_a, 1 / mass_b), 0.4L * std::sqrt(3e8L * effective)));
  EXPECT_TRUE(within(1e-15, dashpot_coefficient(damped, 1 / mass_a, 0.0), 0.4L * std::sqrt(3e8L * mass_a)));  // a wall
  EXPECT_TRUE(
      same_bits(dashpot_coefficient(damped, 1 / mass_a, 1 / mass_b), dashpot_coefficient(damped, 1 / mass_b, 1 / mass_a)));
  EXPECT_EQ(dashpot_coefficient(sand, 1 / mass_a, 1 / mass_b), 0);
}

TEST(GrainContact, TakesOverTheForcesOfABrokenBondUpToItsLimits) {
  ContactForce<Real> force = limit_grain_contact<true>(sand, pressed(100), -700.0, 0.5, no_dashpot);
  EXPECT_TRUE(within(1e-14, force.shear, -50));
  EXPECT_TRUE(within(1e-14, force.moment, 100.0L * radius / 3));
  force = limit_grain_contact<true>(sand, pressed(100), -30.0, 1e-4, no_dashpot);
  EXPECT_EQ(force.shear, -30);
  EXPECT_EQ(force.moment, 1e-4);
}

TEST(GrainContact, SwappingThePairGivesExactOpposites) {
  Draw draw(11);
  for (int n = 0; n < 100000; ++n) {
    double const r1 = draw.of_size(1e-5, 1e-3), r2 = draw.of_size(1e-5, 1e-3);
    ASSERT_TRUE(same_bits(common_radius(r1, r2), common_radius(r2, r1)));
    Contact seen_from_a = any_contact(draw);
    seen_from_a.motion.common_radius = common_radius(r1, r2);
    Contact seen_from_b = seen_from_a;
    seen_from_b.motion.relative_rotation = -seen_from_a.motion.relative_rotation;
    seen_from_b.moment = -seen_from_a.moment;
    ContactForce<Real> const on_a = force_of(seen_from_a), on_b = force_of(seen_from_b);
    ASSERT_TRUE(same_bits(on_a.normal, on_b.normal));
    ASSERT_TRUE(same_bits(on_a.shear, on_b.shear));
    ASSERT_TRUE(exact_opposites(on_a.moment, on_b.moment));
  }
}

TEST(GrainContact, MirroringTheMotionMirrorsTheForcesToTheBit) {
  Draw draw(12);
  for (int n = 0; n < 100000; ++n) {
    Contact const contact = any_contact(draw);
    Contact mirrored = contact;
    mirrored.motion.shear_increment = -contact.motion.shear_increment;
    mirrored.motion.relative_rotation = -contact.motion.relative_rotation;
    mirrored.shear = -contact.shear;
    mirrored.moment = -contact.moment;
    ContactForce<Real> const force = force_of(contact), image = force_of(mirrored);
    ASSERT_TRUE(same_bits(force.normal, image.normal));
    ASSERT_TRUE(exact_opposites(force.shear, image.shear));
    ASSERT_TRUE(exact_opposites(force.moment, image.moment));
  }
}

TEST(GrainContact, StaysWithinItsLimitsForAnyMotion) {
  Draw draw(13);
  int sliding = 0, rolling = 0, sticking = 0;
  for (int n = 0; n < 100000; ++n) {
    Contact const contact = any_contact(draw);
    ContactForce<Real> const force = force_of(contact);
    double const moment_limit = force.normal * (2 * contact.motion.common_radius) / 6;
    ASSERT_GE(force.normal, 0);
    ASSERT_LE(std::fabs(force.shear), 0.5 * force.normal);
    ASSERT_LE(std::fabs(force.moment), moment_limit * (1 + 1e-15));
    bool const slides = std::fabs(force.shear) == 0.5 * force.normal;
    sliding += slides;
    rolling += std::fabs(force.moment) >= moment_limit * (1 - 1e-15);
    sticking += !slides;
  }
  EXPECT_GT(sliding, 10000);
  EXPECT_GT(rolling, 10000);
  EXPECT_GT(sticking, 10000);
}

TEST(GrainContact, LanesGiveTheBitsOfTheScalar) {
  Draw draw(14);
  for (int n = 0; n < 20000; ++n) {
    LaneStates<Contact> contacts;
    for (Contact& contact : contacts) contact = any_contact(draw);
    auto const row = [&](auto number) { return side_by_side(contacts, number); };
    ContactMotion<Lanes> const motion{row([](Contact const& c) { return c.motion.overlap; }),
                                      row([](Contact const& c) { return c.motion.closing_velocity; }),
                                      row([](Contact const& c) { return c.motion.shear_increment; }),
                                      row([](Contact const& c) { return c.motion.relative_rotation; }),
                                      row([](Contact const& c) { return c.motion.common_radius; })};
    ContactForce<Lanes> const force =
        grain_contact<true>(sand, motion, row([](Contact const& c) { return c.shear; }),
                            row([](Contact const& c) { return c.moment; }), row([](Contact const& c) { return c.dashpot; }));
    for (int l = 0; l < lane_count; ++l) {
      ContactForce<Real> const alone = force_of(contacts[static_cast<std::size_t>(l)]);
      ASSERT_TRUE(same_bits(lane(force.normal, l), alone.normal));
      ASSERT_TRUE(same_bits(lane(force.shear, l), alone.shear));
      ASSERT_TRUE(same_bits(lane(force.moment, l), alone.moment));
    }
  }
}

TEST(GrainContact, StaysFiniteForCoincidentCentresAndExtremeRatiosOfRadius) {
  for (double ratio : {1.0, 1e-3, 1e3, 1e-9}) {
    double const r2 = ratio * radius, common = common_radius(radius, r2);
    ContactMotion<Real> const motion{radius + r2, 0, 1e-6, 1e-2, common};
    ContactForce<Real> const force = grain_contact<true>(sand, motion, 0.0, 0.0, no_dashpot);
    EXPECT_TRUE(within(1e-15, force.normal, 3e8L * (radius + r2))) << ratio;
    EXPECT_TRUE(within(1e-15, force.shear, 200)) << ratio;
    EXPECT_TRUE(within(1e-14, force.moment, 1e-2L * 1e8L * common * common)) << ratio;
  }
}

TEST(GrainContact, HidesNoNan) {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  ContactMotion<Real> motion = pressed(100);
  motion.closing_velocity = motion.shear_increment = motion.relative_rotation = nan;
  ContactForce<Real> const force = grain_contact<true>(sand, motion, 0.0, 0.0, 1.0);
  EXPECT_TRUE(std::isnan(force.normal));
  EXPECT_TRUE(std::isnan(force.shear));
  EXPECT_TRUE(std::isnan(force.moment));
}

// Whatever the law: its tangent is the slope of its force, and its energy what the force has done.
TEST(GrainContact, HasTheTangentAndTheEnergyOfItsForce) {
  for (Real const overlap : {1e-8, 1e-6, 3e-5}) {
    Real const step = 1e-4 * overlap;
    auto const energy = [&](Real u) {
      return grain_energy(sand, {spring_force(sand, u), 0, 0}, grain_stiffness(sand, u, radius));
    };
    Real const slope = (spring_force(sand, overlap + step) - spring_force(sand, overlap - step)) / (2 * step);
    EXPECT_NEAR(grain_stiffness(sand, overlap, radius).normal / slope, 1, 1e-6) << overlap;
    Real const work = (energy(overlap + step) - energy(overlap - step)) / (2 * step);
    EXPECT_NEAR(work / spring_force(sand, overlap), 1, 1e-6) << overlap;
  }
  ContactStiffness<Real> const k = grain_stiffness(sand, 1e-6, radius);
  EXPECT_EQ(k.shear, sand.shear_stiffness);
  EXPECT_EQ(k.rolling, rolling_stiffness(sand, radius));
  EXPECT_DOUBLE_EQ(grain_energy(sand, {0, 3, 0}, k), 4.5 / k.shear);
  EXPECT_DOUBLE_EQ(grain_energy(sand, {0, 0, 1e-6}, k), 0.5e-12 / k.rolling);
}

TEST(GrainContact, LosesToItsDashpotWhatTheForceHasMoreThanTheSpring) {
  ContactMotion<Real> const motion{1e-6, 0.02, 0, 0, radius};
  EXPECT_DOUBLE_EQ(dashpot_loss(sand, motion, spring_force(sand, 1e-6) + 50, 1e-7), 50 * 0.02 * 1e-7);
  EXPECT_EQ(dashpot_loss(sand, motion, normal_force(sand, motion, Undamped()), 1e-7), 0);
}

}  // namespace
}  // namespace clathra
