/// What is expected of the settings of a scene, from the table of what was measured.
#include <gtest/gtest.h>

#include <cmath>

#include "run/expected_error.hpp"

namespace clathra {
namespace {

Scene scene_at(double saturation) {
  Scene scene;
  scene.hydrate.saturation = saturation;
  scene.run.rotational_inertia_factor = 1;
  scene.run.precision = Precision::full;
  return scene;
}
RateNumbers at(double inertial_number, double platen_wave_stress = 0) {
  RateNumbers n;
  n.inertial_number = inertial_number;
  n.platen_wave_stress = platen_wave_stress;
  return n;
}
RateNumbers at(RateEffect const& row) { return at(row.inertial_number); }

TEST(ExpectedError, HasRowsByRisingRate) {
  for (auto const rows : {rate_effects(), inertia_effects()}) {
    ASSERT_GE(rows.size(), 2u);
    for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_GT(rows[i].inertial_number, rows[i - 1].inertial_number);
  }
}

TEST(ExpectedError, IsThatOfTheTableAndBetweenItsRowsOfNeighbours) {
  for (RateEffect const& row : rate_effects()) {
    EXPECT_NEAR(expected_error(scene_at(0), at(row)).peak_q->error, row.sand.error, 1e-4);
    EXPECT_NEAR(expected_error(scene_at(0.55), at(row)).peak_q->error, row.bonded.error, 1e-4);
    EXPECT_NEAR(expected_error(scene_at(0.55), at(row)).peak_q->half_width, row.bonded.half_width, 1e-3);
  }
  RateEffect const &a = rate_effects()[0], &b = rate_effects()[1];
  RateNumbers const middle = at(std::sqrt(a.inertial_number * b.inertial_number), 0);
  EXPECT_NEAR(expected_error(scene_at(0.55), middle).peak_q->error, (a.bonded.error + b.bonded.error) / 2, 1e-4);
}

TEST(ExpectedError, OfATallSpecimenIsThatOfItsInertialNumber) {
  RateEffect const& row = rate_effects().back();
  EXPECT_EQ(expected_error(scene_at(0.55), at(row.inertial_number, 1.9)).peak_q->error, row.bonded.error);
}

TEST(ExpectedError, AddsThatOfHeavierRotationAtItsRate) {
  Scene scene = scene_at(0.55);
  for (RateEffect const& row : inertia_effects()) {
    MeasuredError const own = *expected_error(scene_at(0.55), at(row)).peak_q;
    for (double const inertia : {1.5, 3.0}) {
      scene.run.rotational_inertia_factor = inertia;
      EXPECT_NEAR(expected_error(scene, at(row)).peak_q->error, own.error + row.bonded.error, 1e-9);
      EXPECT_NEAR(expected_error(scene, at(row)).peak_q->half_width, std::hypot(own.half_width, row.bonded.half_width), 1e-9);
    }
  }
  EXPECT_EQ(expected_error(scene, at(2 * inertia_effects().back().inertial_number)).range,
            "only up to I = 0.001 with heavier rotation");
}

TEST(ExpectedError, OfTheDefaultsIsKnown) {
  Scene scene;
  EXPECT_TRUE(expected_error(scene, at(scene.test.inertial_number)).peak_q);
}

TEST(ExpectedError, AddsThatOfMixedPrecisionWithIndependentIntervals) {
  RateEffect const& row = rate_effects().back();
  Scene scene = scene_at(0.55);
  scene.run.precision = Precision::mixed;
  SettingEffect const mixed = mixed_precision_effect();
  EXPECT_NEAR(expected_error(scene, at(row)).peak_q->error, row.bonded.error + mixed.bonded.error, 1e-6);
  EXPECT_NEAR(expected_error(scene, at(row)).peak_q->half_width, std::hypot(row.bonded.half_width, mixed.bonded.half_width),
              1e-6);
}

TEST(ExpectedError, IsTheWorseOfBothMaterialsBetweenThem) {
  auto const farthest = [](ExpectedError const& e) { return std::fabs(e.peak_q->error) + e.peak_q->half_width; };
  for (RateEffect const& row : rate_effects())
    EXPECT_DOUBLE_EQ(farthest(expected_error(scene_at(0.3), at(row))),
                     std::max(farthest(expected_error(scene_at(0), at(row))), farthest(expected_error(scene_at(0.55), at(row)))));
}

/// Every key of the model, each alone other than in the tests of the table.
constexpr std::pair<char const*, void (*)(Scene&)> others[] = {
    {"grains.density", [](Scene& s) { s.grains.density = 2700; }},
    {"grains.normal_stiffness", [](Scene& s) { s.grains.normal_stiffness = 1e8; }},
    {"grains.shear_stiffness", [](Scene& s) { s.grains.shear_stiffness = 1e6; }},
    {"bond.grain_stiffness_factor", [](Scene& s) { s.bond.grain_stiffness_factor = 1; }},
    {"grains.rolling_width_factor", [](Scene& s) { s.grains.rolling_width_factor = 0; }},
    {"damping.viscous_ratio", [](Scene& s) { s.damping.viscous_ratio = 0.2; }},
    {"grading.table", [](Scene& s) { s.grading.table = "uniform"; }},
    {"grading.file", [](Scene& s) { s.grading.file = "sand.csv"; }},
    {"grading.d50", [](Scene& s) { s.grading.d50 = 1e-3; }},
    {"hydrate.temperature", [](Scene& s) { s.hydrate.temperature = -50; }},
    {"hydrate.pore_pressure", [](Scene& s) { s.hydrate.pore_pressure = 1e7; }},
    {"hydrate.density", [](Scene& s) { s.hydrate.density = 850; }},
    {"bond.law", [](Scene& s) { s.bond.law = BondLawKind::constant_thickness; }},
    {"bond.contact_coupling", [](Scene& s) { s.bond.contact_coupling = ContactCoupling::replaces_keeping_force; }},
    {"run.time_step_rule", [](Scene& s) { s.run.time_step_rule = TimeStepRule::fixed; }},
    {"run.time_step_safety", [](Scene& s) { s.run.time_step_safety = 0.3; }},
    {"bond.rolling_lever",
     [](Scene& s) {
       s.bond.rolling_lever = {1, 0};
     }},
    {"bond.thickness_mapping", [](Scene& s) { s.bond.thickness_mapping = ThicknessMapping::scaled; }},
    {"bond.friction_floor", [](Scene& s) { s.bond.friction_floor = true; }},
    {"bond.strength_from", [](Scene& s) { s.bond.strength_from = StrengthFrom::printed; }},
    {"bond.strength_modulus", [](Scene& s) { s.bond.strength_modulus = 5; }},
    {"bond.critical_thickness_from", [](Scene& s) { s.bond.critical_thickness_from = CriticalThicknessFrom::bond_area; }},
    {"bond.after_consolidation", [](Scene& s) { s.bond.after_consolidation = false; }},
    {"specimen.preparation_stress", [](Scene& s) { s.specimen.preparation_stress = 1e5; }},
    {"test.confining_stress", [](Scene& s) { s.test.confining_stress = 5e7; }},
    {"test.wall_friction", [](Scene& s) { s.test.wall_friction = 0.5; }},
    {"damping.local", [](Scene& s) { s.damping.local = 0.7; }},
    {"run.mass_scaled_fraction", [](Scene& s) { s.run.mass_scaled_fraction = 0.1; }},
    {"specimen.file", [](Scene& s) { s.specimen.file = "specimen.h5"; }},
    {"specimen.particles", [](Scene& s) { s.specimen.particles = 300; }},
    {"specimen.width", [](Scene& s) { s.specimen.width = 0.026; }},
    {"specimen.height", [](Scene& s) { s.specimen.height = 1e-3; }},
    {"specimen.aspect_ratio", [](Scene& s) { s.specimen.aspect_ratio = 0.1; }},
    {"specimen.generator", [](Scene& s) { s.specimen.generator = Generator::compression; }},
    {"specimen.compaction_layers", [](Scene& s) { s.specimen.compaction_layers = 1; }},
    {"specimen.void_ratio_at", [](Scene& s) { s.specimen.void_ratio_at = VoidRatioAt::test; }},
    {"test.consolidation_steps", [](Scene& s) { s.test.consolidation_steps = 10; }},
    {"test.axial_strain", [](Scene& s) { s.test.axial_strain = 0.003; }},
};

TEST(ExpectedError, IsNotGivenForWhatWasNotMeasured) {
  RateNumbers const slow = at(rate_effects().front());
  auto const why = [&](auto const& change, RateNumbers const& n) {
    Scene scene = scene_at(0.55);
    change(scene);
    ExpectedError const e = expected_error(scene, n);
    EXPECT_FALSE(e.peak_q);
    return e.range;
  };
  auto const none = [](Scene&) {};
  EXPECT_NE(why(none, at(1, 0)).find("only up to I = "), std::string::npos);
  EXPECT_EQ(why(none, at(1e-6, 100)), "only up to W = 2");
  EXPECT_EQ(why([](Scene& s) { s.hydrate.saturation = 0.8; }, slow), "only up to a saturation of 55 %");
  EXPECT_EQ(why([](Scene& s) { s.run.rotational_inertia_factor = 4; }, slow), "only up to moments of inertia times 3");
  EXPECT_EQ(why([](Scene& s) { s.specimen.void_ratio = 0.3, s.grains.friction = 0; }, slow),
            "specimen.void_ratio, grains.friction");
  for (auto const& [key, change] : others) EXPECT_EQ(why(change, slow), key);
  Scene sand = scene_at(0);
  sand.hydrate.temperature = 7, sand.bond.rolling_lever = {0, 0.1};
  EXPECT_TRUE(expected_error(sand, slow).peak_q) << "of bonds that there are not";
  sand.specimen.void_ratio = 0.24, sand.grading.d50 = 0.1694e-3;
  EXPECT_TRUE(expected_error(sand, slow).peak_q);
}

}  // namespace
}  // namespace clathra
