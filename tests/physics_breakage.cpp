/// One bond broken in each mode at the load of the golden tables, and what is left of it in that very step.
#include "golden_bonds.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

constexpr double dt = 1e-7, R_t = 827.13, R_c = 4294.4, R_s_0 = 876.23, R_r_0 = 1766.0;  // S = 55 %, gap 0
constexpr double k_bn = 1.4209e8, k_bs = 9.4726e7, k_bm = 1.0840;
constexpr double L_r = 69.482e-6 / 14;
constexpr double printed_digits = 1e-4;

/// A pair bonded by the scene at an overlap (negative: across a gap), moved from outside. `shear` and `moment` are the grain
/// contact's history before.
Simulation held_pair(ContactCoupling coupling, double overlap, double shear = 0, double moment = 0) {
  Scene const scene = hydrate_scene(0.55, coupling);
  Specimen s = two_discs(overlap);
  s.void_ratio = 1;
  if (shear != 0) s.contacts.push_back({0, 1, shear, moment});
  bond_all(s, scene);
  Simulation sim(s, bonded_laws(scene, s.critical_thickness), 3e-4);
  sim.time_step = dt;
  hold_all(sim);
  return sim;
}

/// Steps with the discs' relative closing speed and spins.
void move(Simulation& sim, double closing, double spin_a, double spin_b, int steps) {
  drive(sim, 0, 0, 0, spin_a);
  drive(sim, 1, -closing, 0, spin_b);
  sim.step(steps);
}

/// Forces of the pair as disc 0 feels them: normal, shear, moment.
struct PairForce {
  double normal, shear, moment;
};
PairForce force(Simulation const& sim) {
  Disc const a = disc(sim, 0), b = disc(sim, 1);
  return {-a.fx, a.fy, a.torque - 0.5 * (b.x - a.x) * a.fy};
}

/// Bond forces just before and (as they would have been) in the step of the break.
struct Break {
  PairForce last;
  int steps;
};
Break move_until_broken(Simulation& sim, double closing, double spin_a, double spin_b) {
  Break result{force(sim), 0};
  while (sim.assembly().broken_bonds() == 0 && result.steps < 3000) {
    result.last = force(sim);
    move(sim, closing, spin_a, spin_b, 1);
    ++result.steps;
  }
  EXPECT_EQ(sim.assembly().broken_bonds(), 1);
  return result;
}

/// The load of the last intact step is below the strength, that of the next is not.
void expect_break_between(double last, double increment, double strength) {
  EXPECT_LT(last, strength * (1 + printed_digits));
  EXPECT_GE(last + increment, strength * (1 - printed_digits));
  EXPECT_LT(increment, 2e-3 * strength);
}

constexpr ContactCoupling couplings[] = {ContactCoupling::replaces, ContactCoupling::parallel,
                                         ContactCoupling::replaces_keeping_force};

TEST(BrokenBond, FailsInTensionAtTheTensileStrength) {
  for (ContactCoupling coupling : couplings) {
    Simulation sim = held_pair(coupling, 0);
    double const step = R_t / k_bn / 1000;
    Break const b = move_until_broken(sim, -step / dt, 0, 0);
    expect_break_between(-b.last.normal, k_bn * step, R_t);
    EXPECT_EQ(sim.assembly().break_counts()[BreakMode::tension], 1);
    PairForce const after = force(sim);  // u_n <= 0: nothing is left
    EXPECT_EQ(after.normal, 0);
    EXPECT_EQ(after.shear, 0);
    EXPECT_EQ(after.moment, 0);
  }
}

TEST(BrokenBond, FailsInCompressionAtTheCompressiveStrength) {
  for (ContactCoupling coupling : couplings) {
    Simulation sim = held_pair(coupling, 0);
    double const step = R_c / k_bn / 1000;
    Break const b = move_until_broken(sim, step / dt, 0, 0);
    double const grain = coupling == ContactCoupling::parallel ? sand_kn * step * (b.steps - 1) : 0;
    expect_break_between(b.last.normal - grain, k_bn * step, R_c);
    EXPECT_EQ(sim.assembly().break_counts()[BreakMode::compression], 1);
    EXPECT_NEAR(force(sim).normal / (sand_kn * step * b.steps), 1, within(1e-9, 1e-5));
  }
}

