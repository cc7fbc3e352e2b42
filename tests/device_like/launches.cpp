/// What a device is asked to do for a step: each launch and each wait of the host has a price there.
#include "device_like/host_access.hpp"
#include "golden_states.hpp"

namespace clathra {
namespace {

using device_like::LaunchCount;

struct Asked {
  LaunchCount::Counts launches, round_trips;
  int allocations;
};

/// For steps at once without a search and without a look for faults.
Asked for_steps(Precision precision, int steps) {
  Simulation sim = ready(bonded_patch(Composite::parallel), Composite::parallel, {}, nullptr, precision);
  sim.loading.x = sim.loading.y = AxisDrive::held();
  sim.set_skin(0.3 * grain_d50);
  sim.step();
  std::int64_t const searches = sim.rebuilds();
  LaunchCount const count;
  sim.step(steps);
  EXPECT_EQ(sim.rebuilds(), searches);
  return {count.launches(), count.round_trips(), count.allocations()};
}

class Launches : public testing::TestWithParam<Precision> {};
INSTANTIATE_TEST_SUITE_P(, Launches, testing::Values(Precision::full, Precision::mixed),
                         [](auto const& test) { return std::string(precision_names[static_cast<int>(test.param)]); });

// The host waits once for all of them.
TEST_P(Launches, OfAStepAreThreeAndNoneMakesTheHostWait) {
  for (int const steps : {10, 50}) {
    Asked const asked = for_steps(GetParam(), steps);
    LaunchCount::Counts const launches{
        {"reduce kick_and_drift", steps}, {"for contact_forces_bonded", steps}, {"reduce wall_forces", steps}};
    LaunchCount::Counts const waits{{"copy of step_state", 1}};
    EXPECT_EQ(asked.launches, launches);
    EXPECT_EQ(asked.round_trips, waits);
    EXPECT_EQ(asked.allocations, 0);
  }
}

int total(LaunchCount::Counts const& counts) {
  int sum = 0;
  for (auto const& [what, number] : counts) sum += number;
  return sum;
}

// The zero fills of new fields are launches too.
TEST_P(Launches, OfAStepWithASearchAreNoMoreThanTheyWere) {
  Simulation sim = ready(bonded_patch(Composite::parallel), Composite::parallel, {}, nullptr, GetParam());
  for (int n = 0; n < 20; ++n) {  // the sixteenth search sorts in space
    sim.request_rebuild();
    sim.step();
  }
  LaunchCount const count;
  sim.request_rebuild();
  sim.step();
  EXPECT_LE(total(count.launches()), 58);
  EXPECT_LE(total(count.round_trips()), 14);
  EXPECT_LE(count.allocations(), 39);
}

}  // namespace
}  // namespace clathra
