/// Intact bonds: stiffness of a chain, no work on closed paths, rigid turns.
#include <array>

#include "draw.hpp"
#include "golden_bonds.hpp"
#include "printed_number.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

constexpr double golden_k_bn = 1.4209e8;  // S = 55 %, gap 0: table of golden numbers

/// Force over shortening of a chain of `bonds` bonds between two walls, at rest.
double stiffness_of_chain(int bonds) {
  Scene const scene = hydrate_scene(0.55, ContactCoupling::replaces);
  Specimen s = open_space();
  for (int n = 0; n <= bonds; ++n) add_disc(s, 2 * grain_radius * n, 0);
  enclose(s);
  s.bottom = -1e9;
  s.top = 1e9;
  for (int n = 0; n < bonds; ++n) s.contacts.push_back({n, n + 1, 0, 0, 0});
  SimulationLaws laws = bonded_laws(scene, h_max_of(scene));
  laws.motion.damping = 0.7;
  Simulation sim(s, laws, 1e-5);
  sim.time_step = 1e-7;
  double const width = sim.assembly().walls().width();
  sim.loading().x = AxisDrive::at_rate(1.0, true);
  while (width - sim.assembly().walls().width() < 0.3e-6 * bonds) sim.step();
  sim.loading().x = AxisDrive::held();
  sim.step(6000);
  EXPECT_NEAR(sim.assembly().reactions().normal[left] / sim.assembly().reactions().normal[right], 1, within(1e-7, 3e-5));
  return sim.assembly().reactions().normal[left] / (width - sim.assembly().walls().width());
}

TEST(ChainOfBonds, HasTheStiffnessOfOneBondDividedByTheirNumber) {
  for (int bonds : {1, 2, 4, 8}) {
    // The two wall contacts are springs in the same row.
    double const flexibility = 1 / stiffness_of_chain(bonds) - 2 / sand_kn;
    EXPECT_NEAR(bonds / flexibility / golden_k_bn, 1, 5e-5) << bonds;
  }
}

/// A loaded pair that moves as it is told: a grain contact of 300 N/m with a bond made on it.
Simulation driven_pair(ContactCoupling coupling) {
  Scene const scene = hydrate_scene(0.55, coupling);
  Specimen s = two_discs(1e-6, grain_radius, 1.5 * grain_radius);
  s.void_ratio = 1;
  s.contacts.push_back({0, 1, 20, 1e-3});
  bond_all(s, scene);
  Simulation sim(s, bonded_laws(scene, s.critical_thickness), 3e-4);
  sim.time_step = 1e-7;
  hold_all(sim);
  return sim;
}

using Way = std::array<double, 6>;  // x, y and angle of either disc

/// Work of the pair's forces along a closed path and the sum of its amounts.
struct Work {
  double net = 0, gross = 0;
};
Work go_round(Simulation& sim, std::array<double, 6> const& phase, double amplitude, int steps) {
  auto const place = [&](int step) {
    Way at;
    for (std::size_t k = 0; k < 6; ++k)
      at[k] = (k % 3 == 2 ? 1 / grain_radius : 1) * amplitude * std::sin(2 * pi * step / steps + phase[k]);
    return at;
  };
  auto const forces = [&] {
    Disc const a = disc(sim, 0), b = disc(sim, 1);
    return Way{a.fx, a.fy, a.torque, b.fx, b.fy, b.torque};
  };
  Work work;
  Way force = forces(), at = place(0);
  for (int n = 1; n <= steps; ++n) {
    Way const next = place(n);
    std::array<double, 6> rate;
    for (std::size_t k = 0; k < 6; ++k) rate[k] = (next[k] - at[k]) / sim.time_step;
    drive(sim, 0, rate[0], rate[1], rate[2]);
    drive(sim, 1, rate[3], rate[4], rate[5]);
    sim.step();
    Way const now = forces();
    for (std::size_t k = 0; k < 6; ++k) {
      double const done = 0.5 * (force[k] + now[k]) * (next[k] - at[k]);
      work.net += done;
      work.gross += std::abs(done);
    }
    force = now;
    at = next;
  }
  return work;
}

