#include <gtest/gtest.h>

#include "domain/generation/random.hpp"
#include "domain/parallel/near_pairs.hpp"

namespace clathra {
namespace {

/// Discs of a ratio of sizes of 50 anywhere in a square, by falling ids.
Specimen scattered(std::size_t discs) {
  Specimen s;
  for (std::size_t i = 0; i < discs; ++i) {
    s.id.push_back(static_cast<int>(discs - 1 - i));
    s.x.push_back(uniform_random(1, 0, 3 * i) - 0.5);
    s.y.push_back(uniform_random(1, 0, 3 * i + 1) - 0.5);
    double const u = uniform_random(1, 0, 3 * i + 2);
    s.radius.push_back(i % 20 == 0 ? 0.05 : 0.001 * (1 + 9 * u * u));
  }
  return s;
}

std::vector<std::pair<int, int>> one_by_one(Specimen const& s, std::size_t own, double reach) {
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t a = 0; a < own; ++a) {
    for (std::size_t b = 0; b < s.size(); ++b) {
      double const dx = s.x[b] - s.x[a], dy = s.y[b] - s.y[a];
      bool const near = std::sqrt(dx * dx + dy * dy) - (s.radius[a] + s.radius[b]) < reach;
      if (s.id[a] < s.id[b] && near) pairs.emplace_back(s.id[a], s.id[b]);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(NearPairs, AreThoseOfAllPairsForAnyReachAndAnySizes) {
  Specimen const s = scattered(1000);
  for (double const reach : {-0.001, 0.0, 0.002, 0.1}) {
    for (std::size_t const own : {s.size(), s.size() / 3}) {
      std::vector<std::pair<int, int>> found;
      for (NearPair const& p : near_pairs(s, own, reach)) found.emplace_back(s.id[p.a], s.id[p.b]);
      EXPECT_EQ(found, one_by_one(s, own, reach)) << "reach " << reach << ", " << own << " of " << s.size() << " particles";
    }
  }
}

TEST(NearPairs, OfNoDiscsThereAreNone) { EXPECT_TRUE(near_pairs(Specimen{}, 0, 1).empty()); }

}  // namespace
}  // namespace clathra
