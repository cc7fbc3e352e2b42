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
  for (auto const* field : {&r.shear, &r.moment, &r.equilibrium, &r.width, &r.bond_shear, &r.bond_moment})
    EXPECT_TRUE(field->extent(0) == 0 || field->extent(0) == n);
  return (bytes(r) - (r.slice_start.span() + r.length.span()) * sizeof(int) - r.active.span() * sizeof(std::uint64_t)) / n;
}

TEST(Features, ASceneWithoutHydrateHasNoBondField) {
  Simulation sim = packing(sand_laws(), false);
  for (int n = 0; n < 100; ++n) sim.step();
  ContactRows const& rows = sim.rows();
  EXPECT_EQ(rows.equilibrium.extent(0) + rows.width.extent(0) + rows.bond_shear.extent(0) + rows.bond_moment.extent(0), 0u);
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

TEST(Features, WallsKeepShearOnlyWhereTheyAreRough) {
  SimulationLaws laws = sand_laws();
  laws.wall.friction = 0.5;
  Simulation const sim = packing(laws, false);
  EXPECT_GT(sim.wall_contacts().shear.extent(0), 0u);
}

}  // namespace
}  // namespace clathra
