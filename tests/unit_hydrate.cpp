#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "domain/scene/hydrate.hpp"
#include "domain/scene/phase_boundary.hpp"
#include "golden_bonds.hpp"
#include "kernels/bond_law.hpp"
#include "printed_number.hpp"

namespace clathra {
namespace {

constexpr double d50 = golden::d50;

/// Scene of the property tables: equal discs, printed coefficients.
Scene table_scene(double saturation) {
  Scene scene;
  scene.hydrate.saturation = saturation;
  scene.bond.strength_from = StrengthFrom::printed;
  scene.bond.grain_stiffness_factor = 1;
  return scene;
}

TEST(HydrateStrength, FollowsTheGoldenTableOfTemperaturePressureAndDensity) {
  struct Row {
    double temperature, pressure, density;
    char const *compression, *tension, *modulus;  // [MPa]
  };
  Row const rows[] = {{5, 8e6, 900, "8.57009", "4.75494", "289.001"}, {1, 8e6, 900, "9.410", "5.220", "289.8"},
                      {10, 8e6, 900, "7.520", "4.174", "288.0"},      {5, 5e6, 900, "6.140", "3.405", "280.0"},
                      {5, 13e6, 900, "12.62", "7.005", "304.0"},      {5, 8e6, 840, "7.454", "4.138", "259.0"},
                      {5, 8e6, 720, "5.222", "2.905", "199.0"},       {-30, 8e6, 840, "14.81", "8.204", "266.0"}};
  for (Row const& row : rows) {
    HydrateStrength const strength = hydrate_strength(row.temperature, row.pressure, row.density);
    EXPECT_TRUE(agrees(strength.compression * 1e-6, row.compression));
    EXPECT_TRUE(agrees(strength.tension * 1e-6, row.tension));
    EXPECT_TRUE(agrees(strength.modulus * 1e-6, row.modulus));
  }
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
    char const *ratio, *thickness;  // h_max [um] for the sand of the paper
  };
  Row const rows[] = {{20, "0", "0"},           {25, "0.02005", "3.396"},   {25.7, "0.02231", "3.779"}, {26, "0.02326", "3.941"},
                      {30, "0.03546", "6.007"}, {40.7, "0.06294", "10.66"}, {41, "0.06360", "10.77"},   {50, "0.08075", "13.68"},
                      {55, "0.08799", "14.91"}, {55.1, "0.08812", "14.93"}, {60, "0.09359", "15.85"},   {68, "0.09916", "16.80"},
                      {70, "0.09990", "16.92"}, {71, "0.1", "16.94"},       {100, "0.1", "16.94"}};
  for (Row const& row : rows) {
    EXPECT_TRUE(agrees(critical_thickness_ratio(row.percent / 100), row.ratio)) << row.percent;
    EXPECT_TRUE(agrees(critical_thickness_ratio(row.percent / 100) * d50 * 1e6, row.thickness)) << row.percent;
  }
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

/// Tishchenko et al. (2005) at 285 K in sea water, to six digits: the sums cancel to ten. Moridis (2003) fitted fresh water anew.
TEST(Stability, ThePhaseBoundaryIsThatOfTishchenko) {
  EXPECT_NEAR(equilibrium_pressure(285 - 273.15, 35), 10.468152e6, 5);
  double const temperatures[] = {2, 5, 8, 10, 15, 20};
  double const fresh[] = {3.178, 4.275, 5.841, 7.250, 12.78, 23.34}, sea[] = {3.612, 4.886, 6.734, 8.434, 15.35, 28.90},
               moridis[] = {3.182, 4.309, 5.830, 7.197, 12.76, 23.87};
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(equilibrium_pressure(temperatures[i], 0) * 1e-6, fresh[i], 5e-4 * fresh[i]);
    EXPECT_NEAR(equilibrium_pressure(temperatures[i], 35) * 1e-6, sea[i], 5e-4 * sea[i]);
    EXPECT_NEAR(equilibrium_pressure(temperatures[i], 0) * 1e-6, moridis[i], 0.025 * moridis[i]);
    EXPECT_NEAR(equilibrium_temperature(equilibrium_pressure(temperatures[i], 35), 35), temperatures[i], 2e-9);
  }
  EXPECT_NEAR(equilibrium_temperature(13e6, 35), 13.649, 5e-4);
  EXPECT_EQ(equilibrium_temperature(0, 35), -10);
  EXPECT_EQ(equilibrium_temperature(1e9, 0), 28);
  EXPECT_EQ(boundary_warning(5, 35), "");
  EXPECT_NE(boundary_warning(-1, 80).find("-1 degC (-0.15 to 19.85 degC), 80 ppt (0 to 70 ppt)"), std::string::npos);
}

TEST(Stability, NamesTheStateAndWhereTheBoundaryIs) {
  HydrateScene hydrate;
  EXPECT_EQ(stability_problem(hydrate), "");
  hydrate.temperature = 12;
  EXPECT_EQ(stability_problem(hydrate),
            "hydrate is not stable at 12 degC and a pore pressure of 8 MPa in water of 35 ppt of salt: it dissociates above 9.53 "
            "degC, or below 10.7 MPa");
  hydrate.salinity = 0;
  EXPECT_NE(stability_problem(hydrate).find("above 10.8"), std::string::npos) << "fresh water holds it a degree longer";
  hydrate.temperature = 46;
  EXPECT_NE(hydrate_problem(hydrate).find("strength"), std::string::npos);
  hydrate.temperature = 5;
  hydrate.density = 400;
  EXPECT_NE(hydrate_problem(hydrate).find("strength"), std::string::npos);
}

void expect_card(BondCard const& card, golden::Bond const& row) {
  EXPECT_TRUE(agrees(card.thickness * 1e6, row.gap));
  EXPECT_TRUE(agrees(card.B * 1e6, row.width));
  EXPECT_TRUE(agrees(card.h0 * 1e6, row.thickness));
  EXPECT_TRUE(agrees(card.R_t, row.R_t));
  EXPECT_TRUE(agrees(card.R_c, row.R_c));
  double const rounded = golden::E_m / card.E_m;  // the tables are computed with E_m as printed; Eq. 18 gives 2.7e-6 more
  EXPECT_TRUE(agrees(card.k_mh * rounded, row.k_mh));
  EXPECT_TRUE(agrees(card.k_bn, row.k_bn));
  EXPECT_TRUE(agrees(card.k_bs, row.k_bs));
  EXPECT_TRUE(agrees(card.k_bm * rounded, row.k_bm));
  EXPECT_TRUE(agrees(card.area * 1e12, row.area));
}

TEST(BondCard, FollowsThePropertyTable) {
  for (golden::Bond const& row : golden::bonds) {
    double const gap = row.share * critical_thickness_ratio(row.saturation / 100) * d50;
    BondCard const card = evaluate_bond(table_scene(row.saturation / 100), d50, d50 / 2, d50 / 2, gap, 0);
    expect_card(card, row);
    EXPECT_EQ(card.bonded, row.share < 1) << "at the critical thickness there is no bond";
  }
  expect_card(evaluate_bond(table_scene(0.41), d50, golden::unequal_r1, golden::unequal_r2, golden::unequal_gap, 0),
              golden::unequal);
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
  EXPECT_EQ(overlap.thickness, 0);
  EXPECT_TRUE(agrees(overlap.B * 1e6, "59.450"));
  BondCard const none = evaluate_bond(table_scene(0.2), d50, d50 / 2, d50 / 2, 0, 0);
  EXPECT_FALSE(none.bonded);
  EXPECT_EQ(none.k_bm, 0);
}

TEST(BondLaw, TheRollingLeverIsALengthOrAPartOfTheWidth) {
  Scene scene = table_scene(0.55);
  auto const length_of = [&](RollingLever const& lever) {
    scene.bond.rolling_lever = lever;
    return evaluate_bond(scene, d50, d50 / 2, d50 / 2, 0, 0).moment_length;
  };
  EXPECT_EQ(length_of({1, 0}), 1);
  EXPECT_EQ(length_of({1e-3, 0}), 1e-3);
  EXPECT_NEAR(length_of({0, 0.25}), 69.482e-6 / 4, 1e-9);
}

TEST(BondLaw, TheConstantThicknessLawGivesEveryGapTheSameBond) {
  Scene scene = table_scene(0.55);
  scene.bond.law = BondLawKind::constant_thickness;
  scene.bond.constant_thickness = 4e-6;
  BondCard const touching = evaluate_bond(scene, d50, d50 / 2, d50 / 2, 0, 0);
  BondCard const apart = evaluate_bond(scene, d50, d50 / 2, d50 / 2, 5e-6, 0);
  EXPECT_EQ(touching.thickness, 4e-6);
  EXPECT_EQ(touching.h0, 4e-6);
  EXPECT_EQ(touching.B, apart.B);
  EXPECT_EQ(touching.R_t, apart.R_t);
  EXPECT_FALSE(evaluate_bond(scene, d50, d50 / 2, d50 / 2, 15e-6, 0).bonded);
}

TEST(BondLaw, TheQuickTestsShapeFactorsAreNeverAboveTheExactOnes) {
  for (double const h_max : {1e-6, 14.9e-6, 0.5e-3, 1.15e-3, 3e-3}) {
    BondLaw const law = make_bond_law(table_scene(0.55), d50, h_max);
    for (int i = 0; i <= 100; ++i) {
      EXPECT_LE(law.least_shape_of_shear, shape_of_shear(h_max * i / 100));
      EXPECT_LE(law.least_shape_of_rolling, shape_of_rolling(h_max * i / 100));
    }
  }
}

/// R_t, R_c [N/m] and f K of a bond without gap between grains of d50.
struct GaplessBond {
  double saturation, tension, compression;
};

TEST(BondLaw, OfScaledRodsHasTheAddendsOfEquation11ScaledByArea) {
  for (GaplessBond const& expected : {GaplessBond{0.26, 479, 1541}, {0.41, 784, 2522}, {0.55, 916, 2948}}) {
    Scene scene = table_scene(expected.saturation);
    scene.bond.strength_from = StrengthFrom::conditions;
    scene.bond.thickness_mapping = ThicknessMapping::scaled;
    BondCard const card = evaluate_bond(scene, d50, d50 / 2, d50 / 2, 0, 0);
    EXPECT_NEAR(card.R_t, expected.tension, 1);
    EXPECT_NEAR(card.R_c, expected.compression, 1);
    EXPECT_EQ(card.K_s, 0.41);  // a gap of 0 is one at any scale
    double const gap = 5e-6, rod = gap * 12e-3 / d50;
    BondCard const apart = evaluate_bond(scene, d50, d50 / 2, d50 / 2, gap, 0);
    EXPECT_DOUBLE_EQ(apart.K_s, shear_slope(rod));
    EXPECT_DOUBLE_EQ(apart.f_r, shape_of_rolling(rod));
    EXPECT_NEAR(apart.R_t, 3 * apart.q_t * apart.B + (2.67e5 * rod - 160.2) * apart.B / 1.5e-4, 1e-9);
    EXPECT_EQ(apart.thickness, gap);  // stiffness and width are those of the bond itself
  }
}

TEST(BondLaw, OfClampedRodsIsThatOfTheThinnestOneTested) {
  Scene scene = table_scene(0.41);
  scene.bond.thickness_mapping = ThicknessMapping::clamped;
  for (double const gap : {0.0, 5e-6}) {
    BondCard const card = evaluate_bond(scene, d50, d50 / 2, d50 / 2, gap, 0);
    EXPECT_NEAR(card.f_s * card.K_s, 0.520, 5e-4);
    EXPECT_NEAR(card.f_r * card.K_r, 1.017, 5e-4);
    EXPECT_NEAR(card.R_t, 1.421e7 * card.B, 1e-9);
    EXPECT_NEAR(card.R_c, 2.571e7 * card.B, 1e-9);
  }
}

TEST(BondLaw, WithFloorsIsNeverWeakerThanAGrainContact) {
  Scene scene = table_scene(0.26);
  scene.grains.rolling_width_factor = 2;
  scene.grains.friction = 0.5;
  double const h_max = critical_thickness_ratio(0.26) * d50, radius = d50 / 2;
  BondLaw const printed_law = make_bond_law(scene, d50, h_max);
  scene.bond.friction_floor = true;
  BondLaw const law = make_bond_law(scene, d50, h_max);
  double const width = law.width(radius, 0.0);
  BondStrength const with = bond_strength(law.strength, width, 0, radius),
                     without = bond_strength(printed_law.strength, width, 0, radius);
  int floored = 0, printed = 0;
  for (double normal = -300; normal < 0.999 * with.compression; normal += 10) {
    double const shear = std::max(without.shear(normal), 0.5 * normal),
                 rolling = std::max(without.rolling(normal), normal * 2 * radius / 6);
    EXPECT_EQ(with.shear(normal), shear);
    EXPECT_DOUBLE_EQ(with.rolling(normal), rolling);
    (shear > without.shear(normal) ? floored : printed) += 1;
    for (double const part : {0.0, 0.3, 0.6, 0.9}) {
      double const rest = std::sqrt(1 - part * part);
      EXPECT_EQ(with.test(normal, 0.999 * part * shear, 0.999 * rest * rolling), BreakMode::none) << normal << " " << part;
      EXPECT_NE(with.test(normal, 1.001 * part * shear, 1.001 * rest * rolling), BreakMode::none) << normal << " " << part;
    }
  }
  EXPECT_GT(floored, 10);
  EXPECT_GT(printed, 10);
  EXPECT_EQ(with.test(with.compression, 0, 0), BreakMode::compression);
}

TEST(Hydrate, SaysWhatItsStrengthWasNotFittedTo) {
  HydrateScene hydrate;
  EXPECT_EQ(fit_warning(hydrate), "") << "the state of the paper";
  for (double const inside : {-30.0, 8.0}) {
    hydrate.temperature = inside;
    EXPECT_EQ(fit_warning(hydrate), "") << inside;
  }
  hydrate.temperature = -50;
  EXPECT_NE(fit_warning(hydrate).find("not fitted to -50 degC (-30 degC and warmer)"), std::string::npos) << fit_warning(hydrate);
  hydrate.pore_pressure = 1.49e6;
  hydrate.density = 901;
  EXPECT_NE(fit_warning(hydrate).find(", 1.49 MPa of pore pressure (1.5 to 8 MPa), 901 kg/m^3 (720 to 900 kg/m^3)"),
            std::string::npos)
      << fit_warning(hydrate);
}

}  // namespace
}  // namespace clathra
