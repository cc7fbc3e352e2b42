/// The host reads and writes no field outside of kernels and deep copies: on a device it could not.
#include "device_like/host_access.hpp"
#include "golden_states.hpp"
#include "kernels/pair_list.hpp"

namespace clathra {
namespace {

using device_like::HostAccessWatch;

TEST(DeviceLike, AnAccessOfTheHostIsSeen) {
  Field<double> const field("watched", 10);
  HostAccessWatch const watch;
  EXPECT_EQ(watch.report(), "");
  Kokkos::deep_copy(field, 1);
  EXPECT_EQ(Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), field)(3), 1);
  EXPECT_EQ(watch.report(), "");
  EXPECT_EQ(field(3), 1);
  EXPECT_NE(watch.report().find("field \"watched\""), std::string::npos) << watch.report();
}

/// All that a run asks a simulation for.
void use(Simulation& sim) {
  (void)sim.assembly().measures();
  (void)sim.assembly().losses();
  (void)sim.assembly().hash();
  (void)sim.specimen();
  (void)sim.assembly().deepest_overlap();
  (void)sim.assembly().stable_time_step();
  (void)sim.assembly().largest_frequency();
  (void)sim.assembly().broken_bonds();
  (void)sim.assembly().break_events(0);
  (void)list_pairs(sim.assembly().particles, sim.assembly().rows, sim.assembly().laws.contact);
  (void)disc_loads(sim.assembly().particles, sim.assembly().rows, sim.assembly().laws.contact, sim.assembly().walls(),
                   sim.assembly().wall_contacts(), sim.assembly().laws.wall);
}

/// Nothing so far, and it would have been seen.
void expect_none(HostAccessWatch const& watch, Simulation const& sim) {
  EXPECT_EQ(watch.report(), "");
  EXPECT_GE(sim.assembly().particles.id(0), 0);
  EXPECT_NE(watch.report(), "");
}

class HostAccess : public testing::TestWithParam<Precision> {};
INSTANTIATE_TEST_SUITE_P(, HostAccess, testing::Values(Precision::full, Precision::mixed),
                         [](auto const& test) { return std::string(precision_names[static_cast<int>(test.param)]); });

TEST_P(HostAccess, IsNotWhatABondedSpecimenThatBreaksNeeds) {
  HostAccessWatch const watch;
  Specimen const s = bonded_patch(ContactCoupling::parallel);
  Simulation sim = ready(s, ContactCoupling::parallel, {}, nullptr, GetParam());
  sim.set_ledger(true);
  sim.keep_breaks(BreakRecord::details);
  sim.mark_start();
  sim.choose_time_step({});
  std::int64_t const searches = sim.assembly().upkeep.searches();
  for (int n = 0; n < 600; ++n) sim.step();
  EXPECT_GT(sim.assembly().upkeep.searches(), searches);
  EXPECT_GT(sim.assembly().broken_bonds(), 0);
  use(sim);
  SimulationLaws const laws = sim.assembly().laws;
  Simulation resumed(sim.state(), laws, {});
  EXPECT_EQ(resumed.assembly().hash(), sim.assembly().hash());
  expect_none(watch, resumed);
}

TEST_P(HostAccess, IsNotWhatAPeriodicCellNeeds) {
  HostAccessWatch const watch;
  Specimen s = disordered_patch(12, 12, 0.1);
  s.periodic = true;
  SimulationLaws laws = sand_laws();
  laws.precision = GetParam();
  Simulation sim(s, laws, 0.05 * grain_d50);
  sim.time_step = 1e-7;
  for (int n = 0; n < 500; ++n) {
    sim.strain(3e-5, 3e-5);
    sim.step();
  }
  use(sim);
  expect_none(watch, sim);
}

}  // namespace
}  // namespace clathra
