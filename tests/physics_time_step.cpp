/// The time step that follows the limit of stability: how near the bound comes, that it holds at every step, and what a step of
/// changing length does to the motion.
#include <algorithm>
#include <numeric>

#include "domain/measurement/disc_grading.hpp"
#include "packing.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

/// The bound for the springs that carry a force now.
double present_limit(Simulation const& sim) {
  return stable_limit(sim.assembly().springs(), sim.assembly().laws.motion.damping, 0, sim.assembly().across());
}

/// Over that of the springs to come: behind a bond in place of its contact the stiffer of the two counts.
double bound_over_exact(Simulation const& sim) {
  return 2 / present_limit(sim) / clathra::largest_frequency(sim.assembly().springs(), sim.assembly().across(), 400, {true, 0});
}

Simulation loaded_sand(double friction = 0.5) { return {packing(), sand_laws(friction, 2), 0.1 * packing().d50}; }

Simulation bonded_packing(double saturation, ContactCoupling coupling) {
  Specimen s = packing();
  Scene const scene = hydrate_scene(saturation, coupling);
  bond_all(s, scene);
  return Simulation(s, bonded_laws(scene, s.critical_thickness), 0.1 * s.d50);
}

TEST(LimitOfStability, IsBoundedFromAboveWithinThreePercentInPackings) {
  EXPECT_GE(bound_over_exact(loaded_sand()), 1);
  EXPECT_LE(bound_over_exact(loaded_sand()), 1.03);
  for (double const saturation : {0.26, 0.55}) {
    for (ContactCoupling const coupling : {ContactCoupling::parallel, ContactCoupling::replaces}) {
      Simulation const sim = bonded_packing(saturation, coupling);
      EXPECT_LE(bound_over_exact(sim), 1.03) << saturation;
      EXPECT_GE(bound_over_exact(sim), 1) << saturation;
    }
  }
}

TEST(LimitOfStability, IsBoundedWithinFifteenPercentOnLatticesAndWithScaledInertia) {
  SimulationLaws laws = sand_laws(0.5, 0);
  double const closer = 2 * grain_radius * (1 - 1e-6);
  Simulation const hexagonal(hexagonal_patch(30, 30, closer), laws, 1e-6);
  Specimen square = open_space();
  for (int row = 0; row < 30; ++row)
    for (int column = 0; column < 30; ++column) add_disc(square, column * closer, row * closer);
  Simulation const squares(square, laws, 1e-6);
  for (Simulation const* sim : {&hexagonal, &squares}) {
    EXPECT_GE(bound_over_exact(*sim), 1);
    EXPECT_LE(bound_over_exact(*sim), 1.15);
  }
  for (double const inertia : {2.0, 3.0, 10.0}) {
    laws = sand_laws(0.5, 2);
    laws.scaling.inertia = inertia;
    Simulation const sim(packing(), laws, 0.1 * packing().d50);
    EXPECT_GE(bound_over_exact(sim), 1) << inertia;
    EXPECT_LE(bound_over_exact(sim), 1.15) << inertia;
  }
}

TEST(TimeStep, IsAShareOfTheLimitAndOfTheEstimate) {
  Simulation sim = loaded_sand();
  sim.choose_time_step({TimeStepRule::adaptive, 0.9});
  EXPECT_EQ(sim.time_step, 0.9 * sim.assembly().stable_limit());
  sim.choose_time_step({TimeStepRule::fixed, 0.5});
  EXPECT_EQ(sim.time_step, 0.5 * local_time_step(sim.assembly().springs()));
}

/// Steps and sees that none was longer than the springs allow that were there when it began.
void expect_stable_steps(Simulation& sim, int steps, double most) {
  double largest = 0;
  for (int n = 0; n < steps; ++n) {
    largest = std::max(largest, sim.time_step / present_limit(sim));
    sim.step();
  }
  EXPECT_LE(largest, most);
}

// Contacts form in hundreds, and the step before each is already short enough for it.
TEST(TimeStep, IsNeverAboveTheLimitWhileACloudCollapses) {
  Specimen s = disordered_patch(12, 12, 0.2);
  for (std::size_t i = 0; i < s.size(); ++i) {
    s.vx[i] = 2 * uniform_random(3, 5, i);
    s.vy[i] = 2 * uniform_random(3, 6, i);
  }
  enclose(s);
  SimulationLaws laws = sand_laws(0.5, 2);
  laws.motion.damping = 0.3;
  Simulation sim(s, laws, 0.1 * grain_d50);
  sim.choose_time_step({});
  sim.loading().x = sim.loading().y = AxisDrive::at_rate(400);
  expect_stable_steps(sim, 5000, 0.96);
  EXPECT_GT(sim.assembly().measures().touching, 100);
  EXPECT_GT(sim.time_steps().updates(), 10);
}

TEST(TimeStep, IsNeverAboveTheLimitWhileBondsBreak) {
  for (ContactCoupling const coupling : {ContactCoupling::parallel, ContactCoupling::replaces}) {
    Simulation sim = bonded_packing(0.55, coupling);
    sim.choose_time_step({});
    sim.loading().y = AxisDrive::at_rate(100);
    sim.loading().x = AxisDrive::at_rate(-60);
    expect_stable_steps(sim, 3000, 0.96);
    EXPECT_GT(sim.assembly().broken_bonds(), 100);
  }
}

