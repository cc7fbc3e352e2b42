/// Specimens whose void ratio is that at the start of the test.
#include <gtest/gtest.h>

#include <cmath>

#include "domain/biaxial/biaxial_test.hpp"
#include "domain/biaxial/specimen_for_test.hpp"

namespace clathra {
namespace {

Scene scene_of(double void_ratio, double friction) {
  Scene scene;
  scene.specimen.particles = 300;
  scene.specimen.void_ratio = void_ratio;
  scene.specimen.void_ratio_at = VoidRatioAt::test;
  scene.grains.friction = friction;
  return scene;
}

double tested_void_ratio(Scene const& scene, Specimen const& specimen) {
  return BiaxialTest(scene, specimen, {}).preparation().at("void_ratio_after_consolidation");
}

TEST(SpecimenForTest, HasItsVoidRatioConsolidatedWhateverTheFriction) {
  double made[2] = {};
  int n = 0;
  for (double const friction : {0.5, 0.1}) {
    Scene const scene = scene_of(friction > 0.2 ? 0.25 : 0.23, friction);
    GeneratedSpecimen const generated = specimen_for_test(scene, {});
    double const tested = tested_void_ratio(scene, generated.specimen);
    EXPECT_NEAR(tested, scene.specimen.void_ratio, 0.001) << friction;
    EXPECT_EQ(generated.record.at("void_ratio_at_test"), tested);
    EXPECT_NEAR(generated.record.at("void_ratio_wanted"), generated.record.at("void_ratio"), 0.001) << "as made";
    made[n++] = generated.record.at("void_ratio") - tested;
    Scene as_made = scene;
    as_made.specimen.void_ratio_at = VoidRatioAt::preparation;
    double const other = tested_void_ratio(as_made, specimen_for_test(as_made, {}).specimen);
    EXPECT_LT(other, scene.specimen.void_ratio - 0.004) << friction;
  }
  EXPECT_GT(made[0], 0.004);
  EXPECT_GT(made[1], 0.004);
}

TEST(SpecimenForTest, HasItWithBondsThatFormBefore) {
  Scene scene = scene_of(0.24, 0.5);
  scene.hydrate.saturation = 0.55;
  scene.bond.after_consolidation = false;
  EXPECT_NEAR(tested_void_ratio(scene, specimen_for_test(scene, {}).specimen), 0.24, 0.001);
}

TEST(SpecimenForTest, IsRefusedWithOneThatWorksWhereNoneHoldsIt) {
  Scene scene = scene_of(0.32, 0.1);
  try {
    (void)specimen_for_test(scene, {});
    FAIL() << "grains with hardly any friction held a loose packing";
  } catch (Refused const& refusal) {
    std::string const text = refusal.what(), mark = "specimen.void_ratio = ";
    ASSERT_NE(text.find(mark), std::string::npos) << text;
    scene.specimen.void_ratio = std::stod(text.substr(text.find(mark) + mark.size()));
    EXPECT_LT(scene.specimen.void_ratio, 0.32);
    EXPECT_NEAR(tested_void_ratio(scene, specimen_for_test(scene, {}).specimen), scene.specimen.void_ratio, 0.001);
  }
}

}  // namespace
}  // namespace clathra
