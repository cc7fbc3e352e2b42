#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "io/scene/study_file.hpp"
#include "io/scene/study_members.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

class StudyFile : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder);
    std::ofstream(folder / "base.toml") << "[specimen]\nparticles = 300\n";
  }
  void TearDown() override { fs::remove_all(folder); }
  Study load(std::string const& text) const {
    std::ofstream(folder / "many.toml") << text;
    return load_study(folder / "many.toml");
  }
  std::string problems_of(std::string const& text) const {
    try {
      load(text);
    } catch (SceneProblems const& problems) {
      EXPECT_EQ(problems.code(), ExitCode::bad_input);
      return problems.what();
    }
    return "taken";
  }
  static std::vector<std::string> names(Study const& study) {
    std::vector<std::string> all;
    for (StudyGroup const& group : study.groups) all.push_back(group.name);
    return all;
  }

  fs::path const folder = fs::temp_directory_path() / ("clathra_study_" + std::to_string(::getpid()));
  std::string const base = "scene = \"base.toml\"\n";
};

using Names = std::vector<std::string>;

TEST_F(StudyFile, IsAMatrixInTheOrderOfTheFile) {
  Study const study =
      load(base +
           "seeds = 3\n[matrix]\n\"test.confining_stress\" = [\"1 MPa\", \"2 MPa\"]\nhydrate.saturation = [0.26, \"55 %\"]\n"
           "grains.friction = 0.4\n");
  EXPECT_EQ(study.scene, folder / "base.toml");
  EXPECT_EQ(study.folder, fs::path("out/many"));
  EXPECT_EQ(names(study), (Names{"1MPa_saturation0.26", "1MPa_55pct", "2MPa_saturation0.26", "2MPa_55pct"}));
  EXPECT_EQ(study.groups[3].material, "55pct");
  EXPECT_EQ(study.groups[3].settings.back(), Setting("grains.friction", "0.4"))
      << "a single value holds for all and names nothing";
  EXPECT_EQ(study.keys, (Names{"test.confining_stress", "hydrate.saturation", "grains.friction"}));
  EXPECT_EQ(study.seeds, (std::vector<std::uint64_t>{1, 2, 3}));
  Scene const scene = member_scene(study, study.groups[3], 7).scene;
  EXPECT_EQ(scene.test.confining_stress, 2e6);
  EXPECT_EQ(scene.hydrate.saturation, 0.55);
  EXPECT_EQ(scene.grains.friction, 0.4);
  EXPECT_EQ(scene.run.seed, 7u);
}

TEST_F(StudyFile, HasFiveSeedsUnlessItSaysOtherwise) {
  EXPECT_EQ(load(base).seeds.size(), 5u);
  EXPECT_EQ(names(load(base)), Names{"all"});
  EXPECT_EQ(load(base + "seeds = [4, 9]\n").seeds, (std::vector<std::uint64_t>{4, 9}));
}

TEST_F(StudyFile, SpacesRangesEvenly) {
  Study const study = load(base + "[matrix]\ntest.confining_stress = { from = \"1 MPa\", to = \"2 MPa\", count = 6 }\n");
  EXPECT_EQ(names(study), (Names{"1MPa", "1.2MPa", "1.4MPa", "1.6MPa", "1.8MPa", "2MPa"}));
}

TEST_F(StudyFile, CrossesNamedGroupsWithTheMatrix) {
  Study const study = load(base +
                           "[groups.dense]\nspecimen.void_ratio = 0.2\n[groups.loose]\n\"specimen.void_ratio\" = 0.26\n"
                           "[matrix]\n\"hydrate.saturation\" = [\"0 %\", \"55 %\"]\n");
  EXPECT_EQ(names(study), (Names{"dense_0pct", "dense_55pct", "loose_0pct", "loose_55pct"}));
  EXPECT_EQ(member_scene(study, study.groups[0], 1).scene.specimen.void_ratio, 0.2);
}

