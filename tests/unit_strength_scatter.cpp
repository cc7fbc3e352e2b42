/// Strength that differs from bond to bond.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "domain/scene/hydrate.hpp"
#include "kernels/bond_law.hpp"

namespace clathra {
namespace {

StrengthScatter scatter_with(double modulus, std::uint64_t seed = 1) {
  Scene scene;
  scene.bond.strength_modulus = modulus;
  scene.bond.strength_seed = seed;
  return make_bond_law(scene, 0.17e-3, 1e-5).scatter;
}

/// Of the pairs of neighbours in a chain and next ones: ids that are near each other, as they are in a specimen.
std::vector<double> shares_of(StrengthScatter const& scatter) {
  std::vector<double> shares;
  for (int id = 0; id < 50'000; ++id)
    for (int further = 1; further <= 2; ++further) shares.push_back(scatter.share(id, id + further));
  std::sort(shares.begin(), shares.end());
  return shares;
}

TEST(StrengthScatter, IsAWeibullDistributionOfMeanOne) {
  for (double const modulus : {1.0, 3.0, 10.0, 100.0}) {
    std::vector<double> const shares = shares_of(scatter_with(modulus));
    double const n = static_cast<double>(shares.size()), scale = 1 / std::tgamma(1 + 1 / modulus),
                 deviation = std::sqrt(scale * scale * std::tgamma(1 + 2 / modulus) - 1);
    double mean = 0, furthest = 0;
    for (std::size_t k = 0; k < shares.size(); ++k) {
      mean += shares[k] / n;
      double const below = 1 - std::exp(-std::pow(shares[k] / scale, modulus));
      if (below > 1.1e-3) furthest = std::max(furthest, std::abs(below - (static_cast<double>(k) + 0.5) / n));
    }
    EXPECT_NEAR(mean, 1, 4 * deviation / std::sqrt(n)) << modulus;
    EXPECT_LT(furthest, 1.95 / std::sqrt(n)) << modulus << ": Kolmogorov and Smirnov, 0.1 %";
    EXPECT_NEAR(shares.front(), scale * std::pow(-std::log(1 - 1e-3), 1 / modulus), 1e-12) << "the weakest thousandth";
    EXPECT_NEAR(static_cast<double>(std::count(shares.begin(), shares.end(), shares.front())), 1e-3 * n, 4 * std::sqrt(1e-3 * n));
  }
}

TEST(StrengthScatter, BelongsToThePairAndTheSeed) {
  StrengthScatter const one = scatter_with(5, 1), other = scatter_with(5, 2);
  EXPECT_EQ(one.share(3, 8), one.share(8, 3));
  EXPECT_NE(one.share(3, 8), one.share(3, 9));
  EXPECT_NE(one.share(3, 8), one.share(4, 8));
  EXPECT_NE(one.share(3, 8), other.share(3, 8));
  double product = 0;
  constexpr int pairs = 20'000;
  for (int id = 0; id < pairs; ++id) product += (one.share(id, id + 1) - 1) * (other.share(id, id + 1) - 1);
  EXPECT_NEAR(product / pairs, 0, 4 * 0.0525 / std::sqrt(pairs)) << "seeds are independent: 0.0525 is the variance at m = 5";
}

TEST(StrengthScatter, HasALowerBoundWithoutLogarithms) {
  StrengthScatter const scatter = scatter_with(5);
  for (int n = 1; n < 1000; ++n) {
    double const part = 1e-3 * n;
    EXPECT_LE(scatter.lower_bound(part), scatter.quantile(part)) << part;
    EXPECT_GE(scatter.lower_bound(part), 0.6 * scatter.quantile(part)) << part;
  }
}

TEST(StrengthScatter, IsAbsentUnlessItIsAskedFor) {
  BondLaw const law = make_bond_law(Scene(), 0.17e-3, 1e-5);
  EXPECT_FALSE(law.scatter.is_on());
  EXPECT_EQ(weakest(law).strength.tensile_stress, law.strength.tensile_stress);
  Scene scene;
  scene.bond.strength_modulus = 4;
  BondLaw const scattered = make_bond_law(scene, 0.17e-3, 1e-5);
  EXPECT_EQ(weakest(scattered).strength.tensile_stress, scattered.scatter.least * law.strength.tensile_stress);
}

}  // namespace
}  // namespace clathra
