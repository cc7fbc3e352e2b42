#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "domain/hydrate.hpp"

namespace clathra {
namespace {

constexpr double d50 = 0.1694e-3;

/// Scene of the property tables: equal discs, printed coefficients.
Scene table_scene(double saturation) {
  Scene scene;
  scene.hydrate.saturation = saturation;
  scene.bond.coefficients = CoefficientSource::printed;
  return scene;
}

struct Printed {
  double value;
  int digits;  ///< significant digits it is printed with
};

void expect_printed(double computed, Printed printed) {
  double const last = std::pow(10, std::floor(std::log10(std::fabs(printed.value))) - printed.digits + 1);
  EXPECT_NEAR(computed, printed.value, 0.5001 * last);
}

TEST(HydrateStrength, FollowsTheGoldenTableOfTemperaturePressureAndDensity) {
  struct Row {
    double temperature, pressure, density, compression, tension, modulus;
  };
  Row const rows[] = {{5, 8e6, 900, 8.570, 4.755, 289.0},  {1, 8e6, 900, 9.410, 5.220, 289.8},
                      {10, 8e6, 900, 7.520, 4.174, 288.0}, {5, 5e6, 900, 6.140, 3.405, 280.0},
                      {5, 13e6, 900, 12.62, 7.005, 304.0}, {5, 8e6, 840, 7.454, 4.138, 259.0},
                      {5, 8e6, 720, 5.222, 2.905, 199.0},  {-30, 8e6, 840, 14.81, 8.204, 266.0}};
  for (Row const& row : rows) {
    HydrateStrength const strength = hydrate_strength(row.temperature, row.pressure, row.density);
    expect_printed(strength.compression * 1e-6, {row.compression, 4});
    expect_printed(strength.tension * 1e-6, {row.tension, 4});
    expect_printed(strength.modulus * 1e-6, {row.modulus, 4});
  }
  HydrateStrength const base = hydrate_strength(5, 8e6, 900);
  expect_printed(base.compression * 1e-6, {8.57009, 6});
  expect_printed(base.tension * 1e-6, {4.75494, 6});
  expect_printed(base.modulus * 1e-6, {289.001, 6});
}

TEST(HydrateStrength, VanishesWhereTheTrapTableSays) {
  EXPECT_NEAR(hydrate_strength(5, 8e6, 439.2).compression, 0, 1e4);
  EXPECT_NEAR(hydrate_strength(5, 8e6, 437.3).tension, 0, 1e4);
  EXPECT_NEAR(hydrate_strength(45.79, 8e6, 900).compression, 0, 2e3);
  EXPECT_NEAR(hydrate_strength(45.94, 8e6, 900).tension, 0, 2e3);
  EXPECT_NEAR(hydrate_strength(5, 8e6, 322.0).modulus, 0, 5e4);
}

TEST(CriticalThickness, FollowsEquation3OnItsThreeBranches) {
  struct Row {
    double percent;
    Printed ratio;
  };
  Row const rows[] = {{25, {0.02005, 4}}, {25.7, {0.02231, 4}}, {26, {0.02326, 4}}, {30, {0.03546, 4}},   {40.7, {0.06294, 4}},
                      {41, {0.06360, 4}}, {50, {0.08075, 4}},   {55, {0.08799, 4}}, {55.1, {0.08812, 4}}, {60, {0.09359, 4}},
                      {68, {0.09916, 4}}, {70, {0.09990, 4}},   {71, {0.1, 4}},     {100, {0.1, 4}}};
  for (Row const& row : rows) expect_printed(critical_thickness_ratio(row.percent / 100), row.ratio);
  expect_printed(critical_thickness_ratio(0.55) * d50 * 1e6, {14.91, 4});
  EXPECT_EQ(critical_thickness_ratio(0), 0);
  EXPECT_EQ(critical_thickness_ratio(0.1999), 0);
}

TEST(CriticalThickness, JumpsJustAbove20PercentAndJustAbove70Percent) {
  EXPECT_EQ(critical_thickness_ratio(0.2), 0);
  EXPECT_NEAR(critical_thickness_ratio(std::nextafter(0.2, 1.0)), 3.008e-3, 1e-12);
  EXPECT_NEAR(critical_thickness_ratio(0.7), 0.099898, 1e-12);
  EXPECT_EQ(critical_thickness_ratio(std::nextafter(0.7, 1.0)), 0.1);
}

TEST(CriticalThickness, RefusesASaturationInPercent) {
  try {
    critical_thickness_ratio(26);
    FAIL() << "26 was taken as a saturation";
  } catch (std::invalid_argument const& problem) {
    EXPECT_NE(std::string(problem.what()).find("percent"), std::string::npos);
  }
  EXPECT_THROW(critical_thickness_ratio(-0.01), std::invalid_argument);
  EXPECT_THROW(critical_thickness_ratio(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

TEST(Stability, HydrateDissociatesAboveThePhaseBoundaryOfSeaWater) {
  EXPECT_NEAR(stability_temperature(8e6), 9.78, 0.005);
  EXPECT_NEAR(stability_temperature(13e6), 14.64, 0.005);
  EXPECT_NEAR(stability_temperature(4.880e6), 5.0, 0.005);
  EXPECT_NEAR(stability_temperature(9.857e6), 285 - 273.15, 0.005);
  EXPECT_LT(stability_temperature(0), -273);
}

TEST(Stability, TheGateNamesTheStateAndOpensOnlyForItself) {
  HydrateScene hydrate;
  EXPECT_EQ(hydrate_problem(hydrate), "");
  hydrate.temperature = 12;
  EXPECT_NE(hydrate_problem(hydrate).find("9.78"), std::string::npos);
  hydrate.allow_unstable = true;
  EXPECT_EQ(hydrate_problem(hydrate), "");
  hydrate.temperature = 46;
  EXPECT_NE(hydrate_problem(hydrate).find("strength"), std::string::npos);
  hydrate.temperature = 5;
  hydrate.density = 400;
  EXPECT_NE(hydrate_problem(hydrate).find("strength"), std::string::npos);
}

TEST(BondCard, FollowsThePropertyTable) {
  struct Row {
    double saturation, part;  ///< gap / h_max
    double h, B, h0, R_t, R_c, k_mh, k_bn, k_bs, k_bm, area;
  };
  Row const rows[] = {{0.26, 0, 0, 36.326, 1.9703, 355.99, 3441.9, 5.3281e9, 1.4589e8, 9.7262e7, 0.58590, 47.491},
                      {0.26, .25, 0.9852, 31.505, 2.4629, 287.75, 3313.9, 3.6969e9, 1.4415e8, 9.6101e7, 0.30579, 61.966},
                      {0.26, .75, 2.955, 18.243, 3.4481, 99.820, 2964.7, 1.5290e9, 1.3660e8, 9.1066e7, 0.042405, 59.900},
                      {0.41, 0, 0, 59.450, 5.3873, 684.59, 4036.5, 3.1892e9, 1.4326e8, 9.5508e7, 0.93931, 210.72},
                      {0.41, .50, 5.387, 42.381, 8.0809, 443.48, 3575.1, 1.5157e9, 1.3649e8, 9.0995e7, 0.22687, 303.93},
                      {0.55, 0, 0, 69.482, 7.4526, 827.13, 4294.4, 2.6944e9, 1.4209e8, 9.4726e7, 1.0840, 338.90},
                      {0.55, .25, 3.726, 60.518, 9.3157, 700.76, 4048.3, 1.8774e9, 1.3890e8, 9.2602e7, 0.57300, 447.95},
                      {0.55, .75, 11.18, 35.335, 13.042, 344.90, 3369.7, 7.8300e8, 1.2588e8, 8.3923e7, 0.081470, 438.70}};
  for (Row const& row : rows) {
    Scene const scene = table_scene(row.saturation);
    double const gap = row.part * critical_thickness_ratio(row.saturation) * d50;
    BondCard const card = evaluate_bond(scene, d50, d50 / 2, d50 / 2, gap, 0);
    EXPECT_TRUE(card.bonded);
    if (row.h > 0) expect_printed(card.gap * 1e6, {row.h, 4});
    expect_printed(card.B * 1e6, {row.B, 5});
    expect_printed(card.h0 * 1e6, {row.h0, 5});
    expect_printed(card.R_t, {row.R_t, 5});
    expect_printed(card.R_c, {row.R_c, 5});
    double const rounded = 2.89e8 / card.E_m;  // the table is computed with E_m as printed; Eq. 18 gives 2.7e-6 more
    expect_printed(card.k_mh * rounded, {row.k_mh, 5});
    expect_printed(card.k_bn, {row.k_bn, 5});
    expect_printed(card.k_bs, {row.k_bs, 5});
    expect_printed(card.k_bm * rounded, {row.k_bm, 5});
    expect_printed(card.area * 1e12, {row.area, 5});
  }
}

TEST(BondCard, AtTheCriticalThicknessThereIsNoBond) {
  for (double const saturation : {0.26, 0.41, 0.55}) {
    double const h_max = critical_thickness_ratio(saturation) * d50;
    BondCard const card = evaluate_bond(table_scene(saturation), d50, d50 / 2, d50 / 2, h_max, 0);
    EXPECT_FALSE(card.bonded);
    EXPECT_EQ(card.B, 0);
    EXPECT_EQ(card.k_bn, 0);
    EXPECT_LT(card.R_t, -150);
  }
}

TEST(BondCard, BondsWithoutTensileStrengthAreNotFormed) {
  // The gaps of the trap table where R_t vanishes.
  for (auto const& [saturation, gap] : {std::pair{0.26, 3.5695e-6}, {0.41, 10.4119e-6}, {0.55, 14.5476e-6}}) {
    EXPECT_TRUE(evaluate_bond(table_scene(saturation), d50, d50 / 2, d50 / 2, gap - 1e-9, 0).bonded);
    EXPECT_FALSE(evaluate_bond(table_scene(saturation), d50, d50 / 2, d50 / 2, gap + 1e-9, 0).bonded);
  }
  // The smallest disc that can be bonded, at a gap of 0.
  EXPECT_FALSE(evaluate_bond(table_scene(0.26), d50, 9.04e-6, 9.04e-6, 0, 0).bonded);
  EXPECT_TRUE(evaluate_bond(table_scene(0.26), d50, 9.06e-6, 9.06e-6, 0, 0).bonded);
}

TEST(BondCard, AnOverlapCountsAsAGapOfZeroAndSaturationUpTo20PercentBindsNothing) {
  BondCard const overlap = evaluate_bond(table_scene(0.41), d50, d50 / 2, d50 / 2, -1e-6, 0);
  EXPECT_EQ(overlap.gap, 0);
  expect_printed(overlap.B * 1e6, {59.450, 5});
  BondCard const none = evaluate_bond(table_scene(0.2), d50, d50 / 2, d50 / 2, 0, 0);
  EXPECT_FALSE(none.bonded);
  EXPECT_EQ(none.k_bm, 0);
}

TEST(BondLaw, TheMomentLengthFollowsTheScaleOfTheScene) {
  Scene scene = table_scene(0.55);
  auto const length_of = [&](MomentScale scale) {
    scene.bond.moment_scale = scale;
    return evaluate_bond(scene, d50, d50 / 2, d50 / 2, 0, 0).moment_length;
  };
  EXPECT_EQ(length_of(MomentScale::paper_si), 1);
  EXPECT_EQ(length_of(MomentScale::rod_mm), 1e-3);
  EXPECT_NEAR(length_of(MomentScale::similitude), 69.482e-6 / 14, 1e-9);
}

TEST(BondLaw, TheConstantThicknessLawGivesEveryGapTheSameBond) {
  Scene scene = table_scene(0.55);
  scene.bond.law = BondLawKind::constant_thickness;
  scene.bond.plate_thickness = 4e-6;
  BondCard const touching = evaluate_bond(scene, d50, d50 / 2, d50 / 2, 0, 0);
  BondCard const apart = evaluate_bond(scene, d50, d50 / 2, d50 / 2, 5e-6, 0);
  EXPECT_EQ(touching.gap, 4e-6);
  EXPECT_EQ(touching.h0, 4e-6);
  EXPECT_EQ(touching.B, apart.B);
  EXPECT_EQ(touching.R_t, apart.R_t);
  EXPECT_FALSE(evaluate_bond(scene, d50, d50 / 2, d50 / 2, 15e-6, 0).bonded);
}

TEST(BondLaw, TheQuickTestsShapeFactorsAreNeverAboveTheExactOnes) {
  for (double const h_max : {1e-6, 14.9e-6, 0.5e-3, 1.15e-3, 3e-3}) {
    BondLaw const law = make_bond_law(table_scene(0.55), h_max);
    for (int i = 0; i <= 100; ++i) {
      EXPECT_LE(law.least_shape_of_shear, shape_of_shear(h_max * i / 100));
      EXPECT_LE(law.least_shape_of_rolling, shape_of_rolling(h_max * i / 100));
    }
  }
}

}  // namespace
}  // namespace clathra
