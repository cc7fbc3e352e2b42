/// Steps by graphs are the steps one by one, whatever changes in between.
#include "golden_states.hpp"

namespace clathra {
namespace {

class Graphs : public testing::TestWithParam<Precision> {};
INSTANTIATE_TEST_SUITE_P(, Graphs, testing::Values(Precision::full, Precision::mixed),
                         [](auto const& test) { return std::string(precision_names[static_cast<int>(test.param)]); });

/// A bonded specimen that is sheared while its time step, its laws, its ledger and its log of breaks change.
/// @param at_once  steps that are asked for at once
Simulation sheared(Precision precision, int at_once) {
  Simulation sim = ready(bonded_patch(ContactCoupling::parallel), ContactCoupling::parallel, {}, nullptr, precision);
  auto const go_on = [&] {
    for (int n = 0; n < 640; n += at_once) sim.step(at_once);
  };
  go_on();
  sim.time_step *= 0.9;
  go_on();
  SimulationLaws laws = sim.assembly().laws;
  laws.contact.grain.friction = 0.3;
  sim.set_laws(laws);
  go_on();
  sim.set_ledger(true);
  go_on();
  sim.keep_breaks(BreakRecord::events);
  go_on();
  sim.keep_breaks(BreakRecord::details);
  go_on();
  return sim;
}

TEST_P(Graphs, GiveTheStateOfStepsOneByOne) {
  Simulation const many = sheared(GetParam(), 640), single = sheared(GetParam(), 1);
  EXPECT_EQ(many.assembly().hash(), single.assembly().hash());
  EXPECT_EQ(many.assembly().steps(), single.assembly().steps());
  EXPECT_EQ(many.assembly().broken_bonds(), single.assembly().broken_bonds());
  EXPECT_GT(many.assembly().broken_bonds(), 0);
  EXPECT_EQ(many.assembly().losses().sliding, single.assembly().losses().sliding);
  auto const steps_of = [](std::vector<BreakEvent> const& events) {
    std::vector<std::int64_t> steps;
    for (BreakEvent const& event : events) steps.push_back(event.step);
    return steps;
  };
  EXPECT_EQ(steps_of(many.assembly().break_events(0)), steps_of(single.assembly().break_events(0)));
  EXPECT_GE(many.graph_runs(), 6 * 4);
  EXPECT_EQ(single.graph_runs(), 0);
}

}  // namespace
}  // namespace clathra
