#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "io/results/specimen_file.hpp"
#include "io/results/specimen_label.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// A bonded patch with the label of the scene that bonded it.
Specimen bonded_by(Scene const& scene) {
  Specimen s = disordered_patch(6, 6);
  s.density = scene.grains.density;
  s.stress = scene.specimen.preparation_stress;
  bond_all(s, scene);
  s.provenance = nlohmann::json{{"made_of", specimen_label(scene, true)}}.dump();
  return s;
}

Scene scene_at(double saturation) {
  Scene scene;
  scene.hydrate.saturation = saturation;
  return scene;
}

/// What reading a specimen by a scene says: the refusal, or the warnings line by line.
std::string verdict(Specimen const& specimen, Scene const& scene) {
  try {
    std::string text;
    for (std::string const& warning : compare_with_scene("final.h5", specimen, scene)) text += warning + "\n";
    return text;
  } catch (FileProblem const& problem) {
    EXPECT_EQ(problem.code, ExitCode::refused);
    return "refused: " + std::string(problem.what());
  }
}

testing::AssertionResult says(std::string const& text, std::string const& wanted) {
  if (text.find(wanted) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << text << "' does not say '" << wanted << "'";
}

testing::AssertionResult refuses(std::string const& text, std::string const& wanted) {
  return text.find("refused: final.h5: ") == 0 ? says(text, wanted) : testing::AssertionFailure() << "taken: " << text;
}

/// Its bonds are narrower than the thickness says with which they formed.
TEST(SpecimenLabel, OfHydrateThatChangedIsRefused) {
  Scene scene = scene_at(0.41);
  scene.test.kind = TestKind::heating;
  Specimen specimen = bonded_by(scene);
  SceneTexts const before = specimen_label(scene, true);
  specimen.provenance = nlohmann::json{{"made_of", label_after(before, scene, true)}}.dump();
  EXPECT_TRUE(refuses(verdict(specimen, scene), "its hydrate changed in the stages 'heating'"));
  EXPECT_TRUE(refuses(verdict(specimen, scene_at(0.41)), "Go on with that run itself (--resume)"));
  scene.test.kind = TestKind::creep;
  specimen.provenance = nlohmann::json{{"made_of", label_after(before, scene, true)}}.dump();
  EXPECT_EQ(verdict(specimen, scene), "");
}

TEST(SpecimenLabel, OfTheSceneThatMadeTheBondsIsTakenWithoutAWord) {
  Scene const scene = scene_at(0.55);
  EXPECT_EQ(verdict(bonded_by(scene), scene), "");
  Scene other = scene;
  other.hydrate.saturation = 0.55 * (1 + 1e-15);  // another unit
  other.test.confining_stress = 3e6;
  other.grains.friction = 0.3;
  other.bond.critical_thickness = 1e-5;  // without effect
  EXPECT_EQ(verdict(bonded_by(scene), other), "");
}

TEST(SpecimenLabel, BondsOfAnotherSceneAreRefusedWithBothValuesWhateverIsForced) {
  Scene const scene = scene_at(0.55);
  Specimen const specimen = bonded_by(scene);
  auto const expect = [&](char const* wanted, auto&& change) {
    Scene other = scene;
    other.run.ignore_guards = true;
    change(other);
    EXPECT_TRUE(refuses(verdict(specimen, other), wanted));
  };
  expect("hydrate.saturation was 0.55, is 0.26", [](Scene& s) { s.hydrate.saturation = 0.26; });
  expect("hydrate.density was 900 kg/m^3, is 920 kg/m^3", [](Scene& s) { s.hydrate.density = 920; });
  expect("bond.contact_coupling was parallel, is replaces_keeping_force",
         [](Scene& s) { s.bond.contact_coupling = ContactCoupling::replaces_keeping_force; });
  expect("bond.law was thickness_dependent, is constant_thickness",
         [](Scene& s) { s.bond.law = BondLawKind::constant_thickness; });
  expect("bond.strength_from was conditions, is printed", [](Scene& s) { s.bond.strength_from = StrengthFrom::printed; });
  expect("bond.strength_modulus was 0, is 5", [](Scene& s) { s.bond.strength_modulus = 5, s.bond.strength_seed = 2; });
  expect("bond.rolling_lever was 0.25 B, is 1 mm", [](Scene& s) { s.bond.rolling_lever = {1e-3, 0}; });
  expect("bond.rolling_lever was ", [](Scene& s) { s.bond.rolling_lever = {0, 0.1}; });
  expect("bond.critical_thickness_from was saturation, is bond_area",
         [](Scene& s) { s.bond.critical_thickness_from = CriticalThicknessFrom::bond_area; });
  expect("hydrate.saturation was 0.55, is 0", [](Scene& s) { s.hydrate.saturation = 0; });
  expect("bond.law was thickness_dependent, is none", [](Scene& s) { s.bond.law = BondLawKind::none; });
  expect("its grains have a density of 2600 kg/m^3, grains.density is 2700 kg/m^3", [](Scene& s) { s.grains.density = 2700; });
}

TEST(SpecimenLabel, WhatMayBeChosenAnewIsWarnedOf) {
  Scene const scene = scene_at(0.55);
  Specimen const specimen = bonded_by(scene);
  auto const expect = [&](char const* wanted, auto&& change) {
    Scene other = scene;
    change(other);
    EXPECT_TRUE(says(verdict(specimen, other), wanted));
    EXPECT_EQ(verdict(specimen, other).find("refused"), std::string::npos);
  };
  expect("final.h5: hydrate.temperature was 5 degC, is 8 degC", [](Scene& s) { s.hydrate.temperature = 8; });
  expect("grains.normal_stiffness was 0.3 GPa, is 0.1 GPa", [](Scene& s) { s.grains.normal_stiffness = 1e8; });
  expect("grains.shear_stiffness was 0.2 GPa, is 0.1 GPa", [](Scene& s) { s.grains.shear_stiffness = 1e8; });
  expect("specimen.preparation_stress was 50 kPa, is ", [](Scene& s) { s.specimen.preparation_stress = 2e5; });
  expect("run.seed was 1, is 7", [](Scene& s) { s.run.seed = 7; });
}

TEST(SpecimenLabel, BondsThatAreNotLabelledAreJudgedByWhatTheyShow) {
  Scene const scene = scene_at(0.55);
  Specimen specimen = bonded_by(scene);
  specimen.provenance.clear();
  EXPECT_TRUE(says(verdict(specimen, scene), "says nothing of what its bonds are made of but h_max = 14.9"));
  Scene other = scene_at(0.26);
  EXPECT_TRUE(refuses(verdict(specimen, other), "which Eq. 3 gives at a saturation of 0.55; hydrate.saturation is 0.26, which"));
  EXPECT_TRUE(refuses(verdict(specimen, scene_at(0)), "the scene makes none (hydrate.saturation is 0"));
  other = scene;
  other.bond.contact_coupling = ContactCoupling::replaces;
  EXPECT_TRUE(refuses(verdict(specimen, other), "act in parallel to the grain contacts, bond.contact_coupling is replace"));
  other = scene;
  other.bond.critical_thickness_from = CriticalThicknessFrom::given;
  other.bond.critical_thickness = 1e-5;
  EXPECT_TRUE(refuses(verdict(specimen, other), "bond.critical_thickness is 10 um"));
  other.bond.critical_thickness = specimen.critical_thickness;
  EXPECT_EQ(verdict(specimen, other).find("refused"), std::string::npos);
  // A label does not vouch for bonds that are not those of its scene.
  Specimen thinner = bonded_by(scene);
  thinner.critical_thickness *= 0.9;
  EXPECT_TRUE(refuses(verdict(thinner, scene), "h_max"));
}

TEST(SpecimenLabel, ASpecimenWithoutBondsGoesWithAnyHydrate) {
  Scene scene = scene_at(0.55);
  Specimen specimen = disordered_patch(6, 6);
  specimen.provenance = nlohmann::json{{"made_of", specimen_label(scene, false)}}.dump();
  EXPECT_EQ(verdict(specimen, scene_at(0.26)), "");
  EXPECT_EQ(verdict(specimen, scene_at(0)), "");
}

TEST(SpecimenLabel, ShearingIsToldAndAddedUp) {
  Specimen specimen = disordered_patch(6, 6);
  specimen.axial_strain = 0.15;
  EXPECT_TRUE(says(verdict(specimen, Scene()), "was sheared already, to an axial strain of 15 %"));
}

/// Results of the program, on the files that it leaves.
class SpecimenOfARun : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  CommandResult clathra(std::string const& verb, std::string const& more) const {
    return run_clathra(
        verb +
        " " CLATHRA_EXAMPLES
        "/quick.toml --set specimen.particles=100 --set specimen.void_ratio=0.28 --set test.axial_strain=\"0.3 %\" " +
        "--set output.records=5 --set output.snapshots=0 --set hydrate.saturation=\"55 %\" " + more);
  }
  std::string out(std::string const& name) const { return (folder / name).string(); }
  std::string reading(std::string const& file) const { return " --set specimen.file=" + file + " "; }

  fs::path const folder = fs::temp_directory_path() / ("clathra_label_" + std::to_string(::getpid()));
};