TEST_F(StudyFile, SaysAllThatIsWrongWithItsPlace) {
  std::string const text = problems_of(base +
                                       "sedes = 3\nseeds = [1, 1]\n[matrix]\n\"test.confinig_stress\" = [\"1 MPa\"]\n"
                                       "\"hydrate.saturation\" = [\"1 mm\", \"2\"]\n\"run.seed\" = [1, 2]\n"
                                       "\"test.axial_strain\" = { from = \"1 %\", to = 0.2, count = 3 }\n");
  for (char const* const part :
       {":2:9: error: unknown key 'sedes'; did you mean 'seeds'?\n", ":3:13: error: seed 1 is there twice",
        "error: unknown key 'test.confinig_stress' of a scene; did you mean 'test.confining_stress'?",
        ":6:25: error: 'hydrate.saturation' needs a",
        ":7:14: error: 'run.seed' cannot be varied here: 'seeds' of the study gives the seeds",
        "needs two numbers in the same unit, got '1 %' and '0.2'"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  EXPECT_NE(problems_of("seeds = 2\n").find("'scene' is missing"), std::string::npos);
  EXPECT_NE(problems_of(base + "[matrix]\ngrains.friction = [0.3, 0.3]\n").find("has a value twice"), std::string::npos);
  EXPECT_NE(problems_of(base + "[matrix]\ngrains.friction = []\n").find("no value in its list"), std::string::npos);
  EXPECT_NE(problems_of(base + "[groups.\"a b\"]\ngrains.friction = 0.3\n").find("is no name of a group"), std::string::npos);
  EXPECT_NE(problems_of(base + "[groups.\".a\"]\ngrains.friction = 0.3\n").find("none of them a dot in front"),
            std::string::npos);
  EXPECT_NE(problems_of(base + "[groups.a]\ngrains.friction = 0.3\n[matrix]\ngrains.friction = [1]\n")
                .find("in [matrix] and in [groups.a]"),
            std::string::npos);
  EXPECT_NE(problems_of(base + "seeds = 10000\n[matrix]\ngrains.friction = {from = 0.1, to = 0.9, count = 1000}\n")
                .find("more than 100000 members"),
            std::string::npos);
  EXPECT_NE(problems_of("scene = \"a\"\nseeds = 1 2\n").find(":2:"), std::string::npos) << "no TOML";
}

TEST_F(StudyFile, SaysWhatIsWrongOnce) {
  auto const lines = [](std::string const& text) { return std::count(text.begin(), text.end(), '\n') + 1; };
  for (auto const& [text, said] : std::vector<std::pair<std::string, std::string>>{
           {base + "[matrix]\ntest.confining_stress = [\"1 Mpa\", \"2 Mpa\"]\n", "unknown unit 'Mpa' in '1 Mpa'"},
           {base + "[specimen]\nparticles = 100\n[test]\naxial_strain = 0.1\n", "[specimen], [test] belong into the scene file"},
           {"[specimen]\nparticles = 100\n[test]\naxial_strain = 0.1\n", "[specimen], [test] belong to a scene, and this is one"},
           {base + "[groups.a]\ngrains.friction = 0.3\n[groups.b]\ngrains.friction = 0.4\n[matrix]\ngrains.friction = [1]\n",
            "in [matrix] and in [groups.a]"},
           {base + "[matrix]\n\"grains.friction\" = [0.3, 0.4]\ngrains.friction = 0.5\n",
            "'grains.friction' is stated twice, in lines 3 and 4: leave one of them out"}}) {
    std::string const problems = problems_of(text);
    EXPECT_NE(problems.find(said), std::string::npos) << problems;
    EXPECT_EQ(lines(problems), 1) << problems;
  }
}

TEST_F(StudyFile, SaysWhichGroupASceneIsWrongIn) {
  Study const study = load(base + "[matrix]\nhydrate.saturation = \"55 %\"\nhydrate.temperature = [\"5 degC\", \"15 degC\"]\n");
  EXPECT_NO_THROW(member_scene(study, study.groups[0], 1));
  try {
    member_scene(study, study.groups[1], 1);
    ADD_FAILURE() << "taken";
  } catch (SceneProblems const& problems) {
    EXPECT_NE(std::string(problems.what()).find("(in the group 15degC)"), std::string::npos) << problems.what();
  }
}

std::string refused(Study study, std::vector<std::string> const& overrides) {
  try {
    override_study(study, overrides);
  } catch (SceneProblems const& problems) {
    return problems.what();
  }
  return "taken";
}

TEST_F(StudyFile, IsOverriddenByTheCommandLineInWhatItsGroupsDoNotDifferIn) {
  Study study = load(
      base +
      "[matrix]\nhydrate.saturation = [\"26 %\", \"55 %\"]\ngrains.friction = 0.4\n"
      "[groups.a]\nspecimen.void_ratio = 0.2\n[groups.b]\nspecimen.void_ratio = \"20 %\"\ntest.confining_stress = \"2 MPa\"\n");
  EXPECT_NE(refused(study, {"hydrate.saturation=0.41"}).find("is what the groups of"), std::string::npos);
  EXPECT_NE(refused(study, {"test.confining_stress=3 MPa"}).find("is what the groups of"), std::string::npos)
      << "only one has it";
  EXPECT_EQ(refused(study, {"specimen.void_ratio=0.21"}), "taken") << "20 % and 0.2 are one value";
  std::string const all = refused(study, {"run.seed=7", "grains.fricton=1", "grains.friction=1 MPa", "nothing"});
  for (char const* const part :
       {"--set run.seed=7: error: 'run.seed' cannot be set for all members", "unknown key 'grains.fricton'; did you mean",
        "'grains.friction' needs a", "'nothing' needs the form section.key=value"})
    EXPECT_NE(all.find(part), std::string::npos) << part << "\n" << all;
  override_study(study, {"grains.friction=0.3", "damping.local=20 %"});
  for (StudyGroup const& group : study.groups) {
    Scene const scene = member_scene(study, group, 3).scene;
    EXPECT_EQ(scene.grains.friction, 0.3);
    EXPECT_EQ(scene.damping.local, 0.2);
  }
  EXPECT_EQ(study.keys.back(), "damping.local");
  EXPECT_EQ(group_label(study, study.groups[3]), "55 %, 2 MPa") << "in the order in which keys appear";
  EXPECT_EQ(si_text({"test.confining_stress", "2 MPa"}), "2000000");
  EXPECT_EQ(si_text({"bond.contact_coupling", "replaces"}), "replaces");
}

TEST_F(StudyFile, WrittenOutLoadsToTheSameStudyFromAnywhere) {
  std::ofstream(folder / "sizes.csv") << "d_mm,percent_finer\n0.12,0\n0.17,50\n0.24,100\n";
  Study study =
      load(base +
           "seeds = [4, 9]\nprecision_target = \"peak_q_Pa=2%\"\nmax_seeds = 12\n[matrix]\n\"test.confining_stress\" = [\"1 "
           "MPa\", \"2 MPa\"]\n"
           "grading.file = \"sizes.csv\"\noutput.snapshots_at = '[\"1 %\"]'\n[groups.a_b]\nmaterial = \"dense \\\"sand\\\"\"\n"
           "grains.friction = 0.4\n[groups.c]\ngrains.friction = 0.5\n");
  override_study(study, {"damping.local=20 %"});
  fs::create_directories(folder / "elsewhere");
  std::ofstream(folder / "elsewhere" / "written.toml") << resolved_study(study);
  Study const again = load_study(folder / "elsewhere" / "written.toml");
  EXPECT_EQ(again.seeds, study.seeds);
  EXPECT_EQ(again.max_seeds, 12);
  EXPECT_EQ(again.precision_target->width, study.precision_target->width);
  EXPECT_EQ(again.folder, fs::absolute(study.folder));
  EXPECT_EQ(again.keys, study.keys);
  ASSERT_EQ(names(again), names(study));
  EXPECT_EQ(again.groups[0].material, "dense \"sand\"");
  for (std::size_t g = 0; g < study.groups.size(); ++g) {
    EXPECT_EQ(again.groups[g].material, study.groups[g].material);
    EXPECT_EQ(again.groups[g].settings, study.groups[g].settings);
  }
}

TEST_F(StudyFile, HasOneMaterialWhereNamedGroupsDifferInTheirStressAlone) {
  Study const study = load(base +
                           "[groups.low]\ntest.confining_stress = \"1 MPa\"\ngrains.friction = 0.4\n"
                           "[groups.high]\ngrains.friction = 0.4\ntest.confining_stress = \"2 MPa\"\n"
                           "[groups.rough]\ntest.confining_stress = \"2 MPa\"\ngrains.friction = 0.6\n"
                           "[groups.own]\nmaterial = \"mine\"\ngrains.friction = 0.4\n");
  Names materials;
  for (StudyGroup const& group : study.groups) materials.push_back(group.material);
  EXPECT_EQ(materials, (Names{"low+high", "low+high", "rough", "mine"}));
}

TEST(StudyFiles, OfTheExamplesAreRight) {
  int count = 0;
  for (auto const& entry : fs::directory_iterator(CLATHRA_EXAMPLES "/studies")) {
    Study const study = load_study(entry.path());
    for (StudyGroup const& group : study.groups) EXPECT_NO_THROW(member_scene(study, group, 1)) << group.name;
    ++count;
  }
  EXPECT_GT(count, 0);
}

TEST(StudyGoal, IsANumberAndAWidth) {
  EXPECT_EQ(study_goal("peak_q_Pa=2%").width, 0.02);
  EXPECT_EQ(study_goal("peak_q_Pa=2%").number, "peak_q_Pa");
  EXPECT_EQ(study_goal("peak_q=2%").number, "peak_q_Pa");
  EXPECT_EQ(study_goal("peak_friction_angle=2%").number, "peak_friction_angle_deg");
  EXPECT_THROW(number_of_name("peak_friction_angle", NumbersOf::tests), std::invalid_argument) << "one test has no envelope";
  for (std::string const& name : number_names(NumbersOf::tests))
    EXPECT_TRUE(number_of_name(name, NumbersOf::tests).starts_with(name));
  EXPECT_EQ(study_goal("peak_eps1= 0.05").width, 0.05);
  for (char const* const wrong :
       {"peak_q_Pa", "=2%", "peak_q_Pa=", "peak_q_Pa=2 MPa", "peak_q_Pa=0", "peak_q_Pa=-1%", "peak_q_Pa=100%", "peek_q=2%"})
    EXPECT_THROW(study_goal(wrong), std::invalid_argument) << wrong;
}

}  // namespace
}  // namespace clathra
