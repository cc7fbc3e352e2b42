/// What is expected of the settings of a scene, from the table of what was measured.
#include <gtest/gtest.h>

#include <cmath>

#include "expected_error.hpp"

namespace clathra {
namespace {

Scene scene_of(double saturation) {
  Scene scene;
  scene.hydrate.saturation = saturation;
  scene.run.inertia_scaling = 1;
  scene.run.precision = Precision::full;
  return scene;
}
RateNumbers at(double inertial_number, double wave_number = 0) {
  RateNumbers n;
  n.inertial_number = inertial_number;
  n.wave_number = wave_number;
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
    EXPECT_NEAR(expected_error(scene_of(0), at(row)).peak_q->error, row.sand.error, 1e-4);
    EXPECT_NEAR(expected_error(scene_of(0.55), at(row)).peak_q->error, row.bonded.error, 1e-4);
    EXPECT_NEAR(expected_error(scene_of(0.55), at(row)).peak_q->half_width, row.bonded.half_width, 1e-3);
  }
  RateEffect const &a = rate_effects()[0], &b = rate_effects()[1];
  RateNumbers const middle = at(std::sqrt(a.inertial_number * b.inertial_number), 0);
  EXPECT_NEAR(expected_error(scene_of(0.55), middle).peak_q->error, (a.bonded.error + b.bonded.error) / 2, 1e-4);
}

TEST(ExpectedError, OfATallSpecimenIsThatOfItsInertialNumber) {
  RateEffect const& row = rate_effects().back();
  EXPECT_EQ(expected_error(scene_of(0.55), at(row.inertial_number, 1.9)).peak_q->error, row.bonded.error);
}

TEST(ExpectedError, AddsThatOfHeavierRotationAtItsRate) {
  Scene scene = scene_of(0.55);
  for (RateEffect const& row : inertia_effects()) {
    MeasuredError const own = *expected_error(scene_of(0.55), at(row)).peak_q;
    for (double const inertia : {1.5, 3.0}) {
      scene.run.inertia_scaling = inertia;
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
  Scene scene = scene_of(0.55);
  scene.run.precision = Precision::mixed;
  SettingEffect const mixed = mixed_precision_effect();
  EXPECT_NEAR(expected_error(scene, at(row)).peak_q->error, row.bonded.error + mixed.bonded.error, 1e-6);
  EXPECT_NEAR(expected_error(scene, at(row)).peak_q->half_width, std::hypot(row.bonded.half_width, mixed.bonded.half_width),
              1e-6);
}

TEST(ExpectedError, IsTheWorseOfBothMaterialsBetweenThem) {
  auto const farthest = [](ExpectedError const& e) { return std::fabs(e.peak_q->error) + e.peak_q->half_width; };
  for (RateEffect const& row : rate_effects())
    EXPECT_DOUBLE_EQ(farthest(expected_error(scene_of(0.3), at(row))),
                     std::max(farthest(expected_error(scene_of(0), at(row))), farthest(expected_error(scene_of(0.55), at(row)))));
}

/// Every key of the model, each alone other than in the tests of the table.
constexpr std::pair<char const*, void (*)(Scene&)> others[] = {
    {"grains.density", [](Scene& s) { s.grains.density = 2700; }},
    {"grains.kn", [](Scene& s) { s.grains.kn = 1e8; }},
    {"grains.ks", [](Scene& s) { s.grains.ks = 1e6; }},
    {"grains.particle_stiffness_ratio", [](Scene& s) { s.grains.particle_stiffness_ratio = 1; }},
    {"grains.shape_factor", [](Scene& s) { s.grains.shape_factor = 0; }},
    {"grains.contact_damping", [](Scene& s) { s.grains.contact_damping = 0.2; }},
    {"grading.table", [](Scene& s) { s.grading.table = "uniform"; }},
    {"grading.file", [](Scene& s) { s.grading.file = "sand.csv"; }},
    {"grading.d50", [](Scene& s) { s.grading.d50 = 1e-3; }},
    {"hydrate.temperature", [](Scene& s) { s.hydrate.temperature = -50; }},
    {"hydrate.pore_pressure", [](Scene& s) { s.hydrate.pore_pressure = 1e7; }},
    {"hydrate.density", [](Scene& s) { s.hydrate.density = 850; }},
    {"bond.law", [](Scene& s) { s.bond.law = BondLawKind::constant_thickness; }},
    {"bond.composite", [](Scene& s) { s.bond.composite = Composite::memory; }},
    {"bond.moment_scale", [](Scene& s) { s.bond.moment_scale = MomentScale::paper_si; }},
    {"bond.moment_ratio", [](Scene& s) { s.bond.moment_ratio = 0.1; }},
    {"bond.rod_thickness", [](Scene& s) { s.bond.rod_thickness = RodThickness::scaled; }},
    {"bond.friction_floor", [](Scene& s) { s.bond.friction_floor = true; }},
    {"bond.coefficients", [](Scene& s) { s.bond.coefficients = CoefficientSource::printed; }},
    {"bond.mode", [](Scene& s) { s.bond.mode = BondingMode::areal_target; }},
    {"bond.after_consolidation", [](Scene& s) { s.bond.after_consolidation = false; }},
    {"bond.stress", [](Scene& s) { s.bond.stress = 1e5; }},
    {"test.confining_stress", [](Scene& s) { s.test.confining_stress = 5e7; }},
    {"test.wall_friction", [](Scene& s) { s.test.wall_friction = 0.5; }},
    {"run.damping", [](Scene& s) { s.run.damping = 0.7; }},
    {"run.mass_scaling", [](Scene& s) { s.run.mass_scaling = 0.1; }},
    {"sample.file", [](Scene& s) { s.sample.generator = Generator::file; }},
    {"sample.particles", [](Scene& s) { s.sample.particles = 300; }},
    {"sample.width", [](Scene& s) { s.sample.width = 0.026; }},
    {"sample.height", [](Scene& s) { s.sample.height = 1e-3; }},
    {"sample.aspect_ratio", [](Scene& s) { s.sample.aspect_ratio = 0.1; }},
    {"sample.generator", [](Scene& s) { s.sample.generator = Generator::compression; }},
    {"sample.layers", [](Scene& s) { s.sample.layers = 1; }},
    {"sample.void_ratio_at", [](Scene& s) { s.sample.void_ratio_at = VoidRatioAt::test; }},
    {"test.consolidation_steps", [](Scene& s) { s.test.consolidation_steps = 10; }},
    {"test.axial_strain", [](Scene& s) { s.test.axial_strain = 0.003; }},
};

TEST(ExpectedError, IsNotGivenForWhatWasNotMeasured) {
  RateNumbers const slow = at(rate_effects().front());
  auto const why = [&](auto const& change, RateNumbers const& n) {
    Scene scene = scene_of(0.55);
    change(scene);
    ExpectedError const e = expected_error(scene, n);
    EXPECT_FALSE(e.peak_q);
    return e.range;
  };
  auto const none = [](Scene&) {};
  EXPECT_NE(why(none, at(1, 0)).find("only up to I = "), std::string::npos);
  EXPECT_EQ(why(none, at(1e-6, 100)), "only up to W = 2");
  EXPECT_EQ(why([](Scene& s) { s.hydrate.saturation = 0.8; }, slow), "only up to a saturation of 55 %");
  EXPECT_EQ(why([](Scene& s) { s.run.inertia_scaling = 4; }, slow), "only up to moments of inertia times 3");
  EXPECT_EQ(why([](Scene& s) { s.sample.void_ratio = 0.3, s.grains.friction = 0; }, slow), "sample.void_ratio, grains.friction");
  for (auto const& [key, change] : others) EXPECT_EQ(why(change, slow), key);
  Scene sand = scene_of(0);
  sand.hydrate.temperature = 7, sand.bond.moment_ratio = 0.1;
  EXPECT_TRUE(expected_error(sand, slow).peak_q) << "of bonds that there are not";
  sand.sample.void_ratio = 0.24, sand.grading.d50 = 0.1694e-3;
  EXPECT_TRUE(expected_error(sand, slow).peak_q);
}

}  // namespace
}  // namespace clathra
