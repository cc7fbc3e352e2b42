/// What the guards of a shear say, of planted checks.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "domain/biaxial/dilation_watch.hpp"
#include "domain/biaxial/quasi_static.hpp"
#include "domain/biaxial/shear_watch.hpp"

namespace clathra {
namespace {

/// 100 checks: q rises to its peak in the 50th and falls from there on. @param at  what is off in some of them
template <class Plant>
ShearWatch watched(Plant const& at) {
  ShearWatch watch;
  for (int n = 1; n <= 100; ++n) {
    ShearCheck check;
    check.eps1 = n * check_interval;
    check.q = 1e6 * (n <= 50 ? n : 100 - n);
    check.sigma1 = check.q + 1e6;
    check.unbalanced = 1e-4;
    check.time_step = 1e-7;
    at(n, check);
    EXPECT_TRUE(watch.due(check.eps1 * (1 + 1e-12)));
    watch.add(check);
  }
  return watch;
}

/// The one warning of planted checks; "" where there is none.
template <class Plant>
std::string warning_of(Plant const& at) {
  std::vector<std::string> const warnings = watched(at).warnings(true);
  EXPECT_LE(warnings.size(), 1u);
  return warnings.empty() ? "" : warnings.front();
}

TEST(ShearWatch, JudgesTheWayToThePeakAndLeavesTheFailureAlone) {
  auto const shaken = [](int from, int to) {
    return [from, to](int n, ShearCheck& check) {
      if (from <= n && n <= to) check.unbalanced = 0.2, check.mismatch = 0.04, check.stress_error = 0.05;
    };
  };
  EXPECT_TRUE(watched(shaken(51, 100)).balanced(true));
  EXPECT_EQ(warning_of(shaken(51, 100)), "");
  ShearWatch const before = watched(shaken(45, 50));
  EXPECT_FALSE(before.balanced(true));
  EXPECT_NEAR(before.record().at("mean_unbalanced_to_peak"), (6 * 0.2 + 44 * 1e-4) / 50, 1e-12);
  EXPECT_TRUE(before.balanced(false)) << "sand";
  EXPECT_EQ(before.record().at("checks_to_peak"), 50);
  EXPECT_EQ(before.record().at("checks_unbalanced"), 6);
  EXPECT_EQ(before.record().at("sigma3_held_to_peak"), 44.0 / 50);
  EXPECT_NE(before.warnings(true).at(0).find("lower test.inertial_number"), std::string::npos);
  std::string const from_unrest = before.warnings(true, false).at(0);
  EXPECT_NE(from_unrest.find("the test did not begin at rest"), std::string::npos) << from_unrest;
  EXPECT_EQ(from_unrest.find("inertial_number"), std::string::npos) << "a lower rate does not mend that";
}

TEST(ShearWatch, JudgesSigma3ByShareUpToThePeakAndByMagnitudeThroughout) {
  auto const off = [](int from, int to, double by) {
    return [=](int n, ShearCheck& check) { check.stress_error = from <= n && n <= to ? by : 0; };
  };
  EXPECT_EQ(warning_of(off(1, 5, 0.05)), "");
  EXPECT_NE(warning_of(off(1, 6, 0.05)).find("in only 88.0 % of the checks up to the peak"), std::string::npos);
  EXPECT_EQ(warning_of(off(51, 100, 0.99 * stress_error_limit)), "");
  EXPECT_NE(warning_of(off(80, 80, 0.87)).find("sigma_3 was off by up to 87 %"), std::string::npos);
}

TEST(ShearWatch, SaysStressesThatDisagreeAndDeepOverlaps) {
  auto const apart = [](double by) { return [by](int n, ShearCheck& check) { check.mismatch = n == 10 ? by : 0; }; };
  EXPECT_EQ(warning_of(apart(0.99 * mismatch_limit)), "");
  EXPECT_NE(warning_of(apart(1.01 * mismatch_limit)).find("q of the contacts"), std::string::npos);
  auto const deep = [](double share) {
    return [share](int n, ShearCheck& check) { check.deep_share = n == 70 ? share : 0, check.deepest = 0.3; };
  };
  EXPECT_EQ(warning_of(deep(0.99 * deep_overlap_share)), "");
  EXPECT_NE(warning_of(deep(1.2 * deep_overlap_share)).find("at 1.4 % strain, the deepest of the test by 30 %"),
            std::string::npos);
}

TEST(Rate, IsTooFastForSandSoonerThanForBonds) {
  Scene scene;
  scene.hydrate.saturation = 0;
  for (double const limit : {inertial_warning_of_sand, inertial_warning_of_bonds}) {
    RateNumbers const at{1, limit, 0.01, 1}, above{1, 1.01 * limit, 0.01, 1};
    EXPECT_TRUE(is_quasi_static(scene, at) && rate_warnings(scene, at).empty()) << limit;
    EXPECT_FALSE(is_quasi_static(scene, above)) << limit;
    ASSERT_EQ(rate_warnings(scene, above).size(), 1u) << limit;
    EXPECT_NE(rate_warnings(scene, above)[0].find("more than 2 % too high"), std::string::npos);
    scene.hydrate.saturation = 0.26;
  }
}

TEST(Stiffness, IsJudgedByTheLargestStressExpectedAndSeen) {
  Scene scene;
  scene.hydrate.saturation = 0;
  scene.test.confining_stress = 1e6;
  EXPECT_NEAR(expected_sigma1(scene), 3.3e6, 1e3);
  scene.hydrate.saturation = 0.55;
  EXPECT_NEAR(expected_sigma1(scene), 10.66e6, 1e3);
  scene.hydrate.saturation = 0.48;
  EXPECT_GT(expected_sigma1(scene), 8.78e6);
  EXPECT_LT(expected_sigma1(scene), 10.66e6);
  scene.hydrate.saturation = 0;
  scene.grains.normal_stiffness = 4.9 * expected_sigma1(scene);
  RateNumbers const slow{1, 1e-4, 0.01, 1};
  ASSERT_EQ(rate_refusals(scene, slow).size(), 1u);
  EXPECT_NE(rate_refusals(scene, slow)[0].find("kn / sigma_1 = 4.9 with a sigma_1 of 3.3 MPa"), std::string::npos);
  EXPECT_TRUE(rate_warnings(scene, slow).empty());
  scene.grains.normal_stiffness = 14.9 * expected_sigma1(scene);
  EXPECT_TRUE(rate_refusals(scene, slow).empty());
  EXPECT_EQ(rate_warnings(scene, slow).size(), 1u);
  EXPECT_EQ(stiffness_warning_at(scene, 2 * expected_sigma1(scene)), "") << "said before the run";
  scene.grains.normal_stiffness = 15.1 * expected_sigma1(scene);
  EXPECT_TRUE(rate_warnings(scene, slow).empty());
  EXPECT_EQ(stiffness_warning_at(scene, expected_sigma1(scene)), "");
  EXPECT_NE(stiffness_warning_at(scene, 1.1 * expected_sigma1(scene)).find("overlapped"), std::string::npos);
}

TEST(Collapse, IsAVoidRatioBelowThatOfGrainsOrMostContactsDeep) {
  EXPECT_EQ(collapse(0.051, 0.49), "");
  EXPECT_NE(collapse(0.049, 0).find("void ratio"), std::string::npos);
  EXPECT_NE(collapse(std::nan(""), 0).find("void ratio"), std::string::npos);
  EXPECT_NE(collapse(0.2, 0.51).find("51 % of the contacts"), std::string::npos);
}

/// Volumetric strain of a test that contracts and then dilates at a planted angle.
double planted_eps_v(double eps1, double psi) {
  double const s = std::sin(psi), slope = -2 * s / (1 - s);
  return eps1 < 0.01 ? 0.5 * eps1 : 0.005 + slope * (eps1 - 0.01);
}

TEST(DilationWatch, HasTheAngleThatWasPlantedOverStretchesOfOnePercent) {
  constexpr double psi = 0.2, degree = std::numbers::pi / 180;
  DilationWatch watch;
  for (int n = 1; n <= 150; ++n) {
    double const eps1 = n * check_interval + 3e-6 * (n % 7);  // checks come a step late, by different steps
    watch.check(eps1, planted_eps_v(eps1, psi));
    EXPECT_EQ(std::isnan(watch.largest()), eps1 < dilation_window) << n;
  }
  EXPECT_NEAR(watch.largest() * degree, psi, 1e-9);
  watch.begin_record();
  EXPECT_NEAR(watch.largest() * degree, psi, 1e-9) << "until the next stretch that of the last one";
  watch.check(0.0305, planted_eps_v(0.03, psi) - 0.001);
  EXPECT_GT(watch.largest() * degree, psi);
  // Steps as long as a window, and longer, make stretches too.
  DilationWatch coarse;
  for (int n = 1; n <= 10; ++n) coarse.check(0.015 * n, planted_eps_v(0.015 * n, psi));
  EXPECT_NEAR(coarse.largest() * degree, psi, 1e-9);
}

}  // namespace
}  // namespace clathra
