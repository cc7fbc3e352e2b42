/// Strength envelopes and shear bands, against planted ones.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "domain/measurement/paired_strength.hpp"
#include "domain/measurement/shear_band.hpp"
#include "domain/measurement/strength_fit.hpp"

namespace clathra {
namespace {

/// sigma_1 at failure by Mohr and Coulomb.
double failure_stress(double cohesion, double friction_angle, double sigma3) {
  double const n = (1 + std::sin(friction_angle)) / (1 - std::sin(friction_angle));
  return 2 * cohesion * std::sqrt(n) + n * sigma3;
}

TEST(Envelope, IsTheLeastSquaresLineAndKnowsWhenThereIsNone) {
  std::vector<FailureStress> tests;
  for (double const sigma3 : {0.5e6, 1e6, 2e6, 4e6}) tests.push_back({failure_stress(0.3e6, 0.5, sigma3), sigma3});
  auto const fit = fitted_envelope(tests);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->cohesion, 0.3e6, 1);
  EXPECT_NEAR(fit->friction_angle, 0.5, 1e-9);
  EXPECT_FALSE(fitted_envelope({{3e6, 1e6}, {3.1e6, 1e6}}));
  EXPECT_FALSE(fitted_envelope({{5e6, 1e6}, {3e6, 2e6}})) << "strength that falls with the stress";
}

/// A line through the points (1, 1), (2, 3), (3, 4) MPa: by hand a = -1/3, N = 3/2, residuals -1/6, 1/3, -1/6, s^2 = 1/6.
TEST(Envelope, HasTheErrorsOfTheLine) {
  auto const fit = fitted_envelope({{1e6, 1e6}, {3e6, 2e6}, {4e6, 3e6}});
  ASSERT_TRUE(fit && fit->errors);
  double const a = -1.0 / 3, n = 1.5, root = std::sqrt(n);
  EXPECT_NEAR(fit->cohesion / 1e6, a / (2 * root), 1e-12);
  EXPECT_NEAR(fit->friction_angle, std::asin(0.5 / 2.5), 1e-12);
  double const var_a = 7.0 / 18, cov = -1.0 / 6, var_n = 1.0 / 12;  // s^2 (X^T X)^-1
  double const dc_da = 1 / (2 * root), dc_dn = -a / (4 * n * root), dphi_dn = 1 / (root * (n + 1));
  double const var_c = dc_da * dc_da * var_a + 2 * dc_da * dc_dn * cov + dc_dn * dc_dn * var_n;
  EXPECT_NEAR(fit->errors->cohesion / 1e6, std::sqrt(var_c), 1e-12);
  EXPECT_NEAR(fit->errors->friction_angle, dphi_dn * std::sqrt(var_n), 1e-12);
  EXPECT_NEAR(fit->errors->covariance / 1e6, dphi_dn * (dc_da * cov + dc_dn * var_n), 1e-12);
  EXPECT_NEAR(fit->errors->r_squared, 1 - (1.0 / 6) / (14.0 / 3), 1e-12);
  EXPECT_FALSE(fitted_envelope({{3e6, 1e6}, {5e6, 2e6}})->errors) << "two tests have no scatter";
  EXPECT_NEAR(fit->curvature.value() * 1e6, -1, 1e-9) << "the parabola through them: slopes 2 and 1";
  EXPECT_FALSE(fitted_envelope({{3e6, 1e6}, {3.1e6, 1e6}, {5e6, 2e6}})->curvature) << "two stresses have none";
}

/// 2,000 sets of six tests about a known envelope: the spread of the fits is what their errors say.
TEST(Envelope, HasErrorsThatAreTheSpreadOfManyFits) {
  std::mt19937_64 generator(7);
  std::normal_distribution<double> scatter(0, 0.05e6);
  double of_c = 0, of_phi = 0, said_c = 0, said_phi = 0;
  constexpr int sets = 2000;
  for (int n = 0; n < sets; ++n) {
    std::vector<FailureStress> tests;
    for (double const sigma3 : {1e6, 1e6, 2e6, 2e6, 3e6, 3e6})
      tests.push_back({failure_stress(0.3e6, 0.5, sigma3) + scatter(generator), sigma3});
    auto const fit = fitted_envelope(tests);
    ASSERT_TRUE(fit && fit->errors);
    of_c += std::pow(fit->cohesion - 0.3e6, 2), of_phi += std::pow(fit->friction_angle - 0.5, 2);
    said_c += std::pow(fit->errors->cohesion, 2), said_phi += std::pow(fit->errors->friction_angle, 2);
  }
  EXPECT_NEAR(std::sqrt(said_c / of_c), 1, 0.05);
  EXPECT_NEAR(std::sqrt(said_phi / of_phi), 1, 0.05);
}

TEST(ShearBand, IsFoundWhereItWasPlanted) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> within(0, 1);
  std::vector<double> x, y;
  double const angle = 0.6, across = 0.55, width = 0.1;
  for (int n = 0; n < 4000; ++n) {
    bool const inside = n % 4 == 0;
    double px = within(generator), py = within(generator);
    if (inside) {
      double const along = within(generator) - 0.5, off = across + 0.9 * width * (within(generator) - 0.5);
      px = off * std::cos(angle) - along * std::sin(angle), py = off * std::sin(angle) + along * std::cos(angle);
    }
    x.push_back(px), y.push_back(py);
  }
  Band const band = best_band(x, y, width);
  EXPECT_NEAR(band.angle, angle, 0.03);
  EXPECT_NEAR((band.from + band.to) / 2, across, 0.02);
  EXPECT_LE(band.to - band.from, width);
  std::size_t held = 0;
  for (std::size_t i = 0; i < x.size(); ++i) held += band.holds(x[i], y[i]) ? 1 : 0;
  EXPECT_EQ(held, band.points);
  BandShares const shares = band_shares(x, y, width);
  EXPECT_EQ(shares.one, static_cast<double>(band.points) / 4000);
  EXPECT_GT(shares.one, 0.3);
  EXPECT_GT(shares.two, shares.one + 0.05);
  EXPECT_LT(shares.two, shares.one + 0.2) << "what is left fills the square evenly";
  EXPECT_EQ(band_shares({}, {}, width).two, 0);
}

