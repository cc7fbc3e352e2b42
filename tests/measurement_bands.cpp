/// A band fitted to a field of shear strain, against planted ones.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "domain/measurement/shear_band.hpp"
#include "domain/measurement/strain_field.hpp"
#include "planted_band.hpp"

namespace clathra {
namespace {

constexpr double d50 = PlantedBand::d50, degree = std::numbers::pi / 180;

/// Of the places where the discs were, where the band is as it was planted.
std::optional<BandProfile> least_squares_band(Sheared const& s) {
  return fit_band(s.start.x, s.start.y, shear_strain(s.now), d50, smoothing_of_shear_strain(s.now));
}

std::optional<BandProfile> grain_band(Sheared const& s) {
  StrainGrid const grid = grain_strain(s.start, s.now);
  return fit_band(grid.x, grid.y, grid.shear, d50, grid.smoothing);
}

TEST(BandFit, FindsInclinationAndThicknessOfAPlantedBand) {
  for (double const inclination : {35.0, 50.0, 63.0, 120.0})
    for (double const thickness : {6.0, 10.0, 16.0})
      for (double const noise : {0.0, 0.05}) {
        PlantedBand const planted{inclination * degree, thickness * d50, noise * d50};
        auto const band = least_squares_band(planted.specimen());
        ASSERT_TRUE(band);
        EXPECT_NEAR(band->inclination / degree, inclination, 1) << thickness << " " << noise;
        EXPECT_NEAR(band->thickness / d50, thickness, 1) << inclination << " " << noise;
        EXPECT_NEAR(band->position / d50, 0, 1);
        EXPECT_NEAR(band->inside, 2 * std::asinh(planted.shear / 2), 0.06);
        EXPECT_NEAR(band->outside, 0, noise > 0 ? 0.06 : 0.02);
        EXPECT_GT(band->explained, 0.5);
      }
}

TEST(BandFit, FindsItInTheFieldOfSingleGrains) {
  for (double const inclination : {35.0, 50.0, 63.0, 120.0})
    for (double const thickness : {2.0, 3.0, 6.0, 10.0, 16.0})
      for (double const noise : {0.0, 0.05}) {
        PlantedBand const planted{inclination * degree, thickness * d50, noise * d50};
        auto const band = grain_band(planted.specimen());
        ASSERT_TRUE(band);
        EXPECT_NEAR(band->inclination / degree, inclination, 1) << thickness << " " << noise;
        EXPECT_NEAR(band->thickness / d50, thickness, 1) << inclination << " " << noise;
        EXPECT_NEAR(band->position / d50, 0, 1);
        EXPECT_NEAR(band->inside, planted.shear * std::sqrt(1 + planted.shear * planted.shear / 4), 0.03);
        EXPECT_NEAR(band->outside, 0, noise > 0 ? 0.06 : 1e-3);
        EXPECT_GT(band->explained, 0.5);
      }
}

TEST(BandFit, AThickerBandHasAWiderGaussian) {
  for (auto* const fitted : {&least_squares_band, &grain_band}) {
    double last = 0;
    for (double const thickness : {6.0, 10.0, 16.0}) {
      double const deviation = fitted(PlantedBand{55 * degree, thickness * d50, 0.02 * d50}.specimen())->gaussian_deviation / d50;
      EXPECT_GT(deviation, last + 0.5);
      EXPECT_LT(deviation, thickness / 2);
      last = deviation;
    }
  }
}

TEST(BandFit, SaysHowLittleItExplainsWhereThereIsNoBand) {
  auto const band = least_squares_band(PlantedBand{0, 1, 0.05 * d50}.specimen());  // sheared all over
  if (band) {
    EXPECT_LT(band->explained, 0.15);
  }
  std::vector<double> const few(49, 1.0);
  EXPECT_FALSE(fit_band(few, few, std::vector<float>(49, 0.1F), d50, 5 * d50));
  std::vector<double> line;
  for (int i = 0; i < 1000; ++i) line.push_back(i * d50);
  EXPECT_FALSE(fit_band(line, line, std::vector<float>(1000, 0.1F), d50, 5 * d50)) << "the same strain everywhere";
}

/// A fit whose inside is so many times its outside.
BandAt fit_at(double eps1, double inclination, double ratio, double outside = 0.04) {
  BandProfile band;
  band.inclination = inclination * degree, band.inside = ratio * outside, band.outside = outside;
  return {eps1, band};
}

TEST(BandOnset, IsWhereTheStrainInsideBecomesTwiceThatBesideIt) {
  // inside - 2 outside is -0.02, then 0.06: 0 at a quarter of the way
  std::vector<BandAt> const series{fit_at(0.01, 60, 1), fit_at(0.02, 60, 1.5), fit_at(0.04, 60, 3.5), fit_at(0.08, 60, 8)};
  ASSERT_TRUE(band_onset(series));
  EXPECT_NEAR(*band_onset(series), 0.025, 1e-12);
  for (double const onset : {0.021, 0.03, 0.0399}) {  // planted: inside = 2 outside + 3 (eps1 - onset)
    std::vector<BandAt> planted;
    for (double const eps1 : {0.005, 0.02, 0.04, 0.1}) planted.push_back(fit_at(eps1, 55, 2 + 3 * (eps1 - onset) / 0.04));
    EXPECT_NEAR(*band_onset(planted), onset, 1e-12);
  }
}

TEST(BandOnset, CountsFromWhereTheLastBandKeepsItsDirection) {
  std::vector<BandAt> series{fit_at(0.01, 120, 4), fit_at(0.02, 118, 4), fit_at(0.03, 62, 4), fit_at(0.04, 66, 3),
                             fit_at(0.05, 58, 4)};
  EXPECT_EQ(*band_onset(series), 0.03) << "another band before: no line to draw";
  series[3] = fit_at(0.04, 69, 3);
  EXPECT_EQ(*band_onset(series), 0.05) << "11 degrees off the last one";
  series[3] = fit_at(0.04, 60, 1);
  EXPECT_NEAR(*band_onset(series), 0.04 + 0.01 / 3, 1e-12) << "it faded in between";
  series[3] = {0.04, {}};
  EXPECT_EQ(*band_onset(series), 0.05);
  EXPECT_EQ(*band_onset({fit_at(0.01, 178, 4), fit_at(0.02, 3, 4)}), 0.01)
      << "lying bands: 5 degrees apart, across the horizontal";
}

TEST(BandOnset, IsNothingWithoutABandAtTheEnd) {
  EXPECT_FALSE(band_onset({}));
  EXPECT_FALSE(band_onset({{0.01, {}}, {0.02, {}}}));
  EXPECT_FALSE(band_onset({fit_at(0.01, 60, 3), fit_at(0.02, 60, 1.9)}));
  EXPECT_FALSE(band_onset({fit_at(0.01, 60, 3), {0.02, {}}}));
  EXPECT_FALSE(band_onset({fit_at(0.01, 60, 3, 0), fit_at(0.02, 60, 3, 0)})) << "no strain at all";
  EXPECT_EQ(*band_onset({fit_at(0.02, 60, 2)}), 0.02);
}

TEST(BandOnset, OfPlantedBandsIsWhereTheyOutgrowTheStrainBesideThem) {
  for (auto* const fitted : {&least_squares_band, &grain_band}) {
    std::vector<BandAt> series{{0, fitted(PlantedBand{60 * degree, 8 * d50, 0, 0}.specimen())}};
    for (double const shear : {0.1, 0.2, 0.4})
      series.push_back({shear, fitted(PlantedBand{60 * degree, 8 * d50, 0.05 * d50, shear}.specimen())});
    ASSERT_TRUE(band_onset(series));
    EXPECT_LE(*band_onset(series), 0.2);
  }
}

}  // namespace
}  // namespace clathra
