/// What a scene does not need it does not pay for: neither bytes nor launches.
#include <map>
#include <string>

#include "scenes.hpp"

namespace clathra {
namespace {

/// Names of the kernels launched while it lives, with their number.
class Launches {
 public:
  Launches() {
    counted().clear();
    Kokkos::Tools::Experimental::set_begin_parallel_for_callback(&count);
    Kokkos::Tools::Experimental::set_begin_parallel_reduce_callback(&count);
    Kokkos::Tools::Experimental::set_begin_parallel_scan_callback(&count);
  }
  ~Launches() {
    Kokkos::Tools::Experimental::set_begin_parallel_for_callback(nullptr);
    Kokkos::Tools::Experimental::set_begin_parallel_reduce_callback(nullptr);
    Kokkos::Tools::Experimental::set_begin_parallel_scan_callback(nullptr);
  }
  Launches(Launches const&) = delete;
  int of(std::string const& name) const { return counted()[name]; }
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

Simulation packing(SimulationLaws const& laws, bool hydrate, Composite composite = Composite::parallel) {
  Specimen s = disordered_patch(8, 8);
  if (hydrate) bond_all(s, hydrate_scene(0.55, composite));
  Simulation sim(s, laws, 0.1 * grain_d50);
  sim.time_step = 1e-8;
  sim.loading.y = AxisDrive::at_rate(1);
  return sim;
}
SimulationLaws hydrate_laws(Composite composite) {
  Scene const scene = hydrate_scene(0.55, composite);
  return bonded_laws(scene, h_max_of(scene));
}

std::size_t bytes_per_entry(Simulation const& sim) {
  std::size_t const n = sim.contact_entries();
  ContactRows const& r = sim.rows();
  for (auto const* field : {&r.shear, &r.moment, &r.formation_overlap, &r.width, &r.bond_shear, &r.bond_moment})
    EXPECT_TRUE(field->extent(0) == 0 || field->extent(0) == n);
  return (bytes(r) - (r.slice_start.span() + r.length.span()) * sizeof(int) - r.active.span() * sizeof(std::uint64_t)) / n;
}

TEST(Features, ASceneWithoutHydrateHasNoBondField) {
  Simulation sim = packing(sand_laws(), false);
  for (int n = 0; n < 100; ++n) sim.step();
  ContactRows const& rows = sim.rows();
  EXPECT_EQ(rows.formation_overlap.extent(0) + rows.width.extent(0) + rows.bond_shear.extent(0) + rows.bond_moment.extent(0), 0u);
  EXPECT_EQ(sim.wall_contacts().shear.extent(0), 0u);  // smooth walls
  EXPECT_EQ(sim.broken_bonds(), 0);
  LossTotals const none = sim.losses();
  EXPECT_EQ(none.sliding + none.rolling + none.damping, 0);
}

TEST(Features, CostBytesOnlyWhereTheyAreOn) {
  std::size_t const real = sizeof(Real), index = sizeof(int);
  EXPECT_EQ(bytes_per_entry(packing(sand_laws(0.5, 0), false)), index + real);
  EXPECT_EQ(bytes_per_entry(packing(sand_laws(), false)), index + 2 * real);
  EXPECT_EQ(bytes_per_entry(packing(hydrate_laws(Composite::replace), true, Composite::replace)), index + 4 * real);
  EXPECT_EQ(bytes_per_entry(packing(hydrate_laws(Composite::memory), true, Composite::memory)), index + 4 * real);
  EXPECT_EQ(bytes_per_entry(packing(hydrate_laws(Composite::parallel), true)), index + 6 * real);
}

TEST(Features, LaunchOnlyWhatTheSceneNeeds) {
  Simulation sand = packing(sand_laws(), false), bonded = packing(hydrate_laws(Composite::parallel), true);
  {
    Launches const launches;
    for (int n = 0; n < 50; ++n) sand.step();
    EXPECT_EQ(launches.of("contact_forces"), 50);
    EXPECT_EQ(launches.with("bond"), 0);
    EXPECT_EQ(launches.with("loss"), 0);
    EXPECT_EQ(launches.with("wall_shear"), 0);
    EXPECT_EQ(launches.of("kick_and_drift"), 50);
  }
  Launches const launches;
  for (int n = 0; n < 50; ++n) bonded.step();
  EXPECT_EQ(launches.of("contact_forces_bonded"), 50);
  EXPECT_EQ(launches.of("contact_forces"), 0);
}

/// Names of the accounts that a ledger keeps with these laws, and the bytes that they cost a place of a disc.
std::string accounts_of(SimulationLaws const& laws, bool hydrate) {
  Simulation sim = packing(laws, hydrate);
  std::size_t const before = sim.bytes();
  sim.set_ledger(true);
  std::string names;
  int accounts = 0;
  EnergyLosses losses = sim.energy_losses();
  for_each_account(losses, {}, [&](std::string const& name, Field<Accum> const& account, bool) {
    if (account.extent(0) == 0) return;
    names += name.substr(5) + " ";
    ++accounts;
  });
  EXPECT_EQ(sim.bytes() - before, accounts * sizeof(Accum) * sim.particles().x.extent(0)) << names;
  for (int n = 0; n < 50; ++n) sim.step();
  EXPECT_GT(sim.losses().sliding + sim.losses().damping + 1, 0);
  return names;
}

TEST(Features, ALedgerHasNoAccountThatItsSceneHasNoUseFor) {
  SimulationLaws sand = sand_laws();
  EXPECT_EQ(accounts_of(sand, false), "sliding rolling ");
  sand.motion.damping = 0.3;
  EXPECT_EQ(accounts_of(sand, false), "sliding rolling damping ");
  EXPECT_EQ(accounts_of(sand_laws(0.5, 0), false), "sliding ");
  EXPECT_EQ(accounts_of(sand_laws(0, 0), false), "");
  SimulationLaws viscous = hydrate_laws(Composite::parallel);
  viscous.contact.grain.damping_ratio = 0.02;
  EXPECT_EQ(accounts_of(viscous, true), "sliding rolling dashpot breakage ");
}

TEST(Features, GrainsWithoutFrictionKeepNoShear) {
  std::size_t const real = sizeof(Real), index = sizeof(int);
  EXPECT_EQ(bytes_per_entry(packing(sand_laws(0, 0), false)), index);
  EXPECT_EQ(bytes_per_entry(packing(sand_laws(0, 2), false)), index + real);
  SimulationLaws smooth = hydrate_laws(Composite::parallel);
  smooth.contact.grain.friction = 0;
  EXPECT_EQ(bytes_per_entry(packing(smooth, true)), index + 5 * real);
  smooth = hydrate_laws(Composite::replace);
  smooth.contact.grain.friction = 0;
  EXPECT_EQ(bytes_per_entry(packing(smooth, true, Composite::replace)), index + 4 * real);  // the shear of the bonds
}

/// Sheared packings that agree to the bit: without friction, and with a friction that clamps every shear to zero.
TEST(Features, WithoutFrictionHaveTheBitsOfALimitOfZero) {
  for (bool const hydrate : {false, true}) {
    auto const sheared = [&](double friction) {
      SimulationLaws laws = hydrate ? hydrate_laws(Composite::parallel) : sand_laws();
      laws.contact.grain.friction = friction;
      Simulation sim = packing(laws, hydrate);
      sim.time_step = 1e-7;
      sim.loading.y = AxisDrive::at_rate(1000);
      for (int n = 0; n < 2000; ++n) sim.step();
      EXPECT_GT(sim.measures().touching, 20);
      Specimen const end = sim.specimen();
      return std::vector{end.x, end.y, end.vx, end.vy};
    };
    EXPECT_EQ(sheared(0), sheared(1e-200));  // so small a limit adds nothing to any force
  }
}

TEST(Features, BreaksAreCountedWithoutALogWhereNobodyReadsTheEvents) {
  auto const sheared = [](bool events) {
    Simulation sim = packing(hydrate_laws(Composite::parallel), true);
    sim.keep_break_events(events);
    sim.loading.y = AxisDrive::at_rate(2000);
    sim.loading.x = AxisDrive::at_rate(-1500);
    for (int n = 0; n < 4000; ++n) sim.step();
    return sim;
  };
  Simulation const logged = sheared(true), counted = sheared(false);
  EXPECT_GT(logged.broken_bonds(), 10);
  EXPECT_EQ(static_cast<int>(logged.break_events(0).size()), logged.broken_bonds());
  EXPECT_EQ(counted.broken_bonds(), logged.broken_bonds());
  EXPECT_EQ(counted.break_counts()[BreakMode::shear], logged.break_counts()[BreakMode::shear]);
  EXPECT_EQ(counted.break_counts()[BreakMode::rolling], logged.break_counts()[BreakMode::rolling]);
  EXPECT_TRUE(counted.break_events(0).empty());
  EXPECT_EQ(counted.hash(), logged.hash());
  EXPECT_GE(logged.bytes(), counted.bytes() + 41 * 100);  // of a bond
}

TEST(Features, WallsKeepShearOnlyWhereTheyAreRough) {
  SimulationLaws laws = sand_laws();
  laws.wall.friction = 0.5;
  Simulation const sim = packing(laws, false);
  EXPECT_GT(sim.wall_contacts().shear.extent(0), 0u);
}

}  // namespace
}  // namespace clathra