TEST(BrokenBond, FailsInShearAtTheShearStrengthOfItsNormalForce) {
  struct Row {
    double normal, strength;
  };
  for (Row row : {Row{0, R_s_0}, Row{200, 1009.9}, Row{1000, 1382.5}}) {
    Simulation sim = held_pair(ContactCoupling::replaces, 0);
    move(sim, row.normal / k_bn / 100 / dt, 0, 0, 100);
    double const spin = 1000.0, arm = grain_radius - 0.5 * row.normal / k_bn;
    Break const b = move_until_broken(sim, 0, spin, spin);
    EXPECT_NEAR(b.last.normal, row.normal, 0.01);
    expect_break_between(std::abs(b.last.shear), k_bs * 2 * spin * arm * dt, row.strength);
    EXPECT_NEAR(b.last.moment, 0, within(1e-9, 1e-7));
    EXPECT_EQ(sim.assembly().break_counts()[BreakMode::shear], 1);
  }
}

TEST(BrokenBond, FailsInRollingAtTheRollingStrengthOfItsNormalForce) {
  struct Row {
    double normal, strength;
  };
  for (Row row : {Row{0, R_r_0}, Row{200, 2035.4}, Row{1000, 2786.4}}) {
    Simulation sim = held_pair(ContactCoupling::replaces, 0);
    move(sim, row.normal / k_bn / 100 / dt, 0, 0, 100);
    double const spin = 40.0;
    Break const b = move_until_broken(sim, 0, spin, -spin);
    expect_break_between(std::abs(b.last.moment), k_bm * 2 * spin * dt, row.strength * L_r);
    EXPECT_NEAR(b.last.shear, 0, 1e-6);
    EXPECT_EQ(sim.assembly().break_counts()[BreakMode::rolling], 1);
  }
}

TEST(BrokenBond, FailsOnTheEllipseUnderShearAndMomentTogether) {
  Simulation sim = held_pair(ContactCoupling::replaces, 0);
  Break const b = move_until_broken(sim, 0, 900, 850);
  double const shear = std::abs(b.last.shear) / R_s_0, moment = std::abs(b.last.moment) / (R_r_0 * L_r);
  EXPECT_GT(shear, 0.05);
  double const now = std::hypot(shear, moment);
  EXPECT_LT(now, 1 + printed_digits);
  EXPECT_GE(now * (b.steps + 1.0) / b.steps, 1 - printed_digits);
}

TEST(BrokenBond, UnderCompressionFollowsTheGrainLawFromTheSameStepOn) {
  struct Row {
    double formed_at, before;  // overlap at formation [m], force at an overlap of 2 um just before [N/m]
  };
  for (Row row : {Row{0, 284.18}, Row{-5e-6, 962.85}}) {
    Simulation sim = held_pair(ContactCoupling::replaces, row.formed_at);
    EXPECT_NEAR(force(sim).normal, 0, within(0, 5e-3));
    move(sim, (2e-6 - row.formed_at) / 100 / dt, 0, 0, 100);
    EXPECT_NEAR(force(sim).normal, row.before, 0.05);
    Break const b = move_until_broken(sim, 0, 800, 900);
    EXPECT_NEAR(b.last.normal, row.before, 0.05);
    EXPECT_GT(std::abs(b.last.shear), 300);
    PairForce const after = force(sim);
    EXPECT_NEAR(after.normal, 600, within(1e-6, 1e-2));
    EXPECT_NEAR(after.shear, -300, within(1e-6, 1e-2));  // clipped to mu F_n, with its sign
    double const limit = 600 * 2 * grain_radius / 6;
    EXPECT_NEAR(after.moment, std::min(b.last.moment + k_bm * 100 * dt, limit), 2e-3 * limit);
    EXPECT_GT(after.moment, 0);
  }
}

TEST(BrokenBond, InParallelLeavesTheGrainContactAsItWas) {
  Simulation sim = held_pair(ContactCoupling::parallel, 2e-6);
  EXPECT_NEAR(force(sim).normal, 600, within(1e-6, 1e-2));  // the bond is free of stress
  Break const b = move_until_broken(sim, 0, 800, 800);
  EXPECT_NEAR(b.last.normal, 600, within(1e-6, 1e-2));
  EXPECT_NEAR(std::abs(b.last.shear) - 300, R_s_0, 20);  // bond forces alone are tested
  PairForce const after = force(sim);
  EXPECT_NEAR(after.normal, 600, within(1e-6, 1e-2));
  EXPECT_NEAR(after.shear, -300, within(1e-6, 1e-2));
}

