/// Verlet skins of discs: how far they may move beside their box before neighbours are searched again.
#include "domain/scene/specimen_design.hpp"
#include "domain/simulation/neighbour_list_upkeep.hpp"
#include "kernels/rebuild_inputs.hpp"
#include "on_host.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

constexpr double h = 0.05 * grain_d50;

/// A hundred discs far from each other, of which two move.
Specimen two_of_a_hundred_fly(double slow, double fast) {
  Specimen s = open_space();
  for (int n = 0; n < 100; ++n) add_disc(s, 0.01 * n, 0.02 * n);
  s.vx[10] = slow;
  s.vy[20] = fast;
  return s;
}

double skin_of(Simulation const& sim, int id) { return value(sim.assembly().particles.verlet_skin, index_of(sim, id)); }

/// Gives discs their skins as a search does. @return the largest
double give_skins(Simulation const& sim, AffineFrame const& frame, SkinRange const& range) {
  RebuildInputs const all = rebuild_inputs(sim.assembly().particles, sim.assembly().rows, frame, make_faults(), {});
  assign_verlet_skins(sim.assembly().particles, frame, range, all.mean_of_speeds({}));
  return range.skin(all.largest[RebuildInputs::speed], all.mean_of_speeds({}));
}

TEST(VerletSkin, GrowsWithTheSpeedUpToFiveTimesTheLeast) {
  Simulation const sim(two_of_a_hundred_fly(0.02, 1), {}, 2 * h);
  EXPECT_DOUBLE_EQ(give_skins(sim, {}, {h, 5 * h}), 5 * h);
  double const mean = (0.02 + 1) / 100;
  EXPECT_EQ(skin_of(sim, 0), h);
  EXPECT_NEAR(skin_of(sim, 10) / h, 1 + 0.2 * 0.02 / mean, 1e-12);
  EXPECT_DOUBLE_EQ(skin_of(sim, 20), 5 * h);
}

TEST(VerletSkin, IsThatOfTheMotionBesideTheBox) {
  AffineFrame frame;
  frame.centre_x = 0.3;
  frame.centre_y = -0.2;
  frame.gradient = {0.5, 0.9, -0.75};
  frame.drift_x = 2;
  frame.drift_y = -1;
  Specimen s = two_of_a_hundred_fly(0.02, 1);
  for (std::size_t i = 0; i < s.size(); ++i) {
    s.vx[i] += frame.velocity_x(s.x[i], s.y[i]);
    s.vy[i] += frame.velocity_y(s.y[i]);
  }
  Simulation const moved(s, {}, 2 * h), still(two_of_a_hundred_fly(0.02, 1), {}, 2 * h);
  give_skins(moved, frame, {h, 5 * h});
  give_skins(still, {}, {h, 5 * h});
  for (int id : {0, 10, 20, 99}) EXPECT_NEAR(skin_of(moved, id) / skin_of(still, id), 1, 1e-11) << id;
}

TEST(VerletSkin, IsTheSameForAllAtRest) {
  Simulation const sim(two_of_a_hundred_fly(0, 0), {}, 2 * h);
  EXPECT_EQ(give_skins(sim, {}, {h, 5 * h}), h);
  for (int id : {0, 10, 99}) EXPECT_EQ(skin_of(sim, id), h);
}

TEST(VerletSkin, OneDiscThatFliesSeldomCallsForASearch) {
  Specimen s = disordered_patch(10, 10);
  double const way = 10 * grain_d50, top = *std::max_element(s.y.begin(), s.y.end());
  add_disc(s, s.x[0], top + 4 * grain_d50, grain_radius, 1, 0);
  s.right = 1;
  s.top = 1;
  Simulation sim(s, {}, 2 * h);
  sim.time_step = 1e-6;
  std::int64_t const before = sim.assembly().upkeep.searches();
  auto const steps = static_cast<int>(way / sim.time_step);
  sim.step(steps);
  // Without a skin of its own it would be one for each h of the way.
  EXPECT_LE(sim.assembly().upkeep.searches() - before, way / (4.5 * h) + 3);
  EXPECT_GE(sim.assembly().upkeep.searches() - before, way / (5.5 * h) - 3);
}

bool in_row(HostRows const& rows, int i, int j) {
  for (int k = 0; k < rows.length(i); ++k) {
    if (rows.neighbour(rows.entry(i, k)) == j) return true;
  }
  return false;
}

template <class Visit>
void for_each_pair(HostDiscs const& p, Visit const& visit) {
  for (int i = 0; i < p.owned; ++i) {
    for (int j = 0; j < p.owned; ++j) {
      if (i != j) visit(i, j, std::hypot(p.x(i) - p.x(j), p.y(i) - p.y(j)) - p.radius(i) - p.radius(j));
    }
  }
}

TEST(VerletSkin, RowsReachAsFarAsBothSkinsTogether) {
  Simulation const sim(gas(), {}, 2 * h);
  HostDiscs const discs(sim.assembly().particles);
  HostRows const rows(sim.assembly().rows);
  int listed = 0;
  for_each_pair(discs, [&](int i, int j, double gap) {
    bool const near = gap < discs.verlet_skin(i) + discs.verlet_skin(j);
    listed += near ? 1 : 0;
    EXPECT_EQ(in_row(rows, i, j), near) << i << " and " << j;
  });
  EXPECT_GT(listed, 30);
}

