/// A test as a list of stages: what sides do, where stages end, and that neither the pace of the caller nor a restart shows.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "domain/measurement/loading_numbers.hpp"
#include "scenes.hpp"
#include "stage_run.hpp"

namespace clathra {
namespace {

/// Five stages, one of each kind of side.
Scene five_stages() {
  LoadingStage compression("compression", SideScene::at_stress(2e6), SideScene::held()),
      shear = LoadingStage("shear", SideScene::at_inertial_number(5e-4), SideScene::at_stress(1.5e6)),
      unloading = LoadingStage("unloading", SideScene::at_inertial_number(-5e-4), SideScene::at_stress(1.5e6)),
      undrained = LoadingStage("undrained", SideScene::at_inertial_number(5e-4), SideScene::following(Follow::constant_volume)),
      constant_mean =
          LoadingStage("constant mean", SideScene::at_inertial_number(5e-4), SideScene::following(Follow::constant_mean_stress));
  compression.increments = 3;
  compression.until.rest = true;
  shear.until.path = 0.004;
  unloading.until.deviator_stress = 0.2e6;
  undrained.until.stress_ratio = 0.5;
  undrained.until.path = 0.01;
  constant_mean.until.path = 0.003;
  return with({compression, shear, unloading, undrained, constant_mean});
}

void expect_same_rows(StageRun const& one, StageRun const& other) {
  ASSERT_EQ(one.rows.size(), other.rows.size());
  for (std::size_t i = 0; i < one.rows.size(); ++i) {
    EXPECT_EQ(one.rows[i].stage, other.rows[i].stage) << i;
    EXPECT_EQ(one.rows[i].step, other.rows[i].step) << i;
    EXPECT_EQ(one.rows[i].eps1, other.rows[i].eps1) << i;
    EXPECT_EQ(one.rows[i].q_Pa, other.rows[i].q_Pa) << i;
    EXPECT_EQ(one.rows[i].inertial_number, other.rows[i].inertial_number) << i;
  }
  EXPECT_EQ(one.hash, other.hash);
}

TEST(Stages, ThatABiaxialTestStandsForHaveItsBits) {
  Scene scene = small_test();
  scene.test.axial_strain = 0.01;
  Scene list = scene;
  list.stages = stages_of(scene);
  list.test.kind = TestKind::list;
  StageRun const preset = run_stages(scene), written_out = run_stages(list);
  EXPECT_EQ(preset.rows.size(), 41u);
  expect_same_rows(preset, written_out);
}

TEST(Stages, DoNotKnowThePaceOfTheirCallerNorRestarts) {
  StageRun const whole = run_stages(five_stages());
  ASSERT_EQ(whole.stages.size(), 5u);
  expect_same_rows(whole, run_stages(five_stages(), 37));
  expect_same_rows(whole, run_stages(five_stages(), 1000, 3));
  StageRun const restarted = run_stages(five_stages(), 700, 1);
  expect_same_rows(whole, restarted);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(restarted.stages[i].ended_by, whole.stages[i].ended_by);
    EXPECT_EQ(restarted.stages[i].numbers, whole.stages[i].numbers) << whole.stages[i].name;
  }
}

TEST(Stages, SayWhatTheyEndedBy) {
  StageRun const course = run_stages(five_stages());
  EXPECT_EQ(course.result("compression").ended_by, "rest");
  EXPECT_EQ(course.result("shear").ended_by, "path");
  EXPECT_EQ(course.result("unloading").ended_by, "deviator stress");
  EXPECT_EQ(course.result("constant mean").ended_by, "path");
  EXPECT_NEAR(course.result("compression").numbers.at("end_sigma1_Pa"), 2e6, 0.005 * 2e6);
  double path = 0;
  for (StageResult const& one : course.stages) path += one.numbers.at("path");
  double along = 0;
  for (std::size_t i = 1; i < course.rows.size(); ++i) along += std::abs(course.rows[i].eps1 - course.rows[i - 1].eps1);
  EXPECT_LE(along, path * (1 + 1e-9)) << "rows go along the path";
  EXPECT_GT(along, 0.9 * path) << "walls that are steered tremble between them";
  for (std::size_t i = 1; i < course.rows.size(); ++i) EXPECT_GE(course.rows[i].step, course.rows[i - 1].step);
}

/// Both ways: the stage ends with the first step that is beyond the mark.
TEST(Stages, EndAtTheVeryStep) {
  LoadingStage shear("shear", SideScene::at_inertial_number(5e-4), SideScene::at_stress(1e6)),
      unloading = LoadingStage("unloading", SideScene::at_inertial_number(-5e-4), SideScene::at_stress(1e6));
  shear.until.deviator_stress = 0.5e6;
  unloading.until.deviator_stress = 0.1e6;
  StageRun const course = run_stages(with({shear, unloading}));
  double const up = course.of("shear").back().q_Pa, down = course.of("unloading").back().q_Pa;
  EXPECT_GE(up, 0.5e6);
  EXPECT_LT(up, 0.51e6);
  EXPECT_LE(down, 0.1e6);
  EXPECT_GT(down, 0.09e6);
  EXPECT_EQ(course.of("unloading").front().q_Pa, up) << "a stage begins where the one before has ended";
}

TEST(Stages, KeepTheVolumeToRounding) {
  LoadingStage shear("shear", SideScene::at_inertial_number(5e-4), SideScene::following(Follow::constant_volume));
  shear.until.axial_strain = 0.02;
  StageRun const course = run_stages(with({shear}));
  ASSERT_GT(course.rows.size(), 10u);
  for (HistoryRow const& row : course.rows) EXPECT_LT(std::abs(row.eps_v), 1e-12) << row.eps1;
  double const e = course.rows.front().void_ratio;
  EXPECT_NEAR(course.rows.back().void_ratio, e, 1e-12 * (1 + e));
  EXPECT_GT(std::abs(course.rows.back().sigma3_Pa - course.rows.front().sigma3_Pa), 0.05e6) << "which takes stress";
}

/// u = (K_w / n) eps_v for a fluid that gives way, n the porosity: from much softer than the sand to much stiffer.
TEST(Stages, KeepTheVolumeOfTheirFluid) {
  for (double const modulus : {1e5, 2e6, 2e7, 1e8, 2.2e9}) {
    LoadingStage shear("shear", SideScene::at_inertial_number(1e-4), SideScene::following(Follow::constant_volume));
    shear.lateral.fluid_modulus = modulus;
    shear.until.axial_strain = 0.01;
    StageRun const course = run_stages(with({shear}));
    double const e = course.rows.front().void_ratio, stiffness = modulus * (1 + e) / e;
    double largest = 0;
    for (HistoryRow const& row : course.rows)
      largest = std::max(largest, std::abs(course.rows.front().sigma3_Pa - row.sigma3_Pa));
    for (HistoryRow const& row : course.rows)
      EXPECT_NEAR(stiffness * row.eps_v, course.rows.front().sigma3_Pa - row.sigma3_Pa, 0.08 * largest)
          << modulus << " " << row.eps1;
    EXPECT_GT(largest, std::min(0.02e6, 0.03 * modulus)) << "of a strain of a few per mille at least";
  }
}

TEST(Stages, KeepTheMeanStress) {
  LoadingStage shear("shear", SideScene::at_inertial_number(1e-4), SideScene::following(Follow::constant_mean_stress));
  shear.until.axial_strain = 0.02;
  StageRun const course = run_stages(with({shear}));
  double mean = 0;
  for (HistoryRow const& row : course.rows) {
    EXPECT_NEAR(row.p_Pa, 1e6, 0.02e6) << row.eps1;
    mean += (row.p_Pa - 1e6) / static_cast<double>(course.rows.size());
  }
  EXPECT_LT(std::abs(mean), 0.01e6);
  EXPECT_GT(course.rows.back().q_Pa, 0.3e6);
}

TEST(Stages, TurnRoundBetweenTwoMarks) {
  LoadingStage cycles("cycles", SideScene::at_inertial_number(5e-4), SideScene::at_stress(1e6));
  cycles.turn.axial_strain = {0, 0.002};
  cycles.until.cycles = 3;
  StageRun const course = run_stages(with({cycles}));
  EXPECT_EQ(course.stages.front().ended_by, "cycles");
  EXPECT_EQ(course.stages.front().numbers.at("turns"), 6);
  EXPECT_NEAR(course.stages.front().numbers.at("path"), 6 * 0.002, 6 * 1.6e-5) << "a step strains by 8e-6";
  EXPECT_NEAR(course.rows.back().eps1, 0, 2e-5);
  LoadingCurves curves;
  for (HistoryRow const& row : course.rows) {
    EXPECT_LT(row.eps1, 0.002 + 2e-5);
    EXPECT_GT(row.eps1, -2e-5);
    curves.eps1.push_back(row.eps1), curves.eps_v.push_back(row.eps_v), curves.sigma1.push_back(row.sigma1_Pa);
    curves.sigma3.push_back(row.sigma3_Pa), curves.void_ratio.push_back(row.void_ratio);
  }
  StageRecord const numbers = loading_numbers(cycles, curves);
  EXPECT_GT(numbers.at("damping_ratio"), 5e-4);
  EXPECT_LT(numbers.at("damping_ratio"), 0.02) << "small cycles of dense sand are nearly elastic";
  EXPECT_NEAR(numbers.at("strain_per_cycle"), 0, 2e-5) << "the strain is what is prescribed";
}

TEST(Stages, OfAnExtensionOpen) {
  Scene scene = sand();
  scene.test.kind = TestKind::extension;
  scene.test.axial_strain = 0.01;
  StageRun const course = run_stages(scene);
  EXPECT_NEAR(course.rows.back().eps1, -0.01, 1e-5);
  EXPECT_EQ(course.rows.size(), 41u);
  EXPECT_LT(course.rows.back().q_Pa, -0.2e6);
  EXPECT_NEAR(course.rows.back().sigma3_Pa, 1e6, 0.05e6);
}

/// Hexagonal lattices that neither slide nor roll: C11 = (sqrt(3)/4) (3 k_n + k_s), C12 = (sqrt(3)/4) (k_n - k_s) for springs
/// k_n, k_s between neighbours. What walls change falls with the number of grains across.
class Lattice : public testing::Test {
 protected:
  static constexpr double c11 = 0.4330127018922193 * (3 * sand_kn + sand_ks), c12 = 0.4330127018922193 * (sand_kn - sand_ks);
  static StageRecord numbers_of(TestKind kind, int columns) {
    Scene scene = sand();
    scene.grains.friction = 5;
    scene.grains.rolling_width_factor = 0;
    scene.test.kind = kind;
    scene.test.largest_stress = 1.2e6;
    scene.test.increments = 2;
    StageRun const course = run_stages(scene, 100'000, 0, lattice(columns));
    LoadingCurves curves;
    for (HistoryRow const& row : course.of("compression")) {
      curves.eps1.push_back(row.eps1), curves.eps_v.push_back(row.eps_v), curves.sigma1.push_back(row.sigma1_Pa);
      curves.sigma3.push_back(row.sigma3_Pa), curves.void_ratio.push_back(row.void_ratio);
    }
    return loading_numbers(stages_of(scene).front(), curves);
  }
  static Specimen lattice(int columns) {
    Specimen specimen = hexagonal_patch(columns, 2 * (columns * 11 / 20));
    enclose(specimen);
    specimen.d50 = grain_d50;
    return specimen;
  }
  /// Errors that halve as the lattice doubles.
  static void expect_first_order(double coarse, double fine, double exact, double tolerance) {
    EXPECT_NEAR(fine, exact, tolerance * exact);
    EXPECT_NEAR(2 * fine - coarse, exact, 0.25 * tolerance * exact) << coarse << ", " << fine;
  }
};

/// A closed cycle of stress that breaks and slides nothing, without damping: what work is left went into waves, and falls with
/// the rate.
TEST_F(Lattice, GivesBackTheWorkOfACycle) {
  double before = 1e-4;
  for (double const inertial_number : {8e-4, 4e-4, 2e-4}) {
    LoadingStage cycle("cycle", SideScene::at_inertial_number(inertial_number), SideScene::at_stress(1e6));
    cycle.turn.deviator_stress = {0, 0.3e6};
    cycle.until.cycles = 1;
    Scene scene = with({cycle});
    scene.grains.friction = 5;
    scene.grains.rolling_width_factor = 0;
    scene.damping.local = 0;
    scene.output.energy = true;
    BiaxialTest test(scene, lattice(20), {});
    double most = 0;
    while (!test.finished())
      if (test.advance(100'000)) most = std::max(most, std::abs(test.energy().boundary_work));
    EnergyRow const end = test.energy();
    double const left = std::abs(end.boundary_work) / most;
    EXPECT_LT(left, 0.01) << inertial_number << ": waves that are on their way";
    double const residual = std::abs(end.residual) / most;
    EXPECT_LT(residual, before) << inertial_number;
    before = 0.6 * residual;
  }
}

TEST_F(Lattice, HasTheModuliAndTheEarthPressureOfItsSprings) {
  StageRecord const coarse = numbers_of(TestKind::oedometer, 20), fine = numbers_of(TestKind::oedometer, 40);
  expect_first_order(coarse.at("constrained_modulus_Pa"), fine.at("constrained_modulus_Pa"), c11, 0.1);
  expect_first_order(coarse.at("k0_of_increments"), fine.at("k0_of_increments"), c12 / c11, 0.4);
  EXPECT_NEAR(c12 / c11, 1.0 / 11, 1e-12);
  StageRecord const coarse_bulk = numbers_of(TestKind::isotropic, 20), fine_bulk = numbers_of(TestKind::isotropic, 40);
  expect_first_order(coarse_bulk.at("bulk_modulus_Pa"), fine_bulk.at("bulk_modulus_Pa"), 0.5 * (c11 + c12), 0.12);
}

}  // namespace
}  // namespace clathra