TEST(NewBond, IsFreeOfStressAndTreatsThePresentContactAsItsCompositeSays) {
  double const overlap = 1e-6, shear = 30, moment = 2e-3;
  PairForce const replaced = force(held_pair(ContactCoupling::replaces, overlap, shear, moment));
  EXPECT_NEAR(replaced.normal, 0, within(0, 5e-3));
  EXPECT_EQ(replaced.shear, 0);
  EXPECT_EQ(replaced.moment, 0);
  for (ContactCoupling coupling : {ContactCoupling::parallel, ContactCoupling::replaces_keeping_force}) {
    PairForce const kept = force(held_pair(coupling, overlap, shear, moment));
    EXPECT_NEAR(kept.normal, 300, within(1e-6, 1e-2));
    EXPECT_NEAR(kept.shear, shear, within(1e-12, 1e-4));
    EXPECT_NEAR(kept.moment, moment, within(1e-12, 1e-8));
    Simulation sim = held_pair(coupling, overlap, shear, moment);
    move(sim, 1e-7 / 10 / dt, 0, 0, 10);
    double const stiffness = coupling == ContactCoupling::parallel ? sand_kn + k_bn : k_bn;
    EXPECT_NEAR((force(sim).normal - 300) / (stiffness * 1e-7), 1, 1e-4);
  }
}

/// A free pair of unequal discs, bonded across a small gap, flying apart and spinning.
Simulation flying_pair(ContactCoupling coupling, double apart, double spin) {
  Scene const scene = hydrate_scene(0.55, coupling);
  Specimen s = two_discs(-1e-6, grain_radius, 1.7 * grain_radius);
  s.void_ratio = 1;
  s.vx = {0.3 - apart, 0.3 + 0.3 * apart};
  s.vy = {-0.2, 0.1};
  s.omega = {spin, -0.4 * spin};
  bond_all(s, scene);
  Simulation sim(s, bonded_laws(scene, s.critical_thickness), 1e-6);
  sim.time_step = 0.5e-7;
  return sim;
}

struct Momentum {
  double x = 0, y = 0, angular = 0, size = 0, angular_size = 0;
};
Momentum momentum(Simulation const& sim) {
  Momentum sum;
  for (int id : {0, 1}) {
    Disc const d = disc(sim, id);
    double const r = (id == 0 ? 1 : 1.7) * grain_radius, m = grain_mass(r);
    sum.x += m * d.vx;
    sum.y += m * d.vy;
    sum.angular += m * (d.x * d.vy - d.y * d.vx) + 0.5 * m * r * r * d.omega;
    sum.size += m * std::hypot(d.vx, d.vy);
    sum.angular_size += m * std::hypot(d.x, d.y) * std::hypot(d.vx, d.vy) + 0.5 * m * r * r * std::abs(d.omega);
  }
  return sum;
}

TEST(BrokenBond, ConservesLinearAndAngularMomentum) {
  for (ContactCoupling coupling : couplings) {
    for (double apart : {3.0, -2.5}) {  // by tension; by shear and rolling under compression
      Simulation sim = flying_pair(coupling, apart, 2e4);
      Momentum const start = momentum(sim);
      int broke_at = 0;
      for (int n = 1; n <= 400; ++n) {
        sim.step();
        if (broke_at == 0 && sim.assembly().broken_bonds() == 1) broke_at = n;
        Disc const a = disc(sim, 0), b = disc(sim, 1);
        ASSERT_EQ(a.fx, -b.fx);  // to the bit
        ASSERT_EQ(a.fy, -b.fy);
        Momentum const now = momentum(sim);
        ASSERT_NEAR(now.x, start.x, within(1e-14, 1e-6) * start.size);
        ASSERT_NEAR(now.y, start.y, within(1e-14, 1e-6) * start.size);
        ASSERT_NEAR(now.angular, start.angular, within(1e-13, 1e-6) * start.angular_size);
      }
      EXPECT_GT(broke_at, 0);
    }
  }
}

}  // namespace
}  // namespace clathra
