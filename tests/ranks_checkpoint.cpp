/// A simulation that was taken apart and put together again goes on with the same bits, on any number of ranks.
#include "golden_states.hpp"
#include "ranks_main.hpp"

namespace clathra {
namespace {

TEST(Checkpoint, TakesNothingFromTheGoldenState) {
  for (Golden const& g : golden) {
    Specimen const whole = bonded_patch(g.coupling), empty = without_discs(whole);
    auto sim = std::make_unique<Simulation>(ready(whole, g.coupling, world(), world().root() ? &whole : &empty, g.precision));
    for (int n = 0; n < 3000; ++n) {
      if (n % 700 == 350) sim = std::make_unique<Simulation>(sim->state(), sim->assembly().laws, world());
      sim->step();
    }
    EXPECT_EQ(sim->assembly().hash(), g.hash);
    EXPECT_EQ(sim->assembly().broken_bonds(), g.broken);
    EXPECT_GT(sim->assembly().upkeep.searches(), 5);
  }
}

TEST(Checkpoint, KeepsTheDetailsOfBrokenBonds) {
  Specimen const whole = bonded_patch(ContactCoupling::parallel), empty = without_discs(whole);
  Simulation alone = ready(whole, ContactCoupling::parallel);
  auto sim = std::make_unique<Simulation>(ready(whole, ContactCoupling::parallel, world(), world().root() ? &whole : &empty));
  alone.keep_breaks(BreakRecord::details);
  sim->keep_breaks(BreakRecord::details);
  for (int n = 0; n < 3000; ++n) {
    if (n % 700 == 350) sim = std::make_unique<Simulation>(sim->state(), sim->assembly().laws, world());
    sim->step();
    alone.step();
  }
  EXPECT_EQ(sim->assembly().hash(), alone.assembly().hash());
  BreakEvents const all = gathered(world(), sim->assembly().detailed_break_events(0)),
                    one = alone.assembly().detailed_break_events(0);
  EXPECT_TRUE(all.detailed);
  if (!world().root()) return;
  EXPECT_GT(one.rows.size(), 20u);
  ASSERT_EQ(all.details.size(), one.details.size());
  for (std::size_t k = 0; k < one.details.size(); ++k)
    for (BreakDetailColumn const& column : break_detail_columns)
      EXPECT_EQ(all.details[k].*column.value, one.details[k].*column.value) << column.heading << " of event " << k;
}

TEST(Checkpoint, KeepsAccountsAndDisplacements) {
  Specimen const whole = bonded_patch(ContactCoupling::parallel), empty = without_discs(whole);
  Simulation sim = ready(whole, ContactCoupling::parallel, world(), world().root() ? &whole : &empty);
  sim.set_ledger(true);
  sim.mark_start();
  sim.choose_time_step({});
  sim.step(777);
  Simulation again(sim.state(), sim.assembly().laws, world());
  EXPECT_EQ(again.assembly().hash(), sim.assembly().hash());
  for (int n = 0; n < 1000; ++n) {
    sim.step();
    again.step();
    ASSERT_EQ(again.time_step, sim.time_step) << n;  // chosen anew at the same steps
  }
  EXPECT_EQ(again.time_steps().updates(), sim.time_steps().updates());
  EXPECT_EQ(again.assembly().hash(), sim.assembly().hash());
  EXPECT_EQ(again.assembly().losses().sliding, sim.assembly().losses().sliding);
  EXPECT_EQ(again.assembly().losses().damping, sim.assembly().losses().damping);
  EXPECT_EQ(again.assembly().boundary_work(), sim.assembly().boundary_work());
  EXPECT_EQ(again.assembly().time(), sim.assembly().time());
  auto const total_way = [](Simulation const& s) {
    double way = 0;
    auto const x = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.assembly().particles.x);
    auto const from = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.assembly().start_x);
    for (int i = 0; i < s.assembly().particles.owned; ++i) way = std::max(way, std::abs(x(i) - from(i)));
    return s.assembly().ranks().max(way);
  };
  EXPECT_GT(total_way(sim), 0);
  EXPECT_EQ(total_way(again), total_way(sim));
  EXPECT_EQ(again.assembly().break_counts()[BreakMode::shear], sim.assembly().break_counts()[BreakMode::shear]);
}

}  // namespace
}  // namespace clathra
