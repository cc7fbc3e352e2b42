/// The laws do not see a constant velocity or a rigid rotation of the whole, and stresses agree inside and at the walls.
#include "domain/generation/equilibration.hpp"
#include "kernels/stability.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

/// A bonded cluster of unequal discs whose discs fly and spin at random, without walls.
Specimen wild_cluster(double vx, double vy) {
  Specimen s = disordered_patch(8, 8);
  for (std::size_t i = 0; i < s.size(); ++i) {
    s.vx[i] = 5 * (uniform_random(1, 11, i) - 0.5) + vx;
    s.vy[i] = 5 * (uniform_random(1, 12, i) - 0.5) + vy;
    s.omega[i] = 5e4 * (uniform_random(1, 13, i) - 0.5);
  }
  bond_all(s, hydrate_scene(0.41, ContactCoupling::parallel));
  s.left = s.bottom = -1e9;
  s.right = s.top = 1e9;
  return s;
}

Simulation run_cluster(double vx, double vy, double dt, int steps) {
  Specimen const s = wild_cluster(vx, vy);
  Simulation sim(s, bonded_laws(hydrate_scene(0.41, ContactCoupling::parallel), s.critical_thickness), 0.05 * grain_d50);
  sim.time_step = dt;
  sim.step(steps);
  return sim;
}

TEST(ConstantVelocity, OfTheWholeDoesNotShowInTheRelativeMotion) {
  double const vx = 3, vy = -2, dt = 2e-8;
  Simulation const still = run_cluster(0, 0, dt, 1000), moving = run_cluster(vx, vy, dt, 1000);
  EXPECT_GT(still.assembly().broken_bonds(), 5);
  EXPECT_EQ(still.assembly().broken_bonds(), moving.assembly().broken_bonds());
  Specimen const a = still.specimen(), b = moving.specimen();
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_NEAR(b.x[i] - vx * moving.assembly().time(), a.x[i], within(1e-9, 1e-4) * grain_radius) << i;
    ASSERT_NEAR(b.y[i] - vy * moving.assembly().time(), a.y[i], within(1e-9, 1e-4) * grain_radius) << i;
    ASSERT_NEAR(b.vx[i] - vx, a.vx[i], within(1e-8, 1e-3)) << i;
    ASSERT_NEAR(b.omega[i], a.omega[i], within(1e-3, 30)) << i;
  }
  Measures const m = still.assembly().measures(), n = moving.assembly().measures();
  EXPECT_GT(m.bonded, 20);
  EXPECT_NEAR(m.bond_energy / n.bond_energy, 1, within(1e-7, 1e-4));
}

/// Largest force [N/m] in a stress-free bonded cluster after rigid turns about its middle, over that of one bond at its strength.
double force_after_turns(int steps_a_turn, int turns, ContactCoupling coupling) {
  Scene const scene = hydrate_scene(0.55, coupling);
  Specimen s = hexagonal_patch(5, 5, 2 * grain_radius + 1e-6);
  s.void_ratio = 1;
  bond_all(s, scene);
  EXPECT_GT(s.contacts.size(), 50u);
  Simulation sim(s, bonded_laws(scene, s.critical_thickness), 0.05 * grain_d50);
  sim.time_step = 1e-7;
  hold_all(sim);
  double const turn = 2 * pi / steps_a_turn, x0 = 5 * grain_radius, y0 = 4 * grain_radius;
  auto const x = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sim.assembly().particles.x);
  for (int n = 0; n < steps_a_turn * turns; ++n) {
    if (n % 50 == 0) sim.request_search();  // discs without inertia do not ask for one
    Specimen const now = sim.specimen();
    for (std::size_t i = 0; i < s.size(); ++i) {
      double const dx = now.x[i] - x0, dy = now.y[i] - y0, c = std::cos(turn) - 1, w = std::sin(turn);
      drive(sim, static_cast<int>(i), (c * dx - w * dy) / sim.time_step, (w * dx + c * dy) / sim.time_step, turn / sim.time_step);
    }
    sim.step();
  }
  double largest = 0;
  for (SpecimenContact const& c : sim.specimen().contacts) {
    largest = std::max({largest, std::abs(c.shear), std::abs(c.bond_shear)});
    EXPECT_EQ(c.moment, 0);
    EXPECT_EQ(c.bond_moment, 0);
  }
  EXPECT_EQ(sim.assembly().broken_bonds(), 0);
  EXPECT_NEAR(sim.assembly().measures().bonded, static_cast<double>(s.contacts.size()), 0);
  return largest / 876.0;
}

TEST(RigidRotation, OfABondedClusterStrainsNoBond) {
  for (ContactCoupling coupling : {ContactCoupling::replaces, ContactCoupling::parallel}) {
    double const coarse = force_after_turns(1000, 1, coupling), fine = force_after_turns(2000, 1, coupling);
    EXPECT_LT(coarse, 1e-3);
    EXPECT_TRUE(shrinks(coarse, fine, 2, 0.1, 3e-5));
  }
}

TEST(StressAtRest, IsTheSameInTheContactsAndAtTheWalls) {
  SimulationLaws laws = sand_laws();
  laws.motion.damping = 0.7;
  Simulation sim(disordered_patch(16, 20, 0.04, 3), laws, 0.1 * grain_d50);
  prepare_servo(sim, 1e6, 2e-3, grain_d50, {});
  EXPECT_TRUE(hold_stress(sim, 1e6, {within(1e-5, 1e-4)}, 60000, {}, "test"));
  sim.loading().x = sim.loading().y = AxisDrive::held();
  sim.step(3000);
  Measures const m = sim.assembly().measures();
  EXPECT_NEAR(m.stress_area_xx / sim.assembly().area() / sim.assembly().stress().x, 1, 2e-5);
  EXPECT_NEAR(m.stress_area_yy / sim.assembly().area() / sim.assembly().stress().y, 1, 2e-5);
  EXPECT_NEAR(m.stress_area_xy, m.stress_area_yx, 2e-5 * m.stress_area_xx);  // no moment stress at rest
  EXPECT_NEAR(sim.assembly().stress().x / 1e6, 1, 0.01);
}

}  // namespace
}  // namespace clathra
