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
  Simulation sim = ready(bonded_patch(ContactCoupling::parallel), ContactCoupling::parallel, {}, nullptr, precision);
  sim.loading().x = sim.loading().y = AxisDrive::held();
  sim.set_skin(0.3 * grain_d50);
  sim.step();
  std::int64_t const searches = sim.assembly().upkeep.searches();
  LaunchCount const count;
  sim.step(steps);
  EXPECT_EQ(sim.assembly().upkeep.searches(), searches);
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
        {"reduce kick_and_drift", steps}, {"for contact_forces_bonded", steps}, {"for wall_forces", steps}};
    LaunchCount::Counts const waits{{"copy of step_state", 1}};
    EXPECT_EQ(asked.launches, launches);
    EXPECT_EQ(asked.round_trips, waits);
    EXPECT_EQ(asked.allocations, 0);
  }
}

/// What a search adds to a step.
int difference(LaunchCount::Counts with, LaunchCount::Counts const& without) {
  int sum = 0;
  for (auto const& [what, number] : with) sum += number;
  for (auto const& [what, number] : without) sum -= number;
  return sum;
}

/// For a step with a search.
Asked for_a_search(Simulation& sim) {
  sim.request_search();
  LaunchCount const count;
  sim.step();
  return {count.launches(), count.round_trips(), count.allocations()};
}

// Every sixteenth one sorts in space as well.
TEST_P(Launches, OfASearchAreBoundedOneMakesTheHostWaitAndNothingIsAllocated) {
  Simulation sim = ready(bonded_patch(ContactCoupling::parallel), ContactCoupling::parallel, {}, nullptr, GetParam());
  for (int n = 0; n < 34; ++n) (void)for_a_search(sim);
  Asked step;
  {
    LaunchCount const count;
    sim.step();
    step = {count.launches(), count.round_trips(), count.allocations()};
  }
  for (int n = 0; n < 16; ++n) {
    Asked const asked = for_a_search(sim);
    LaunchCount::Counts waits = asked.round_trips;
    for (char const* scan : {"scan_cells", "scan_slices", "find_near_walls"}) waits.erase(scan);  // their sums stay on the device
    EXPECT_LE(difference(asked.launches, step.launches), GetParam() == Precision::full ? 49 : 48) << n;
    EXPECT_EQ(difference(waits, step.round_trips), 1 + 1) << n;  // and the step is asked for in two parts
    EXPECT_EQ(asked.allocations, 0) << n;
  }
}

}  // namespace
}  // namespace clathra