TEST(VerletSkin, RowsHoldEveryPairInTouchHoweverDiscsFly) {
  Simulation sim(gas(), {}, 2 * h);
  sim.time_step = 0.3 * sim.assembly().stable_time_step();
  sim.loading().x = AxisDrive::at_rate(500);
  sim.loading().y = AxisDrive::at_rate(-300);
  int touching = 0, missing = 0;
  for (int n = 0; n < 4000; ++n) {
    sim.step();
    HostRows const rows(sim.assembly().rows);
    for_each_pair(HostDiscs(sim.assembly().particles), [&](int i, int j, double gap) {
      if (gap >= 0) return;
      ++touching;
      if (!in_row(rows, i, j)) ++missing;
    });
  }
  EXPECT_EQ(missing, 0);
  EXPECT_GT(touching, 3000);
  EXPECT_GT(sim.assembly().upkeep.searches(), 20);
}

// The first checkpoints have no column of skins.
TEST(VerletSkin, LeavesASmallPeriodicCellWideEnough) {
  Specimen s = disordered_patch(5, 5, 0.1);
  s.periodic = true;
  s.vx[5] = 3;  // all others are at rest
  Simulation sim(s, {}, 0.4 * grain_d50);
  double const side = std::min(sim.assembly().now.cell.width(), sim.assembly().now.cell.height()), largest = 1.1 * grain_radius;
  EXPECT_LT(skin_of(sim, 5), 5 * 0.2 * grain_d50);
  EXPECT_GT(skin_of(sim, 5), 0.2 * grain_d50);
  EXPECT_LE(2 * (2 * largest + 2 * skin_of(sim, 5)), side);
}

/// The homogeneous motion of a box whose walls stood at `before`.
AffineFrame motion_since(Walls const& before, Walls const& now) {
  AffineFrame frame;
  frame.reference_centre_x = 0.5 * (before.position[left] + before.position[right]);
  frame.reference_centre_y = 0.5 * (before.position[bottom] + before.position[top]);
  frame.centre_x = 0.5 * (now.position[left] + now.position[right]);
  frame.centre_y = 0.5 * (now.position[bottom] + now.position[top]);
  frame.stretch = {now.width() / before.width(), 0, now.height() / before.height()};
  return frame;
}

/// The greatest non-affine displacement of a disc as a share of its skin.
double greatest_displacement(HostDiscs const& p, AffineFrame const& f) {
  double greatest = 0;
  for (int i = 0; i < p.owned; ++i) {
    double const x = f.centre_x + f.stretch.xx * (p.reference_x(i) - f.reference_centre_x);
    double const y = f.centre_y + f.stretch.yy * (p.reference_y(i) - f.reference_centre_y);
    greatest = std::max(greatest, std::hypot(p.x(i) - x, p.y(i) - y) / p.verlet_skin(i));
  }
  return greatest;
}

/// Steps, and expects that no non-affine displacement ever exceeds its skin, and that some disc comes near it.
void expect_searches_in_time(Simulation& sim, int steps) {
  Walls at_search = sim.assembly().walls();
  std::int64_t const before = sim.assembly().upkeep.searches();
  double largest = 0;
  for (int n = 0; n < steps; ++n) {
    std::int64_t const searches = sim.assembly().upkeep.searches();
    sim.step();
    if (sim.assembly().upkeep.searches() > searches) at_search = sim.assembly().walls();
    AffineFrame const motion = motion_since(at_search, sim.assembly().walls());
    double const displacement = greatest_displacement(HostDiscs(sim.assembly().particles), motion);
    EXPECT_NEAR(std::sqrt(largest_nonaffine_displacement2(sim.assembly().particles, sim.assembly().particles.reference_x,
                                                          sim.assembly().particles.reference_y, motion)),
                displacement, 1e-9);
    EXPECT_LT(displacement, 1) << n;
    largest = std::max(largest, displacement);
  }
  EXPECT_GT(largest, 0.8);
  EXPECT_GE(sim.assembly().upkeep.searches() - before, 3);
}

TEST(VerletSkin, SearchesComeInTimeForDiscsThatFly) {
  Specimen s = two_of_a_hundred_fly(0.3, -0.2);
  s.left = s.bottom = -1;
  s.right = s.top = 3;
  Simulation sim(s, {}, 2 * h);
  sim.time_step = 2e-7;
  expect_searches_in_time(sim, 8000);
}

TEST(VerletSkin, SearchesComeInTimeForDiscsThatAnArrivingWallLeavesBehind) {
  Specimen s = two_of_a_hundred_fly(0, 0);
  s.left = s.bottom = -1;
  s.right = s.top = 3;
  Simulation sim(s, {}, 2 * h);
  sim.time_step = 2e-7;
  sim.loading().y = AxisDrive::at_rate(0.05);
  expect_searches_in_time(sim, 8000);
}

/// A flying disc has a wider skin, but around a large one of a wide curve not so many small ones that its row overflows.
TEST(VerletSkin, OfAWideCurveLeavesARowRoomForAllNeighbours) {
  double const small = 0.05e-3, large = 21 * small;
  NeighbourListUpkeep const upkeep(small);
  SkinRange const wide = upkeep.skins({}, small, large, true), common = upkeep.skins({}, small, 2.4 * small, true);
  EXPECT_EQ(common.most, 5 * common.least);
  EXPECT_LT(wide.most, 5 * wide.least);
  EXPECT_GE(wide.most, wide.least);
  EXPECT_NEAR(most_neighbours(Grading({2 * small, 2 * large}, {0, 1}), 2 * wide.most), longest_row, 1e-6);
}

}  // namespace
}  // namespace clathra
