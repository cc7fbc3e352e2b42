/// Runs that cannot go on are stopped within 200 steps, naming a disc and the step.
#include <limits>

#include "extreme_rows.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

/// A bonded packing between walls under compression.
Simulation pressed_packing() {
  Scene const scene = hydrate_scene(0.55, ContactCoupling::replaces);
  Specimen s = disordered_patch(10, 10, 0.02);
  bond_all(s, scene);
  Simulation sim(s, bonded_laws(scene, s.critical_thickness), 0.05 * grain_d50);
  sim.time_step = 0.7 * sim.assembly().stable_time_step();
  sim.loading().x = sim.loading().y = AxisDrive::at_rate(100);
  return sim;
}

/// The text of the fault that stops a run within 200 steps.
std::string fault_of(Simulation& sim) {
  std::int64_t const first = sim.assembly().steps();
  try {
    while (sim.assembly().steps() < first + 200) sim.step();
  } catch (Diverged const& fault) {
    return fault.what();
  }
  return "none";
}

bool names(std::string const& text, std::string const& part) { return text.find(part) != std::string::npos; }

TEST(Diverged, ByANumberThatIsNotFiniteInAnyFieldOfADisc) {
  for (double bad : {nan, infinity, -infinity}) {
    for (int field = 0; field < 5; ++field) {
      Simulation sim = pressed_packing();
      sim.step(150);
      ParticleSoA const& p = sim.assembly().particles;
      int const disc = index_of(sim, 42);
      if (field < 2)
        assign(field == 0 ? p.x : p.y, disc, bad);
      else
        assign(field == 2 ? p.vx : field == 3 ? p.vy : p.omega, disc, bad);
      std::string const text = fault_of(sim);
      EXPECT_TRUE(names(text, "step ")) << text;
      EXPECT_TRUE(names(text, "particle ")) << text;
      EXPECT_TRUE(names(text, "not finite")) << field << " " << text;
    }
  }
  if (!testing::Test::HasFailure())
    print_row("NaN and infinity in position, velocity and spin of a particle", "refused: the particle \"is not finite\"",
              "names the particle");
}

TEST(Diverged, ByAPositionThatIsNotFiniteThoughNothingTouchesTheDisc) {
  Simulation sim(two_discs(-1e-5), sand_laws(), 1e-5);
  sim.time_step = 1e-7;
  assign(sim.assembly().particles.x, index_of(sim, 1), nan);
  EXPECT_TRUE(names(fault_of(sim), "particle 1 has a position or velocity that is not finite"));
}

TEST(Diverged, ByAForceThatIsNotFiniteNamesTheDisc) {
  Specimen s = two_discs(-1e-5);
  Simulation sim(s, sand_laws(), 1e-5);
  sim.time_step = 1e-7;
  assign(sim.assembly().particles.vx, index_of(sim, 1), nan);
  EXPECT_TRUE(names(fault_of(sim), "particle 1 has a position or velocity that is not finite"));
}

TEST(Diverged, BeforeTheFirstStepWhereTheSpecimenIsNotFinite) {
  for (auto field : {&Specimen::x, &Specimen::y, &Specimen::vx, &Specimen::omega, &Specimen::radius}) {
    Specimen s = disordered_patch(4, 4);
    (s.*field)[7] = nan;
    try {
      Simulation const sim(s, sand_laws(), 1e-5);
      ADD_FAILURE() << "went on";
    } catch (Diverged const& fault) {
      EXPECT_TRUE(names(fault.what(), "particle 7")) << fault.what();
    }
  }
}

TEST(Diverged, ByATimeStepThreeTimesTooLong) {
  Simulation sim = pressed_packing();
  sim.time_step = 3 * 2 / sim.assembly().largest_frequency();
  std::string const text = fault_of(sim);
  EXPECT_TRUE(names(text, "particle ")) << text;
  EXPECT_TRUE(names(text, "step ")) << text;
}

TEST(Diverged, SaysSinceWhenWhereAndWhatToChange) {
  Simulation sim = pressed_packing();
  sim.time_step = 3 * 2 / sim.assembly().largest_frequency();
  std::string const text = fault_of(sim);
  for (char const* const part :
       {", since a step after ", "; it is at (", " mm", "; the time step is ", " of the stable limit of the present contacts: "})
    EXPECT_TRUE(names(text, part)) << part << " is not in " << text;
  double const share = std::stod(text.substr(text.find("the time step is ") + 17));
  EXPECT_GT(share, 1) << text;
  EXPECT_TRUE(names(text, "shorten the step (run.time_step_safety)")) << text;
}

