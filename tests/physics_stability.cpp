/// The stable time step: estimate, power iteration and what really happens, against exact limits.
#include "scenes.hpp"

namespace clathra {
namespace {

SimulationLaws equal_springs() {
  SimulationLaws laws = sand_laws(1e6, 0);
  laws.contact.grain.shear_stiffness = sand_kn;
  return laws;
}

double exact_limit(Simulation const& sim, int iterations) { return 2 / sim.largest_frequency(iterations); }
double estimate(Simulation const& sim) { return sim.stable_time_step(); }

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

/// A bonded packing, at rest but for a trace of noise, that can neither slip nor break.
Simulation trembling_packing(Composite composite) {
  Scene const scene = hydrate_scene(0.55, composite);
  Specimen s = disordered_patch(12, 12, 0.02);
  bond_all(s, scene);
  for (std::size_t i = 0; i < s.size(); ++i) s.vx[i] = 1e-3 * uniform_random(3, 5, i);
  SimulationLaws laws = unbreakable(bonded_laws(scene, s.critical_thickness));
  laws.contact.grain.friction = 1e9;
  return Simulation(s, laws, 0.1 * grain_d50);
}

double growth(Composite composite, double share, int steps) {
  Simulation sim = trembling_packing(composite);
  sim.time_step = share * exact_limit(sim, 2000);
  double const before = sim.measures().kinetic;
  try {
    for (int n = 0; n < steps; ++n) sim.step();
  } catch (Diverged const&) {
    return HUGE_VAL;
  }
  return sim.measures().kinetic / before;
}

TEST(StabilityLimit, OfABondedPackingDividesStableFromDiverging) {
  for (Composite composite : {Composite::replace, Composite::parallel}) {
    EXPECT_LT(growth(composite, 0.98, 3000), 30);
    EXPECT_GT(growth(composite, 1.05, 3000), 1e6);
    Simulation const sim = trembling_packing(composite);
    EXPECT_NEAR(exact_limit(sim, 20) / exact_limit(sim, 2000), 1, 0.05);  // 20 iterations come from above
    EXPECT_GE(exact_limit(sim, 20), exact_limit(sim, 2000) * (1 - 1e-9));
    EXPECT_LT(estimate(sim), exact_limit(sim, 2000));
  }
}

}  // namespace
}  // namespace clathra
