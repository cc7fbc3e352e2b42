/// What is said of a test that is not what it should be: not at rest before its shear, not balanced in it, grains too soft.
#include <gtest/gtest.h>

#include <algorithm>

#include "small_test.hpp"

namespace clathra {
namespace {

TEST(Consolidation, ThatIsCutShortIsSaidAndNeverCalledQuasiStatic) {
  Scene scene = small_test();
  BiaxialTest const whole(scene, small_specimen(), {});
  EXPECT_EQ(whole.preparation().at("quasi_static"), 1);
  EXPECT_TRUE(whole.warnings().empty());
  EXPECT_GT(whole.preparation().at("consolidation_steps"), 400);
  for (int const steps : {0, 350}) {
    scene.test.consolidation_steps = steps;
    scene.run.ignore_guards = false;
    EXPECT_THROW(BiaxialTest(scene, small_specimen(), {}), Refused) << "however many steps are stated";
    scene.run.ignore_guards = true;
    BiaxialTest const cut(scene, small_specimen(), {});
    EXPECT_EQ(cut.preparation().at("consolidation_steps"), steps);
    EXPECT_EQ(cut.preparation().at("quasi_static"), 0);
    ASSERT_EQ(cut.warnings().size(), 2u) << "before hydrate forms, and after";
    for (std::string const& warning : cut.warnings())
      EXPECT_NE(warning.find("within " + std::to_string(steps) + " steps"), std::string::npos) << warning;
  }
}

/// A time step so short that the specimen is nowhere near rest when the budget ends.
TEST(Consolidation, ThatDoesNotComeToRestIsRefused) {
  Scene scene = small_test();
  scene.specimen.particles = 60;
  scene.specimen.void_ratio = 0.3;
  scene.specimen.compaction_layers = 1;
  scene.hydrate.saturation = 0;
  Specimen const specimen = generate_specimen(scene, {}).specimen;
  scene.run.time_step_safety = 1e-3;
  try {
    BiaxialTest const test(scene, specimen, {});
    ADD_FAILURE() << "was sheared";
  } catch (Refused const& refusal) {
    std::string const text = refusal.what();
    EXPECT_NE(text.find("within 200000 steps: "), std::string::npos) << text;
    EXPECT_NE(text.find("of 1 MPa (at rest within 0.5 %)"), std::string::npos) << text;
    EXPECT_NE(text.find("test.consolidation_steps"), std::string::npos) << text;
  }
}

/// The mean stress of a specimen at rest is what all forces of its walls come to, shear as well as pressure.
void expect_stress_of_the_walls(BiaxialTest& test, double wall_friction) {
  HistoryRow const row = test.record();
  EXPECT_NEAR(row.sigma1_Pa, 1e6, 5e3) << wall_friction;
  EXPECT_NEAR(row.sigma3_Pa, 1e6, 5e3) << wall_friction;
  double const off =
      std::max(std::fabs(row.contact_sigma1_Pa / row.sigma1_Pa - 1), std::fabs(row.contact_sigma3_Pa / row.sigma3_Pa - 1));
  if (wall_friction == 0) EXPECT_LT(off, 5e-3);
  if (wall_friction == 0.5) EXPECT_GT(off, 5e-3) << "what such walls carry by shear";
}

TEST(Consolidation, OfRoughWallsComesToRestWithTheirShear) {
  for (double const wall_friction : {0.0, 0.04, 0.5}) {
    Scene scene = small_test();
    scene.test.wall_friction = wall_friction;
    BiaxialTest test(scene, small_specimen(), {});
    EXPECT_EQ(test.preparation().at("quasi_static"), 1) << wall_friction;
    EXPECT_LT(test.preparation().at("consolidation_steps"), 20000) << wall_friction;
    expect_stress_of_the_walls(test, wall_friction);
  }
}

/// The verdict on a shear and what it rests on.
struct Verdict {
  double quasi_static, checks, unbalanced, largest;
  std::vector<std::string> warnings;
};
Verdict verdict_on(Scene const& scene) {
  BiaxialTest test(scene, small_specimen(), {});
  EXPECT_EQ(test.preparation().at("quasi_static"), 1);
  while (!test.finished()) (void)test.advance(1000);
  StageRecord const checks = test.stage_results().front().numbers;
  return {test.preparation().at("quasi_static"), checks.at("checks"), checks.at("checks_unbalanced"),
          checks.at("largest_unbalanced"), test.stage_results().front().warnings};
}

TEST(QuasiStatic, IsTakenBackByAShearThatIsNotBalancedWhateverIsWritten) {
  Scene scene = small_test();
  scene.hydrate.saturation = 0;  // breaking bonds shake a slow shear, too
  scene.test.axial_strain = 0.01;
  scene.test.inertial_number = 2e-5;
  Verdict const slow = verdict_on(scene);
  EXPECT_EQ(slow.quasi_static, 1);
  EXPECT_EQ(slow.checks, 50);
  EXPECT_TRUE(slow.warnings.empty()) << slow.warnings[0];
  scene.hydrate.saturation = 0.55;
  scene.test.axial_strain = 0.02;
  scene.bond.rolling_lever = {0, 1.0 / 14};  // many break
  scene.test.inertial_number = 9e-4;         // no warning of the rate
  scene.test.max_platen_wave_stress = 0;
  for (int const records : {1, 7, 300}) {
    scene.output.records = records;
    Verdict const fast = verdict_on(scene);
    EXPECT_EQ(fast.quasi_static, 0);
    EXPECT_EQ(fast.checks, 100);
    EXPECT_GT(fast.unbalanced, 1);
    ASSERT_GE(fast.warnings.size(), 1u);
    EXPECT_NE(fast.warnings[0].find("out of balance on the way to the peak of q"), std::string::npos) << fast.warnings[0];
  }
}

TEST(WaveNumber, BoundsTheRateByTheHeightOfTheSpecimenThatIsSheared) {
  Scene scene = small_test();
  BiaxialTest free(scene, small_specimen(), {});
  StageRecord const plan = free.plan();
  double const wave = plan.at("platen_wave_stress"), rate = plan.at("strain_rate_per_s");
  EXPECT_EQ(free.preparation().count("rate_share"), 0u);
  scene.test.max_platen_wave_stress = 1.01 * wave;
  BiaxialTest const loose(scene, small_specimen(), {});
  EXPECT_EQ(loose.plan(), plan) << "a bound that is not met changes nothing";
  EXPECT_EQ(loose.state_hash(), free.state_hash());
  scene.test.max_platen_wave_stress = wave / 4;
  BiaxialTest bounded(scene, small_specimen(), {});
  EXPECT_EQ(bounded.plan().at("platen_wave_stress"), wave / 4);
  EXPECT_NEAR(bounded.plan().at("strain_rate_per_s"), rate / 4, 1e-12 * rate);
  EXPECT_NEAR(bounded.plan().at("inertial_number"), scene.test.inertial_number / 4, 1e-16);
  EXPECT_NEAR(bounded.preparation().at("rate_share"), 0.25, 1e-12);
  EXPECT_NEAR(bounded.record().platen_wave_stress, wave / 4, 1e-3 * wave);
  // The rate of a test is chosen once: as it gets lower the bound does not let it go faster.
  scene.test.axial_strain = 0.001;
  while (!bounded.finished() && bounded.axial_strain() < 0.001) (void)bounded.advance(1000, 0.001);
  HistoryRow const row = bounded.record();
  EXPECT_LT(row.platen_wave_stress, wave / 4);
  EXPECT_NEAR(row.platen_wave_stress, wave / 4 * (1 - row.eps1), 2e-3 * wave);
}

// A check, a row of history and one of energies may fall on one step and share what was measured; the next step is another state.
TEST(Records, AreMeasuredAnewAtEachStep) {
  Scene scene = small_test();
  scene.test.axial_strain = 0.01;
  scene.test.inertial_number = 2e-5;
  scene.output.records = 10;
  scene.output.energy = true;
  BiaxialTest test(scene, small_specimen(), {});
  double grain_energy = 0;
  while (!test.finished()) {
    while (!test.advance(1000)) continue;
    HistoryRow const row = test.record();
    EXPECT_NEAR(row.contact_sigma1_Pa, row.sigma1_Pa, 0.05 * row.sigma1_Pa);
    EXPECT_GT(test.energy().grain_elastic, grain_energy);  // up to the peak
    grain_energy = test.energy().grain_elastic;
  }
  EXPECT_GT(test.record().sigma1_Pa, 2 * scene.test.confining_stress);
}

TEST(Overlap, OfMoreThanATenthOfTheRadiusIsSaidWithShareAndMaximum) {
  Scene scene = small_test();
  scene.hydrate.saturation = 0;
  scene.test.axial_strain = 0.01;
  scene.grains.normal_stiffness = 2.4e7;
  scene.grains.shear_stiffness = 1.6e7;
  BiaxialTest test(scene, small_specimen(), {});
  while (!test.finished()) (void)test.advance(1000);
  StageRecord const checks = test.stage_results().front().numbers;
  EXPECT_GT(checks.at("deep_overlap_share"), 0.01);
  EXPECT_GT(checks.at("deepest_overlap"), 0.1);
  EXPECT_LT(checks.at("deepest_overlap"), 1);
  bool said = false;
  std::vector<StageResult> const stages = test.stage_results();
  for (std::string const& text : stages.front().warnings)
    said = said || text.find("overlapped by more than 10 % of the smaller radius") != std::string::npos;
  EXPECT_TRUE(said);
}

bool said(std::vector<std::string> const& warnings, std::string const& part) {
  return std::any_of(warnings.begin(), warnings.end(), [&](std::string const& text) { return text.find(part) != text.npos; });
}

/// Loose sand made with more friction than its grains have in the test.
TEST(Density, ThatConsolidationChangesIsSaid) {
  Scene scene = small_test();
  scene.hydrate.saturation = 0;
  scene.specimen.void_ratio = 0.28;
  Specimen const specimen = generate_specimen(scene, {}).specimen;
  std::string const part = "of it elastic): what is tested is denser than what was made";
  EXPECT_FALSE(said(BiaxialTest(scene, specimen, {}).warnings(), part));
  scene.grains.friction = 0.02;
  BiaxialTest const slippery(scene, specimen, {});
  EXPECT_TRUE(said(slippery.warnings(), part));
  EXPECT_LT(slippery.preparation().at("void_ratio_after_consolidation"), 0.25);
}

TEST(Bonds, ThatBreakBeforeTheTestAreSaid) {
  Scene scene = small_test();
  scene.bond.after_consolidation = false;
  std::string const part = "% of the bonds broke before the test";
  EXPECT_FALSE(said(BiaxialTest(scene, small_specimen(), {}).warnings(), part));
  scene.test.confining_stress = 8e6;
  scene.hydrate.saturation = 0.3;
  scene.bond.rolling_lever = {0, 1.0 / 40};
  BiaxialTest const weak(scene, small_specimen(), {});
  EXPECT_GT(weak.preparation().at("broken_in_consolidation"), 0.2 * weak.preparation().at("bonds"));
  EXPECT_TRUE(said(weak.warnings(), part));
}

TEST(Collapse, OfAForcedTestIsSaid) {
  Scene scene = small_test();
  scene.hydrate.saturation = 0;
  scene.test.axial_strain = 1e-3;
  scene.run.ignore_guards = true;
  scene.grains.normal_stiffness = 6e6, scene.grains.shear_stiffness = 4e6;
  BiaxialTest test(scene, small_specimen(), {});
  while (!test.finished()) (void)test.advance(1000);
  EXPECT_TRUE(said(test.stage_results().front().warnings, "guard ignored: the void ratio has fallen to"));
}

}  // namespace
}  // namespace clathra
