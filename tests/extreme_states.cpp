/// Specimens and states at the ends of what can be, by the library.
#include <chrono>
#include <cmath>
#include <limits>

#include "domain/biaxial/biaxial_test.hpp"
#include "domain/generation/equilibration.hpp"
#include "domain/measurement/history_row.hpp"
#include "extreme_rows.hpp"
#include "packing.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

Simulation bonded_sand(double saturation, ContactCoupling coupling, std::function<void(SimulationLaws&)> const& change = {}) {
  Specimen s = packing();
  Scene const scene = hydrate_scene(saturation, coupling);
  bond_all(s, scene);
  SimulationLaws laws = bonded_laws(scene, s.critical_thickness);
  laws.motion.damping = 0.7;
  if (change) change(laws);
  return Simulation(s, laws, 0.1 * s.d50);
}

TEST(ExtremeStates, NoDiscOneDiscTwoDiscs) {
  expect_refusal<std::invalid_argument>("0 particles", "at least one particle",
                                        [] { Simulation(open_space(), sand_laws(), 1e-5); });
  Simulation one(disc_on_floor(1e-6), sand_laws(), 1e-6);
  one.choose_time_step({});
  one.step(1000);
  expect_row("1 particle on a floor", "kinetic + elastic energy over the first",
             (one.assembly().measures().kinetic + one.assembly().measures().wall_energy) / (0.5 * sand_kn * 1e-12), 0.1,
             2.5);  // leapfrog's own energy swings by so much at 0.95 of the limit, and stays
  Simulation two(two_discs(1e-6), sand_laws(), 1e-6);
  two.choose_time_step({});
  two.step(1000);
  expect_row("2 particles pressed together fly apart", "distance over their diameter",
             disc(two, 1).x - disc(two, 0).x > 0 ? (disc(two, 1).x - disc(two, 0).x) / (2 * grain_radius) : 0, 1, 1e99);
}

TEST(ExtremeStates, ABoulderThirtyTimesTheFinesHasMoreNeighboursThanARowHolds) {
  Specimen s = open_space();
  add_disc(s, 0, 0, 30 * grain_radius);
  for (int ring = 0; ring < 2; ++ring)
    for (int n = 0; n < 97; ++n) {
      double const angle = 2 * pi * (n + 0.5 * ring) / 97, way = (31.02 + 1.8 * ring) * grain_radius;
      add_disc(s, way * std::cos(angle), way * std::sin(angle));
    }
  expect_refusal<Diverged>("a boulder of 30 times the fines", "more neighbours than a row holds",
                           [&] { Simulation(s, sand_laws(), 0.12 * grain_d50); });
}

TEST(ExtremeStates, BondsWithoutStrengthAndBondsThatNeverBreak) {
  for (ContactCoupling const coupling : {ContactCoupling::parallel, ContactCoupling::replaces}) {
    Simulation weak = bonded_sand(0.55, coupling, [](SimulationLaws& laws) {
      laws.contact.bond.strength.tensile_stress = laws.contact.bond.strength.compressive_stress = 0;
    });
    weak.choose_time_step({});
    weak.step();
    std::string const name = coupling == ContactCoupling::parallel ? " (parallel)" : " (replaces)";
    expect_row("bond strength 0" + name, "bonds broken in the first step", weak.assembly().broken_bonds(), 200, 1e99);
    expect_row("bond strength 0" + name, "bonds left", weak.assembly().measures().bonded, 0, 0);
    weak.step(3000);
    weak.assembly().throw_if_unstable();
    expect_row("bond strength 0, after 3,000 steps" + name, "kinetic over elastic energy",
               weak.assembly().measures().kinetic / weak.assembly().measures().grain_energy, 0, 1e-2);
    Simulation strong = bonded_sand(0.55, coupling, [](SimulationLaws& laws) { laws = unbreakable(laws); });
    strong.choose_time_step({});
    strong.loading().y = AxisDrive::at_rate(50);
    strong.step(5000);
    strong.assembly().throw_if_unstable();
    expect_row("bond strength without end" + name, "bonds broken", strong.assembly().broken_bonds(), 0, 0);
  }
}

