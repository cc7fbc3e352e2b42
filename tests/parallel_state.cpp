/// The same bits whatever the threads, the order of the input and the way through a specimen. The packings are made by hand with
/// + - * / and sqrt alone, so that their golden values do not lean on any libm.
#include "golden_states.hpp"

namespace clathra {
namespace {

TEST(State, AfterThousandsOfStepsThroughBreakageIsTheGoldenOne) {
  for (Golden const& g : golden) {
    Simulation const sim = sheared(bonded_patch(g.coupling), g.coupling, g.precision);
    EXPECT_GT(sim.assembly().upkeep.searches(), 5);
    EXPECT_GT(sim.assembly().broken_bonds(), 20);
    EXPECT_EQ(sim.assembly().broken_bonds(), g.broken);
    EXPECT_EQ(sim.assembly().hash(), g.hash)
        << "coupling " << static_cast<int>(g.coupling) << ", " << precision_names[static_cast<int>(g.precision)] << ": 0x"
        << std::hex << sim.assembly().hash();
  }
}

class StateIn : public testing::TestWithParam<Precision> {};
INSTANTIATE_TEST_SUITE_P(, StateIn, testing::Values(Precision::full, Precision::mixed),
                         [](auto const& test) { return std::string(precision_names[static_cast<int>(test.param)]); });

TEST_P(StateIn, DoesNotKnowTheOrderOfTheInput) {
  Specimen const s = bonded_patch(ContactCoupling::parallel);
  Simulation const one = sheared(s, ContactCoupling::parallel, GetParam());
  for (std::uint64_t seed : {1, 2}) {
    Simulation const other = sheared(shuffled(s, seed), ContactCoupling::parallel, GetParam());
    EXPECT_EQ(other.assembly().hash(), one.assembly().hash());
    expect_equal_measures(one, other);
    auto const first = one.assembly().break_events(0), second = other.assembly().break_events(0);
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
      EXPECT_EQ(first[k].step, second[k].step);
      EXPECT_EQ(first[k].id_a, second[k].id_a);
      EXPECT_EQ(first[k].id_b, second[k].id_b);
      EXPECT_EQ(first[k].mode, second[k].mode);
      EXPECT_EQ(first[k].x, second[k].x);
    }
  }
}

/// Sheared through breakage between servo walls, at time steps that follow the limit, with all accounts.
Simulation between_servo_walls(Precision precision) {
  Simulation sim = ready(bonded_patch(ContactCoupling::parallel), ContactCoupling::parallel, {}, nullptr, precision);
  sim.loading().x = AxisDrive::at_stress(2e6, 20);
  sim.set_ledger(true);
  sim.keep_breaks(BreakRecord::details);
  sim.choose_time_step({});
  return sim;
}

/// All that the device keeps of steps beside the discs.
void expect_equal_steps(Simulation const& one, Simulation const& many) {
  EXPECT_EQ(one.assembly().steps(), many.assembly().steps());
  EXPECT_EQ(one.assembly().time(), many.assembly().time());
  EXPECT_EQ(one.time_step, many.time_step);
  EXPECT_EQ(one.assembly().upkeep.searches(), many.assembly().upkeep.searches());
  EXPECT_EQ(one.time_steps().updates(), many.time_steps().updates());
  EXPECT_EQ(one.assembly().now.walls.loading.x.integral, many.assembly().now.walls.loading.x.integral);
  EXPECT_EQ(one.assembly().losses().breakage, many.assembly().losses().breakage);
  for (int wall = 0; wall < wall_count; ++wall) {
    EXPECT_EQ(one.assembly().walls().position[wall], many.assembly().walls().position[wall]) << wall;
    EXPECT_EQ(one.assembly().walls().velocity[wall], many.assembly().walls().velocity[wall]) << wall;
  }
}

TEST_P(StateIn, IsThatOfStepsOneByOneAfterManyAtOnce) {
  Simulation one = between_servo_walls(GetParam()), many = between_servo_walls(GetParam());
  for (int const steps : {1, 7, 64, 200, 1500}) {
    one.step(steps);
    many.step(steps);
    EXPECT_EQ(one.assembly().hash(), many.assembly().hash()) << steps;
    expect_equal_steps(one, many);
    expect_equal_measures(one, many);
  }
  EXPECT_GT(many.assembly().upkeep.searches(), 5);
  EXPECT_GT(many.time_steps().updates(), 3);
  BreakEvents const first = one.assembly().detailed_break_events(0), second = many.assembly().detailed_break_events(0);
  ASSERT_GT(first.rows.size(), 10U);
  ASSERT_EQ(first.rows.size(), second.rows.size());
  for (std::size_t k = 0; k < first.rows.size(); ++k) {
    EXPECT_EQ(first.rows[k].step, second.rows[k].step);
    EXPECT_EQ(first.details[k].eps1, second.details[k].eps1);
  }
}

TEST(State, ComesToAHeightOfTheBoxInAsManyStepsAtOnceAsOneByOne) {
  Simulation one = between_servo_walls(Precision::full), many = between_servo_walls(Precision::full);
  double const height = one.assembly().walls().height() * (1 - 0.0113);
  StepLimits limits;
  limits.height.low = height;
  while (one.assembly().walls().height() > height) one.step();
  many.step(1000000, limits);
  EXPECT_GT(many.assembly().steps(), 100);
  EXPECT_EQ(many.assembly().steps(), one.assembly().steps());
  EXPECT_EQ(many.assembly().hash(), one.assembly().hash());
  many.step(10, limits);
  EXPECT_EQ(many.assembly().steps(), one.assembly().steps() + 1) << "below it one step at a time";
}

TEST(State, OfUnboundSandDoesNotKnowTheOrderOfTheInput) {
  auto const run = [](Specimen const& s) {
    SimulationLaws laws = sand_laws();
    laws.motion.damping = 0.5;
    Simulation sim(s, laws, 0.05 * grain_d50);
    sim.time_step = 1e-7;
    sim.loading().x = sim.loading().y = AxisDrive::at_rate(300);
    sim.step(3000);
    EXPECT_GT(sim.assembly().measures().touching, 200);
    return sim.assembly().hash();
  };
  Specimen const s = disordered_patch(14, 14);
  EXPECT_EQ(run(s), run(shuffled(s, 5)));
}

TEST(State, SurvivesTheWayThroughASpecimenAndGoesOnWithTheSameBits) {
  for (ContactCoupling coupling : {ContactCoupling::replaces, ContactCoupling::parallel}) {
    Specimen const s = bonded_patch(coupling);
    Simulation original = ready(s, coupling);
    SimulationLaws laws = original.assembly().laws;
    laws.wall.friction = 0;  // a specimen does not hold the shear of rough walls
    original.set_laws(laws);
    for (int n = 0; n < 1500; ++n) original.step();
    AxisDrive const drive_x = original.loading().x, drive_y = original.loading().y;
    original.loading().x = original.loading().y = AxisDrive::held();
    original.step();  // the walls stand: a specimen holds no wall velocities
    Simulation copy(shuffled(original.specimen(), 3), laws, 0.05 * grain_d50);
    EXPECT_EQ(copy.assembly().hash(), original.assembly().hash());
    // Rows are ordered by touch at the last search: both search at the same state.
    original.request_search();
    original.evaluate_forces();
    copy.time_step = original.time_step;
    for (Simulation* sim : {&original, &copy}) {
      sim->loading().x = drive_x;
      sim->loading().y = drive_y;
    }
    for (int n = 0; n < 1500; ++n) {
      original.step();
      copy.step();
    }
    EXPECT_GT(copy.assembly().broken_bonds(), 0);
    EXPECT_EQ(copy.assembly().hash(), original.assembly().hash());
  }
}

/// What acts on each disc, by id.
std::vector<double> forces_of(Simulation const& sim) {
  std::vector<double> forces;
  for (int id = 0; id < sim.assembly().discs(); ++id) {
    Disc const d = disc(sim, id);
    forces.insert(forces.end(), {d.fx, d.fy, d.torque});
  }
  return forces;
}

TEST(State, TakenWhileASearchIsDueKeepsTheForcesOfEachDisc) {
  Simulation sim = ready(bonded_patch(ContactCoupling::parallel), ContactCoupling::parallel);
  sim.step(2000);
  std::vector<double> const before = forces_of(sim);
  auto const order = [&] {
    std::vector<int> places;
    for (int id = 0; id < sim.assembly().discs(); ++id) places.push_back(index_of(sim, id));
    return places;
  };
  std::vector<int> const places = order();
  sim.request_search();
  (void)sim.state();
  EXPECT_NE(order(), places);  // the search has put them in another order
  EXPECT_EQ(forces_of(sim), before);
}

/// A bonded pair across the edge of a periodic cell that flies apart by more than neighbours reach in one step.
TEST(State, OfABondAcrossAPeriodicEdgeIsKeptByASearchInAnyStep) {
  Specimen s = open_space();
  s.periodic = true;
  s.left = s.bottom = 0;
  s.right = s.top = 40 * grain_radius;
  double const gap = 1e-6;
  add_disc(s, grain_radius + gap, s.top / 2, grain_radius, 1);
  add_disc(s, s.right - grain_radius, s.top / 2, grain_radius, -1);
  Scene const scene = hydrate_scene(0.55, ContactCoupling::parallel);
  s.critical_thickness = h_max_of(scene);
  s.contacts.push_back({0, 1});
  s.contacts[0].formation_overlap = -gap;
  s.separate_bonds = true;
  SimulationLaws const laws = unbreakable(bonded_laws(scene, s.critical_thickness));
  Simulation sim(s, laws, 1e-9);
  ASSERT_EQ(sim.assembly().measures().bonded, 1);
  sim.time_step = 1e-7;
  for (int n = 0; n < 20; ++n) {
    sim.request_search();
    sim.step();
    ASSERT_EQ(sim.assembly().measures().bonded, 1) << "step " << n;
  }
}

TEST(State, EveryBitOfAFieldChangesItsHash) {
  Specimen const s = bonded_patch(ContactCoupling::parallel);
  SimulationLaws const laws = bonded_laws(hydrate_scene(0.41, ContactCoupling::parallel), s.critical_thickness);
  Simulation sim(s, laws, 1e-5);
  std::uint64_t const hash = sim.assembly().hash();
  for_each_field(sim.assembly().particles, [&](DiscField const& about, auto const& field) {
    bool const whole = std::is_same_v<std::decay_t<decltype(field)>, Field<int>>;
    double const before = value(field, 17);
    assign(field, 17, whole ? before + 1 : std::nextafter(before, 1e6));
    EXPECT_NE(sim.assembly().hash(), hash) << about.name;
    assign(field, 17, before);
    EXPECT_EQ(sim.assembly().hash(), hash) << about.name;
  });
  for (ContactNumber const& number : contact_numbers) {
    Specimen other = s;
    other.contacts[5].*number.of = std::nextafter(s.contacts[5].*number.of, 1.0);
    EXPECT_NE(Simulation(other, laws, 1e-5).assembly().hash(), hash) << number.name;
  }
  Specimen other = s;
  other.contacts[5].bond_shear = 1e-12;
  EXPECT_NE(Simulation(other, laws, 1e-5).assembly().hash(), hash);
  other.contacts[5].bond_shear = -0.0;
  EXPECT_EQ(Simulation(other, laws, 1e-5).assembly().hash(), hash);
}

}  // namespace
}  // namespace clathra
