/// Servo walls on an elastic block.
#include "domain/generation/equilibration.hpp"
#include "kernels/stability.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

/// A bonded lattice between walls, under an isotropic stress, that cannot break.
Simulation elastic_block(double stress, double alpha) {
  Scene const scene = hydrate_scene(0.55, ContactCoupling::parallel);
  Specimen s = hexagonal_patch(16, 18);
  enclose(s);
  bond_all(s, scene);
  SimulationLaws laws = unbreakable(bonded_laws(scene, s.critical_thickness));
  laws.motion.damping = alpha;
  Simulation sim(s, laws, 0.1 * grain_d50);
  prepare_servo(sim, stress, 1e-3, grain_d50, {});
  EXPECT_TRUE(hold_stress(sim, stress, {1e-3}, 40000, {}, "test"));
  return sim;
}

TEST(ServoWall, ThatMustMoveAtAConstantRateKeepsTheStress) {
  double const stress = 1e6;
  Simulation sim = elastic_block(stress, 0.3);
  // Compressed along y, the block spreads along x at a constant rate.
  double const rate = strain_rate_of(1e-4, stress, sand_density, grain_d50), width = sim.assembly().walls().width();
  sim.loading().y = AxisDrive::at_rate(rate);
  sim.loading().x.largest_speed = rate * width;
  sim.step(2000);  // the servo finds the rate
  double const from = sim.assembly().walls().width();
  double mean = 0, worst = 0, speed_early = 0, speed_late = 0;
  constexpr int steps = 6000;
  for (int n = 0; n < steps; ++n) {
    sim.step();
    mean += sim.assembly().stress().x / stress / steps;
    worst = std::max(worst, std::abs(sim.assembly().stress().x / stress - 1));
    (n < steps / 2 ? speed_early : speed_late) += sim.assembly().walls().velocity[right] / (steps / 2);
  }
  EXPECT_GT(sim.assembly().walls().width(), from);
  EXPECT_NEAR(speed_late / speed_early, 1, 0.15);  // it does move at a constant rate
  EXPECT_GT(speed_late, 0.02 * rate * width);
  EXPECT_NEAR(mean, 1, 1e-3);
  EXPECT_LT(worst, 0.01);
  EXPECT_EQ(sim.assembly().broken_bonds(), 0);
}

TEST(Rest, KnowsADeviatorOnTheWallsWhereItIsAskedFor) {
  double const stress = 1e6, deviator = 3e-3;
  Simulation sim = elastic_block(stress, 0.3);
  sim.loading().y.target_stress = (1 + deviator) * stress;
  EXPECT_TRUE(hold_stress(sim, stress, {1e-3}, 40000, {}, "test"));
  EXPECT_NEAR(sim.assembly().stress().y / sim.assembly().stress().x - 1, deviator, 0.1 * deviator);
  Measures const m = sim.assembly().measures();
  EXPECT_EQ(unrest(sim, m, stress, {1e-3, 1.2 * deviator}), "");
  EXPECT_EQ(unrest(sim, m, stress, {1e-3, 1e-3}), "vertical stress 0.3 % higher than the lateral one (at rest within 0.1 %)");
  EXPECT_FALSE(hold_stress(sim, stress, {1e-3, 1e-3}, 2000, {}, "test"));
}

/// Largest error of both stresses over so many steps, relatively.
double worst_error(Simulation& sim, double stress, int steps) {
  double worst = 0;
  for (int n = 0; n < steps; ++n) {
    sim.step();
    worst = std::max({worst, std::abs(sim.assembly().stress().x / stress - 1), std::abs(sim.assembly().stress().y / stress - 1)});
  }
  return worst;
}

TEST(ServoWall, ThatIsToldAnotherStressReachesItWithoutRinging) {
  double const before = 1e6, stress = 1.02e6;
  Simulation sim = elastic_block(before, 0.3);
  sim.loading().x.target_stress = sim.loading().y.target_stress = stress;
  sim.loading().x.largest_speed = sim.loading().y.largest_speed = 1;
  EXPECT_LT(worst_error(sim, stress, 100), 0.02);  // no more than it was when it was told
  EXPECT_LT(worst_error(sim, stress, 400), 2e-3);
  EXPECT_LT(worst_error(sim, stress, 400), 2e-4);
}

TEST(ServoWall, IsStableWithoutAnyDamping) {
  double const stress = 1e6;
  Simulation sim = elastic_block(stress, 0.3);
  SimulationLaws laws = sim.assembly().laws;
  laws.motion.damping = 0;
  sim.set_laws(laws);
  sim.loading().x.target_stress = sim.loading().y.target_stress = 1.001 * stress;
  (void)worst_error(sim, 1.001 * stress, 2000);
  double const early = worst_error(sim, 1.001 * stress, 2000), late = worst_error(sim, 1.001 * stress, 20000);
  EXPECT_LT(early, within(2e-5, 2e-4));
  EXPECT_LT(late, within(early, 2e-4));
}

TEST(ServoWall, ClosesAtItsIntegralAndAShareOfTheError) {
  ServoLaw law;
  double const target = 1e6, error = 2e4, length = 0.01, dt = 1e-7;
  int const contacts = 40;
  double const proportional = law.gain * length / (law.contact_stiffness * contacts * dt) * error;
  for (double const steps : {1000.0, 4.0, 1.0, 0.0}) {  // of the integral time: it counts as four at least
    law.integral_time = steps * dt;
    AxisDrive drive = AxisDrive::at_stress(target, 1e3);
    double const gained = proportional / std::max(steps, 4.0);
    double const tolerance = 1e-12 * proportional;
    EXPECT_NEAR(drive.closing_speed(law, target - error, length, length, contacts, dt), proportional + gained, tolerance);
    EXPECT_NEAR(drive.integral, gained, tolerance) << steps;
    EXPECT_NEAR(drive.closing_speed(law, target + error, length, length, contacts, dt), -proportional, tolerance);
    EXPECT_NEAR(drive.integral, 0, tolerance) << steps;
  }
}

TEST(ServoWall, NeverMovesFasterThanItsCap) {
  Specimen s = hexagonal_patch(6, 6);
  enclose(s, grain_radius);  // out of touch: all error, no contact
  Simulation sim(s, sand_laws(), 0.1 * grain_d50);
  sim.time_step = 1e-7;
  sim.loading().x = sim.loading().y = AxisDrive::at_stress(1e6, 0.1);
  for (int n = 0; n < 200; ++n) {
    sim.step();
    EXPECT_EQ(sim.assembly().walls().velocity[left], 0.1);
    EXPECT_EQ(sim.assembly().walls().velocity[top], -0.1);
  }
}

}  // namespace
}  // namespace clathra
