/// Strain and stress of snapshots, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "domain/measurement/principal_axes.hpp"
#include "domain/measurement/strain_field.hpp"
#include "domain/measurement/surroundings.hpp"
#include "made_up_lattice.hpp"

namespace clathra {
namespace {

/// Displaces a lattice by x' = F x.
Snapshot deformed(double fxx, double fxy, double fyx, double fyy) {
  Snapshot s = made_up_lattice(40, 60);
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    double const x = fxx * s.x[i] + fxy * s.y[i], y = fyx * s.x[i] + fyy * s.y[i];
    s.ux[i] = static_cast<float>(x - s.x[i]), s.uy[i] = static_cast<float>(y - s.y[i]);
    s.x[i] = x, s.y[i] = y;
  }
  return s;
}

TEST(StrainField, IsTheDifferenceOfThePrincipalNaturalStrains) {
  for (float const strain : shear_strain(deformed(1.1, 0, 0, 0.85))) ASSERT_NEAR(strain, std::log(1.1 / 0.85), 1e-4);
  double const shear = 0.5;  // simple shear: l1 / l2 = (g / 2 + sqrt(1 + g^2 / 4))^2
  for (float const strain : shear_strain(deformed(1, shear, 0, 1)))
    ASSERT_NEAR(strain, 2 * std::log(shear / 2 + std::sqrt(1 + shear * shear / 4)), 1e-4);
}

TEST(StrainField, IsNotMadeByTurningOrSwelling) {
  for (float const strain : shear_strain(deformed(std::cos(0.7), -std::sin(0.7), std::sin(0.7), std::cos(0.7))))
    ASSERT_NEAR(strain, 0, 1e-4);
  for (float const strain : shear_strain(deformed(1.2, 0, 0, 1.2))) ASSERT_NEAR(strain, 0, 1e-4);
}

TEST(StrainField, FindsTheBandAndSurvivesADiscThatFlewAway) {
  Snapshot s = made_up_lattice(40, 60);
  double const middle = s.top / 2, half = 0.1 * s.top;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.ux[i] = static_cast<float>(std::clamp(s.y[i] - middle, -half, half));
    s.x[i] += double(s.ux[i]);
  }
  std::vector<float> const strain = shear_strain(s);
  EXPECT_NEAR(strain[20 + 40 * 30], 2 * std::log(0.5 + std::sqrt(1.25)), 0.05);
  EXPECT_NEAR(strain[20 + 40 * 3], 0, 1e-4);
  s.x[0] = 1e6, s.y[0] = -1e6;
  EXPECT_EQ(shear_strain(s).size(), s.x.size());
  EXPECT_TRUE(std::isnan(shear_strain(made_up_lattice(1, 1)).at(0))) << "one particle has no strain";
}

TEST(StrainField, IsNotKnownWhereDiscsLieInALine) {
  Snapshot s = made_up_lattice(60, 1);
  for (float const strain : shear_strain(s)) ASSERT_TRUE(std::isnan(strain));
  for (std::size_t i = 0; i < s.x.size(); ++i) s.y[i] += (i % 2 == 0 ? 0.5 : -0.5) * s.d50;  // two lines are a plane
  std::vector<float> const strain = shear_strain(s);
  for (std::size_t i = 10; i < 50; ++i) ASSERT_NEAR(strain[i], 0, 1e-6) << i;  // at the ends there are too few
}

TEST(PrincipalAxes, AreThoseOfATurnedTensor) {
  for (double const angle : {0.0, 0.3, 1.2, 1.5707963, 2.5, 3.1}) {
    double const c = std::cos(angle), s = std::sin(angle);
    PrincipalAxes const axes = principal_axes(5 * c * c + 2 * s * s, 5 * s * s + 2 * c * c, 3 * c * s);
    EXPECT_NEAR(axes.major, 5, 1e-12);
    EXPECT_NEAR(axes.minor, 2, 1e-12);
    EXPECT_NEAR(axes.direction, angle, 1e-7);
  }
  EXPECT_EQ(principal_axes(-1, -1, 0).major, -1);
}

TEST(PrincipalStress, IsTheStressOfTheDiscsOverTheWholeBox) {
  Snapshot s = made_up_lattice(20, 30);
  s.stress_xx.assign(s.x.size(), 1e6f), s.stress_yy.assign(s.x.size(), 3e6f), s.stress_xy.assign(s.x.size(), 0.0f);
  double const solid = std::acos(-1.0) / 4;  // of a square lattice
  PrincipalAxes const stress = principal_stress(s);
  EXPECT_NEAR(stress.major / 3e6, solid, 1e-6);
  EXPECT_NEAR(stress.minor / 1e6, solid, 1e-6);
  EXPECT_NEAR(stress.direction, std::acos(-1.0) / 2, 1e-9);
  EXPECT_EQ(principal_stress(Snapshot()).major, 0);
}

TEST(Surroundings, AreTheDiscsWithinADistanceAndThePairsBetweenThem) {
  Snapshot s = made_up_lattice(20, 20);
  s.x[3] = std::nan("");
  double const x = s.x[210], y = s.y[210], distance = 3.5 * 2 * static_cast<double>(s.radius[0]);
  Snapshot const part = surroundings(s, x, y, distance);
  std::size_t discs = 0, pairs = 0;
  auto const near = [&](std::size_t i) { return std::hypot(s.x[i] - x, s.y[i] - y) <= distance; };
  for (std::size_t i = 0; i < s.id.size(); ++i) discs += near(i) ? 1 : 0;
  for (std::size_t k = 0; k < s.a.size(); ++k)
    pairs += near(static_cast<std::size_t>(s.a[k])) && near(static_cast<std::size_t>(s.b[k])) ? 1 : 0;
  EXPECT_GT(discs, 30u);
  EXPECT_EQ(part.id.size(), discs);
  EXPECT_EQ(part.a.size(), pairs);
  EXPECT_EQ(part.normal_force.size(), pairs);
  EXPECT_EQ(part.vx.size(), discs);
  for (std::size_t k = 0; k < part.a.size(); ++k) {
    auto const a = static_cast<std::size_t>(part.a[k]), b = static_cast<std::size_t>(part.b[k]);
    EXPECT_LT(std::hypot(part.x[a] - part.x[b], part.y[a] - part.y[b]), 2.5 * 2 * static_cast<double>(s.radius[0]))
        << "numbered anew";
  }
}

}  // namespace
}  // namespace clathra
