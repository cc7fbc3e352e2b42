/// A disc on a rough floor: from sliding to rolling, and down an incline.
#include "scenes.hpp"

namespace clathra {
namespace {

constexpr double g = 10, friction = 0.5;

/// A disc at rest on a rough floor, under gravity turned by `angle` from the vertical.
Simulation resting_disc(double angle, double speed, double dt) {
  double const press = g * std::cos(angle);
  Specimen s = disc_on_floor(grain_mass() * press / sand_kn);
  s.vx[0] = speed;
  SimulationLaws laws = sand_laws();
  laws.wall.friction = friction;
  laws.motion.gravity_x = g * std::sin(angle);
  laws.motion.gravity_y = -press;
  Simulation sim(s, laws, 3e-4);
  sim.time_step = dt;
  return sim;
}

double rim_velocity(Disc const& d) { return d.vx + d.omega * grain_radius; }

TEST(SlidingDisc, BeginsToRollAtTwoThirdsOfItsSpeed) {
  double const u0 = 1e-3;
  for (double dt : {2e-7, 1e-7, 0.5e-7}) {
    Simulation sim = resting_disc(0, u0, dt);
    double before = u0, now = u0;
    while (now > 0) {
      before = now;
      sim.step();
      now = rim_velocity(disc(sim, 0));
    }
    // The rim velocity falls in a straight line. Velocities stand half a step behind the time and friction acts from the first
    // step on, so that the line begins one half step late: an error of first order, known exactly.
    double const instant = sim.assembly().time() - dt / 2 - dt * now / (now - before);
    EXPECT_NEAR((instant - dt / 2) / (u0 / (3 * friction * g)), 1, within(1e-6, 3e-5)) << dt;
    double mean = 0;
    constexpr int steps = 4000;  // over many swings of the shear spring
    for (int n = 0; n < steps; ++n) {
      sim.step();
      mean += disc(sim, 0).vx / steps;
    }
    EXPECT_NEAR(mean / u0, 2.0 / 3, 3e-4);
  }
}

double acceleration(double angle) {
  constexpr int steps = 20000;
  Simulation sim = resting_disc(angle, 0, 1e-7);
  sim.step(steps);
  return disc(sim, 0).vx / sim.assembly().time();
}

TEST(DiscOnAnIncline, RollsWithTwoThirdsOfGravityUpToThreeTimesTheFriction) {
  for (double tangent : {0.1, 0.3, 0.6}) {  // the shear spring swings up to twice its mean: below 1.5 mu nothing slips
    double const angle = std::atan(tangent);
    EXPECT_NEAR(acceleration(angle) / (g * std::sin(angle)), 2.0 / 3, 2e-4) << tangent;
  }
  for (double tangent : {1.6, 3.0}) {
    double const angle = std::atan(tangent);
    EXPECT_NEAR(acceleration(angle) / (g * (std::sin(angle) - friction * std::cos(angle))), 1, 1e-3) << tangent;
  }
}

}  // namespace
}  // namespace clathra