TEST(ClosedPath, OfABondedPairDoesNoNetWork) {
  for (ContactCoupling coupling :
       {ContactCoupling::replaces, ContactCoupling::parallel, ContactCoupling::replaces_keeping_force}) {
    Draw draw(7);
    // Small paths: lever arms change with the overlap, which leaves work of the third order in the amplitude.
    double const amplitude = 1e-6 * grain_radius;
    double coarse = 0, fine = 0;
    for (int path = 0; path < 100; ++path) {
      std::array<double, 6> phase;
      for (double& p : phase) p = draw.between(0, 2 * pi);
      Simulation sim = driven_pair(coupling);
      Work const work = go_round(sim, phase, amplitude, 200);
      EXPECT_LT(std::abs(work.net), within(1e-6, 1e-2) * work.gross) << path;
      if (coupling != ContactCoupling::replaces || path % 10 != 0) continue;
      Simulation large = driven_pair(coupling), slow = driven_pair(coupling);
      coarse += std::abs(go_round(large, phase, 1e3 * amplitude, 200).net);
      fine += std::abs(go_round(slow, phase, 1e3 * amplitude, 800).net);
    }
    EXPECT_LE(fine, within(0.5, 2) * coarse);  // falls with the step to that rest
  }
}

TEST(LoadAndUnload, OfABondInOneDirectionGivesTheWorkBack) {
  for (std::size_t direction = 0; direction < 6; ++direction) {
    std::array<double, 6> phase;
    phase.fill(-pi / 2);
    Simulation sim = driven_pair(ContactCoupling::replaces);
    double const amplitude = 1e-3 * grain_radius;
    double net = 0, gross = 0;
    double last = disc(sim, 0).fx;
    constexpr int steps = 200;
    bool const turn = direction % 3 == 2;
    double const way = turn ? amplitude / grain_radius : amplitude;
    auto const force = [&] {
      Disc const d = disc(sim, direction < 3 ? 0 : 1);
      return direction % 3 == 0 ? d.fx : direction % 3 == 1 ? d.fy : d.torque;
    };
    last = force();
    for (int n = 0; n < 2 * steps; ++n) {
      double const rate = (n < steps ? way : -way) / steps / sim.time_step;
      drive(sim, direction < 3 ? 0 : 1, direction % 3 == 0 ? rate : 0, direction % 3 == 1 ? rate : 0, turn ? rate : 0);
      sim.step();
      double const now = force(), done = 0.5 * (last + now) * rate * sim.time_step;
      net += done;
      gross += std::abs(done);
      last = now;
    }
    EXPECT_LT(std::abs(net), 1e-5 * gross) << direction;
  }
}

/// A bonded pair in free rigid rotation: the exact circle of leapfrog, chords and all. (Where normal and shear springs swing, the
/// slip taken over the distance at the step's end feeds their coupling a little in each step: of the order of the squared turn a
/// step, so that 600 steps a turn let rounding errors grow tenfold in sixty turns. Sand turns a millionth of that a step.)
TEST(RigidTurn, LeavesTheForcesOfAFreePairUnchanged) {
  Scene const scene = hydrate_scene(0.55, ContactCoupling::replaces);
  constexpr int steps = 1200;
  double const dt = 1e-7, turn = 2 * pi / steps, u0 = 2e-6;
  SimulationLaws const laws = bonded_laws(scene, h_max_of(scene));
  double const k = laws.contact.bond.stiffness(laws.contact.bond.width(grain_radius, 0.0), 0.0).normal;
  // Pull = m R (2 sin(turn/2) / dt)^2 with R = r + pull / 2k - u0 / 2.
  double const rate2 = std::pow(2 * std::sin(turn / 2) / dt, 2), m = grain_mass();
  double const pull = m * rate2 * (grain_radius - u0 / 2) / (1 - m * rate2 / (2 * k));
  Specimen s = two_discs(u0 - pull / k);
  s.contacts.push_back({0, 1, 0, 0, u0});
  double const radius = 0.5 * s.x[1], chord = 2 * radius * std::sin(turn / 2) / dt;
  s.x = {-radius, radius};
  s.vx = {-chord * std::sin(turn / 2), chord * std::sin(turn / 2)};
  s.vy = {-chord * std::cos(turn / 2), chord * std::cos(turn / 2)};
  s.omega = {std::sin(turn) / dt, std::sin(turn) / dt};
  Simulation sim(s, laws, 1e-5);  // a small skin: many neighbour searches on the way
  sim.time_step = dt;
  EXPECT_NEAR(disc(sim, 0).fx / pull, 1, within(1e-9, 5e-4));
  for (int n = 1; n <= 100 * steps; ++n) {
    sim.step();
    if (n % (7 * steps + 11) != 0 && n != 100 * steps) continue;
    Disc const d = disc(sim, 0);
    EXPECT_NEAR(std::hypot(d.fx, d.fy) / pull, 1, within(1e-8, 0.06));
    SpecimenContact const c = pair_history(sim);
    EXPECT_NEAR(c.shear / pull, 0, within(1e-8, 2e-3));
    EXPECT_NEAR(c.moment / (pull * grain_radius), 0, 1e-8);
  }
  EXPECT_NEAR(disc(sim, 1).x / radius, 1, 1e-3);
  EXPECT_GT(sim.assembly().upkeep.searches(), 1000);
}

