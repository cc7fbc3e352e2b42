/// The stable time step: estimate, power iteration and what really happens, against exact limits.
#include "scenes.hpp"

namespace clathra {
namespace {

SimulationLaws equal_springs() {
  SimulationLaws laws = sand_laws(1e6, 0);
  laws.contact.grain.shear_stiffness = sand_kn;
  return laws;
}

double exact_limit(Simulation const& sim, int iterations) { return 2 / sim.assembly().largest_frequency(iterations); }
double estimate(Simulation const& sim) {
  return local_time_step({sim.assembly().particles, sim.assembly().rows, sim.assembly().laws.contact, sim.assembly().walls(),
                          sim.assembly().laws.wall});
}

/// In units of sqrt(m / k_n).
double unit_time() { return std::sqrt(grain_mass() / sand_kn); }

constexpr double closer = 2 * grain_radius * (1 - 1e-9);  // just in touch

TEST(StabilityLimit, OfTwoDiscsIsThatOfTheirShearSpring) {
  Simulation const sim(two_discs(1e-12), equal_springs(), 1e-6);
  EXPECT_NEAR(exact_limit(sim, 200) / unit_time(), 2 / std::sqrt(6.0), 1e-6);
}

TEST(StabilityLimit, OfTheHexagonalLatticeIsTheExactOne) {
  Simulation const sim(hexagonal_patch(40, 40, closer), equal_springs(), 1e-6);
  EXPECT_NEAR(exact_limit(sim, 400) / unit_time(), 0.408, 0.003);
  EXPECT_NEAR(exact_limit(sim, 20) / exact_limit(sim, 400), 1, 0.05);
  EXPECT_NEAR(estimate(sim) / unit_time(), 1 / std::sqrt(6.0), 1e-6);  // exact where all discs are alike
}

TEST(StabilityLimit, OfTheSquareLatticeIsTheExactOne) {
  Specimen s = open_space();
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 40; ++column) add_disc(s, column * closer, row * closer);
  }
  Simulation const sim(s, equal_springs(), 1e-6);
  EXPECT_NEAR(exact_limit(sim, 400) / unit_time(), 0.500, 0.004);
  EXPECT_NEAR(estimate(sim) / unit_time(), 0.5, 1e-6);
}

TEST(StabilityLimit, OfADiscOnARoughFloorIsThatOfItsShearSpring) {
  for (double const friction : {0.0, 0.3}) {
    SimulationLaws laws = sand_laws();
    laws.wall.friction = friction;
    Simulation const sim(disc_on_floor(1e-9), laws, 1e-6);
    double const stiffness = friction > 0 ? 3 * sand_ks : sand_kn;  // F_s turns the disc as well: k_s (1/m + r^2/I)
    EXPECT_NEAR(exact_limit(sim, 200), 2 * std::sqrt(grain_mass() / stiffness), 1e-4 * unit_time());
    double const frame = std::sqrt(2.0);  // x and the rotation pull on each other, in |K| as in K
    EXPECT_LE(sim.assembly().stable_limit(), exact_limit(sim, 200) * (1 + 1e-6));
    EXPECT_GE(sim.assembly().stable_limit(), exact_limit(sim, 200) / frame);
  }
}

/// A bonded packing, at rest but for a trace of noise, that can neither slip nor break.
Simulation trembling_packing(ContactCoupling coupling, double alpha = 0, double dashpot = 0) {
  Scene const scene = hydrate_scene(0.55, coupling);
  Specimen s = disordered_patch(12, 12, 0.02);
  bond_all(s, scene);
  for (std::size_t i = 0; i < s.size(); ++i) s.vx[i] = 1e-3 * uniform_random(3, 5, i);
  SimulationLaws laws = unbreakable(bonded_laws(scene, s.critical_thickness));
  laws.contact.grain.friction = 1e9;
  laws.contact.grain.damping_ratio = dashpot;
  laws.motion.damping = alpha;
  return Simulation(s, laws, 0.1 * grain_d50);
}

/// @param sim  made for this alone: a copy would share its discs
double growth_of(Simulation&& sim, double time_step, int steps) {
  sim.time_step = time_step;
  double const before = sim.assembly().measures().kinetic;
  try {
    sim.step(steps);
  } catch (Diverged const&) {
    return HUGE_VAL;
  }
  return sim.assembly().measures().kinetic / before;
}

double growth(ContactCoupling coupling, double share, int steps) {
  double const limit = exact_limit(trembling_packing(coupling), 2000);
  return growth_of(trembling_packing(coupling), share * limit, steps);
}

TEST(StabilityLimit, OfABondedPackingDividesStableFromDiverging) {
  for (ContactCoupling coupling : {ContactCoupling::replaces, ContactCoupling::parallel}) {
    EXPECT_LT(growth(coupling, 0.98, 3000), 30);
    EXPECT_GT(growth(coupling, 1.05, 3000), 1e6);
    Simulation const sim = trembling_packing(coupling);
    EXPECT_NEAR(exact_limit(sim, 20) / exact_limit(sim, 2000), 1, 0.05);  // 20 iterations come from above
    EXPECT_GE(exact_limit(sim, 20), exact_limit(sim, 2000) * (1 - 1e-9));
    EXPECT_LT(estimate(sim), exact_limit(sim, 2000));
  }
}

