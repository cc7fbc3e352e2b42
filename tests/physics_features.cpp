/// What a scene does not need it does not pay for: neither bytes nor launches.
#include <map>
#include <set>
#include <string>

#include "domain/biaxial/biaxial_state.hpp"
#include "domain/biaxial/scene_needs.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

/// Names of the kernels launched while it lives, with their number.
class CountedLaunches {
 public:
  CountedLaunches() {
    counted().clear();
    Kokkos::Tools::Experimental::set_begin_parallel_for_callback(&count);
    Kokkos::Tools::Experimental::set_begin_parallel_reduce_callback(&count);
    Kokkos::Tools::Experimental::set_begin_parallel_scan_callback(&count);
  }
  ~CountedLaunches() {
    Kokkos::Tools::Experimental::set_begin_parallel_for_callback(nullptr);
    Kokkos::Tools::Experimental::set_begin_parallel_reduce_callback(nullptr);
    Kokkos::Tools::Experimental::set_begin_parallel_scan_callback(nullptr);
  }
  CountedLaunches(CountedLaunches const&) = delete;
  int of(std::string const& name) const { return counted()[name]; }
  /// Those launched so many times.
  std::set<std::string> launched(int times) const {
    std::set<std::string> names;
    for (auto const& [name, count] : counted())
      if (count == times) names.insert(name);
    return names;
  }
  int with(std::string const& part) const {
    int sum = 0;
    for (auto const& [name, times] : counted()) sum += name.find(part) != std::string::npos ? times : 0;
    return sum;
  }

 private:
  static std::map<std::string, int>& counted() {
    static std::map<std::string, int> counts;
    return counts;
  }
  static void count(char const* name, std::uint32_t, std::uint64_t*) { ++counted()[name]; }
};

Simulation small_packing(SimulationLaws const& laws, bool hydrate, ContactCoupling coupling = ContactCoupling::parallel) {
  Specimen s = disordered_patch(8, 8);
  if (hydrate) bond_all(s, hydrate_scene(0.55, coupling));
  Simulation sim(s, laws, 0.1 * grain_d50);
  sim.time_step = 1e-8;
  sim.loading().y = AxisDrive::at_rate(1);
  return sim;
}
SimulationLaws hydrate_laws(ContactCoupling coupling) {
  Scene const scene = hydrate_scene(0.55, coupling);
  return bonded_laws(scene, h_max_of(scene));
}

std::size_t bytes_per_entry(Simulation const& sim) {
  std::size_t const n = sim.assembly().contact_entries();
  ContactRows const& r = sim.assembly().rows;
  for (auto const* field : {&r.shear, &r.moment, &r.formation_overlap, &r.width, &r.bond_shear, &r.bond_moment})
    EXPECT_TRUE(field->extent(0) == 0 || field->extent(0) == n);
  return (bytes(r) - r.slice_start.span() * sizeof(int) - r.length.span() * sizeof(RowLength) -
          r.active.span() * sizeof(std::uint64_t)) /
         n;
}

TEST(Features, ASceneWithoutHydrateHasNoBondField) {
  Simulation sim = small_packing(sand_laws(), false);
  sim.step(100);
  ContactRows const& rows = sim.assembly().rows;
  EXPECT_EQ(rows.formation_overlap.extent(0) + rows.width.extent(0) + rows.bond_shear.extent(0) + rows.bond_moment.extent(0), 0u);
  EXPECT_EQ(sim.assembly().wall_contacts().shear.extent(0), 0u);  // smooth walls
  EXPECT_EQ(sim.assembly().broken_bonds(), 0);
  DissipationTotals const none = sim.assembly().losses();
  EXPECT_EQ(none.sliding + none.rolling + none.damping, 0);
}

/// What entries with a shear force have beside reals.
std::size_t index_and_reference() { return sizeof(int) + (tested_precision() == Precision::full ? 0 : sizeof(std::int32_t)); }

