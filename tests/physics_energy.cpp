/// The energy ledger: no account is computed as the remainder, so the remainder is the test.
#include "scenes.hpp"

namespace clathra {
namespace {

double stored(Measures const& m) { return m.kinetic + m.grain_energy + m.bond_energy + m.wall_energy; }
double lost(DissipationTotals const& l) { return l.sliding + l.rolling + l.dashpot + l.breakage + l.damping; }

/// What a bonded pair flies with before and after its bond broke; both times nothing but kinetic energy.
struct BrokenPair {
  double residual, breakage;
};
BrokenPair break_pair(ContactCoupling coupling, int refinement) {
  Scene const scene = hydrate_scene(0.55, coupling);
  Specimen s = two_discs(-1e-6, grain_radius, 1.3 * grain_radius);
  s.void_ratio = 1;
  s.vx = {-16, 12};
  s.omega = {300, -100};
  bond_all(s, scene);
  Simulation sim(s, bonded_laws(scene, s.critical_thickness), 1e-5);
  sim.time_step = 0.2e-7 / refinement;
  sim.set_ledger(true);
  double const start = stored(sim.assembly().measures());
  sim.step(400 * refinement);
  EXPECT_EQ(sim.assembly().broken_bonds(), 1);
  Measures const m = sim.assembly().measures();
  EXPECT_EQ(m.grain_energy + m.bond_energy, 0);
  return {start - m.kinetic - lost(sim.assembly().losses()), sim.assembly().losses().breakage};
}

TEST(EnergyLedger, OfABrokenPairClosesToFirstOrder) {
  for (ContactCoupling coupling :
       {ContactCoupling::replaces, ContactCoupling::parallel, ContactCoupling::replaces_keeping_force}) {
    BrokenPair const coarse = break_pair(coupling, 2), fine = break_pair(coupling, 8);
    EXPECT_NEAR(fine.breakage / (0.5 * 827.0 * 827.0 / 1.42e8), 1, 0.1);
    EXPECT_LT(std::abs(coarse.residual), 0.05 * coarse.breakage);
    EXPECT_LT(std::abs(fine.residual), 0.5 * std::abs(coarse.residual));
  }
}

TEST(EnergyLedger, CountsWhatBreakingStiffens) {
  // S = 55 %, u_0 = 0, u_n = 2 um: 284 -> 600 N/m sets (k_n - k_bn) u^2 / 2 = 3.16e-4 J/m free; the shear is clipped to 300 N/m.
  Scene const scene = hydrate_scene(0.55, ContactCoupling::replaces);
  Specimen s = two_discs(0);
  s.void_ratio = 1;
  bond_all(s, scene);
  Simulation sim(s, bonded_laws(scene, s.critical_thickness), 3e-4);
  sim.time_step = 1e-7;
  hold_all(sim);
  drive(sim, 1, -2e-6 / 100 / 1e-7, 0, 0);
  sim.step(100);
  sim.set_ledger(true);
  EXPECT_NEAR(sim.assembly().measures().bond_energy, 0.5 * 1.4209e8 * 4e-12, 1e-7);
  drive(sim, 0, 0, 0, 100);
  drive(sim, 1, 0, 0, 100);
  while (sim.assembly().broken_bonds() == 0) sim.step();
  double const shear = 1060.9, free_energy = 0.5 * (3e8 - 1.4209e8) * 4e-12;  // R_s at 284.18 N/m
  double const of_shear = 0.5 * shear * shear / 9.4726e7 - 0.5 * 300 * 300 / 2e8;
  EXPECT_NEAR(free_energy, 3.16e-4, 1e-6);
  EXPECT_NEAR(sim.assembly().losses().breakage, of_shear - free_energy, 0.01 * of_shear);
}

/// What goes in through the walls of a bonded packing that is sheared until many bonds broke, and where it went.
struct Balance {
  double work = 0, residual = 0, flow = 0;
  int broken = 0;
};
Balance shear_packing(ContactCoupling coupling, double dt_share, double dashpot) {
  Scene const scene = hydrate_scene(0.41, coupling);
  Specimen s = disordered_patch(14, 16);
  bond_all(s, scene);
  SimulationLaws laws = bonded_laws(scene, s.critical_thickness);
  laws.motion.damping = 0.3;
  laws.wall.friction = 0.2;
  laws.contact.grain.damping_ratio = dashpot;
  Simulation sim(s, laws, 0.05 * grain_d50);
  sim.time_step = dt_share * sim.assembly().stable_time_step();
  sim.set_ledger(true);
  sim.loading().y = AxisDrive::at_rate(300);
  double const start = stored(sim.assembly().measures());
  while (std::log(s.height() / sim.assembly().walls().height()) < 0.06) sim.step();
  DissipationTotals const l = sim.assembly().losses();
  Balance b{sim.assembly().boundary_work(), 0, 0, sim.assembly().broken_bonds()};
  b.residual = b.work - (stored(sim.assembly().measures()) - start) - lost(l);
  b.flow = std::abs(b.work) + std::abs(l.breakage);
  EXPECT_GT(l.sliding, 0);
  EXPECT_GT(l.rolling, 0);
  EXPECT_GT(l.damping, 0);
  EXPECT_EQ(l.dashpot > 0, dashpot > 0);
  return b;
}

TEST(EnergyLedger, OfAShearedPackingCloses) {
  for (ContactCoupling coupling :
       {ContactCoupling::replaces, ContactCoupling::parallel, ContactCoupling::replaces_keeping_force}) {
    Balance const coarse = shear_packing(coupling, 0.7, 0), fine = shear_packing(coupling, 0.35, 0);
    EXPECT_GT(coarse.broken, 50);
    EXPECT_LT(std::abs(coarse.residual), 2e-3 * coarse.flow);
    EXPECT_LT(std::abs(fine.residual), within(4e-4, 8e-4) * fine.flow);
  }
  Balance const damped = shear_packing(ContactCoupling::parallel, 0.3, 0.1);
  EXPECT_LT(std::abs(damped.residual), 1e-3 * damped.flow);
}

TEST(EnergyLedger, StandsStillWithoutIt) {
  Scene const scene = hydrate_scene(0.41, ContactCoupling::parallel);
  Specimen s = disordered_patch(6, 6);
  bond_all(s, scene);
  Simulation sim(s, bonded_laws(scene, s.critical_thickness), 0.05 * grain_d50);
  sim.time_step = 1e-8;
  sim.step();
  DissipationTotals const l = sim.assembly().losses();
  EXPECT_EQ(l.sliding + l.rolling + l.dashpot + l.breakage + l.damping, 0);
}

}  // namespace
}  // namespace clathra