TEST(Diverged, NamesThePlaceAndTheDeepestContactOfTheDisc) {
  Specimen s = disordered_patch(5, 5);
  s.x[11] = s.x[3];
  s.y[11] = s.y[3] + 0.2 * s.radius[3];
  Simulation sim(s, sand_laws(), 1e-5);
  sim.time_step = 1e-9;
  try {
    sim.step(200);
    ADD_FAILURE() << "went on";
  } catch (Diverged const& fault) {
    std::string const text = fault.what();
    EXPECT_TRUE(names(text, "; its deepest contact, with particle 3, overlaps by 1.")) << text;
    EXPECT_TRUE(names(text, "the step is not why: the grains are too soft")) << text;
    ASSERT_TRUE(fault.placed);
    EXPECT_NEAR(fault.x, s.x[11], 0.1 * grain_radius);
    EXPECT_NEAR(fault.y, s.y[11], 0.1 * grain_radius);
  }
}

TEST(Diverged, KnowsWhereADiscWasThatIsNowhere) {
  Simulation sim = pressed_packing();
  sim.step(150);
  int const disc = index_of(sim, 42);
  double const x = value(sim.assembly().particles.x, disc);
  assign(sim.assembly().particles.x, disc, nan);
  try {
    sim.step(200);
    ADD_FAILURE() << "went on";
  } catch (Diverged const& fault) {
    EXPECT_TRUE(std::isfinite(fault.x) && std::isfinite(fault.y)) << fault.what();
    EXPECT_NEAR(fault.x, x, 12 * grain_d50) << "it has spread from there";
    // In mixed precision its neighbours see it at some whole number of ticks, and stay finite.
    EXPECT_EQ(names(fault.what(), "particles are like it"), tested_precision() == Precision::full) << fault.what();
  }
}

TEST(Diverged, ByCoincidentDiscs) {
  Specimen s = disordered_patch(5, 5);
  s.x[11] = s.x[3];
  s.y[11] = s.y[3];
  Simulation sim(s, sand_laws(), 1e-5);
  sim.time_step = 1e-7;
  std::string const text = fault_of(sim);
  EXPECT_TRUE(names(text, "particle 11 overlaps a neighbour")) << text;
}

TEST(Diverged, ByACentreInsideAnotherDiscButNotByLess) {
  for (auto const& [overlap, text] : {std::pair{0.95, "none"}, std::pair{1.05, "overlaps a neighbour"}}) {
    Simulation sim(two_discs(overlap * grain_radius), sand_laws(), 1e-5);
    sim.time_step = 1e-10;  // they hardly part within 200 steps
    EXPECT_TRUE(names(fault_of(sim), text)) << overlap;
  }
}

TEST(Diverged, ByACentreBehindAWallButNotByLess) {
  for (auto const& [overlap, text] : {std::pair{0.95, "none"}, std::pair{1.05, "particle 0 overlaps a neighbour or a wall"}}) {
    Simulation sim(disc_on_floor(overlap * grain_radius), sand_laws(), 1e-5);
    sim.time_step = 1e-10;  // it hardly moves within 200 steps
    EXPECT_TRUE(names(fault_of(sim), text)) << overlap;
  }
}

TEST(Diverged, ByASumThatItsWordsCannotHold) {
  Simulation sim(two_discs(1e-8), sand_laws(), 1e-5);
  sim.time_step = 1e-7;
  assign(sim.assembly().particles.vx, index_of(sim, 1), 1e9);  // a kinetic energy of 3e13 J/m
  try {
    (void)sim.assembly().measures();
    ADD_FAILURE() << "was summed";
  } catch (Diverged const& fault) {
    EXPECT_TRUE(names(fault.what(), "step 0, time 0")) << fault.what();
    EXPECT_TRUE(names(fault.what(), "measure_discs: 1 of the terms")) << fault.what();
  }
}

TEST(Diverged, ByADiscFarOutsideTheWalls) {
  for (double out : {2 * grain_radius, 1.0, 1e6, 1e12}) {
    Specimen s = disordered_patch(5, 5);
    s.x[6] = s.right + out;
    std::string text;
    try {
      Simulation sim(s, sand_laws(), 1e-5);
      sim.time_step = 1e-7;
      text = fault_of(sim);
    } catch (Diverged const& fault) {  // at once, where its force on the wall cannot be summed
      text = fault.what();
    }
    EXPECT_TRUE(names(text, "particle 6 ")) << out << ": " << text;
  }
}