TEST(Features, CostBytesOnlyWhereTheyAreOn) {
  std::size_t const real = tested_precision() == Precision::full ? sizeof(double) : sizeof(float);
  EXPECT_EQ(bytes_per_entry(small_packing(sand_laws(0.5, 0), false)), index_and_reference() + real);
  EXPECT_EQ(bytes_per_entry(small_packing(sand_laws(), false)), index_and_reference() + 2 * real);
  EXPECT_EQ(bytes_per_entry(small_packing(hydrate_laws(ContactCoupling::replaces), true, ContactCoupling::replaces)),
            index_and_reference() + 4 * real);
  EXPECT_EQ(bytes_per_entry(small_packing(hydrate_laws(ContactCoupling::replaces_keeping_force), true,
                                          ContactCoupling::replaces_keeping_force)),
            index_and_reference() + 4 * real);
  EXPECT_EQ(bytes_per_entry(small_packing(hydrate_laws(ContactCoupling::parallel), true)), index_and_reference() + 6 * real);
}

TEST(Features, LaunchOnlyWhatTheSceneNeeds) {
  Simulation sand = small_packing(sand_laws(), false), bonded = small_packing(hydrate_laws(ContactCoupling::parallel), true);
  {
    CountedLaunches const launches;
    sand.step(50);
    EXPECT_EQ(launches.of("contact_forces"), 50);
    EXPECT_EQ(launches.with("bond"), 0);
    EXPECT_EQ(launches.with("loss"), 0);
    EXPECT_EQ(launches.with("wall_shear"), 0);
    EXPECT_EQ(launches.of("kick_and_drift"), 50);
  }
  CountedLaunches const launches;
  bonded.step(50);
  EXPECT_EQ(launches.of("contact_forces_bonded"), 50);
  EXPECT_EQ(launches.of("contact_forces"), 0);
}

/// What needs_of() says of a scene is what a simulation of it keeps and launches.
void expect_needs(std::string const& what, Scene const& scene) {
  SceneNeeds const needs = needs_of(scene);
  Specimen s = disordered_patch(8, 8);
  bool const bonded = scene.hydrate.saturation > 0;
  if (bonded) bond_all(s, scene);
  SimulationLaws laws = test_laws(scene, grain_d50, bonded ? s.critical_thickness : 0);
  laws.motion.damping = scene.damping.local;
  Simulation sim(s, laws, 0.1 * grain_d50);
  sim.choose_time_step(scene.run.step_choice());
  sim.set_ledger(scene.output.energy);
  if (scene.output.takes_snapshots()) sim.mark_start();
  EXPECT_EQ(bytes_per_entry(sim), static_cast<std::size_t>(needs.bytes(FieldOf::entry))) << what;
  // Rough walls keep theirs for the discs next to them alone.
  int const of_walls = scene.test.wall_friction > 0 ? 4 * sizeof(Real) : 0;
  std::vector<std::string> const columns = sim.state().discs.names().discs;
  std::set<std::string> kept(columns.begin(), columns.end()), named;
  kept.insert("id");
  if (for_gpu) kept.insert("disc_rows");  // copies of others, which no state has
  for (NeededField const& field : needs.fields)
    if (field.of == FieldOf::disc) named.insert(field.name);
  EXPECT_EQ(kept, named) << what;
  std::size_t const places = sim.assembly().particles.x.extent(0),
                    marks = (scene.output.takes_snapshots() ? 4 : 2) * sizeof(Coord);
  EXPECT_EQ(bytes(sim.assembly().particles) + bytes(sim.assembly().dissipation) + marks * places,
            static_cast<std::size_t>(needs.bytes(FieldOf::disc) - of_walls) * places)
      << what;
  CountedLaunches const launches;
  sim.step(7);
  std::set<std::string> kernels;
  for (NeededKernel const& kernel : needs.kernels) kernels.insert(kernel.name);
  EXPECT_EQ(launches.launched(7), kernels) << what;
}