// As while an assembly is closed, whose friction and rolling width are turned up and down every ten steps.
TEST(TimeStep, FollowsTheLaws) {
  Simulation sim = loaded_sand();
  SimulationLaws laws = sim.assembly().laws;
  laws.contact.grain.shape_factor = 0.5;
  sim.set_laws(laws);
  sim.choose_time_step({});
  double largest = 0;
  for (int n = 0; n < 80; ++n) {
    laws.contact.grain.shape_factor *= 1.02;
    sim.set_laws(laws);
    sim.step();
    largest = std::max(largest, sim.time_step / present_limit(sim));
  }
  EXPECT_LE(largest, 0.98);
  EXPECT_GT(sim.time_steps().updates(), 5);
  std::int64_t const before = sim.time_steps().updates();
  EXPECT_LT(before, 60) << "not at each of them";
  laws.contact.grain.shape_factor = 0.5;  // softer
  sim.set_laws(laws);
  sim.step();
  EXPECT_EQ(sim.time_steps().updates(), before);
  double const undamped = sim.time_step;
  laws.motion.damping = 0.7;
  sim.set_laws(laws);
  sim.step();
  EXPECT_LE(sim.time_step, 0.97 * present_limit(sim));
  EXPECT_GT(sim.time_steps().updates(), before);
  EXPECT_NE(sim.time_step, undamped);
}

// Velocities lie half a step behind, so a constant force moves a disc along its parabola to the digit, if the kick between two
// steps of unlike length is the mean of both.
TEST(TimeStep, MayChangeWithoutAnErrorInTheMotion) {
  SimulationLaws laws = sand_laws();
  laws.motion.gravity_y = -9.81;
  Specimen s = open_space();
  add_disc(s, 0, 0);
  Simulation sim(s, laws, 1e-6);
  double const first = 1e-4;
  double time = 0;
  for (int n = 0; n < 100; ++n) {
    sim.time_step = first * (1 + n % 7);
    time += sim.time_step;
    sim.step();
  }
  EXPECT_NEAR(sim.assembly().time(), time, 1e-15);
  double const height = sim.specimen().y[0];
  EXPECT_NEAR(height, -0.5 * 9.81 * time * (time + first), within(1e-13, 2e-9));  // at rest half a step before the start
}

/// Amplitudes grow by (s + sqrt(s^2 - 1))^2 a step where omega dt = 2 s. The second frequency of this packing lies 1 to 2 %
/// below the first: up to there one mode grows alone.
TEST(TimeStep, AboveTheLimitGrowsAtThePredictedRate) {
  if (tested_precision() == Precision::mixed) GTEST_SKIP() << "grows from motions far below a tick";
  Simulation rest = loaded_sand(1e6);
  SimulationLaws laws = rest.assembly().laws;
  laws.motion.damping = 0.7;
  rest.set_laws(laws);
  rest.time_step = 0.7 * present_limit(rest);
  rest.step(120000);  // its forces are in balance to the last digits
  rest.stop_discs();
  laws.motion.damping = 0;
  for (double const share : {1.002, 1.01}) {
    Simulation copy(rest.specimen(), laws, 0.1 * packing().d50);
    copy.time_step = share * 2 / copy.assembly().largest_frequency(400);
    double const rate = 2 * std::acosh(share);
    std::vector<double> logs;
    while (logs.size() < 400 && (logs.empty() || logs.back() < std::log(1e-5))) {
      copy.step();
      logs.push_back(0.5 * std::log(copy.assembly().measures().kinetic / copy.assembly().measures().grain_energy));
    }
    ASSERT_GT(logs.size(), 12u);
    double const measured = (logs.back() - logs[logs.size() - 4]) / 3;
    EXPECT_NEAR(measured / rate, 1, 1e-3) << share;
  }
}

TEST(MassScaling, RaisesTheSmallestMassesAndAllMomentsOfInertia) {
  Specimen s = open_space();
  double const a = grain_radius;
  add_disc(s, 0, 0, a);
  add_disc(s, 5 * a, 0, 2 * a);
  SimulationLaws laws = sand_laws();
  laws.scaling = {3, 1.5 * a};
  Simulation const sim(s, laws, 0.1 * a);
  for (int id : {0, 1}) {
    double const moving = id == 0 ? 1.5 * a : 2 * a, mass = pi * moving * moving * sand_density, r = id == 0 ? a : 2 * a;
    EXPECT_NEAR(value(sim.assembly().particles.inverse_mass, index_of(sim, id)) * mass, 1, within(1e-14, 1e-7));
    EXPECT_NEAR(value(sim.assembly().particles.inverse_inertia, index_of(sim, id)) * 3 * 0.5 * mass * r * r, 1,
                within(1e-14, 1e-7));
  }
  EXPECT_NEAR(sim.assembly().facts.added_mass, 1.25 / 5, 1e-14);
  EXPECT_NEAR(sim.assembly().facts.moving_density(), 1.25 * sand_density, 1e-9);
}

TEST(MassScaling, FindsTheRadiusThatAShareOfTheDiscsLiesBelow) {
  std::vector<double> const radii{5, 3, 1, 4, 2, 9, 8, 10, 7, 6};
  EXPECT_EQ(radius_above(radii, 0), 1);
  EXPECT_EQ(radius_above(radii, 0.1), 2);
  EXPECT_EQ(radius_above(radii, 0.25), 4);
  EXPECT_EQ(radius_above(radii, 1), 10);
}

}  // namespace
}  // namespace clathra