/// Carries disc 1 about disc 0 by `angle` in one step, both discs turning along at `spin`.
void carry_round(Simulation& sim, double dx, double dy, double from, double angle, double spin) {
  auto const x = [&](double t) { return dx * std::cos(t) - dy * std::sin(t); };
  auto const y = [&](double t) { return dx * std::sin(t) + dy * std::cos(t); };
  double const to = from + angle, dt = sim.time_step;
  drive(sim, 0, 0, 0, spin);
  drive(sim, 1, (x(to) - x(from)) / dt, (y(to) - y(from)) / dt, spin);
  sim.step();
}

/// A pair with some load in all its springs, disc 1 at (dx, dy) from disc 0.
struct LoadedPair {
  Simulation sim;
  double dx = 0, dy = 0;
  SpecimenContact history;
};
LoadedPair loaded_pair(ContactCoupling coupling) {
  LoadedPair pair{driven_pair(coupling), 0, 0, {}};
  for (int n = 0; n < 100; ++n) {
    drive(pair.sim, 0, 1e-2, 0, 5);
    drive(pair.sim, 1, 0, 2e-2, 20);
    pair.sim.step();
  }
  Disc const a = disc(pair.sim, 0), b = disc(pair.sim, 1);
  pair.dx = b.x - a.x;
  pair.dy = b.y - a.y;
  pair.history = pair_history(pair.sim);
  return pair;
}

TEST(RigidTurn, HundredsOfTimesLeaveTheForcesOfALoadedPairUnchanged) {
  for (ContactCoupling coupling : {ContactCoupling::replaces, ContactCoupling::parallel}) {
    LoadedPair pair = loaded_pair(coupling);
    bool const mixed = tested_precision() == Precision::mixed;
    int const steps = mixed ? 1000 : 100, turns = 100000 / steps;
    double const turn = 2 * pi / steps;
    Disc const before = disc(pair.sim, 1);
    // Rigid for a sum of steps on the chord: the discs turn by sin(turn) a step. For the way since a reference: by as much as the
    // branch.
    double const of_discs = within(std::sin(turn), turn);
    for (int n = 0; n < turns * steps; ++n)
      carry_round(pair.sim, pair.dx, pair.dy, turn * (n % steps), turn, of_discs / pair.sim.time_step);
    SpecimenContact const now = pair_history(pair.sim);
    Disc const after = disc(pair.sim, 1);
    EXPECT_NEAR(now.shear / pair.history.shear, 1, within(1e-6, 0.15));
    EXPECT_NEAR(now.moment, pair.history.moment, within(0, 1e-4) * std::abs(pair.history.moment));
    EXPECT_NEAR(now.bond_moment, pair.history.bond_moment, within(0, 1e-4) * std::abs(pair.history.bond_moment));
    EXPECT_NEAR(now.bond_shear, pair.history.bond_shear, within(1e-6, 0.15) * std::abs(pair.history.bond_shear));
    EXPECT_NEAR(after.fx / before.fx, 1, within(1e-6, 1e-3));
    EXPECT_NEAR(after.torque / before.torque, 1, within(1e-6, 0.15));
  }
}

TEST(RigidTurn, CarriesShearRoundToSecondOrder) {
  for (ContactCoupling coupling :
       {ContactCoupling::replaces, ContactCoupling::parallel, ContactCoupling::replaces_keeping_force}) {
    double drift[3];
    for (int level = 0; level < 3; ++level) {
      LoadedPair pair = loaded_pair(coupling);
      ASSERT_NE(pair.history.shear + pair.history.bond_shear, 0);
      int const steps = (tested_precision() == Precision::mixed ? 500 : 4000) << level;
      double const turn = 2 * pi / steps;
      for (int n = 0; n < steps; ++n) carry_round(pair.sim, pair.dx, pair.dy, turn * n, turn, turn / pair.sim.time_step);
      SpecimenContact const now = pair_history(pair.sim);
      EXPECT_NEAR(now.moment, pair.history.moment, within(0, 1e-4) * std::abs(pair.history.moment));
      EXPECT_NEAR(now.bond_moment, pair.history.bond_moment, within(0, 1e-4) * std::abs(pair.history.bond_moment));
      drift[level] = now.shear + now.bond_shear - pair.history.shear - pair.history.bond_shear;
    }
    EXPECT_TRUE(shrinks(drift[0], drift[1], 2, 0.1, 0.05));  // the way since a reference has no error of the step
    EXPECT_TRUE(shrinks(drift[1], drift[2], 2, 0.1, 0.05));
  }
}

}  // namespace
}  // namespace clathra
