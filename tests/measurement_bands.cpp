/// A band fitted to a field of shear strain, against planted ones.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "domain/measurement/shear_band.hpp"
#include "domain/measurement/strain_field.hpp"
#include "draw.hpp"

namespace clathra {
namespace {

constexpr double d50 = 1e-3, degree = std::numbers::pi / 180, shear = 0.3;

/// Equal discs on a shaken lattice 70 by 140, displaced along a straight band: linearly across it, rigidly beside it.
Snapshot planted(double inclination, double thickness, double noise) {
  Draw draw(7);
  Snapshot s;
  double const nx = -std::sin(inclination), ny = std::cos(inclination);  // of the band's normal
  for (int row = 0; row < 140; ++row)
    for (int column = 0; column < 70; ++column) {
      double const x = (column - 35 + draw.between(-0.3, 0.3)) * d50, y = (row - 70 + draw.between(-0.3, 0.3)) * d50;
      double const along = shear * std::clamp(nx * x + ny * y, -thickness / 2, thickness / 2);
      double const ux = along * ny + draw.between(-noise, noise), uy = -along * nx + draw.between(-noise, noise);
      s.id.push_back(static_cast<int>(s.id.size()));
      s.x.push_back(x + ux), s.y.push_back(y + uy);
      s.ux.push_back(static_cast<float>(ux)), s.uy.push_back(static_cast<float>(uy));
      s.radius.push_back(static_cast<float>(d50 / 2));
    }
  s.d50 = d50;
  return s;
}

/// Of the places where the discs were, where the band is as it was planted.
std::optional<BandProfile> fitted(Snapshot const& s) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < s.x.size(); ++i) x.push_back(s.x[i] - double(s.ux[i])), y.push_back(s.y[i] - double(s.uy[i]));
  return fit_band(x, y, shear_strain(s), d50, strain_window * d50);
}

TEST(BandFit, FindsInclinationAndThicknessOfAPlantedBand) {
  for (double const inclination : {35.0, 50.0, 63.0, 120.0})
    for (double const thickness : {6.0, 10.0, 16.0})
      for (double const noise : {0.0, 0.05 * d50}) {
        auto const band = fitted(planted(inclination * degree, thickness * d50, noise));
        ASSERT_TRUE(band);
        EXPECT_NEAR(band->inclination / degree, inclination, 1) << thickness << " " << noise;
        EXPECT_NEAR(band->thickness / d50, thickness, 1) << inclination << " " << noise;
        EXPECT_NEAR(band->position / d50, 0, 1);
        EXPECT_NEAR(band->inside, 2 * std::asinh(shear / 2), 0.06);
        EXPECT_NEAR(band->outside, 0, noise > 0 ? 0.06 : 0.02);
        EXPECT_GT(band->explained, 0.5);
      }
}

TEST(BandFit, AThickerBandHasAWiderGaussian) {
  double last = 0;
  for (double const thickness : {6.0, 10.0, 16.0}) {
    double const deviation = fitted(planted(55 * degree, thickness * d50, 0.02 * d50))->gaussian_deviation / d50;
    EXPECT_GT(deviation, last + 0.5);
    EXPECT_LT(deviation, thickness / 2);
    last = deviation;
  }
}

TEST(BandFit, SaysHowLittleItExplainsWhereThereIsNoBand) {
  auto const band = fitted(planted(0, 1, 0.05 * d50));  // sheared all over
  if (band) EXPECT_LT(band->explained, 0.15);
  std::vector<double> const few(49, 1.0);
  EXPECT_FALSE(fit_band(few, few, std::vector<float>(49, 0.1F), d50, 5 * d50));
  std::vector<double> line;
  for (int i = 0; i < 1000; ++i) line.push_back(i * d50);
  EXPECT_FALSE(fit_band(line, line, std::vector<float>(1000, 0.1F), d50, 5 * d50)) << "the same strain everywhere";
}

}  // namespace
}  // namespace clathra
