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

}  // namespace
}  // namespace clathra
