/// What a search has to know of all discs before it begins.
#include "kernels/rebuild_inputs.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

RebuildInputs enqueued_rebuild_inputs(Simulation const& sim, Faults const& faults = make_faults()) {
  return rebuild_inputs(sim.assembly().particles, sim.assembly().rows, {}, faults, {});
}

TEST(RebuildInputs, FindsBoundsAndSpeeds) {
  Specimen s = open_space();
  add_disc(s, -0.3, 0.1);
  add_disc(s, 0.2, -0.7);
  add_disc(s, -0.25, 0.05);
  s.vx = {0.3, 0, -2};
  s.vy = {0.4, 0, 0};
  RebuildInputs const all = enqueued_rebuild_inputs(Simulation(s, {}, 1e-4));
  Bounds const bounds = all.bounds();
  EXPECT_EQ(bounds.left, -0.3);
  EXPECT_EQ(bounds.right, 0.2);
  EXPECT_EQ(bounds.bottom, -0.7);
  EXPECT_EQ(bounds.top, 0.1);
  EXPECT_EQ(all.sums[RebuildInputs::discs], 3);
  EXPECT_EQ(all.largest[RebuildInputs::speed], 2);
  EXPECT_NEAR(all.mean_of_speeds({}), 2.5 / 3, 1e-15);
  EXPECT_EQ(all.largest[RebuildInputs::bonded_gap], 0);
  for (int fault = 0; fault < fault_count; ++fault) EXPECT_EQ(all.largest[RebuildInputs::faults + fault], -1);
}

TEST(RebuildInputs, FindsTheWidestGapOfAnIntactBond) {
  Scene const scene = hydrate_scene(0.55, ContactCoupling::parallel);
  Specimen s = disordered_patch(10, 10, 0.03);
  bond_all(s, scene);
  Simulation const sim(s, bonded_laws(scene, s.critical_thickness), 0.05 * grain_d50);
  double widest = 0;
  for (SpecimenContact const& c : s.contacts) {
    auto const at = [&](int id) { return static_cast<std::size_t>(std::find(s.id.begin(), s.id.end(), id) - s.id.begin()); };
    std::size_t const a = at(c.id_a), b = at(c.id_b);
    widest = std::max(widest, std::hypot(s.x[b] - s.x[a], s.y[b] - s.y[a]) - (s.radius[a] + s.radius[b]));
  }
  EXPECT_GT(widest, 0);
  EXPECT_NEAR(enqueued_rebuild_inputs(sim).largest[RebuildInputs::bonded_gap], widest, 1e-12 * widest);
}

TEST(RebuildInputs, BringsFaultsAlong) {
  Faults const faults = make_faults();
  Kokkos::deep_copy(faults.disc, 7);
  RebuildInputs const all = enqueued_rebuild_inputs(Simulation(disordered_patch(3, 3), {}, 1e-4), faults);
  for (int fault = 0; fault < fault_count; ++fault) EXPECT_EQ(all.largest[RebuildInputs::faults + fault], 7);
}

TEST(RebuildInputs, RefusesSpeedsThatCannotBeSummed) {
  RebuildInputs all;
  all.sums[RebuildInputs::speeds_out_of_range] = 1;
  EXPECT_THROW((void)all.mean_of_speeds({}), SumOutOfRange);
  EXPECT_EQ(RebuildInputs().bounds().right, 0);  // of no disc
}

}  // namespace
}  // namespace clathra
