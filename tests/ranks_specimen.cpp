/// What discs show of a specimen, on any number of ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "domain/measurement/specimen_facts.hpp"
#include "ranks_main.hpp"

namespace clathra {
namespace {

/// Discs of sizes up to 1 to 30 anywhere in a box, many of them in one another, some of them twice.
Specimen heap() {
  Specimen s;
  s.right = 0.02, s.top = 0.01;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(0, 1);
  for (int i = 0; i < 700; ++i) {
    s.id.push_back((i * 11 + 3) % 700);
    s.x.push_back(i % 50 == 9 ? s.x.back() : s.right * number(random));
    s.y.push_back(i % 50 == 9 ? s.y.back() : s.top * number(random));
    s.radius.push_back(i % 50 == 9 ? s.radius.back() : 1e-5 * std::pow(30, number(random)));
  }
  return s;
}

Specimen part_of(Specimen const& whole) {
  Specimen part = whole;
  part.id.clear(), part.x.clear(), part.y.clear(), part.radius.clear();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (static_cast<int>(i % static_cast<std::size_t>(world().count())) != world().rank()) continue;
    part.id.push_back(whole.id[i]), part.x.push_back(whole.x[i]), part.y.push_back(whole.y[i]);
    part.radius.push_back(whole.radius[i]);
  }
  return part;
}

void expect_same(OverlappingPair const& a, OverlappingPair const& b) {
  EXPECT_EQ(a.share, b.share);
  EXPECT_EQ(a.id_a, b.id_a);
  EXPECT_EQ(a.id_b, b.id_b);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
}

TEST(RanksSpecimen, OverlapsAreThoseOfAllPairs) {
  Specimen const whole = heap();
  SpecimenOverlaps wanted;
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (std::size_t k = 0; k < whole.size(); ++k) {
      if (whole.id[i] >= whole.id[k]) continue;
      double const dx = whole.x[k] - whole.x[i], dy = whole.y[k] - whole.y[i], branch = std::sqrt(dx * dx + dy * dy);
      double const overlap = whole.radius[i] + whole.radius[k] - branch;
      if (!(overlap > 0)) continue;
      OverlappingPair const pair{overlap / std::min(whole.radius[i], whole.radius[k]), whole.id[i], whole.id[k], whole.x[i],
                                 whole.y[i]};
      ++wanted.touching;
      wanted.deep += pair.share > deep_pair;
      wanted.through += pair.share > 1;
      wanted.stress += overlap * branch / (2 * whole.width() * whole.height());
      if (pair.share > wanted.deepest.share || (pair.share == wanted.deepest.share && pair.id_a < wanted.deepest.id_a))
        wanted.deepest = pair;
    }
  SpecimenOverlaps const found = overlaps_of(part_of(whole), world());
  EXPECT_GT(wanted.through, 14);
  EXPECT_EQ(found.touching, wanted.touching);
  EXPECT_EQ(found.deep, wanted.deep);
  EXPECT_EQ(found.through, wanted.through);
  EXPECT_NEAR(found.stress, wanted.stress, 1e-12 * wanted.stress);
  EXPECT_EQ(found.stress, overlaps_of(whole).stress);
  expect_same(found.deepest, wanted.deepest);
}

TEST(RanksSpecimen, TheOutlineIsThatOfTheWhole) {
  Specimen whole = heap();
  whole.x[20] = -0.001;
  whole.y[30] = whole.y[31] = whole.top + 0.002;
  SpecimenOutline const one = outline_of(whole), many = outline_of(part_of(whole), world());
  EXPECT_EQ(one.discs, 700);
  EXPECT_EQ(one.outside, 3);
  EXPECT_EQ(one.at_wall[0].id, whole.id[20]);
  EXPECT_EQ(one.at_wall[3].id, std::min(whole.id[30], whole.id[31]));
  EXPECT_EQ(one.farthest, 0.02);
  EXPECT_EQ(many.discs, one.discs);
  EXPECT_EQ(many.sizes.d50, one.sizes.d50);
  EXPECT_EQ(many.void_ratio, one.void_ratio);
  EXPECT_EQ(many.farthest, one.farthest);
  EXPECT_EQ(many.outside, one.outside);
  for (std::size_t wall = 0; wall < 4; ++wall) {
    EXPECT_EQ(many.at_wall[wall].id, one.at_wall[wall].id);
    EXPECT_EQ(many.at_wall[wall].depth, one.at_wall[wall].depth);
    EXPECT_EQ(many.at_wall[wall].space, one.at_wall[wall].space);
  }
}

}  // namespace
}  // namespace clathra
