/// Hydrate that changes in stages of a test: increments, ends, failure, energy, restarts.
#include <gtest/gtest.h>

#include "domain/scene/phase_boundary.hpp"
#include "stage_run.hpp"

namespace clathra {
namespace {

/// A small specimen with 41 % hydrate.
Scene hydrate_sand(std::vector<LoadingStage> stages) {
  Scene scene = with(std::move(stages));
  scene.hydrate.saturation = 0.41;
  return scene;
}

LoadingStage warming(double deviator, double temperature = 14, double saturation = 0.2) {
  LoadingStage stage("warming", SideScene::at_stress(1e6 + deviator), SideScene::at_stress(1e6));
  stage.increments = 5;
  stage.hydrate.temperature = temperature;
  stage.hydrate.saturation = saturation;
  stage.until.rest = true;
  stage.until.axial_strain = 0.2;
  return stage;
}

TEST(HydrateStages, LoseTheirBondsIncrementByIncrementAndKeepTheLedger) {
  using enum ContactCoupling;
  using enum HydrateLoss;
  for (auto const& [coupling, loss] : {std::pair{parallel, critical_thickness},
                                       {replaces, critical_thickness},
                                       {replaces_keeping_force, critical_thickness},
                                       {parallel, recession},
                                       {parallel, uniform}}) {
    Scene scene = hydrate_sand({warming(0.3e6)});
    scene.hydrate.loss = loss;
    scene.bond.contact_coupling = coupling;
    scene.bond.after_consolidation = coupling != ContactCoupling::replaces;
    scene.output.energy = true;
    BiaxialTest test(scene, small_specimen(), {});
    HistoryRow const first = test.record();
    std::vector<HistoryRow> rows;
    while (!test.finished())
      if (test.advance(100'000)) rows.push_back(test.record());
    StageResult const result = test.stage_results().front();
    EXPECT_EQ(result.ended_by, "rest");
    EXPECT_EQ(result.numbers.at("end_temperature_degC"), 14);
    EXPECT_GE(rows.size(), 6u) << "five increments at least, and the load before them";
    EXPECT_EQ(rows.back().bonds_intact, 0);
    EXPECT_EQ(rows.back().broken.total(), first.bonds_intact + first.broken.total());
    EXPECT_GT(rows.back().broken[BreakMode::dissolved], first.bonds_intact / 2);
    EXPECT_LT(rows.back().boundary_K, 0);
    EXPECT_GT(first.boundary_K, 4);
    for (std::size_t i = 1; i < rows.size(); ++i) {
      EXPECT_GE(rows[i].temperature, rows[i - 1].temperature);
      EXPECT_LE(rows[i].saturation_pct, rows[i - 1].saturation_pct);
    }
    EnergyRow const energy = test.energy();
    EXPECT_LT(std::abs(energy.residual), 1e-3 * (std::abs(energy.boundary_work) + std::abs(energy.dissolved)));
    EXPECT_GT(std::abs(energy.dissolved), 1e-2 * energy.boundary_work) << "an account of its own, of some size";
  }
}

TEST(HydrateStages, DoNotKnowThePaceOfTheirCallerNorRestarts) {
  Scene scene = hydrate_sand({warming(0.3e6)});
  for (auto const& [precision, loss] : {std::pair{Precision::full, HydrateLoss::critical_thickness},
                                        {Precision::mixed, HydrateLoss::critical_thickness},
                                        {Precision::mixed, HydrateLoss::recession},
                                        {Precision::full, HydrateLoss::uniform}}) {
    scene.run.precision = precision;
    scene.hydrate.loss = loss;
    StageRun const whole = run_stages(scene);
    for (StageRun const& other : {run_stages(scene, 37), run_stages(scene, 700, 1)}) {
      ASSERT_EQ(other.rows.size(), whole.rows.size());
      for (std::size_t i = 0; i < whole.rows.size(); ++i) {
        EXPECT_EQ(other.rows[i].step, whole.rows[i].step);
        EXPECT_EQ(other.rows[i].q_Pa, whole.rows[i].q_Pa);
        EXPECT_EQ(other.rows[i].bonds_intact, whole.rows[i].bonds_intact);
      }
      EXPECT_EQ(other.hash, whole.hash);
    }
  }
}

/// Where nothing changes nothing is touched.
TEST(HydrateStages, OfAConstantClimateLeaveTheState) {
  LoadingStage still = warming(0.3e6, 5, 0.41), without = still;
  without.hydrate = {};
  without.increments = 1;
  for (Precision const precision : {Precision::full, Precision::mixed}) {
    Scene scene = hydrate_sand({without}), same = hydrate_sand({still});
    scene.run.precision = same.run.precision = precision;
    BiaxialTest one(scene, small_specimen(), {}), other(same, small_specimen(), {});
    while (!one.finished()) (void)one.advance(1);
    std::int64_t const steps = one.record().step;
    while (other.record().step < steps) (void)other.advance(1);
    EXPECT_EQ(other.state_hash(), one.state_hash());
    (void)other.advance(1);  // the first increment, which is none, and a step
    EXPECT_FALSE(other.finished());
    EXPECT_EQ(other.record().broken[BreakMode::dissolved], 0);
  }
}

/// What bears a load with its hydrate, and not without, fails on the way: the test says where.
TEST(HydrateStages, FailWhereTheLoadIsMoreThanTheSandBears) {
  Scene scene = hydrate_sand({warming(2.6e6)});
  StageResult const result = run_stages(scene).stages.front();
  EXPECT_EQ(result.numbers.at("failed"), 1) << result.ended_by;
  EXPECT_GT(result.numbers.at("failed_temperature_degC"), 5);
  EXPECT_LT(result.numbers.at("failed_saturation"), 0.41);
  EXPECT_NE(result.warnings.back().find("MPa of pore pressure and a saturation of"), std::string::npos) << result.warnings.back();
}

/// Undrained: the pressure stays until the boundary, follows it from there, and the stage ends as it uses the stresses up.
TEST(HydrateStages, UndrainedFollowTheBoundaryUntilNoStressIsLeft) {
  LoadingStage stage = warming(0.2e6, 14, 0.41);
  stage.increments = 40;
  stage.hydrate.undrained = true;
  Scene scene = hydrate_sand({stage});
  StageRun const course = run_stages(scene);
  EXPECT_EQ(course.stages.front().ended_by, "no effective stress");
  double const boundary = equilibrium_temperature(8e6, 35);
  for (HistoryRow const& row : course.rows) {
    double const pressure = row.temperature <= boundary ? 8e6 : equilibrium_pressure(row.temperature, 35);
    EXPECT_NEAR(row.pore_pressure, pressure, 1);
    if (&row == &course.rows.back() || row.temperature == 5) continue;  // the load is being put on at first
    EXPECT_NEAR(row.sigma3_Pa, 1e6 - (pressure - 8e6), 0.02e6) << row.temperature;
    EXPECT_NEAR(row.q_Pa, 0.2e6, 0.02e6) << row.temperature;
  }
  EXPECT_NEAR(course.rows.back().pore_pressure, 9e6, 0.2e6);
}

/// The effective stresses follow the pressure at constant total stress, there and back.
TEST(HydrateStages, AtConstantTotalStressBearWhatThePressureLeaves) {
  LoadingStage down = warming(0.2e6, not_given, 0.3);
  down.name = "down";
  down.hydrate.pore_pressure = 6e6;
  down.hydrate.constant_total_stress = true;
  LoadingStage up = down;
  up.name = "up";
  up.vertical = SideScene::at_stress(3.2e6);
  up.lateral = SideScene::at_stress(3e6);
  up.hydrate.pore_pressure = 8e6;
  up.hydrate.saturation = not_given;
  StageRun const course = run_stages(hydrate_sand({down, up}));
  EXPECT_NEAR(course.of("down").back().sigma3_Pa, 3e6, 0.02e6);
  EXPECT_NEAR(course.of("down").back().q_Pa, 0.2e6, 0.02e6);
  EXPECT_NEAR(course.of("up").back().sigma3_Pa, 1e6, 0.01e6);
  EXPECT_EQ(course.of("up").back().saturation_pct, 30) << "it stays";
}

}  // namespace
}  // namespace clathra
