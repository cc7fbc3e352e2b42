/// Directions of contacts and forces, against planted ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "domain/measurement/fabric.hpp"
#include "draw.hpp"
#include "made_up_lattice.hpp"

namespace clathra {
namespace {

constexpr double half_turn = std::numbers::pi;

/// A pair of discs of its own, whose branch points in a direction [rad].
void add_pair(Snapshot& s, double direction, ContactState state = ContactState::contact, double gap = -1e-9) {
  auto const n = static_cast<int>(s.x.size());
  s.a.push_back(n), s.b.push_back(n + 1);
  s.x.insert(s.x.end(), {0.3 * n, 0.3 * n + 2.5 * std::cos(direction)});
  s.y.insert(s.y.end(), {-0.1 * n, -0.1 * n + 2.5 * std::sin(direction)});
  s.state.push_back(static_cast<std::uint8_t>(state)), s.gap.push_back(gap),
      s.normal_force.push_back(1 + 0.5 * std::cos(7 * direction));
}

/// The angle below which lies a share of the normals of density (1 + a cos 2 (theta - direction)) / pi.
double quantile(double share, double a, double direction) {
  double from = 0, to = pi;
  for (int k = 0; k < 60; ++k) {
    double const middle = (from + to) / 2;
    double const below = (middle + a / 2 * (std::sin(2 * (middle - direction)) + std::sin(2 * direction))) / pi;
    (below < share ? from : to) = middle;
  }
  return from;
}

Snapshot distributed(int pairs, double a, double direction) {
  Snapshot s;
  for (int n = 0; n < pairs; ++n) add_pair(s, quantile((n + 0.5) / pairs, a, direction));
  return s;
}

bool same_bits(Rose const& p, Rose const& q) {
  auto const numbers = [](Rose const& r) {
    std::vector<double> all{r.fabric.xx,        r.fabric.yy,        r.fabric.xy,       r.fabric.deviator,
                            r.fabric.direction, r.force_anisotropy, r.force_direction, double(r.pairs)};
    all.insert(all.end(), r.normals.begin(), r.normals.end());
    all.insert(all.end(), r.forces.begin(), r.forces.end());
    return all;
  };
  return numbers(p) == numbers(q);
}

TEST(Fabric, IsTheMeanOfNTimesNOverPlantedNormals) {
  Snapshot s;
  for (int k = 0; k < 3; ++k) add_pair(s, 0);
  add_pair(s, half_turn / 2);
  Fabric const upright = rose_of(s, ContactSet::touching).fabric;
  EXPECT_NEAR(upright.xx, 0.75, 1e-15);
  EXPECT_NEAR(upright.yy, 0.25, 1e-15);
  EXPECT_NEAR(upright.xy, 0, 1e-15);
  EXPECT_NEAR(upright.deviator, 0.5, 1e-15);
  EXPECT_NEAR(upright.direction, 0, 1e-12);
  EXPECT_NEAR(upright.anisotropy(), 1, 1e-15);
  Snapshot turned;
  add_pair(turned, half_turn / 6), add_pair(turned, half_turn / 6 + half_turn), add_pair(turned, 2 * half_turn / 3);
  Fabric const f = rose_of(turned, ContactSet::touching).fabric;  // (2 e e + f f) / 3, f across e
  EXPECT_NEAR(f.xx, (2 * 0.75 + 0.25) / 3, 1e-14);
  EXPECT_NEAR(f.yy, (2 * 0.25 + 0.75) / 3, 1e-14);
  EXPECT_NEAR(f.xy, std::sqrt(3.0) / 12, 1e-14);
  EXPECT_NEAR(f.xx + f.yy, 1, 1e-15);
  EXPECT_NEAR(f.deviator, 1.0 / 3, 1e-14);
  EXPECT_NEAR(f.direction, half_turn / 6, 1e-9);
}

/// Midpoints of a smooth function over its period: the sampling is exact to rounding, but where the density touches 0.
TEST(Fabric, HasTwiceItsDeviatorAsTheAnisotropyOfThePlantedDensity) {
  for (double const a : {0.05, 0.3, 0.6, 1.0})
    for (double const direction : {0.2, 1.0, 2.9}) {
      Fabric const fabric = rose_of(distributed(2000, a, direction), ContactSet::touching).fabric;
      EXPECT_NEAR(fabric.anisotropy(), a, a < 1 ? 1e-12 : 2e-5);
      EXPECT_NEAR(fabric.direction, direction, a < 1 ? 1e-12 : 1e-4);
      EXPECT_EQ(fabric.anisotropy(), 2 * fabric.deviator);
      EXPECT_NEAR(fabric.deviator, std::hypot(fabric.xx - fabric.yy, 2 * fabric.xy), 1e-14);
    }
}

TEST(Fabric, OfAllDirectionsAlikeHasNone) {
  Fabric const f = rose_of(distributed(3600, 0, 0), ContactSet::mechanical).fabric;
  EXPECT_NEAR(f.xx, 0.5, 1e-12);
  EXPECT_NEAR(f.deviator, 0, 1e-12);
  EXPECT_EQ(rose_of({}, ContactSet::touching).fabric.xx, 0);
}

TEST(ContactSets, TellTouchingFromBondedAcrossAGapFromBroken) {
  ContactState const broken = broken_in(BreakMode::shear);
  Snapshot s;
  add_pair(s, 0.1, ContactState::contact, -1e-9);
  add_pair(s, 0.2, ContactState::contact, -0.0);  // weak, rounded in a file
  add_pair(s, 0.3, ContactState::bonded, -1e-9);
  add_pair(s, 0.4, ContactState::bonded, -0.0);
  add_pair(s, 0.5, ContactState::bonded, 1e-9);
  add_pair(s, 0.6, broken, -1e-9);
  add_pair(s, 0.7, broken, -0.0);
  add_pair(s, 0.8, broken, 1e-9);
  add_pair(s, 0.9, broken, 0.0);
  add_pair(s, 1.0, ContactState::contact, 0.0);  // it would not be listed if it did not touch
  auto const members = [&](ContactSet set) {
    std::vector<std::size_t> of;
    for (std::size_t k = 0; k < s.a.size(); ++k)
      if (belongs(s, k, set)) of.push_back(k);
    EXPECT_EQ(rose_of(s, set).pairs, of.size());
    return of;
  };
  using Pairs = std::vector<std::size_t>;
  EXPECT_EQ(members(ContactSet::touching), (Pairs{0, 1, 2, 3, 5, 6, 9}));
  EXPECT_EQ(members(ContactSet::mechanical), (Pairs{0, 1, 2, 3, 4, 5, 6, 9}));
  EXPECT_EQ(members(ContactSet::bonded), (Pairs{2, 3, 4}));
}

TEST(Rose, HasTheSameBitsForAnyOrderAndForEitherDiscFirst) {
  Draw draw(3);
  Snapshot s;
  for (int k = 0; k < 3000; ++k) {
    add_pair(s, draw.between(-half_turn, half_turn));
    s.normal_force.back() = draw.of_size(1e-3, 1e6);
  }
  for (double const direction : {0.0, half_turn / 2, half_turn / 18}) add_pair(s, direction);  // between bins
  s.y[s.y.size() - 5] = s.y[s.y.size() - 6];
  Rose const first = rose_of(s, ContactSet::touching);
  EXPECT_NE(first.force_anisotropy, 0);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::vector<std::size_t> order(s.a.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    Snapshot t = s;
    for (std::size_t k = 0; k < order.size(); ++k) {
      t.a[k] = s.a[order[k]], t.b[k] = s.b[order[k]];
      t.normal_force[k] = s.normal_force[order[k]];
      if (draw.between(0, 1) < 0.5) std::swap(t.a[k], t.b[k]);
    }
    EXPECT_TRUE(same_bits(rose_of(t, ContactSet::touching), first)) << seed;
  }
}

TEST(Rose, LeavesOutPairsWithoutADirectionOrAForce) {
  Snapshot s;
  for (int k = 0; k < 4; ++k) add_pair(s, 1);
  s.x[1] = s.x[0], s.y[1] = s.y[0];
  s.x[2] = std::nan("");
  s.normal_force[2] = std::nan("");
  EXPECT_EQ(rose_of(s, ContactSet::touching).pairs, 1U);
}

TEST(Rose, CountsContactsAndForcesByDirection) {
  Snapshot s = made_up_lattice(30, 30);
  for (std::size_t k = 0; k < s.a.size(); ++k)
    if (s.b[k] != s.a[k] + 1) s.normal_force[k] = 3;  // upright
  Rose const rose = rose_of(s, ContactSet::mechanical);
  EXPECT_EQ(rose.pairs, s.a.size());
  EXPECT_NEAR(rose.normals[0], 9, 1e-9) << "half of the pairs in one of 18 bins";
  EXPECT_NEAR(rose.normals[9], 9, 1e-9);
  EXPECT_NEAR(rose.fabric.anisotropy(), 0, 1e-9);
  EXPECT_NEAR(rose.forces[0], 0.5, 1e-6);
  EXPECT_NEAR(rose.forces[9], 1.5, 1e-6);
  EXPECT_GT(rose.force_anisotropy, 0.5);
  EXPECT_NEAR(rose.force_direction, std::acos(-1.0) / 2, 0.1);
  s.state.assign(s.a.size(), static_cast<std::uint8_t>(broken_in(BreakMode::shear)));
  s.normal_force.assign(s.a.size(), 0.0), s.gap.assign(s.a.size(), 1e-9);
  EXPECT_EQ(rose_of(s, ContactSet::mechanical).pairs, 0u) << "bonds that are gone";
}

}  // namespace
}  // namespace clathra