TEST(ExtremeStates, OverlapOfHalfARadiusAndCoincidentCentres) {
  Simulation deep(two_discs(0.5 * grain_radius), sand_laws(), 1e-6);
  deep.choose_time_step({});
  deep.step(2000);
  deep.assembly().throw_if_unstable();
  double const energy = 0.5 * sand_kn * 0.25 * grain_radius * grain_radius;
  expect_row("overlap of half a radius", "kinetic energy afterwards over the elastic one before",
             deep.assembly().measures().kinetic / energy, 0.3, 3);
  expect_refusal<Diverged>("coincident centres", "overlaps", [] {
    Simulation sim(two_discs(2 * grain_radius), sand_laws(), 1e-6);
    sim.time_step = 1e-8;
    sim.step(100);
    sim.assembly().throw_if_unstable();
  });
}

TEST(ExtremeStates, OneDiscWideAndAThousandTall) {
  Specimen s = open_space();
  for (int n = 0; n < 1000; ++n) add_disc(s, 0, 2 * grain_radius * n * (1 - within(1e-5, 1e-4)));  // 100 times its round-off
  enclose(s);
  SimulationLaws laws = sand_laws();
  laws.motion.damping = 0.7;
  Simulation sim(s, laws, 0.1 * grain_d50);
  sim.choose_time_step({});
  sim.step(60000);
  sim.assembly().throw_if_unstable();
  expect_row("a column of 1,000 particles", "force at its top over that at its foot",
             sim.assembly().reactions().normal[top] / sim.assembly().reactions().normal[bottom], 0.99, 1.01);
}

TEST(ExtremeStates, TheStepCounterPassesFourBillion) {
  Simulation sim = bonded_sand(0.55, ContactCoupling::parallel);
  sim.choose_time_step({});
  sim.loading().y = AxisDrive::at_rate(200);
  SimulationState late = sim.state(), early = late;
  late.numbers["step"] = 4294967286.0;
  early.numbers["step"] = -10;  // what mixed precision rounds by repeats itself after 2^32 steps
  Simulation other(late, sim.assembly().laws, {}), same(early, sim.assembly().laws, {});
  for (int n = 0; n < 4000; ++n) {
    same.step();
    other.step();
  }
  expect_row("step counter at 2^32 - 10", "steps after 4,000 more", static_cast<double>(other.assembly().steps()) - 4294967286.0,
             4000, 4000);
  EXPECT_EQ(other.assembly().hash(), same.assembly().hash());
  ASSERT_GT(other.assembly().broken_bonds(), 0);
  EXPECT_GT(other.assembly().break_events(0).back().step, 4294967296);
}

// Nothing but round-off of the positions may show: overlaps of 1e-6 m beside coordinates of 200 m. In mixed precision the ticks
// fall elsewhere: 0.9 pm at either end of each of some six contacts, beside overlaps of 0.5 um.
TEST(ExtremeStates, ABoxMovedByAMillionDiameters) {
  Simulation loaded(packing(), sand_laws(), 0.1 * packing().d50);
  SimulationLaws laws = loaded.assembly().laws;
  laws.motion.damping = 0.7;
  loaded.set_laws(laws);
  prepare_servo(loaded, 1e6, 1e-3, packing().d50, {});
  ASSERT_TRUE(hold_stress(loaded, 1e6, {1e-3}, 200000, {}, "test"));
  Specimen const original = loaded.specimen();
  Specimen moved = original;
  double const way = 1e6 * moved.d50;
  for (auto* axis : {&moved.x, &moved.y})
    for (double& place : *axis) place += way;
  for (double* edge : {&moved.left, &moved.right, &moved.bottom, &moved.top}) *edge += way;
  Simulation const here(original, sand_laws(), 0.1 * moved.d50), there(moved, sand_laws(), 0.1 * moved.d50);
  double worst = 0, mean = 0;
  for (int id = 0; id < here.assembly().discs(); ++id) {
    int const i = index_of(here, id), j = index_of(there, id);
    worst = std::max(worst, std::abs(value(here.assembly().particles.force_x, i) - value(there.assembly().particles.force_x, j)));
  }
  Measures const m = here.assembly().measures();
  mean = m.stress_area_yy / m.touching / (2 * grain_radius);
  expect_row("a box moved by 1e6 diameters at 1 MPa", "largest change of a net force over the mean contact force", worst / mean,
             0, within(1e-6, 2e-5));
}

