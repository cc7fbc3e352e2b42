/// Hydrate that forms in a stage, under whatever stresses then act.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "stage_run.hpp"

namespace clathra {
namespace {

/// Loaded one-dimensionally, bonded there, and sheared on.
Scene bonded_at_rest_in_one_dimension(double saturation = 0.55) {
  LoadingStage oedometer("one-dimensional", SideScene::at_stress(2e6), SideScene::held()),
      shear("shear", SideScene::at_inertial_number(5e-4), SideScene::held());
  oedometer.increments = 2;
  oedometer.until.rest = true;
  shear.until.path = 0.003;
  shear.forms_hydrate = true;
  Scene scene = with({oedometer, shear});
  scene.hydrate.saturation = saturation;
  return scene;
}

TEST(HydrateFormation, InTheFirstStageBondsWhatTheConsolidationWould) {
  Scene preset = sand();
  preset.hydrate.saturation = 0.55;
  preset.test.axial_strain = 0.001;
  Scene marked = preset;
  marked.stages = stages_of(preset);
  marked.stages.front().forms_hydrate = true;
  marked.test.kind = TestKind::list;
  BiaxialTest const of_preset(preset, small_specimen(), ProgressCallback()),
      of_mark(marked, small_specimen(), ProgressCallback());
  for (char const* const number : {"bonds", "h_max_m", "bond_area_m2", "pairs_without_tensile_strength"})
    EXPECT_EQ(of_mark.preparation().at(number), of_preset.preparation().at(number)) << number;
  EXPECT_GT(of_mark.preparation().at("bonds"), 400);
  for (HistoryRow const& row : of_mark.consolidation()) {
    EXPECT_EQ(row.stage, "consolidation");
    EXPECT_EQ(row.bonds_intact, 0);
  }
}

/// Neighbours are searched as far as bonds reach, whatever the skin.
TEST(HydrateFormation, BondsAcrossGapsThatTheSkinDoesNotSpan) {
  Scene scene = bonded_at_rest_in_one_dimension();
  scene.run.verlet_skin = 2e-6;
  BiaxialTest test(scene, small_specimen(), ProgressCallback());
  while (!test.stage().forms_hydrate) test.advance(100'000);
  EXPECT_GT(test.preparation().at("h_max_m"), 3 * scene.run.verlet_skin);
  EXPECT_EQ(static_cast<double>(test.record().bonds_intact), test.preparation().at("bonds"));
}

/// Bonds are stress-free where they form: nothing moves by it, and what follows is stiffer than sand.
TEST(HydrateFormation, UnderAnisotropicStressesChangesNoneOfThem) {
  Scene const scene = bonded_at_rest_in_one_dimension();
  Scene sand_alone = scene;
  sand_alone.hydrate.saturation = 0;
  sand_alone.stages.back().forms_hydrate = false;
  StageRun const bonded = run_stages(scene), sand = run_stages(sand_alone);
  HistoryRow const before = bonded.of("one-dimensional").back(), after = bonded.of("shear").front();
  EXPECT_EQ(before.bonds_intact, 0);
  EXPECT_GT(after.bonds_intact, 400);
  EXPECT_EQ(after.bonds_intact_pct, 100);
  EXPECT_EQ(after.void_ratio, before.void_ratio);
  EXPECT_NEAR(after.sigma1_Pa, before.sigma1_Pa, 1e-9 * before.sigma1_Pa);
  EXPECT_NEAR(after.sigma3_Pa, before.sigma3_Pa, 1e-9 * before.sigma3_Pa);
  EXPECT_LT(after.sigma3_Pa, 0.9 * after.sigma1_Pa) << "the state must be anisotropic for this to say anything";
  // Its mean contact force counts bonds that carry nothing yet.
  EXPECT_NEAR(after.unbalanced / after.coordination, before.unbalanced / before.coordination, 0.005 * before.unbalanced);
  auto const rise = [](StageRun const& run) {
    std::vector<HistoryRow> const rows = run.of("shear");
    return (rows.back().sigma1_Pa - rows.front().sigma1_Pa) / (rows.back().eps1 - rows.front().eps1);
  };
  EXPECT_EQ(bonded.of("one-dimensional").back().step, sand.of("one-dimensional").back().step);
  EXPECT_GT(rise(bonded), 1.3 * rise(sand));
}

/// Nothing is won or lost by it, but for what a coupling lets a bond take over, which has an account.
TEST(HydrateFormation, KeepsTheLedgerClosed) {
  for (ContactCoupling const coupling : {ContactCoupling::parallel, ContactCoupling::replaces_keeping_force}) {
    Scene scene = bonded_at_rest_in_one_dimension();
    scene.bond.contact_coupling = coupling;
    scene.output.energy = true;
    BiaxialTest test(scene, small_specimen(), ProgressCallback());
    EnergyRow formed, last;
    bool seen = false;
    while (!test.finished()) {
      if (!test.advance(100'000)) continue;
      last = test.energy();
      if (std::exchange(seen, seen || test.stage().forms_hydrate) != seen) formed = last;
    }
    ASSERT_TRUE(seen);
    EXPECT_LT(std::abs(last.residual), 2e-3 * last.boundary_work);
    if (coupling == ContactCoupling::parallel) {
      EXPECT_EQ(formed.dissolved, 0);
      EXPECT_EQ(formed.bond_elastic, 0);
    } else {
      EXPECT_NE(formed.dissolved, 0);
    }
  }
}

TEST(HydrateFormation, KnowsNeitherThePaceOfTheCallerNorRestarts) {
  for (Precision const precision : {Precision::full, Precision::mixed}) {
    Scene scene = bonded_at_rest_in_one_dimension(0.41);
    scene.run.precision = precision;
    StageRun const whole = run_stages(scene);
    for (StageRun const& other : {run_stages(scene, 37), run_stages(scene, 700, 1)}) {
      EXPECT_EQ(other.hash, whole.hash);
      ASSERT_EQ(other.rows.size(), whole.rows.size());
      EXPECT_EQ(other.rows.back().q_Pa, whole.rows.back().q_Pa);
      EXPECT_EQ(other.rows.back().bonds_intact, whole.rows.back().bonds_intact);
    }
  }
}

TEST(HydrateFormation, IsRefusedWhereTheSpecimenHasBonds) {
  Scene scene = bonded_at_rest_in_one_dimension();
  Scene bonded = sand();
  bonded.hydrate.saturation = 0.55;
  Specimen const specimen = BiaxialTest(bonded, small_specimen(), ProgressCallback()).specimen();
  EXPECT_THROW(BiaxialTest(scene, specimen, ProgressCallback()), Refused);
}

}  // namespace
}  // namespace clathra
