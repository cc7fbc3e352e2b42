/// Which bonds the laws of loss take first, and that they end alike.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "domain/scene/dissociation.hpp"
#include "kernels/bond_geometry.hpp"
#include "stage_run.hpp"

namespace clathra {
namespace {

/// Spearman's: the correlation of ranks, ties sharing theirs.
double rank_correlation(std::vector<double> const& a, std::vector<double> const& b) {
  auto const ranks = [](std::vector<double> const& values) {
    std::vector<double> rank(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      for (double const other : values) rank[i] += other < values[i] ? 1 : other == values[i] ? 0.5 : 0;
    return rank;
  };
  std::vector<double> const x = ranks(a), y = ranks(b);
  double const n = static_cast<double>(x.size()), mean = n / 2;
  double xy = 0, xx = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean) * (y[i] - mean);
    xx += (x[i] - mean) * (x[i] - mean);
    yy += (y[i] - mean) * (y[i] - mean);
  }
  return xy / std::sqrt(xx * yy);
}

/// Which bonds go first, over one loss of 41 % of hydrate under a deviator.
struct LossOrder {
  double of_gap = 0;     ///< rank correlation of h_cr with when bonds over gaps dissolved
  double of_width = 0;   ///< and of B of formation, of all
  double dissolved = 0;  ///< share of all bonds
  double at_once = 0;    ///< share of these that left in the last increment
  double vertical = 0;   ///< mean of -cos 2 theta over those that broke: 1 vertical, -1 horizontal
  double left = 0;       ///< bonds at the end
};

/// The order of those that dissolved, and the orientation of the others.
LossOrder order_of(BreakEvents const& events, Specimen const& formed) {
  std::map<int, double> radius;
  for (std::size_t i = 0; i < formed.size(); ++i) radius[formed.id[i]] = formed.radius[i];
  std::vector<double> when, width, when_over_gap, gap;
  LossOrder order;
  double broken = 0;
  for (std::size_t k = 0; k < events.rows.size(); ++k) {
    BreakEvent const& event = events.rows[k];
    BreakDetails const& details = events.details[k];
    if (event.mode != static_cast<int>(BreakMode::dissolved)) {
      order.vertical -= std::cos(details.orientation * pi / 90);
      ++broken;
      continue;
    }
    when.push_back(static_cast<double>(event.step));
    width.push_back(
        bond_width(common_radius(radius.at(event.id_a), radius.at(event.id_b)), formed.critical_thickness - details.thickness));
    if (!(details.thickness > 0)) continue;
    when_over_gap.push_back(when.back());
    gap.push_back(details.thickness);
  }
  order.of_gap = rank_correlation(when_over_gap, gap);
  order.of_width = rank_correlation(when, width);
  order.dissolved = static_cast<double>(when.size()) / static_cast<double>(events.rows.size());
  order.at_once = static_cast<double>(std::count(when.begin(), when.end(), when.back())) / static_cast<double>(when.size());
  order.vertical /= broken;
  return order;
}

LossOrder order_by(HydrateLoss loss) {
  LoadingStage stage("warming", SideScene::at_stress(2e6), SideScene::at_stress(1e6));
  stage.increments = 30;
  stage.hydrate.saturation = 0.2;
  stage.until.rest = true;
  stage.until.axial_strain = 0.2;
  Scene scene = with({stage});
  scene.hydrate.saturation = 0.41;
  scene.hydrate.loss = loss;
  scene.output.event_details = true;
  BiaxialTest test(scene, small_specimen(), {});
  Specimen const formed = test.specimen();
  while (!test.finished()) (void)test.advance(100'000);
  LossOrder order = order_of(test.take_events(), formed);
  order.left = static_cast<double>(test.record().bonds_intact);
  EXPECT_EQ(test.stage_results().front().ended_by, "rest");
  return order;
}

TEST(HydrateLoss, TakesWideGapsOrNarrowBondsOrLoadedOnesFirstAndEndsAlike) {
  LossOrder const gaps = order_by(HydrateLoss::critical_thickness), widths = order_by(HydrateLoss::recession),
                  loads = order_by(HydrateLoss::uniform);
  for (LossOrder const* const order : {&gaps, &widths, &loads}) {
    EXPECT_EQ(order->left, 0);
    EXPECT_LT(order->vertical, -0.4) << "what breaks is pulled: it lies across the larger stress";
  }
  EXPECT_LT(gaps.of_gap, -0.98);
  EXPECT_GT(widths.of_gap, -0.95);
  EXPECT_LT(gaps.of_width, 0.97);
  EXPECT_GT(widths.of_width, 0.98);
  EXPECT_LT(gaps.at_once, 0.1);
  EXPECT_LT(widths.at_once, 0.1);
  EXPECT_EQ(loads.at_once, 1) << "none without a load that it does not bear, until the end";
  EXPECT_GT(loads.dissolved, 0.85);
  EXPECT_LT(gaps.dissolved, 0.85);
  EXPECT_LT(widths.dissolved, 0.85);
}

/// A rate of dissociation: the saturation is that of the path, however often the test is taken apart on its way.
TEST(HydrateLoss, ByARateGoesAlongItsPathWhateverThePaceAndTheRestarts) {
  LoadingStage stage("warming", SideScene::at_stress(1.3e6), SideScene::at_stress(1e6));
  stage.increments = 5;
  stage.hydrate.temperature = 12;
  stage.hydrate.dissociation = Dissociation::clarke_2001;
  stage.hydrate.duration = 3600;
  stage.until.rest = true;
  stage.until.axial_strain = 0.2;
  Scene scene = with({stage});
  scene.hydrate.saturation = 0.41;
  scene.hydrate.loss = HydrateLoss::recession;
  scene.run.precision = Precision::mixed;
  StageRun const whole = run_stages(scene), other = run_stages(scene, 330, 1);
  EXPECT_EQ(other.hash, whole.hash);
  ASSERT_EQ(other.rows.size(), whole.rows.size());
  HydratePath const path{scene, whole.specimen.d50, whole.specimen.critical_thickness, stage.hydrate, {5, 8e6, 0.41}};
  double const left = path.at(1).saturation;
  EXPECT_TRUE(left > 0.21 && left < 0.39) << left;
  EXPECT_EQ(whole.stages.front().numbers.at("end_saturation"), left);
  EXPECT_EQ(whole.rows.front().saturation_pct, 100 * 0.41);
  EXPECT_LT(whole.rows.back().bonds_intact, whole.rows.front().bonds_intact);
  for (std::size_t i = 1; i < whole.rows.size(); ++i) {
    EXPECT_LE(whole.rows[i].saturation_pct, whole.rows[i - 1].saturation_pct);
    if (whole.rows[i].boundary_K > 0) EXPECT_EQ(whole.rows[i].saturation_pct, 100 * 0.41) << "stable";
  }
}

/// What scatters is kept nowhere: the numbers of bonds are there again after a restart.
TEST(StrengthScatter, KeepsItsBondsThroughRestarts) {
  Scene scene = small_test();
  scene.test.axial_strain = 0.01;
  scene.bond.strength_modulus = 4;
  for (Precision const precision : {Precision::full, Precision::mixed}) {
    scene.run.precision = precision;
    StageRun const whole = run_stages(scene), other = run_stages(scene, 900, 1);
    EXPECT_EQ(other.hash, whole.hash);
    scene.bond.strength_seed += 1;
    EXPECT_NE(run_stages(scene).hash, whole.hash);
  }
}

}  // namespace
}  // namespace clathra