TEST(Diverged, ByMoreNeighboursThanARowHolds) {
  Specimen s = open_space();
  add_disc(s, 0, 0, 40 * grain_radius);
  for (int n = 0; n < 100; ++n) {
    double const angle = 2 * pi * n / 100;
    add_disc(s, 41 * grain_radius * std::cos(angle), 41 * grain_radius * std::sin(angle));
  }
  try {
    Simulation const sim(s, sand_laws(), 1e-5);
    ADD_FAILURE() << "went on";
  } catch (Diverged const& fault) {
    EXPECT_TRUE(names(fault.what(), "particle 0 has more neighbours than a row holds")) << fault.what();
  }
}

/// Equal discs that hardly touch: only the skin makes neighbours of so many.
TEST(ExtremeSizes, AreNotBlamedForASkinThatListsTooMany) {
  Specimen s = open_space();
  for (int n = 0; n < 400; ++n) add_disc(s, 2.2 * grain_radius * (n % 20), 2.2 * grain_radius * (n / 20));
  SimulationLaws laws = sand_laws();
  laws.precision = Precision::full;  // mixed precision refuses such a skin before
  try {
    Simulation const sim(s, laws, 7 * grain_d50);
    ADD_FAILURE() << "went on";
  } catch (Diverged const& fault) {
    EXPECT_TRUE(names(fault.what(), "give a smaller run.verlet_skin, or none: ")) << fault.what();
    EXPECT_TRUE(names(fault.what(), " are 7 of d50, where 0.12 are usual")) << fault.what();
    EXPECT_FALSE(names(fault.what(), "grading")) << fault.what();
  }
}

/// Discs of 1 : 15 squeezed between walls, at rest in the end.
TEST(ExtremeSizes, RestTogetherUnderStress) {
  Specimen s = open_space();
  double const large = 15 * grain_radius;
  for (double x : {1.0, 3.0}) {
    for (double y : {1.0, 3.0}) add_disc(s, 1.02 * x * large, 1.02 * y * large, large);
  }
  for (int n = 0; n < 9; ++n) {  // in the hole between them
    double const x = 2.04 * large + (n % 3 - 1) * 2.2 * grain_radius, y = 2.04 * large + (n / 3 - 1) * 2.2 * grain_radius;
    add_disc(s, x, y);
  }
  enclose(s);
  SimulationLaws laws = sand_laws();
  laws.motion.damping = 0.7;
  Simulation sim(s, laws, 0.5 * grain_radius);
  sim.time_step = 0.7 * sim.assembly().stable_time_step();
  sim.loading().x = sim.loading().y = AxisDrive::at_stress(1e5, 0.5);
  sim.step(40000);
  sim.loading().x = sim.loading().y = AxisDrive::held();
  sim.step(40000);
  sim.assembly().throw_if_unstable();
  Measures const m = sim.assembly().measures();
  EXPECT_NEAR(m.stress_area_xx / sim.assembly().area() / sim.assembly().stress().x, 1, 1e-3);
  EXPECT_GE(m.touching, 4);
  EXPECT_LT(m.kinetic, 1e-9 * (m.grain_energy + m.wall_energy));
}

TEST(SmallestSpecimen, OfOneDiscFallsAndBounces) {
  Specimen s = disc_on_floor(-1e-6);
  SimulationLaws laws = sand_laws();
  laws.motion.gravity_y = -10;
  Simulation sim(s, laws, 1e-7);
  sim.time_step = 1e-7;
  EXPECT_EQ(sim.assembly().measures().touching, 0);
  EXPECT_GT(sim.assembly().stable_time_step(), 0);
  EXPECT_EQ(sim.assembly().largest_frequency(), 0);
  double lowest = 1;
  for (int n = 0; n < 9000; ++n) {  // 2 sqrt(2 h / g) = 0.9 ms
    sim.step();
    lowest = std::min(lowest, disc(sim, 0).y);
  }
  EXPECT_LT(lowest, grain_radius);
  EXPECT_NEAR(disc(sim, 0).y - grain_radius, 1e-6, 0.02e-6);
}

TEST(SmallestSpecimen, OfNoDiscIsRefused) { EXPECT_THROW(Simulation(open_space(), sand_laws(), 1e-5), std::invalid_argument); }

TEST(ScatteredDiscs, TakeNoMoreMemoryThanCloseOnes) {
  Specimen s = two_discs(1e-8);
  add_disc(s, 1e6, 1e6);
  add_disc(s, -1e7, 3);
  Simulation sim(s, sand_laws(), 1e-5);
  sim.time_step = 1e-8;
  sim.step(20);
  EXPECT_EQ(sim.assembly().measures().touching, 1);
  EXPECT_LT(sim.bytes(), 20000u);
}

}  // namespace
}  // namespace clathra
