/// Stages that cannot come to their end, do not come to rest, or fail under their load.
#include <gtest/gtest.h>

#include "stage_run.hpp"

namespace clathra {
namespace {

/// Runs stages and wants them to be refused with these words.
void expect_refusal(std::vector<LoadingStage> stages, std::string const& words) {
  try {
    run_stages(with(std::move(stages)));
    ADD_FAILURE() << "ended";
  } catch (Refused const& refusal) {
    EXPECT_NE(std::string(refusal.what()).find(words), std::string::npos) << refusal.what();
  }
}

StageRun under_dead_load(double dead_load, double axial_strain = 0.06) {
  Scene scene = sand();
  scene.test.kind = TestKind::creep;
  scene.test.axial_strain = axial_strain;
  scene.test.dead_load = dead_load;
  return run_stages(scene);
}

/// Also where platens are at their largest speed for long, for the load is still being put on.
TEST(Stages, BearADeadLoad) {
  for (double const load : {0.3e6, 0.9e6}) {
    StageRun const course = under_dead_load(load);
    EXPECT_EQ(course.stages.front().ended_by, "rest");
    EXPECT_EQ(course.stages.front().numbers.at("failed"), 0) << load;
    EXPECT_NEAR(course.rows.back().sigma1_Pa, 1e6 + load, 0.01e6);
  }
}

TEST(Stages, SayThatTheyFailedUnderADeadLoad) {
  StageResult const result = under_dead_load(3e6).stages.front();
  EXPECT_EQ(result.ended_by, "axial strain");
  EXPECT_EQ(result.numbers.at("failed"), 1);
  EXPECT_LT(result.numbers.at("failed_eps1"), 0.06);
  EXPECT_GT(result.numbers.at("failed_q_Pa"), 1e6) << "not while the load was put on";
  EXPECT_LT(result.numbers.at("failed_q_Pa"), 3e6);
  EXPECT_NE(result.warnings.back().find("failed under its dead load"), std::string::npos);
}

TEST(Stages, SayNotWhetherALoadIsBorneWhereTheyAreCutOff) {
  StageResult const result = under_dead_load(0.9e6, 5e-4).stages.front();
  EXPECT_EQ(result.ended_by, "axial strain");
  EXPECT_FALSE(result.numbers.contains("failed"));
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_NE(result.warnings.back().find("whether it bears its load is not known"), std::string::npos);
}

/// The strain rate falls as a specimen comes to bear its load.
TEST(Stages, EndWhereTheirStrainRateHasFallen) {
  double path = 0;
  for (double const rate : {20.0, 2.0}) {
    LoadingStage load("load", SideScene::at_stress(1.5e6), SideScene::at_stress(1e6));
    load.until.strain_rate = rate;
    StageRun const course = run_stages(with({load}));
    EXPECT_EQ(course.stages.front().ended_by, "strain rate");
    std::vector<HistoryRow> const& rows = course.rows;
    EXPECT_GT(rows.back().eps1, path) << "the lower the rate, the later";
    path = rows.back().eps1;
    double fastest = 0;
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (rows[i].time_s > rows[i - 1].time_s)
        fastest = std::max(fastest, (rows[i].eps1 - rows[i - 1].eps1) / (rows[i].time_s - rows[i - 1].time_s));
    EXPECT_GT(fastest, 2 * rate) << "it was faster before";
  }
}

TEST(Stages, ThatCannotComeToTheirEndAreRefused) {
  LoadingStage shear("shear", SideScene::at_inertial_number(9e-3), SideScene::at_stress(1e6));
  shear.until.deviator_stress = 50e6;
  expect_refusal({shear}, "stage 'shear' has not come to its end within a path of 50 %");
}

TEST(Stages, ThatRestShortOfTheirEndAreRefused) {
  LoadingStage compression("compression", SideScene::at_stress(1.5e6), SideScene::at_stress(1.5e6));
  compression.until.mean_stress = 3e6;
  expect_refusal({compression}, "stage 'compression' has come to rest under its stresses without coming to its end");
}

TEST(Stages, ThatGoAwayFromTheirEndAreRefused) {
  LoadingStage shear("shear", SideScene::at_inertial_number(5e-4), SideScene::at_stress(1e6)),
      unloading = LoadingStage("unloading", SideScene::at_inertial_number(-5e-4), SideScene::at_stress(1e6));
  shear.until.axial_strain = 0.004;
  unloading.until.axial_strain = 0.006;
  expect_refusal({shear, unloading}, "and goes away from 0.6 %, where it is to end");
}

TEST(Stages, ThatDoNotComeToRestAreRefusedOrSaySo) {
  LoadingStage compression("compression", SideScene::at_stress(2e6), SideScene::held());
  compression.increments = 2;
  compression.until.rest = true;
  Scene scene = with({compression});
  BiaxialTest const prepared(scene, small_specimen(), {});
  scene.test.consolidation_steps = 300;  // too few from here on
  BiaxialTest refused(scene, prepared.state(), Ranks{});
  EXPECT_THROW((void)refused.advance(10'000), Refused);
  scene.stages.front().allow_unsettled = true;
  BiaxialTest allowed(scene, prepared.state(), Ranks{});
  while (!allowed.finished()) (void)allowed.advance(10'000);
  StageResult const result = allowed.stage_results().front();
  EXPECT_EQ(result.ended_by, "steps, not at rest");
  EXPECT_EQ(result.numbers.at("unsettled"), 1);
  EXPECT_EQ(result.numbers.at("quasi_static"), 0);
}

}  // namespace
}  // namespace clathra
