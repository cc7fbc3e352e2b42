/// The same bits on any number of ranks: ctest runs this file on 1, 2, 3, 4 and 7 of them, with one thread and with two.
#include <array>
#include <map>

#include "domain/measurement/snapshot.hpp"
#include "golden_states.hpp"
#include "on_host.hpp"
#include "ranks_main.hpp"

namespace clathra {
namespace {

/// This rank's part of a specimen, discs and contacts dealt out like cards: nothing lies where it will belong.
Specimen dealt(Specimen const& whole) {
  Specimen part = without_discs(whole);
  auto const mine = [](std::size_t k) {
    return static_cast<int>(k % static_cast<std::size_t>(world().count())) == world().rank();
  };
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (!mine(i)) continue;
    part.id.push_back(whole.id[i]);
    for (auto field :
         {&Specimen::x, &Specimen::y, &Specimen::angle, &Specimen::vx, &Specimen::vy, &Specimen::omega, &Specimen::radius})
      (part.*field).push_back((whole.*field)[i]);
  }
  for (std::size_t k = 0; k < whole.contacts.size(); ++k) {
    if (mine(k / 3)) part.contacts.push_back(whole.contacts[k]);
  }
  return part;
}

/// Two vertical cuts that follow one another, the second so far out that the ranks behind it own nothing.
Decomposition lopsided(Specimen const& s) {
  std::vector<Cut> cuts;
  for (int rank = 0; rank + 1 < world().count(); ++rank) {
    bool const last = rank + 2 == world().count();
    cuts.push_back({rank % 2 == 0, rank == 0 ? s.left + 0.3 * s.width() : 1.0 + rank, -1 - rank, last ? -2 - rank : rank + 1});
  }
  return Decomposition(cuts);
}

TEST(Ranks, ReachTheGoldenStateThroughBreakage) {
  for (Golden const& g : golden) {
    Specimen const whole = bonded_patch(g.coupling), part = dealt(whole);
    Simulation sim = ready(whole, g.coupling, world(), &part, g.precision);
    sim.step(3000);
    EXPECT_EQ(sim.assembly().hash(), g.hash);
    EXPECT_EQ(sim.assembly().broken_bonds(), g.broken);
    EXPECT_EQ(sim.assembly().discs(), static_cast<int>(whole.size()));
  }
}

TEST(Ranks, FollowTheLimitOfStabilityAlike) {
  Specimen const whole = bonded_patch(ContactCoupling::parallel), part = dealt(whole);
  Simulation one = ready(whole, ContactCoupling::parallel), many = ready(whole, ContactCoupling::parallel, world(), &part);
  for (Simulation* sim : {&one, &many}) sim->choose_time_step({});
  for (int n = 0; n < 1500; ++n) {
    one.step();
    many.step();
    ASSERT_EQ(one.time_step, many.time_step) << n;
  }
  EXPECT_EQ(one.assembly().hash(), many.assembly().hash());
  EXPECT_EQ(one.assembly().time(), many.assembly().time());
  EXPECT_EQ(one.time_steps().updates(), many.time_steps().updates());
  EXPECT_GT(many.time_steps().updates(), 3);
}

std::int64_t neighbours_listed(Simulation const& sim) {
  HostRows const rows(sim.assembly().rows);
  std::int64_t listed = 0;
  for (int i = 0; i < sim.assembly().particles.owned; ++i) listed += rows.length(i);
  return sim.assembly().ranks().sum(listed);
}

TEST(Ranks, ListNeighboursAsFarAsFlyingDiscsHaveLeeway) {
  Specimen whole = disordered_patch(20, 20, 0.1);
  for (std::size_t i = 0; i < whole.size(); i += 8) whole.vx[i] = whole.vx[i + 1] = 3;  // all others are at rest
  Specimen const part = dealt(whole);
  constexpr double skin = 0.5 * grain_d50;
  Simulation const one(whole, {}, skin), many(part, {}, skin, world());
  EXPECT_EQ(neighbours_listed(one), neighbours_listed(many));
  EXPECT_GT(neighbours_listed(one), 200);
}

TEST(Ranks, MissNoContactOfFlyingDiscs) {
  Specimen const whole = gas(), part = dealt(whole);
  constexpr double skin = 0.1 * grain_d50;
  Simulation one(whole, {}, skin), many(part, {}, skin, world());
  for (Simulation* sim : {&one, &many}) {
    sim->time_step = 0.3 * one.assembly().stable_time_step();
    sim->loading().x = AxisDrive::at_rate(500);
    sim->loading().y = AxisDrive::at_rate(-300);
    for (int n = 0; n < 4000; ++n) sim->step();
  }
  EXPECT_EQ(one.assembly().hash(), many.assembly().hash());
  EXPECT_EQ(one.assembly().upkeep.searches(), many.assembly().upkeep.searches());
}

TEST(Ranks, MeasureWhatOneRankMeasures) {
  Specimen const whole = bonded_patch(ContactCoupling::parallel), part = dealt(whole);
  Simulation one = ready(whole, ContactCoupling::parallel), many = ready(whole, ContactCoupling::parallel, world(), &part);
  one.set_ledger(true);
  many.set_ledger(true);
  for (int n = 0; n < 1500; ++n) {
    one.step();
    many.step();
  }
  EXPECT_EQ(one.assembly().hash(), many.assembly().hash());
  expect_equal_measures(one, many);
}

TEST(Ranks, MayOwnNothingAndMayBeCutAnewAtAnyTime) {
  Specimen const whole = bonded_patch(ContactCoupling::parallel), part = dealt(whole);
  Simulation sim = ready(whole, ContactCoupling::parallel, world(), &part);
  int fewest = sim.assembly().discs();
  for (int n = 0; n < 3000; ++n) {
    if (n == 400 || n == 2000) sim.set_decomposition(lopsided(whole));
    // The first rank claims to be slower than the others: it gets fewer discs.
    if (n == 1200) sim.set_decomposition(Decomposition::bisect(world(), sim.assembly().particles, world().root() ? 5 : 1));
    sim.step();
    fewest = std::min(fewest, sim.assembly().particles.owned);
  }
  if (world().count() > 2) {
    EXPECT_EQ(world().min(fewest), 0);
  }
  Golden const& g = golden[1];
  ASSERT_EQ(g.coupling, ContactCoupling::parallel);
  // Cutting anew asks for a neighbour search, and searches order rows: the lone rank searches at the same steps.
  Simulation one = ready(whole, ContactCoupling::parallel);
  for (int n = 0; n < 3000; ++n) {
    if (n == 400 || n == 1200 || n == 2000) one.request_search();
    one.step();
  }
  EXPECT_EQ(sim.assembly().hash(), one.assembly().hash());
  expect_equal_measures(one, sim);
}

/// Discs by id and pairs by ids, as they stand in the snapshots of all ranks; on rank 0.
struct Seen {
  std::map<int, std::array<double, 8>> discs;
  std::map<std::array<int, 2>, std::array<double, 4>> pairs;
};
Seen seen(Simulation const& sim, Ranks const& ranks) {
  Snapshot const s = take_snapshot(sim);
  std::vector<double> discs, pairs;
  for (std::size_t i = 0; i < s.id.size(); ++i)
    discs.insert(discs.end(), {double(s.id[i]), s.x[i], s.y[i], s.ux[i], s.stress_yy[i], double(s.coordination[i]),
                               double(s.bonds_intact[i]), double(s.bonds_initial[i])});
  for (std::size_t k = 0; k < s.a.size(); ++k)
    pairs.insert(pairs.end(), {double(s.a[k]), double(s.b[k]), double(s.state[k]), s.normal_force[k], s.width[k], s.gap[k]});
  discs = ranks.gather(discs);
  pairs = ranks.gather(pairs);
  Seen all;
  std::vector<int> id;  // by number
  for (std::size_t k = 0; k < discs.size(); k += 8) {
    id.push_back(static_cast<int>(discs[k]));
    std::copy_n(discs.begin() + static_cast<std::ptrdiff_t>(k), 8, all.discs[id.back()].begin());
  }
  for (std::size_t k = 0; k < pairs.size(); k += 6) {
    int const a = id.at(static_cast<std::size_t>(pairs[k])), b = id.at(static_cast<std::size_t>(pairs[k + 1]));
    EXPECT_TRUE(
        all.pairs.insert({{std::min(a, b), std::max(a, b)}, {pairs[k + 2], pairs[k + 3], pairs[k + 4], pairs[k + 5]}}).second);
  }
  return all;
}

TEST(Ranks, ShowTheSameDiscsAndPairs) {
  Specimen const whole = bonded_patch(ContactCoupling::parallel), part = dealt(whole);
  Simulation one = ready(whole, ContactCoupling::parallel), many = ready(whole, ContactCoupling::parallel, world(), &part);
  one.mark_start();
  many.mark_start();
  for (int n = 0; n < 3000; ++n) {
    one.step();
    many.step();
  }
  Seen const expected = seen(one, {}), found = seen(many, world());
  if (!world().root()) return;
  EXPECT_EQ(found.discs, expected.discs);
  EXPECT_EQ(found.pairs, expected.pairs);
  EXPECT_GT(found.pairs.size(), 400u);
}

TEST(Ranks, OwnEqualPartsOfTheWork) {
  Specimen const whole = bonded_patch(ContactCoupling::replaces), part = dealt(whole);
  Simulation sim = ready(whole, ContactCoupling::replaces, world(), &part);
  int const ranks = world().count();
  double const fair = static_cast<double>(sim.assembly().discs()) / ranks;
  EXPECT_NEAR(sim.assembly().particles.owned, fair, 2 + 0.1 * fair);
  if (ranks == 1) return;
  // Discs of the first rank take three times as long: the parts that they lie in become smaller.
  int const before = sim.assembly().particles.owned;
  sim.set_decomposition(Decomposition::bisect(world(), sim.assembly().particles, world().root() ? 3 : 1));
  sim.step();
  if (world().root()) {
    EXPECT_LT(sim.assembly().particles.owned, before);
  }
  double const most = world().max(sim.assembly().particles.owned);
  EXPECT_GT(most, fair);
  EXPECT_EQ(world().sum(std::int64_t{sim.assembly().particles.owned}), sim.assembly().discs());
}

TEST(Ranks, HandOutASpecimenWhosePartsAreTheWhole) {
  Specimen const whole = bonded_patch(ContactCoupling::replaces), part = dealt(whole);
  Simulation sim = ready(whole, ContactCoupling::replaces, world(), &part);
  sim.step(500);
  Simulation alone = ready(whole, ContactCoupling::replaces);
  for (int n = 0; n < 500; ++n) alone.step();
  Specimen const mine = sim.specimen(), all = alone.specimen();
  EXPECT_EQ(world().sum(static_cast<std::int64_t>(mine.size())), static_cast<std::int64_t>(all.size()));
  EXPECT_EQ(world().sum(static_cast<std::int64_t>(mine.contacts.size())), static_cast<std::int64_t>(all.contacts.size()));
  for (std::size_t i = 0; i < mine.size(); ++i) {
    auto const at = static_cast<std::size_t>(mine.id[i]);
    EXPECT_EQ(mine.x[i], all.x[at]);
    EXPECT_EQ(mine.omega[i], all.omega[at]);
  }
  Simulation const again(mine, sim.assembly().laws, 0.05 * grain_d50, world());
  EXPECT_EQ(again.assembly().hash(), alone.assembly().hash());
}

}  // namespace
}  // namespace clathra
