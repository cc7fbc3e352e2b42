/// Specimen files that are read but make odd tests, and what verbs say of a test of them before it is run.
#include "domain/measurement/specimen_facts.hpp"
#include "specimen_in_a_file.hpp"

namespace clathra {
namespace {

TEST_F(SpecimenCheck, ASpecimenThatIsNotAtRestIsWarnedOf) {
  write([](Specimen& s) { s.vx[place(s, 17)] = 30; });
  EXPECT_NE(warnings().find("particle 17 moves or spins at 30 m/s, worth 2340 kPa"), std::string::npos) << warnings();
  write([](Specimen& s) { s.vx[place(s, 17)] = 3, s.stress = 0; });
  EXPECT_NE(warnings().find("particle 17 moves or spins at 3 m/s"), std::string::npos) << warnings();
  write([](Specimen& s) { s.vx[place(s, 17)] = 0.1; });
  EXPECT_EQ(warnings(), "");
}

TEST_F(SpecimenCheck, ABoxSmallerThanItsSandIsWarnedOf) {
  write([](Specimen& s) { s.right -= 0.03e-3; });
  leave_out({"void_ratio"});
  EXPECT_NE(warnings().find("d50 into the right wall: the box is smaller than its sand"), std::string::npos) << warnings();
  write([](Specimen& s) { s.right -= 0.03e-3, s.axial_strain = 0.05; });  // platens press discs into themselves
  leave_out({"void_ratio"});
  EXPECT_EQ(warnings(), "");
}

TEST_F(SpecimenCheck, ABoxLargerThanItsSandIsWarnedOf) {
  write([](Specimen& s) { s.top += s.height(); });
  leave_out({"void_ratio"});
  EXPECT_NE(warnings().find("d50) from the nearest particle: the box is larger than its sand"), std::string::npos) << warnings();
  EXPECT_TRUE(says(run_clathra("info '" + file.string() + "'"), "warning: " + file.string() + ": the top wall is "));
  EXPECT_TRUE(says(by_scene("check", "--ignore-guards"), "the box is larger than its sand"));
}

TEST_F(SpecimenCheck, DiscsTooLargeForTheirPlacesAreWarnedOf) {
  write([](Specimen& s) {
    for (double& r : s.radius) r *= 1.15;
  });
  leave_out({"void_ratio", "d50"});
  EXPECT_NE(warnings().find("% of the pairs that touch overlap by more than a tenth of the smaller radius"), std::string::npos);
  EXPECT_NE(warnings().find("says that it rests under 1000 kPa; by the overlaps"), std::string::npos) << warnings();
}

/// As of the grading of a specimen that is made.
TEST_F(SpecimenCheck, SizesThatMakeOddTestsAreWarnedOf) {
  write([](Specimen& s) { scale_lengths(s, 1e-3); });
  EXPECT_NE(warnings().find("half of the grains are finer than 0.000169 mm, clay by size"), std::string::npos) << warnings();
  write([](Specimen& s) { scale_lengths(s, 100); });
  EXPECT_NE(warnings().find("half of the grains are coarser than 16.9 mm, gravel by size"), std::string::npos) << warnings();
  write(two_sizes(2e-4));
  EXPECT_NE(warnings().find("hardly any grains around 50 %: 49 % are finer than 0.2 mm, 51 % finer than 0.8 mm"),
            std::string::npos)
      << warnings();
  write([](Specimen& s) {
    for (double& r : s.radius) r = 5e-5;
  });
  leave_out({"void_ratio", "d50"});
  EXPECT_NE(warnings().find("the particles are as good as equal (d90 / d10 = 1)"), std::string::npos) << warnings();
}

TEST_F(SpecimenCheck, AStressThatTheOverlapsDoNotShowIsWarnedOf) {
  std::string const wanted = "says that it rests under 1000 kPa; by the overlaps of its particles and a kn of 100 MPa it carries";
  write([](Specimen&) {});
  EXPECT_NE(warnings(1e8).find(wanted), std::string::npos) << warnings(1e8);
  // The stiffness that it came to rest with is what counts, where the file says it.
  write([](Specimen& s) { s.provenance = R"({"made_of": {"grains.normal_stiffness": "0.3 GPa"}})"; });
  EXPECT_EQ(warnings(1e8), "");
  EXPECT_FALSE(says(run_clathra("info '" + file.string() + "'"), "says that it rests"));
  write([](Specimen& s) { s.provenance = R"({"made_of": {"grains.normal_stiffness": "3 MPa"}})"; });
  EXPECT_TRUE(says(run_clathra("info '" + file.string() + "'"), "says that it rests under 1000 kPa"));
  for (auto const& change : std::vector<std::function<void(Specimen&)>>{[](Specimen& s) { s.axial_strain = 0.01; },
                                                                        [](Specimen& s) { s.critical_thickness = 1e-5; },
                                                                        [](Specimen& s) { s.stress = 0; }}) {
    write(change);
    EXPECT_EQ(warnings(1e8), "");
  }
}

/// The grading of the scene is not that of the file: what a test of it costs and how fast it goes follows from its discs.
TEST_F(SpecimenCheck, ATestIsForecastFromTheDiscsOfTheFile) {
  write([](Specimen& s) { scale_lengths(s, 3); });
  CommandResult const triple = by_scene("check", "--particle-steps-per-second 1e6");
  EXPECT_TRUE(says(triple, "  d50                0.5082 mm\n")) << triple.output;
  EXPECT_FALSE(says(triple, "generation"));
  std::ofstream(folder / "sand.csv") << "d_mm,percent_finer\n1,0\n2,100\n";
  CommandResult const curve = by_scene("check", "--set grading.file='" + (folder / "sand.csv").string() + "'");
  EXPECT_TRUE(says(curve, "warning: grading.file has no effect: the specimen comes from ")) << curve.output;
  EXPECT_TRUE(says(curve, "not measured: test.axial_strain, specimen.file\n") || says(curve, "not measured: specimen.file\n"))
      << curve.output;
  // A specimen that is named beside the scene, as a study does for its members, takes the place of the scene's grading.
  std::ofstream(folder / "own.toml") << "[grading]\nfile = \"sand.csv\"\n[specimen]\nparticles = 300\n";
  CommandResult const shared =
      run_clathra("check '" + (folder / "own.toml").string() + "' --set specimen.file='" + file.string() + "'");
  EXPECT_FALSE(says(shared, "has no effect")) << shared.output;
  write(two_sizes(2e-4));
  SpecimenDesign const design = design_of(read_specimen(file));
  EXPECT_EQ(design.particles, 175);
  EXPECT_DOUBLE_EQ(design.grading.d50(), 2e-4);
  EXPECT_NEAR(design.grading.finer_than(5e-4), 165. / 325, 0.01);  // areas: 165 x 1 and 10 x 16
  EXPECT_NEAR(design.grading.mean_disc_area(), std::numbers::pi * 325e-8 / 175, 0.03 * std::numbers::pi * 325e-8 / 175);
}

TEST_F(SpecimenCheck, WhatATestCannotBearIsRefusedAsWhereItIsGenerated) {
  write([](Specimen&) {});
  std::string const ranks = "100 particles cannot be cut among 3 ranks: each needs 50, so at most 2 can share them";
  CommandResult const among = by_scene("check", "--ranks 3");
  EXPECT_EQ(among.code, 77);
  EXPECT_TRUE(says(among, ranks)) << among.output;
  for (char const* const verb : {"check", "run"}) {
    CommandResult const skin = by_scene(verb, "--set run.verlet_skin='0.6 mm'");
    EXPECT_EQ(skin.code, 77) << skin.output;
    EXPECT_TRUE(says(skin, "of this grading the skin may be")) << skin.output;
  }
}

}  // namespace
}  // namespace clathra