TEST(Features, AreListedWithTheirBytesAndKernels) {
  Scene scene;
  scene.run.precision = Precision::full;
  expect_needs("sand", scene);
  scene.output.energy = true;
  expect_needs("sand with energy", scene);
  scene.hydrate.saturation = 0.55;
  expect_needs("parallel with energy", scene);
  scene.bond.contact_coupling = ContactCoupling::replaces;
  scene.output.snapshots = 0;
  expect_needs("replace with energy, without snapshots", scene);
  scene.grains.friction = 0;
  scene.grains.rolling_width_factor = 0;
  scene.damping.local = 0;
  expect_needs("replace without friction and damping", scene);
  scene.hydrate.saturation = 0;
  scene.test.wall_friction = 0.3;
  scene.damping.viscous_ratio = 0.1;
  expect_needs("smooth grains between rough walls, dashpots", scene);
}

/// Names of the accounts that a ledger keeps with these laws, and the bytes that they cost a place of a disc.
std::string accounts_of(SimulationLaws const& laws, bool hydrate) {
  Simulation sim = small_packing(laws, hydrate);
  std::size_t const before = sim.bytes();
  sim.set_ledger(true);
  std::string names;
  int accounts = 0;
  Dissipation losses = sim.assembly().dissipation;
  for_each_dissipation(losses, {}, [&](std::string const& name, Field<Accum> const& account, bool) {
    if (account.extent(0) == 0) return;
    names += name.substr(5) + " ";
    ++accounts;
  });
  EXPECT_EQ(sim.bytes() - before, accounts * sizeof(Accum) * sim.assembly().particles.x.extent(0)) << names;
  sim.step(50);
  EXPECT_GT(sim.assembly().losses().sliding + sim.assembly().losses().damping + 1, 0);
  return names;
}

TEST(Features, ALedgerHasNoAccountThatItsSceneHasNoUseFor) {
  SimulationLaws sand = sand_laws();
  EXPECT_EQ(accounts_of(sand, false), "sliding rolling ");
  sand.motion.damping = 0.3;
  EXPECT_EQ(accounts_of(sand, false), "sliding rolling damping ");
  EXPECT_EQ(accounts_of(sand_laws(0.5, 0), false), "sliding ");
  EXPECT_EQ(accounts_of(sand_laws(0, 0), false), "");
  SimulationLaws viscous = hydrate_laws(ContactCoupling::parallel);
  viscous.contact.grain.damping_ratio = 0.02;
  EXPECT_EQ(accounts_of(viscous, true), "sliding rolling dashpot breakage ");
}

TEST(Features, GrainsWithoutFrictionKeepNoShear) {
  std::size_t const real = tested_precision() == Precision::full ? sizeof(double) : sizeof(float), index = sizeof(int);
  EXPECT_EQ(bytes_per_entry(small_packing(sand_laws(0, 0), false)), index);
  EXPECT_EQ(bytes_per_entry(small_packing(sand_laws(0, 2), false)), index + real);
  SimulationLaws smooth = hydrate_laws(ContactCoupling::parallel);
  smooth.contact.grain.friction = 0;
  EXPECT_EQ(bytes_per_entry(small_packing(smooth, true)), index_and_reference() + 5 * real);
  smooth = hydrate_laws(ContactCoupling::replaces);
  smooth.contact.grain.friction = 0;
  EXPECT_EQ(bytes_per_entry(small_packing(smooth, true, ContactCoupling::replaces)),
            index_and_reference() + 4 * real);  // the shear of the bonds
}

