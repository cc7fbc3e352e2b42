/// What is expected of the settings of a scene, from the table of what was measured.
#include <gtest/gtest.h>

#include <cmath>

#include "domain/biaxial/expected_error.hpp"

namespace clathra {
namespace {

Scene scene_of(double saturation) {
  Scene scene;
  scene.hydrate.saturation = saturation;
  return scene;
}
RateNumbers at(double inertial_number, double wave_number) {
  RateNumbers n;
  n.inertial_number = inertial_number;
  n.wave_number = wave_number;
  return n;
}
RateNumbers at(RateEffect const& row) { return at(row.inertial_number, row.wave_number); }

TEST(ExpectedError, HasRowsByRisingRateWithAWaveNumberInProportion) {
  auto const rows = rate_effects();
  ASSERT_GE(rows.size(), 2u);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_GT(rows[i].inertial_number, rows[i - 1].inertial_number);
    EXPECT_NEAR(rows[i].wave_number / rows[i].inertial_number, rows[0].wave_number / rows[0].inertial_number,
                0.02 * rows[0].wave_number / rows[0].inertial_number);
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

TEST(ExpectedError, OfATallSpecimenIsThatOfTheRateWithItsWave) {
  RateEffect const &slow = rate_effects().front(), &fast = rate_effects().back();
  ExpectedError const tall = expected_error(scene_of(0.55), at(slow.inertial_number, fast.wave_number));
  EXPECT_NEAR(tall.peak_q->error, fast.bonded.error, 1e-6);
  EXPECT_NE(tall.range.find(" for a W of "), std::string::npos) << tall.range;
}

TEST(ExpectedError, AddsThatOfMixedPrecisionWithIndependentIntervals) {
  RateEffect const& row = rate_effects().back();
  Scene scene = scene_of(0.55);
  scene.run.precision = Precision::mixed;
  SettingEffect const& mixed = mixed_precision_effects()[0];
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
  EXPECT_NE(why(none, at(1, 0)).find("measured up to I = "), std::string::npos);
  EXPECT_NE(why(none, at(1e-6, 100)).find("measured up to I = "), std::string::npos);
  EXPECT_EQ(why([](Scene& s) { s.bond.reading = "literal"; }, slow), "measured for the default law only");
  EXPECT_EQ(why([](Scene& s) { s.test.confining_stress = 5e7; }, slow), "measured at 1 MPa with kn of 0.3 GPa only");
  EXPECT_EQ(why([](Scene& s) { s.run.damping = 0.7; }, slow), "measured with a local damping of 0.3 only");
  EXPECT_EQ(why([](Scene& s) { s.hydrate.saturation = 0.8; }, slow), "measured up to a saturation of 55 %");
  EXPECT_EQ(why([](Scene& s) { s.run.inertia_scaling = 3; }, slow), "measured without scaled masses only");
}

}  // namespace
}  // namespace clathra
