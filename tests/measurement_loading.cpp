/// The numbers of stages, from curves that are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "domain/measurement/loading_numbers.hpp"

namespace clathra {
namespace {

/// Ellipses of q over eps_1. @param lag  of the strain behind the stress [rad]
LoadingCurves ellipses(double lag) {
  constexpr int points = 400, cycles = 5;
  LoadingCurves c;
  for (int i = 0; i <= points * cycles; ++i) {
    double const phase = 2 * std::numbers::pi * i / points;
    c.eps1.push_back(0.001 * (1 - std::cos(phase)));
    c.sigma3.push_back(1e6);
    c.sigma1.push_back(2e6 - 5e5 * std::cos(phase + lag));
    c.eps_v.push_back(0), c.void_ratio.push_back(0.2);
  }
  return c;
}

TEST(LoadingNumbers, OfAnEllipseAreThoseOfItsLag) {
  LoadingStage cycles;
  cycles.vertical.inertial_number = 1e-4;
  cycles.turn.axial_strain = {0, 0.002};
  for (double const lag : {0.02, 0.1, 0.4}) {
    double const ratio = loading_numbers(cycles, ellipses(lag)).at("damping_ratio");
    EXPECT_NEAR(ratio, 0.5 * std::sin(lag), 1e-3 * ratio) << lag;
  }
  EXPECT_NEAR(loading_numbers(cycles, ellipses(0)).at("damping_ratio"), 0, 1e-12) << "an elastic loop encloses nothing";
}

/// Each cycle goes two steps forth and one back.
TEST(LoadingNumbers, OfCyclesThatWanderAreTheStrainOfACycle) {
  LoadingStage stage;
  stage.vertical.inertial_number = 1e-4;
  stage.turn.deviator_stress = {0, 1e6};
  LoadingCurves c;
  for (int turn = 0; turn <= 8; ++turn) {
    c.eps1.push_back(turn % 2 == 0 ? 0.001 * turn / 2 : 0.001 * (turn - 1) / 2 + 0.002);
    c.sigma3.push_back(1e6), c.sigma1.push_back(turn % 2 == 0 ? 1e6 : 2e6), c.eps_v.push_back(0), c.void_ratio.push_back(0.2);
  }
  EXPECT_NEAR(loading_numbers(stage, c).at("strain_per_cycle"), 0.001, 1e-12);
}

LoadingCurves straight(double from, double to, double k0, double modulus) {
  LoadingCurves c;
  for (int i = 0; i <= 10; ++i) {
    double const sigma1 = from + (to - from) * i / 10;
    c.sigma1.push_back(sigma1), c.sigma3.push_back(from + k0 * (sigma1 - from));
    c.eps1.push_back((sigma1 - from) / modulus), c.eps_v.push_back(c.eps1.back());
    c.void_ratio.push_back(0.2 - c.eps1.back());
  }
  return c;
}

TEST(LoadingNumbers, OfOneDimensionalCompressionAreModulusAndEarthPressure) {
  LoadingStage stage;
  stage.vertical.stress = 4e6;
  stage.lateral.hold = true;
  StageRecord const numbers = loading_numbers(stage, straight(1e6, 4e6, 0.4, 3e8));
  EXPECT_NEAR(numbers.at("constrained_modulus_Pa"), 3e8, 1);
  EXPECT_NEAR(numbers.at("k0_of_increments"), 0.4, 1e-12);
  EXPECT_NEAR(numbers.at("k0"), (1e6 + 0.4 * 3e6) / 4e6, 1e-12);
  EXPECT_FALSE(numbers.contains("bulk_modulus_Pa"));
  stage.lateral = stage.vertical;
  StageRecord const isotropic = loading_numbers(stage, straight(1e6, 4e6, 1, 3e8));
  EXPECT_NEAR(isotropic.at("bulk_modulus_Pa"), 3e8, 1);
  EXPECT_FALSE(isotropic.contains("k0"));
}

TEST(LoadingNumbers, OfUnloadingAreTheSecant) {
  LoadingStage stage;
  stage.name = "unloading";
  stage.vertical.inertial_number = -1e-4;
  EXPECT_NEAR(loading_numbers(stage, straight(1e6, 4e6, 0, 3e8)).at("secant_stiffness_Pa"), 3e8, 1);
}

/// p falls to a least value and rises again; u is what sigma_3 has lost.
TEST(LoadingNumbers, AtConstantVolumeAreThePorePressureAndWherePTurns) {
  LoadingStage stage;
  stage.vertical.inertial_number = 1e-4;
  stage.lateral.follow = Follow::constant_volume;
  LoadingCurves c;
  for (int i = 0; i <= 100; ++i) {
    double const t = i / 100.0, p = 1e6 - 8e5 * t + 8e5 * t * t, q = 6e5 * t;  // least at t = 1/2: 0.8 MPa
    c.eps1.push_back(0.1 * t), c.eps_v.push_back(0), c.void_ratio.push_back(0.2);
    c.sigma1.push_back(p + q / 2), c.sigma3.push_back(p - q / 2);
  }
  StageRecord const numbers = loading_numbers(stage, c);
  EXPECT_NEAR(numbers.at("phase_transformation_eps1"), 0.05, 1e-12);
  EXPECT_NEAR(numbers.at("phase_transformation_p_Pa"), 8e5, 1);
  double const largest = 1e6 - *std::min_element(c.sigma3.begin(), c.sigma3.end());
  EXPECT_NEAR(numbers.at("largest_pore_pressure_Pa"), largest, 1e-6);
  EXPECT_NEAR(numbers.at("largest_pore_pressure_ratio"), largest / 1e6, 1e-12);
  for (double const sign : {-1.0, 1.0}) {
    LoadingCurves straight_on = c;
    for (std::size_t i = 0; i < c.sigma1.size(); ++i) {
      straight_on.sigma3[i] = 1e6;
      straight_on.sigma1[i] = 1e6 + sign * 1e3 * static_cast<double>(i);
    }
    EXPECT_FALSE(loading_numbers(stage, straight_on).contains("phase_transformation_eps1")) << "p turns nowhere";
  }
}

}  // namespace
}  // namespace clathra