/// Sheared packings without friction, and with one that clamps every shear to zero. In double precision they agree to the bit. In
/// mixed precision those that keep no shear have no references either, and know overlaps to 15 pm instead of 0.9.
TEST(Features, WithoutFrictionHaveTheBitsOfALimitOfZero) {
  auto const shear = [](Simulation& sim, int steps) {
    sim.time_step = 1e-7;
    sim.loading().y = AxisDrive::at_rate(1000);
    sim.step(steps);
    EXPECT_GT(sim.assembly().measures().touching, 20);
    return sim.specimen();
  };
  for (bool const hydrate : {false, true}) {
    SimulationLaws laws = hydrate ? hydrate_laws(ContactCoupling::parallel) : sand_laws();
    laws.contact.grain.friction = 0;
    Simulation loose = small_packing(laws, hydrate);
    Specimen const dense = shear(loose, 2000);
    auto const sheared = [&](double friction) {
      laws.contact.grain.friction = friction;
      Simulation sim(dense, laws, 0.1 * dense.d50);
      Specimen const end = shear(sim, tested_precision() == Precision::full ? 1000 : 50);
      return std::vector{end.x, end.y, end.vx, end.vy};
    };
    auto const without = sheared(0), clamped = sheared(1e-200);  // so small a limit adds nothing to any force
    for (std::size_t k = 0; k < without.size(); ++k)
      for (std::size_t i = 0; i < without[k].size(); ++i)
        ASSERT_NEAR(without[k][i], clamped[k][i], k < 2 ? within(0, 1e-10) : within(0, 1e-4)) << k << ", " << i;
  }
}

TEST(Features, BreaksAreCountedWithoutALogWhereNobodyReadsTheEvents) {
  auto const sheared = [](BreakRecord record) {
    Simulation sim = small_packing(hydrate_laws(ContactCoupling::parallel), true);
    sim.keep_breaks(record);
    sim.loading().y = AxisDrive::at_rate(2000);
    sim.loading().x = AxisDrive::at_rate(-1500);
    sim.step(4000);
    return sim;
  };
  Simulation const logged = sheared(BreakRecord::events), counted = sheared(BreakRecord::counts);
  EXPECT_GT(logged.assembly().broken_bonds(), 10);
  EXPECT_EQ(static_cast<int>(logged.assembly().break_events(0).size()), logged.assembly().broken_bonds());
  EXPECT_EQ(counted.assembly().broken_bonds(), logged.assembly().broken_bonds());
  EXPECT_EQ(counted.assembly().break_counts()[BreakMode::shear], logged.assembly().break_counts()[BreakMode::shear]);
  EXPECT_EQ(counted.assembly().break_counts()[BreakMode::rolling], logged.assembly().break_counts()[BreakMode::rolling]);
  EXPECT_TRUE(counted.assembly().break_events(0).empty());
  EXPECT_EQ(counted.assembly().hash(), logged.assembly().hash());
  EXPECT_GE(logged.bytes(), counted.bytes() + 41 * 100);  // of a bond
  EXPECT_TRUE(logged.assembly().detailed_break_events(0).details.empty());
  Simulation const detailed = sheared(BreakRecord::details);
  EXPECT_EQ(detailed.assembly().hash(), logged.assembly().hash());
  EXPECT_EQ(static_cast<int>(detailed.assembly().detailed_break_events(0).details.size()), logged.assembly().broken_bonds());
  Scene scene;
  scene.hydrate.saturation = 0.55;
  EXPECT_EQ(needs_of(scene).bytes(FieldOf::bond), 0);
  scene.output.event_details = true;
  auto const bonds = (logged.bytes() - counted.bytes()) / 33;
  EXPECT_EQ(detailed.bytes() - logged.bytes(), static_cast<std::size_t>(needs_of(scene).bytes(FieldOf::bond)) * bonds);
  scene.output.events = false;
  EXPECT_EQ(needs_of(scene).bytes(FieldOf::bond), 0);
}

TEST(Features, WallsKeepShearOnlyWhereTheyAreRough) {
  SimulationLaws laws = sand_laws();
  laws.wall.friction = 0.5;
  Simulation const sim = small_packing(laws, false);
  EXPECT_GT(sim.assembly().wall_contacts().shear.extent(0), 0u);
}

}  // namespace
}  // namespace clathra