/// A test of a seed whose envelope has this cohesion and friction angle.
SeedTest test_of(std::uint64_t seed, double sigma3, double cohesion, double angle) {
  double const n = (1 + std::sin(angle)) / (1 - std::sin(angle));
  return {seed, sigma3, {2 * cohesion * std::sqrt(n) + n * sigma3, sigma3}};
}

TEST(PairedStrength, IsTheMeanOfTheEnvelopesOfCompleteSeeds) {
  std::vector<SeedTest> tests;
  std::vector<double> cohesions, angles;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    double const cohesion = 1e6 + 1e5 * static_cast<double>(seed), angle = 0.4 + 0.01 * static_cast<double>(seed * seed);
    cohesions.push_back(cohesion), angles.push_back(angle);
    for (double const sigma3 : {1e6, 2e6, 3e6}) tests.push_back(test_of(seed, sigma3, cohesion, angle));
  }
  // Two tests of a fifth seed: its envelope is of other stresses, and far off.
  for (double const sigma3 : {1e6, 2e6}) tests.push_back(test_of(5, sigma3, 5e6, 0.8));
  PairedStrength const strength = paired_strength(tests);
  EXPECT_EQ(strength.seeds, (std::vector<std::uint64_t>{1, 2, 3, 4}));
  EXPECT_EQ(strength.incomplete, (std::vector<std::uint64_t>{5}));
  MeanInterval const c = mean_interval(cohesions), phi = mean_interval(angles);
  EXPECT_EQ(strength.cohesion->count, 4);
  EXPECT_NEAR(strength.envelope->cohesion, c.mean, 1);
  EXPECT_NEAR(*strength.cohesion->half_width, *c.half_width, 1);
  EXPECT_NEAR(strength.envelope->friction_angle, phi.mean, 1e-9);
  EXPECT_NEAR(*strength.friction_angle->half_width, *phi.half_width, 1e-9);
}

TEST(PairedStrength, OfOneSeedOrOfTestsWithoutPairsIsOneFitWithItsErrors) {
  std::vector<SeedTest> tests = {test_of(1, 1e6, 1e6, 0.5), test_of(1, 2e6, 1.1e6, 0.5), test_of(1, 3e6, 1e6, 0.5)};
  for (bool const paired : {true, false}) {
    PairedStrength const strength = paired_strength(tests);
    EXPECT_EQ(strength.seeds.size(), paired ? 1u : 0u);
    EXPECT_FALSE(strength.cohesion);
    ASSERT_TRUE(strength.envelope && strength.envelope->errors);
    EXPECT_GT(strength.envelope->errors->cohesion, 0);
    for (std::size_t i = 0; i < 3; ++i) tests[i].seed = 7 + i;
  }
  EXPECT_FALSE(paired_strength({}).envelope);
  EXPECT_FALSE(paired_strength({tests[0], tests[0]}).envelope) << "one confining stress";
}

}  // namespace
}  // namespace clathra
