/// Collisions of two discs and of a disc with a wall against their closed forms (discs: I = m r^2 / 2).
#include "scenes.hpp"

namespace clathra {
namespace {

/// Speeds of collisions in mixed precision are those whose overlaps, some 0.1 um, are 10^4 ticks; lever arms are shorter by a
/// thousandth then, which the closed forms leave out.
double speed(double of_full) { return within(of_full, 0.3); }
/// Of collisions with shear: slower, as what discs turn and slide while they touch is left out, too.
double slow(double of_full) { return within(of_full, 0.03); }

/// One collision of contact time t_c = pi sqrt(m_eff / k_n), cut into `steps` steps. It begins at the instant of touch.
struct Collision {
  double vn, vt, friction, stiffness_ratio;
  int steps;
  double damping_ratio = 0;
};

double contact_time(double effective_mass) { return pi * std::sqrt(effective_mass / sand_kn); }

/// A disc that falls on the floor with normal velocity vn and tangential velocity vt at its rim.
Simulation on_the_floor(Collision const& c) {
  Specimen s = disc_on_floor();
  s.vy[0] = -c.vn;
  s.vx[0] = c.vt;
  SimulationLaws laws = sand_laws();
  laws.wall = {sand_kn, sand_kn * c.stiffness_ratio, c.friction, c.damping_ratio};
  Simulation sim(s, laws, 1e-5);
  sim.time_step = contact_time(grain_mass()) / c.steps;
  return sim;
}

/// Two equal discs, head on, both with half of the velocities.
Simulation of_two_discs(Collision const& c) {
  Specimen s = two_discs(0);
  s.vx = {0.5 * c.vn, -0.5 * c.vn};
  s.vy = {-0.5 * c.vt, 0.5 * c.vt};
  SimulationLaws laws = sand_laws(c.friction, 0);
  laws.contact.grain.shear_stiffness = sand_kn * c.stiffness_ratio;
  laws.contact.grain.damping_ratio = c.damping_ratio;
  Simulation sim(s, laws, 1e-5);
  sim.time_step = contact_time(0.5 * grain_mass()) / c.steps;
  return sim;
}

/// Velocity of the rim along the contact.
double rim_velocity(Simulation const& sim) {
  Disc const a = disc(sim, 0);
  if (sim.assembly().discs() == 1) return a.vx + a.omega * grain_radius;
  Disc const b = disc(sim, 1);
  return (b.vy - a.vy) - (a.omega + b.omega) * grain_radius;
}
double overlap(Simulation const& sim) {
  Disc const a = disc(sim, 0);
  if (sim.assembly().discs() == 1) return grain_radius - a.y;
  Disc const b = disc(sim, 1);
  return 2 * grain_radius - std::hypot(b.x - a.x, b.y - a.y);
}

enum class Partner { wall, disc };
Simulation collide(Partner partner, Collision const& c) { return partner == Partner::wall ? on_the_floor(c) : of_two_discs(c); }
double effective_mass(Partner partner) { return partner == Partner::wall ? grain_mass() : 0.5 * grain_mass(); }

constexpr Partner partners[] = {Partner::wall, Partner::disc};

TEST(HeadOnCollision, OverlapGrowsToRelativeVelocityTimesRootOfMassOverStiffness) {
  for (Partner partner : partners) {
    double const v = speed(1e-3), exact = v * std::sqrt(effective_mass(partner) / sand_kn);
    double error[3];
    for (int level = 0; level < 3; ++level) {
      Simulation sim = collide(partner, {v, 0, 0, 1, 64 << level});
      sim.step(32 << level);
      error[level] = overlap(sim) - exact;
    }
    EXPECT_LT(std::abs(error[2] / exact), 1e-4);
    EXPECT_TRUE(shrinks(error[0], error[1], 2, 0.1, 2e-11));
    EXPECT_TRUE(shrinks(error[1], error[2], 2, 0.1, 2e-11));
  }
}

TEST(HeadOnCollision, LastsPiTimesRootOfMassOverStiffnessAndGivesTheSpeedBack) {
  for (Partner partner : partners) {
    double const v = speed(1e-3), exact = contact_time(effective_mass(partner));
    double error[3];
    for (int level = 0; level < 3; ++level) {
      Simulation sim = collide(partner, {v, 0, 0, 1, 64 << level});
      double before = 0;
      do {
        before = overlap(sim);
        sim.step();
      } while (overlap(sim) > 0);
      double const after = overlap(sim);
      error[level] = sim.assembly().time() - sim.time_step * after / (after - before) - exact;
      double const parting = partner == Partner::wall ? disc(sim, 0).vy : disc(sim, 1).vx - disc(sim, 0).vx;
      EXPECT_NEAR(parting / v, 1, 2.0 / ((64 << level) * (64 << level)));
    }
    EXPECT_LT(std::abs(error[2] / exact), 1e-4);
    EXPECT_TRUE(shrinks(error[0], error[1], 2, 0.1, 2e-10));
    EXPECT_TRUE(shrinks(error[1], error[2], 2, 0.1, 2e-10));
  }
}

/// Rim velocity at t_c over that before, for a contact that sticks (mu -> infinity). Shear is second order as long as the
/// contact lasts; the instant of release falls between two steps, hence the extrapolation.
struct Stick {
  double half_a_step_before_release, at_release;
};
Stick stick(Partner partner, double stiffness_ratio, int steps) {
  double const vt = slow(1e-4);
  Simulation sim = collide(partner, {vt, vt, 1e12, stiffness_ratio, steps});
  double last = 0, before = 0;
  for (int n = 0; n < steps; ++n) {
    before = last;
    sim.step();
    last = rim_velocity(sim) / vt;
  }
  return {last, 1.5 * last - 0.5 * before};
}

TEST(StickingCollision, TurnsTheRimVelocityByTheRatioOfStiffnesses) {
  struct Row {
    double stiffness_ratio, printed;
  };
  for (Partner partner : partners) {
    for (Row row : {Row{1, 0.66613}, Row{2.0 / 3, -0.26626}, Row{0.5, -0.76093}}) {
      EXPECT_NEAR(stick(partner, row.stiffness_ratio, 2000).at_release, row.printed, within(1.5e-5, 5e-3));
      double error[3];
      for (int level = 0; level < 3; ++level) {
        int const steps = 100 << level;
        double const phase = pi * std::sqrt(3 * row.stiffness_ratio) * (1 - 0.5 / steps);
        error[level] = stick(partner, row.stiffness_ratio, steps).half_a_step_before_release - std::cos(phase);
      }
      EXPECT_LT(std::abs(error[2]), within(1e-4, 5e-3));
      if (row.stiffness_ratio == 0.5) continue;  // the errors of phase and amplitude cancel there
      EXPECT_TRUE(shrinks(error[0], error[1], 2, 0.1, 5e-3)) << row.stiffness_ratio;
      EXPECT_TRUE(shrinks(error[1], error[2], 2, 0.1, 5e-3)) << row.stiffness_ratio;
    }
  }
}

/// psi = tangential rim velocity / (mu v_n) after a collision with friction that began with psi1.
double psi_after(Partner partner, double psi1, double stiffness_ratio, int steps) {
  double const vn = slow(1e-4), friction = 0.5;
  Simulation sim = collide(partner, {vn, psi1 * friction * vn, friction, stiffness_ratio, steps});
  sim.step(steps + 2);
  return rim_velocity(sim) / (friction * vn);
}

TEST(SlippingCollision, ChangesTheSpinByTwiceFrictionTimesTheNormalVelocityChange) {
  double const vn = slow(1e-4);
  for (double psi1 : {5.0, 8.0, -6.0}) {
    Simulation sim = on_the_floor({vn, psi1 * 0.5 * vn, 0.5, 0.5, 200});
    sim.step(202);
    double const gained = disc(sim, 0).vy + vn;  // (1 + e) v_n, whatever the step
    EXPECT_NEAR(disc(sim, 0).omega * grain_radius / (-2 * 0.5 * gained * (psi1 > 0 ? 1 : -1)), 1, 3e-3) << psi1;
    for (Partner partner : partners)
      EXPECT_NEAR(psi_after(partner, psi1, 0.5, 2000), psi1 - (psi1 > 0 ? 6 : -6), within(6e-3, 5e-2));
  }
}

TEST(SlippingCollision, FollowsTheTableOfPartialSlip) {
  double const psi1[] = {0.25, 0.5, 1, 1.5, 2, 3, 4, 5};
  double const equal_stiffness[] = {0.1460, 0.2376, 0.2184, -0.2255, -0.6899, -1.3191, -1.4838, -1.0000};
  double const two_thirds[] = {-0.0850, -0.2025, -0.5103, -0.8818, -1.3593, -1.9365, -1.8570, -1.0000};
  for (Partner partner : partners) {
    for (int k = 0; k < 8; ++k) {
      EXPECT_NEAR(psi_after(partner, psi1[k], 1, 2000), equal_stiffness[k], within(3e-4, 1e-2)) << psi1[k];
      EXPECT_NEAR(psi_after(partner, psi1[k], 2.0 / 3, 2000), two_thirds[k], within(3e-4, 1e-2)) << psi1[k];
    }
  }
}

/// Speed after over speed before a head-on collision with a dashpot.
double restitution(Partner partner, double damping_ratio, int steps) {
  double const vn = speed(1e-3);
  Simulation sim = collide(partner, {vn, 0, 0, 1, steps, damping_ratio});
  sim.step(2 * steps);
  return partner == Partner::wall ? disc(sim, 0).vy / vn : (disc(sim, 1).vx - disc(sim, 0).vx) / vn;
}

TEST(DampedCollision, LosesSpeedToADashpotThatNeverPulls) {
  struct Row {
    double damping_ratio, printed;
  };
  for (Partner partner : partners) {
    for (Row row : {Row{0.05, 0.85876}, Row{0.2, 0.57174}, Row{0.5, 0.29844}}) {
      // First order: the dashpot takes the velocity of half a step ago.
      double const coarse = restitution(partner, row.damping_ratio, 500) - row.printed,
                   fine = restitution(partner, row.damping_ratio, 1000) - row.printed;
      EXPECT_LT(std::abs(fine), 2e-3);
      EXPECT_NEAR(2 * fine - coarse, 0, 3e-5) << row.damping_ratio;
    }
  }
}

}  // namespace
}  // namespace clathra