/// Nothing but grain contacts, which are loaded so that none opens.
Simulation trembling_sand(double alpha, double dashpot) {
  Specimen s = disordered_patch(12, 12, 0.02);
  for (std::size_t i = 0; i < s.size(); ++i) {
    s.x[i] *= 0.94;
    s.y[i] *= 0.94;
    s.vx[i] = 1e-6 * uniform_random(3, 5, i);
  }
  enclose(s);
  SimulationLaws laws = sand_laws(1e9, 2);
  laws.contact.grain.damping_ratio = dashpot;
  laws.motion.damping = 0.7;
  Simulation sim(s, laws, 0.1 * grain_d50);
  sim.time_step = 0.2 * sim.assembly().stable_time_step();
  sim.step(20000);  // it comes to rest
  laws.motion.damping = alpha;
  sim.set_laws(laws);
  sim.add_uniform_strain_rate(1e-3, -2e-3);
  return sim;
}

TEST(StableLimit, IsNeverAboveTheExactOneAndNearIt) {
  for (ContactCoupling coupling : {ContactCoupling::replaces, ContactCoupling::parallel}) {
    Simulation const sim = trembling_packing(coupling);
    EXPECT_LT(sim.assembly().stable_limit(), exact_limit(sim, 2000));
    EXPECT_GT(sim.assembly().stable_limit(), 0.5 * exact_limit(sim, 2000));  // its gaps are small: most may close
  }
  Simulation const sand = trembling_sand(0, 0);
  EXPECT_LT(sand.assembly().stable_limit(), exact_limit(sand, 2000));
  EXPECT_GT(sand.assembly().stable_limit(), 0.9 * exact_limit(sand, 2000));
  Simulation const lattice(hexagonal_patch(20, 20, closer), equal_springs(), 1e-6);
  EXPECT_LT(lattice.assembly().stable_limit(), exact_limit(lattice, 400) * (1 + 1e-9));
  EXPECT_GT(lattice.assembly().stable_limit(), 0.86 * exact_limit(lattice, 400));
}

// At the limit the force of local damping always opposes the velocity: the kick is that of (1 + alpha) times the force.
TEST(StableLimit, FallsWithLocalDampingByTheRootOfOnePlusAlpha) {
  if (tested_precision() == Precision::mixed) GTEST_SKIP() << "grows from motions far below a tick";
  for (double const alpha : {0.3, 0.7}) {
    Simulation const sim = trembling_sand(alpha, 0), undamped = trembling_sand(0, 0);
    EXPECT_NEAR(sim.assembly().stable_limit() / undamped.assembly().stable_limit(), 1 / std::sqrt(1 + alpha), 0.01);
    double const exact = exact_limit(sim, 2000) / std::sqrt(1 + alpha);
    EXPECT_LT(growth_of(trembling_sand(alpha, 0), sim.assembly().stable_limit(), 4000), 1);
    EXPECT_GT(growth_of(trembling_sand(alpha, 0), 1.06 * exact, 4000), 1e3);
  }
}

TEST(StableLimit, KnowsDashpots) {
  if (tested_precision() == Precision::mixed) GTEST_SKIP() << "grows from motions far below a tick";
  Simulation const undamped = trembling_sand(0, 0);
  for (double const dashpot : {0.2, 1.0}) {
    double const limit = trembling_sand(0, dashpot).assembly().stable_limit();
    EXPECT_LT(growth_of(trembling_sand(0, dashpot), limit, 4000), 1) << dashpot;
    EXPECT_GT(growth_of(trembling_sand(0, dashpot), 1.4 * limit, 4000), 1e3) << dashpot;
    EXPECT_LT(limit, undamped.assembly().stable_limit());
  }
}

TEST(StableTimeStep, IsCappedAtTheLimitOfDampingAndDashpots) {
  Simulation const viscous = trembling_sand(0, 1), plain = trembling_sand(0.3, 0);
  EXPECT_LT(viscous.assembly().stable_limit(), estimate(viscous));
  EXPECT_EQ(viscous.assembly().stable_time_step(), 0.95 * viscous.assembly().stable_limit());
  EXPECT_EQ(plain.assembly().stable_time_step(0.7), 0.7 * estimate(plain));
}

// A bond in place of the contact is softer than that: when it breaks the grains' own stiffness is back.
TEST(StableTimeStep, KnowsTheStiffnessBehindBondsThatMayBreak) {
  for (ContactCoupling coupling : {ContactCoupling::replaces, ContactCoupling::replaces_keeping_force}) {
    Scene const scene = hydrate_scene(0.55, coupling);
    Specimen s = two_discs(1e-6);
    bond_all(s, scene);
    Simulation const bonded(s, bonded_laws(scene, s.critical_thickness), 0.1 * grain_d50);
    ASSERT_EQ(bonded.assembly().measures().bonded, 1);
    s.contacts[0].formation_overlap = no_bond;
    Simulation const broken(s, bonded_laws(scene, s.critical_thickness), 0.1 * grain_d50);
    EXPECT_GT(exact_limit(bonded, 200), 1.2 * exact_limit(broken, 200));
    EXPECT_LE(bonded.assembly().stable_limit(), broken.assembly().stable_limit() * (1 + 1e-6));
    EXPECT_LE(estimate(bonded), estimate(broken) * (1 + 1e-12));
  }
}

}  // namespace
}  // namespace clathra
