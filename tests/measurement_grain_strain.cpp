/// The strain field whose nodes ride on grains and turn with them, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "domain/measurement/strain_field.hpp"
#include "planted_band.hpp"

namespace clathra {
namespace {

/// Discs of three sizes at places of their own, which turned before.
Snapshot scattered() {
  Snapshot s = PlantedBand{}.specimen().start;
  for (std::size_t i = 0; i < s.radius.size(); ++i) {
    s.radius[i] *= 0.8F + 0.2F * static_cast<float>(i % 3);
    s.angle[i] = static_cast<float>(static_cast<int>(i % 97) - 48) / 16;  // a rotation by sixteenths is exact
  }
  return s;
}

/// x' = F x + c, and each disc turned by an angle.
Snapshot moved(Snapshot s, std::array<double, 4> const& f, double cx, double cy, double turned) {
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    double const x = s.x[i], y = s.y[i];
    s.x[i] = f[0] * x + f[1] * y + cx, s.y[i] = f[2] * x + f[3] * y + cy;
    s.ux[i] = static_cast<float>(s.x[i] - x), s.uy[i] = static_cast<float>(s.y[i] - y);
    s.angle[i] += static_cast<float>(turned);
  }
  return s;
}

std::array<double, 4> turn(double angle) { return {std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)}; }

std::array<double, 4> mean_deformation(StrainGrid const& grid) {
  std::array<double, 4> mean{};
  for (auto const& f : grid.deformation)
    for (std::size_t k = 0; k < 4; ++k) mean[k] += f[k] / static_cast<double>(grid.deformation.size());
  return mean;
}

/// The discs at these places, in this order.
void in_order(Snapshot& s, std::vector<std::size_t> const& places) {
  auto const pick = [&](auto& list) {
    auto const old = list;
    list.clear();
    for (std::size_t const i : places) list.push_back(old[i]);
  };
  pick(s.id), pick(s.x), pick(s.y), pick(s.radius), pick(s.angle), pick(s.ux), pick(s.uy);
}

void shuffle(Snapshot& s, unsigned seed) {
  std::vector<std::size_t> places(s.id.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::shuffle(places.begin(), places.end(), std::mt19937(seed));
  in_order(s, places);
}

TEST(GrainStrain, CoversTheSpecimenWithCellsOfOneD50) {
  StrainGrid const grid = grain_strain(scattered(), scattered());
  EXPECT_NEAR(grid.columns, 69, 1);
  EXPECT_NEAR(grid.rows, 139, 1);
  EXPECT_EQ(grid.spacing, PlantedBand::d50);
  ASSERT_EQ(grid.shear.size(), static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
  ASSERT_EQ(grid.x.size(), grid.shear.size());
  ASSERT_EQ(grid.deformation.size(), grid.shear.size());
  EXPECT_NEAR(grid.x.front(), grid.left + PlantedBand::d50 / 2, 1e-12);
  EXPECT_NEAR(grid.y.back(), grid.bottom + (grid.rows - 0.5) * PlantedBand::d50, 1e-12);
  EXPECT_EQ(grain_strain(scattered(), scattered(), 0.5).columns / 2, grid.columns);
}

TEST(GrainStrain, IsNotMadeByMovingAndTurning) {
  for (double const angle : {0.0, 0.0625, -0.75, 2.5})
    for (float const shear : grain_strain(scattered(), moved(scattered(), turn(angle), 0.3, -7, angle)).shear)
      ASSERT_LT(shear, 1e-11) << angle;  // displacements of 7 m over cells of 1 mm
}

TEST(GrainStrain, SeesGrainsThatTurnWithoutWhatIsAroundThem) {
  StrainGrid const grid = grain_strain(scattered(), moved(scattered(), {1, 0, 0, 1}, 0, 0, 0.25));
  double const mean = std::accumulate(grid.shear.begin(), grid.shear.end(), 0.0) / static_cast<double>(grid.shear.size());
  EXPECT_GT(mean, 0.05);  // 2 sin(1/8) times ways of 0.4 PlantedBand::d50, over a PlantedBand::d50
  for (float const shear : shear_strain(moved(scattered(), {1, 0, 0, 1}, 0, 0, 0.25))) ASSERT_LT(shear, 1e-6);
}

TEST(GrainStrain, OfAHomogeneousOneIsRightInTheMean) {
  for (auto const& f : {std::array<double, 4>{1.02, 0, 0, 0.95}, {1.2, 0.1, -0.05, 0.7}, {1, 0.3, 0, 1}}) {
    std::array<double, 4> const mean = mean_deformation(grain_strain(scattered(), moved(scattered(), f, 0, 0, 0)));
    double const size = std::hypot(f[0] - 1, f[1], f[2]) + std::abs(f[3] - 1), smallest = 70 * PlantedBand::d50;
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(mean[k], f[k], size * PlantedBand::d50 / smallest) << k;  // 2 r / L
  }
}

TEST(StrainField, OfAHomogeneousOneIsExact) {
  for (float const strain : shear_strain(moved(scattered(), {1.02, 0, 0, 0.95}, 0, 0, 0)))
    ASSERT_NEAR(strain, std::log(1.02 / 0.95), 1e-5);  // displacements are floats
}

TEST(GrainStrain, IsGreensStrainOfTheCellsDeformation) {
  StrainGrid const grid = grain_strain(scattered(), moved(scattered(), {1.2, 0.1, -0.05, 0.7}, 0, 0, 0.5));
  for (std::size_t k = 0; k < grid.shear.size(); ++k) {
    auto const& f = grid.deformation[k];
    double const xx = f[0] * f[0] + f[2] * f[2], yy = f[1] * f[1] + f[3] * f[3], xy = f[0] * f[1] + f[2] * f[3];
    double const middle = (xx + yy) / 4, radius = std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy) / 2;
    ASSERT_NEAR(grid.shear[k], (middle + radius) - (middle - radius), 1e-6 * (1 + middle));
  }
}

/// Centres at whole numbers, PlantedBand::d50 = 1: nodes half a PlantedBand::d50 apart lie exactly between two or four of them.
Sheared even_lattice() {
  Draw draw(11);
  Sheared s;
  s.start.d50 = 1;
  for (int i = 0; i < 400; ++i) {
    s.start.id.push_back((i * 7919) % 400);
    s.start.x.push_back(i % 20), s.start.y.push_back(i / 20);
  }
  s.start.radius.assign(400, 0.5F), s.start.angle.assign(400, 0.0F), s.start.ux = s.start.uy = s.start.angle;
  s.now = s.start;
  for (std::size_t i = 0; i < 400; ++i)
    s.now.x[i] += draw.between(-0.1, 0.1), s.now.angle[i] = static_cast<float>(draw.between(-1, 1));
  return s;
}

TEST(GrainStrain, HasTheSameBitsForAnyOrderOfTheDiscs) {
  for (Sheared s : {PlantedBand{1, 8 * PlantedBand::d50, 0.1 * PlantedBand::d50}.specimen(), even_lattice()}) {
    StrainGrid const before = grain_strain(s.start, s.now, 0.5);
    for (unsigned seed = 1; seed <= 4; ++seed) {
      shuffle(s.start, seed), shuffle(s.now, seed + 10);
      StrainGrid const after = grain_strain(s.start, s.now, 0.5);
      EXPECT_EQ(before.shear, after.shear);
      EXPECT_EQ(before.deformation, after.deformation);
      EXPECT_EQ(before.x, after.x);
    }
  }
}

/// Two columns of two discs, nodes on the centres and halfway between them.
TEST(GrainStrain, TiesANodeBetweenTwoGrainsToTheOneOfTheSmallerId) {
  Snapshot start;
  start.d50 = 1;
  start.x = {0, 2, 0, 2}, start.y = {0, 0, 1, 1}, start.id = {7, 3, 8, 4};
  start.radius.assign(4, 0.5F), start.angle.assign(4, 0.0F);
  Snapshot now = start;
  now.x[0] -= 0.1, now.x[2] -= 0.1;  // ids 7 and 8 move away to the left
  StrainGrid const grid = grain_strain(start, now);
  ASSERT_EQ(grid.deformation.size(), 2U);
  EXPECT_NEAR(grid.deformation[0][0], 1.1, 1e-12) << "the middle nodes stay with 3 and 4";
  EXPECT_NEAR(grid.deformation[1][0], 1, 1e-12);
  std::swap(start.id[0], start.id[1]), std::swap(start.id[2], start.id[3]), now.id = start.id;
  EXPECT_NEAR(grain_strain(start, now).deformation[1][0], 1.1, 1e-12);
}

/// Without the discs of a circle about the middle.
Snapshot holed(Snapshot s, Snapshot const& places, double radius) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < s.x.size(); ++i)
    if (std::hypot(places.x[i], places.y[i]) > radius) kept.push_back(i);
  in_order(s, kept);
  return s;
}