TEST(ExtremeStates, DenormalsInTheVelocities) {
  Specimen s = packing(), at_rest = packing();
  for (auto field : {&Specimen::vx, &Specimen::vy, &Specimen::omega})
    for (std::size_t i = 0; i < s.size(); ++i) {
      (s.*field)[i] = std::numeric_limits<double>::denorm_min();
      (at_rest.*field)[i] = 0;
    }
  Simulation sim(s, sand_laws(), 0.1 * s.d50), still(at_rest, sand_laws(), 0.1 * s.d50);
  for (Simulation* one : {&sim, &still}) {
    one->choose_time_step({});
    for (int n = 0; n < 100; ++n) one->step();
  }
  expect_row("denormal velocities", "kinetic energy over that without",
             sim.assembly().measures().kinetic / still.assembly().measures().kinetic, 0.999, 1.001);
}

TEST(ExtremeStates, ADiscFastEnoughToCrossAnotherInOneStep) {
  expect_refusal<Diverged>("a particle that crosses half a particle in a step", "overlaps", [] {
    Specimen s = two_discs(-1.0 * grain_radius);
    SimulationLaws const laws = sand_laws();
    Simulation slow(s, laws, 1e-6);
    double const dt = 0.5 * slow.assembly().stable_time_step();
    s.vx[0] = 1.4 * 2 * grain_radius / dt;
    Simulation sim(s, laws, 1e-6);
    sim.time_step = dt;
    sim.step(64);
    sim.assembly().throw_if_unstable();
  });
}

TEST(ExtremeStates, WallsThatMeet) {
  expect_refusal<Diverged>("walls that meet", "particle", [] {
    Simulation sim(packing(), sand_laws(), 0.1 * packing().d50);
    sim.choose_time_step({});
    sim.loading().y = AxisDrive::at_rate(20000);
    sim.step(100000);
  });
}

TEST(ExtremeStates, AServoWithoutDiscsAtItsWalls) {
  Specimen s = two_discs(1e-9);
  enclose(s, 20 * grain_radius);
  SimulationLaws laws = sand_laws();
  laws.motion.damping = 0.3;
  Simulation sim(s, laws, 1e-6);
  prepare_servo(sim, 1e5, 1e-3, grain_d50, {});
  double const cap = sim.loading().x.largest_speed;
  double fastest = 0;
  for (int n = 0; n < 2000; ++n) {
    sim.step();
    fastest = std::max(fastest, sim.assembly().walls().largest_speed(left, right));
  }
  sim.assembly().throw_if_unstable();
  expect_row("a servo without particles at its walls", "wall speed over its cap", fastest / cap, 0, 1);
}

/// Shear forces of all contacts and bonds.
std::vector<double> shear_forces(Simulation const& sim) {
  std::vector<double> forces;
  for (SpecimenContact const& c : sim.specimen().contacts) forces.push_back(c.shear);
  return forces;
}