TEST_F(SpecimenOfARun, GoesOnUnderItsOwnLabelOnly) {
  ASSERT_EQ(clathra("run", "--output " + out("first")).code, 0);
  std::string const last = reading(out("first") + "/final.h5"), other = " --ignore-guards --set hydrate.saturation=\"26 %\" ";
  for (std::string const verb : {"run", "check"}) {
    CommandResult const refused = clathra(verb, last + other + (verb == "run" ? "--output " + out("second") : ""));
    EXPECT_EQ(refused.code, 77) << verb << refused.output;
    EXPECT_TRUE(says(refused.output, "final.h5: holds bonds of another scene: hydrate.saturation was 0.55, is 0.26")) << verb;
  }
  EXPECT_FALSE(fs::exists(folder / "second"));
  CommandResult const again = clathra("run", last + "--set run.seed=3 --output " + out("second"));
  EXPECT_EQ(again.code, 0) << again.output;
  EXPECT_TRUE(says(again.output, "final.h5: was sheared already, to an axial strain of 0.3"));
  EXPECT_TRUE(says(again.output, "final.h5: run.seed was 1, is 3; what the scene says has no effect"));
  EXPECT_TRUE(says(clathra("check", last).output, "warning: " + out("first") + "/final.h5: was sheared already"));
  // What it has gone through adds up; how it was made stays.
  std::string const info = run_clathra("info " + out("second") + "/final.h5").output;
  EXPECT_TRUE(says(info, "sheared            to an axial strain of 0.6"));
  EXPECT_TRUE(says(info, "run.seed                       1\n"));
  EXPECT_TRUE(says(info, "hydrate.saturation             0.55\n"));
  std::string const whole = reading(out("first") + "/specimen.h5");
  EXPECT_EQ(clathra("check", whole + other).code, 0);
  EXPECT_TRUE(says(clathra("check", whole + "--set grains.normal_stiffness=\"200 MPa\"").output,
                   "grains.normal_stiffness was 0.3 GPa, is 0.2 GPa"));
}

}  // namespace
}  // namespace clathra