TEST(GrainStrain, IsNotKnownInHolesAndOfDiscsThatAreGone) {
  Sheared const s = PlantedBand{}.specimen();
  Snapshot const hole = holed(s.start, s.start, 6 * PlantedBand::d50), gone = holed(s.now, s.start, 6 * PlantedBand::d50);
  for (StrainGrid const& grid : {grain_strain(hole, s.now), grain_strain(s.start, gone)})
    for (std::size_t k = 0; k < grid.shear.size(); ++k) {
      double const distance = std::hypot(grid.x[k], grid.y[k]) / PlantedBand::d50;
      if (distance < 3) {
        ASSERT_TRUE(std::isnan(grid.shear[k]) && std::isnan(grid.deformation[k][0])) << distance;
      }
      if (distance > 8) {
        ASSERT_EQ(grid.shear[k], 0) << distance;
      }
    }
  EXPECT_TRUE(grain_strain({}, {}).shear.empty());
}

TEST(GrainStrain, OfADiscIsThatOfTheCellWhereItWas) {
  Sheared const s = PlantedBand{0, 20 * PlantedBand::d50}.specimen();
  StrainGrid const grid = grain_strain(s.start, s.now);
  std::vector<float> const values = shear_at_discs(grid, s.now);
  ASSERT_EQ(values.size(), s.now.x.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::abs(s.start.y[i]) > 13 * PlantedBand::d50) {
      ASSERT_NEAR(values[i], 0, 1e-6);
    }
    auto const nearest = [&](double from, int count) {
      return std::clamp(static_cast<int>(std::floor(from / PlantedBand::d50)), 0, count - 1);
    };
    int const column = nearest(s.start.x[i] - grid.left, grid.columns), row = nearest(s.start.y[i] - grid.bottom, grid.rows);
    ASSERT_EQ(values[i], grid.shear[static_cast<std::size_t>(row * grid.columns + column)]);
  }
  EXPECT_TRUE(std::isnan(shear_at_discs({}, s.now).at(0)));
}

}  // namespace
}  // namespace clathra