/// Steps a bonded specimen that rests between its walls: at the 50 kPa that it was made under, or loaded to 1 MPa.
/// @param most_change  of any shear force, over their mean;  @param most_of_stress  change on the walls, relative
void expect_rest(std::string const& when, bool loaded, int steps, double most_change, double most_of_stress) {
  Simulation sim = bonded_sand(0.55, ContactCoupling::parallel);
  if (loaded) {
    prepare_servo(sim, 1e6, 1e-3, packing().d50, {});
    ASSERT_TRUE(hold_stress(sim, 1e6, {1e-3}, 200000, {}, "test"));
    sim.loading().x = sim.loading().y = AxisDrive::held();
  }
  sim.choose_time_step({});
  constexpr int until_rest = 50000;  // in ticks it trembles ever after
  for (int round = 0; round < 2; ++round) {
    for (int n = 0; n < until_rest && sim.assembly().measures().unbalanced_ratio(sim.assembly().discs()) > 1e-10; n += 1000)
      for (int k = 0; k < 1000; ++k) sim.step();
    sim.stop_discs();  // a disc that flies between others without a force would hit them later
  }
  std::string const what = loaded ? "a bonded specimen at rest at 1 MPa" : "a bonded specimen at rest at 50 kPa";
  expect_row(what, "unbalanced ratio before", sim.assembly().measures().unbalanced_ratio(sim.assembly().discs()), 0,
             within(1e-9, loaded ? 1e-5 : 1e-4));  // at 50 kPa 0.9 pm are 3e-5 of the mean overlap
  std::vector<double> const before = shear_forces(sim);
  double const stress = sim.assembly().stress().y;
  sim.step(steps);
  std::vector<double> const after = shear_forces(sim);
  ASSERT_EQ(after.size(), before.size());
  double mean = 0, worst = 0, change = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    mean += std::abs(before[k]) / static_cast<double>(before.size());
    change += std::abs(after[k] - before[k]) / static_cast<double>(before.size());
    worst = std::max(worst, std::abs(after[k] - before[k]));
  }
  expect_row(what + when, "mean change of a shear force over their mean", change / mean, 0, within(1e-6, 1e-4));
  expect_row(what + when, "largest change of a shear force over their mean", worst / mean, 0, most_change);
  expect_row(what + when, "stress over that before, less 1", std::abs(sim.assembly().stress().y / stress - 1), 0, most_of_stress);
}

// In mixed precision forces follow from where discs are, which tremble by the 0.9 pm that places are rounded to.
TEST(ExtremeStates, ARestingBondedSpecimenKeepsItsForces) {
  expect_rest(" after 1e5 steps", false, 100000, within(1e-6, 1e-3), within(1e-6, 1e-5));
  expect_rest(" after 1e5 steps", true, 100000, within(1e-6, 1e-4), within(1e-6, 1e-6));
}

// Labelled long.
TEST(ExtremeStates, LongARestingBondedSpecimenKeepsItsForcesOverTenMillionSteps) {
  expect_rest(" after 1e7 steps", false, 10000000, within(1e-5, 1e-3), within(1e-6, 1e-5));
  expect_rest(" after 1e7 steps", true, 10000000, within(1e-5, 1e-4), within(1e-6, 1e-6));
}

/// q/p at 0.3 % strain. @param nudge  of one disc [d50]
double early_ratio(double inertial_number, double nudge) {
  Scene scene;
  scene.run.precision = tested_precision();
  scene.test.axial_strain = 0.003;
  scene.test.inertial_number = inertial_number;
  scene.test.max_platen_wave_stress = 0;
  scene.output.records = 1;
  Specimen s = packing();
  s.x[7] += nudge * s.d50;
  BiaxialTest test(scene, s, {});
  while (!test.finished()) (void)test.advance(1 << 20);
  HistoryRow const row = test.record();
  return row.q_Pa / row.p_Pa;
}

TEST(ExtremeStates, LongTenTimesSlowerThanVerySlowIsTheSame) {
  double const slow = early_ratio(1e-5, 0), nudged = early_ratio(1e-5, 1e-12), slower = early_ratio(1e-6, 0);
  double const floor = std::max(std::abs(nudged / slow - 1), 1e-3);
  expect_row("I = 1e-6 against 1e-5", "change of q/p at 0.3 % strain over that by a particle moved by 1e-12 d50, or 0.1 %",
             std::abs(slower / slow - 1) / floor, 0, 10);
}

}  // namespace
}  // namespace clathra
