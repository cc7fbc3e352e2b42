#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "domain/scene/specimen_design.hpp"
#include "file_content.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"
#include "loaded_scene.hpp"

namespace clathra {
namespace {

/// The messages of a scene that must be refused, one a line.
std::string problems_of(std::string const& text, Texts const& overrides = {}, ExitCode code = ExitCode::bad_input) {
  try {
    load(text, overrides);
  } catch (SceneProblems const& problems) {
    EXPECT_EQ(problems.code(), problems.problems[0].file.starts_with("--") ? ExitCode::usage : code) << problems.what();
    return problems.what();
  }
  ADD_FAILURE() << "taken:\n" << text;
  return {};
}

void expect_problem(std::string const& text, std::string const& message, ExitCode code = ExitCode::bad_input) {
  std::string const all = problems_of(text, {}, code);
  EXPECT_NE(all.find(message), std::string::npos) << "got:\n" << all << "\nwanted: " << message;
}

TEST(SceneFile, StatesOnlyWhatDiffersFromTheDefaults) {
  Scene const scene = load(sized + "[hydrate]\nsaturation = \"55 %\"\n[test]\nconfining_stress = \"2 MPa\"\n").scene;
  EXPECT_EQ(scene.specimen.particles, 2000);
  EXPECT_EQ(scene.hydrate.saturation, 0.55);
  EXPECT_EQ(scene.test.confining_stress, 2e6);
  EXPECT_EQ(scene.test.inertial_number, Scene{}.test.inertial_number);
  EXPECT_EQ(scene.grains.normal_stiffness, Scene{}.grains.normal_stiffness);
}

TEST(SceneFile, TakesQuantitiesNumbersChoicesAndTruthValues) {
  Scene const scene =
      load(
          "specimen.particles = 2e3\n"
          "[bond]\nlaw = 'constant_thickness'\ncontact_coupling = \"replaces_keeping_force\"\nafter_consolidation = true\n"
          "[hydrate]\nsaturation = 0.41\ntemperature = \"278.15 K\"\n[run]\nseed = 9007199254740992\n")
          .scene;
  EXPECT_EQ(scene.specimen.particles, 2000);
  EXPECT_EQ(scene.bond.law, BondLawKind::constant_thickness);
  EXPECT_EQ(scene.bond.contact_coupling, ContactCoupling::replaces_keeping_force);
  EXPECT_TRUE(scene.bond.after_consolidation);
  EXPECT_DOUBLE_EQ(scene.hydrate.temperature, 5);
  EXPECT_EQ(scene.run.seed, 9007199254740992u);
}

TEST(SceneFile, NamesPlaceCauseAndRemedyOfAProblem) {
  expect_problem("[specimen]\nparticles = 2000\n\n[run]\n# speed\n  seed = 3\ntime_step_saftey = 0.5\n",
                 "my.toml:7:1: error: unknown key 'time_step_saftey' in [run]; did you mean 'time_step_safety'?");
  expect_problem("[specimen]\nparticles = 2000\n[test]\nconfining_stress   = \"1 mm\"\n",
                 "my.toml:4:22: error: 'confining_stress' needs a pressure, got a length ('1 mm'); example: \"1 MPa\"");
}

TEST(SceneFile, AHintIsGivenOnlyWhereItHelps) {
  expect_problem("[hydrate]\nsaturation = \"110 %\"\n",
                 "'saturation' must lie between 0 and 1, got 1.1, which is 110 %; 100 % is the most");
  EXPECT_EQ(problems_of("[hydrate]\nsaturation = \"110 %\"\n").find("looks like percent"), std::string::npos);
  expect_problem("[output]\nsnapshots_at = [\"0,5 %\"]\n", "with a decimal point, got '0,5 %'");
}

TEST(SceneFile, ReportsAllProblemsAtOnceInTheOrderOfTheFile) {
  std::string const all = problems_of(
      "[specimen]\nparticles = -5\nwidht = \"3 mm\"\n[hydrate]\nsaturation = 26\n[grain]\nkn = 3\n[test]\nconfining_stress = "
      "true\n",
      {"run.threads=many", "damping.local"});
  Texts const wanted = {
      "my.toml:2:13: error: 'particles' must lie between 16 and 1000000000, got -5",
      "my.toml:3:1: error: unknown key 'widht' in [specimen]; did you mean 'width'?",
      "my.toml:5:14: error: 'saturation' must lie between 0 and 1, got 26; this looks like percent: write 0.26 or \"26 %\"",
      "my.toml:6:2: error: unknown section [grain]; did you mean 'grains'?",
      "my.toml:9:20: error: 'confining_stress' needs a pressure, got true",
      "--set run.threads=many: error: 'run.threads' needs a number, got 'many'",
      "--set damping.local: error: needs the form key=value"};
  std::size_t at = 0;
  for (std::string const& message : wanted) {
    std::size_t const found = all.find(message, at);
    ASSERT_NE(found, std::string::npos) << message << "\nin\n" << all;
    at = found;
  }
}

TEST(SceneFile, SuggestsTheNearestNameWhereverItIs) {
  expect_problem(sized + "friction = 0.5\n", "unknown key 'friction' in [specimen]; did you mean 'friction' in [grains]?");
  expect_problem("particles = 2000\n", "unknown key 'particles' outside any section; did you mean 'specimen.particles'?");
  expect_problem(sized + "[bond]\ncontact_coupling = \"paralel\"\n",
                 "must be one of 'replaces', 'parallel', 'replaces_keeping_force', got 'paralel'; did you mean 'parallel'?");
  EXPECT_EQ(problems_of(sized + "[run]\nqqqqqqqqqq = 1\n").find("did you mean"), std::string::npos);
}

TEST(SceneFile, AForgottenUnitIsFoundByTheRange) {
  expect_problem(sized + "[test]\nconfining_stress = 1\n", "got 1 Pa; a number without unit is in Pa; example: \"1 MPa\"");
  expect_problem(sized + "[hydrate]\ndensity = 0.9\n", "a number without unit is in kg/m^3");
  expect_problem(sized + "[hydrate]\ntemperature = 5\n",
                 "'temperature' needs a temperature, got a bare number ('5'), which could be degC or K");
  expect_problem(sized + "[test]\naxial_strain = 15\n", "write 0.15 or \"15 %\"");
}

TEST(SceneFile, MissingQuotesAreNamedAndNothingIsSaidOfWhatCouldNotBeRead) {
  EXPECT_EQ(problems_of("[specimen]\nvoid_ratio = 24 %  # loose\n"),
            "my.toml:2:17: error: a number with its unit goes in quotes: \"24 %\"");
  EXPECT_EQ(problems_of(sized + "[test]\nconfining_stress = \"2 MPa\n"),
            "my.toml:4:26: error: a quotation mark (\") is missing in this line");
  expect_problem(sized + "compaction_layers = 5 6\n", "my.toml:3:23: error: cannot be understood: ");
  expect_problem("[output]\nenergy = yes\n", "a text goes in quotes (\"yes\"); what is or is not so is true or false");
  EXPECT_EQ(problems_of("[specimen]\nparticels = 2000\n"),
            "my.toml:2:1: error: unknown key 'particels' in [specimen]; did you mean 'particles'?");
}

TEST(SceneFile, ASpecimenFileTakesThePlaceOfTheSizesInTheScene) {
  auto const file = std::filesystem::temp_directory_path() / ("clathra_place_" + std::to_string(::getpid()));
  std::ofstream(file) << "any";
  Texts const from_file = {"specimen.file=" + file.string()};
  LoadedScene const loaded = load(sized + "void_ratio = 0.24\n[grading]\nd50 = \"0.17 mm\"\n", from_file);
  EXPECT_TRUE(loaded.warnings.empty());
  EXPECT_EQ(loaded.scene.specimen.particles, 0);
  EXPECT_EQ(load(sized, {from_file[0], "specimen.particles=300"}).warnings.size(), 1u) << "said beside it";
  std::filesystem::remove(file);
}

TEST(SceneFile, HostileValuesAreRefused) {
  expect_problem("[specimen]\nparticles = 9000000000000000000\n", "'particles' must lie between");
  expect_problem("[specimen]\nparticles = 9e18\n", "'particles' must lie between");
  expect_problem("[specimen]\nparticles = 2000.5\n", "'particles' needs a whole number");
  expect_problem("[specimen]\nparticles = 99999999999999999999\n", "my.toml:2");
  expect_problem(sized + "[test]\nconfining_stress = \"1e400 Pa\"\n", "'confining_stress' is out of range");
  expect_problem(sized + "[test]\nconfining_stress = 1e400\n", "my.toml:4");
  expect_problem(sized + "[grains]\ndensity = \"-1 g/cm^3\"\n", "'density' must lie between");
  expect_problem("[specimen]\nwidth = \"1 km\"\nheight = \"1 km\"\n",
                 "particles of this grading; between 16 and 1e9 are possible");
  for (char const* const folder : {"..", "../..", "/", ".", "", "out/.."})
    expect_problem(sized + "[output]\nfolder = \"" + folder + "\"\n", "'output.folder' must name a folder of its own");
}

TEST(SceneFile, TheGuardKeepsHostileTextFromTheParser) {
  expect_problem(std::string((1 << 20) + 1, ' '), "my.toml: error: has 1048577 bytes");
  expect_problem(sized + "# " + std::string(1 << 16, 'x') + "\n",
                 "my.toml:3:65537: error: the line has 65538 bytes, at most 65536 are allowed");
  expect_problem(
      "[specimen]\nparticles = 2\xc2\xa0"
      "000\n",
      "my.toml:2:14: error: only ASCII characters are allowed outside quotes and comments");
  expect_problem(std::string("[specimen]\nparticles = 20\0 0\n", 26), "control characters");
  expect_problem("[specimen]\nvoid_ratio = nan\n", "my.toml:2:14: error: nan and inf are not allowed");
  expect_problem("[specimen]\nvoid_ratio = -inf\n", "nan and inf are not allowed");
  expect_problem("[specimen]\nfile = \"\"\"a\"\"\"\n", "multi-line");
  // In quotes any UTF-8: a folder may have any name. Not what only looks like it.
  EXPECT_EQ(load(sized + "[output]\nfolder = \"sable fonc\xc3\xa9 \xe6\xb2\x99/\xf0\x9f\x8f\x96\"\n").scene.output.folder,
            "sable fonc\xc3\xa9 \xe6\xb2\x99/\xf0\x9f\x8f\x96");
  for (char const* const bytes : {"a\\\xff", "\xc3", "\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xa9"})
    expect_problem(std::string("[specimen]\nfile = \"") + bytes + "\"\n", "my.toml:2:");
  expect_problem("[specimen]\nfile = \"a\xa9\"\n", "my.toml:2:10: error: the text is not UTF-8");
  std::string list = "[output]\nsnapshots_at = [";
  for (int i = 1; i < 3000; ++i) list += "0." + std::to_string(10000 + i) + ", ";
  EXPECT_EQ(load(sized + list + "]\n").scene.output.snapshots_at.size(), 2999u);
  std::string const comment = "# sable \xc3\xa0 la m\xc3\xa9thode, \xff nan\r\n";
  EXPECT_EQ(load(comment + sized + "compaction_layers = 7 # \"nan\" '''\r\n").scene.specimen.compaction_layers, 7);
  EXPECT_EQ(load(sized + "[output]\nfolder = \"a#nan\"\n").scene.output.folder, "a#nan");
}

TEST(SceneFile, AMedianDiameterThatIsStatedAsItIsChangesNoBit) {
  auto const sizes = [](std::string const& grading) {
    return design_sample(load(sized + "[grading]\n" + grading).scene).grading.diameters(100);
  };
  EXPECT_EQ(sizes("d50 = \"0.1694 mm\"\n"), sizes(""));
  EXPECT_EQ(sizes("d50 = \"0.1694 mm\"\ntable = \"uniform\"\n"), sizes("table = \"uniform\"\n"));
  EXPECT_NE(sizes("d50 = \"0.1695 mm\"\n"), sizes(""));
}

TEST(SceneFile, AByteOrderMarkIsOneErrorThatSaysWhatToDo) {
  EXPECT_EQ(problems_of("\xef\xbb\xbf[specimen]\n"),
            "my.toml:1:1: error: begins with a byte order mark: save it as UTF-8 without one, or as ASCII");
  for (std::string const mark : {"\xff\xfe", "\xfe\xff"})
    EXPECT_EQ(problems_of(mark + std::string("[\0s\0\n\0", 6)),
              "my.toml:1:1: error: is UTF-16 text: save it as UTF-8, or as ASCII");
}

TEST(SceneFile, DeeplyNestedAndWronglyShapedTextEndsInAMessage) {
  std::string nested;
  for (int i = 0; i < 200000; ++i) nested += "a.b.c\n";
  expect_problem(nested, "my.toml: error: has 1200000 bytes, at most 1048576 are allowed");
  std::string const depth = "exceeded maximum nested value depth of 256";
  expect_problem(sized + "compaction_layers = " + std::string(400, '[') + "\n",
                 "my.toml:3:277: error: cannot be understood: Error while parsing value: " + depth);
  std::string lines;
  for (int i = 0; i < 2000; ++i) lines += std::string(500, '[') + "\n";
  expect_problem(sized + "compaction_layers = [\n" + lines,
                 "my.toml:4:256: error: cannot be understood: Error while parsing value: " + depth);
  std::string dotted, tables;
  for (int i = 0; i < 8; ++i) dotted += "a.";
  expect_problem(sized + dotted + "a = 1\n", "my.toml:3:1: error: unknown key 'a' in [specimen]");
  expect_problem("[" + dotted + "a]\n" + sized, "my.toml:1:2: error: unknown section [a]");
  expect_problem(sized + dotted + "a.a = 1\n", "my.toml:3:18: error: a name has at most 8 dots");
  for (int i = 0; i < 250; ++i) tables += dotted + "a = {";
  expect_problem(sized + tables + std::string(250, '}') + "\n", "my.toml:3:1: error: unknown key 'a' in [specimen]");
  expect_problem(sized + "compaction_layers = [5]\n", "'compaction_layers' needs one value, not a list or a date");
  expect_problem(sized + "compaction_layers = 1979-05-27\n", "'compaction_layers' needs one value");
  expect_problem(sized + "compaction_layers.deep = 5\n", "'compaction_layers' is one value, not a section");
  expect_problem("specimen = 5\n", "'specimen' is a section");
  expect_problem("[specimen]\nparticles = 2000\nparticles = 3000\n", "my.toml:3");
  expect_problem("[specimen\n", "my.toml:1");
  expect_problem("", "the size of the specimen is open");
}

TEST(SceneFile, OverridesWinOverTheFile) {
  Scene const scene = load(sized, {"specimen.particles=200000", "test.confining_stress=3 MPa", "bond.law=none",
                                   "output.energy=true", "output.folder=\"out/a b\""})
                          .scene;
  EXPECT_EQ(scene.specimen.particles, 200000);
  EXPECT_EQ(scene.test.confining_stress, 3e6);
  EXPECT_EQ(scene.bond.law, BondLawKind::none);
  EXPECT_TRUE(scene.output.energy);
  EXPECT_EQ(scene.output.folder, "out/a b");
  EXPECT_NE(
      problems_of(sized, {"run.time_step_saftey=1"})
          .find("--set run.time_step_saftey=1: error: unknown key 'run.time_step_saftey'; did you mean 'run.time_step_safety'?"),
      std::string::npos);
}

TEST(SceneFile, AStrainRateReplacesTheDefaultInertialNumberButNotAStatedOne) {
  Scene const scene = load(sized + "[test]\nstrain_rate = \"5 %/min\"\n").scene;
  EXPECT_EQ(scene.test.strain_rate, 0.05 / 60);
  EXPECT_EQ(scene.test.inertial_number, 0);
  expect_problem(sized + "[test]\nstrain_rate = \"5 %/min\"\ninertial_number = 1e-4\n",
                 "my.toml:4:15: error: give either 'test.inertial_number' or 'test.strain_rate', not both");
  // An override of one replaces the other in the file; two overrides contradict each other.
  EXPECT_EQ(load(sized + "[test]\ninertial_number = 1e-5\n", {"test.strain_rate=5 %/min"}).scene.test.inertial_number, 0);
  EXPECT_EQ(load(sized + "[test]\nstrain_rate = 10\n", {"test.inertial_number=1e-5"}).scene.test.strain_rate, 0);
  problems_of(sized, {"test.strain_rate=10", "test.inertial_number=1e-5"});
  expect_problem(sized + "[test]\ninertial_number = 0\n",
                 "'inertial_number' must lie between 1e-12 and 1, got 0; where the key is left out: 2e-04");
}

TEST(SceneFile, AWaveNumberBoundsTheRateOfAnInertialNumberNotAStatedRate) {
  std::string const bounded = sized + "[test]\nmax_platen_wave_stress = 0.1\n";
  EXPECT_EQ(load(sized).scene.test.max_platen_wave_stress, 0.13);
  EXPECT_EQ(load(sized + "[test]\ninertial_number = 1e-3\n").scene.test.max_platen_wave_stress, 0) << "a stated rate is kept";
  EXPECT_EQ(load(sized, {"test.inertial_number=1e-3", "run.preset=draft"}).scene.test.max_platen_wave_stress, 0);
  EXPECT_EQ(load(bounded + "inertial_number = 1e-3\n").scene.test.max_platen_wave_stress, 0.1);
  expect_problem(
      bounded + "strain_rate = \"5 %/min\"\n",
      "my.toml:4:26: error: 'test.max_platen_wave_stress' lowers the rate of 'test.inertial_number': it cannot change a stated "
      "'test.strain_rate'");
  Scene const stated = load(bounded, {"test.strain_rate=5 %/min"}).scene;
  EXPECT_EQ(stated.test.max_platen_wave_stress, 0) << "an override of the rate takes the place of its bound, too";
  problems_of(sized, {"test.max_platen_wave_stress=0.1", "test.strain_rate=5 %/min"});
  EXPECT_EQ(load(sized + "[test]\nstrain_rate = 10\n", {"test.inertial_number=1e-3", "test.max_platen_wave_stress=0.1"})
                .scene.test.strain_rate,
            0);
}

TEST(SceneFile, ThreeOfFourFixTheSpecimen) {
  std::string const box = "[specimen]\nwidth = \"10 mm\"\nheight = \"20 mm\"\n";
  EXPECT_NO_THROW(load(box));
  EXPECT_NO_THROW(load(box + "particles = 8000\n"));
  EXPECT_NO_THROW(load(box + "particles = 8000\nvoid_ratio = 0.22\n"));
  expect_problem(box + "particles = 8000\nvoid_ratio = 0.22\n[grading]\nd50 = \"0.17 mm\"\n", "three of them fix the fourth");
  EXPECT_NO_THROW(load("[specimen]\nwidth = \"10 mm\"\nparticles = 8000\nvoid_ratio_at = \"test\"\n"));
  expect_problem(box + "void_ratio_at = \"test\"\n", "those of the specimen as it is made");
  expect_problem(box + "aspect_ratio = 3\n", "contradict each other");
  EXPECT_DOUBLE_EQ(load("[specimen]\nwidth = \"10 mm\"\n").scene.specimen.height, 0.02);
  expect_problem(box + "particles = 80000\n", "do not fit");
}

TEST(SceneFile, HydrateOutsideItsStabilityFieldIsRefused) {
  std::string const warm = sized + "[hydrate]\nsaturation = 0.55\ntemperature = \"12 degC\"\n";
  expect_problem(warm, "my.toml:5:15: refused: hydrate is not stable at 12 degC and a pore pressure of 8 MPa in water of 35 ppt",
                 ExitCode::refused);
  EXPECT_EQ(load(warm, {"run.ignore_guards=true"}).warnings.size(), 1u);
  EXPECT_NO_THROW(load(sized + "[hydrate]\ntemperature = \"12 degC\"\n")) << "clean sand has no hydrate to be unstable";
  EXPECT_NO_THROW(load(warm + "[bond]\nlaw = \"none\"\n"));
}

TEST(SceneFile, ASandTooFineForAnyBondIsRefused) {
  expect_problem(sized + "[grading]\nd50 = \"10 um\"\n[hydrate]\nsaturation = 0.55\n",
                 "my.toml:4:7: error: with d50 = 0.01 mm no bond has tensile strength");
  EXPECT_NO_THROW(load(sized + "[grading]\nd50 = \"40 um\"\n[hydrate]\nsaturation = 0.55\n"));
  EXPECT_NO_THROW(load(sized + "[grading]\nd50 = \"10 um\"\n"));
}

TEST(SceneFile, ReplaceAfterConsolidationIsRefusedUnlessForced) {
  std::string const text =
      sized + "[hydrate]\nsaturation = 0.55\n[bond]\ncontact_coupling = \"replaces\"\nafter_consolidation = true\n";
  expect_problem(text, "my.toml:7:23: refused: contact_coupling = \"replaces\" with after_consolidation", ExitCode::refused);
  EXPECT_EQ(load(text, {"run.ignore_guards=true"}).warnings.size(), 1u);
}

TEST(SceneFile, ABondThatReplacesTheContactFormsAtTheBondingStressUnlessToldOtherwise) {
  EXPECT_TRUE(load(sized + "[hydrate]\nsaturation = 0.55\n").scene.bond.after_consolidation);
  EXPECT_FALSE(
      load(sized + "[hydrate]\nsaturation = 0.55\n[bond]\ncontact_coupling = \"replaces\"\n").scene.bond.after_consolidation);
}

TEST(SceneFile, FilesOfASceneAreFoundBesideItAndMissedWithTheirOwnCode) {
  expect_problem("[specimen]\nfile = \"none.h5\"\n", "'specimen.file' names a file that is not there: folder/none.h5",
                 ExitCode::file_missing);
  expect_problem(sized + "[grading]\nfile = \"none.csv\"\n", "'grading.file' names a file that is not there: folder/none.csv",
                 ExitCode::file_missing);
  EXPECT_THROW(load_scene("no/such/scene.toml"), FileProblem);

  auto const folder = std::filesystem::temp_directory_path() / ("clathra_scene_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "broken.csv") << "d_mm,percent_finer\n0.1,0\n0.2,x\n";
  std::ofstream(folder / "scene.toml") << sized << "[grading]\nfile = \"broken.csv\"\n";
  try {
    load_scene(folder / "scene.toml");
    ADD_FAILURE() << "a broken grading was taken";
  } catch (SceneProblems const& problems) {
    EXPECT_EQ(problems.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(problems.what()).find("broken.csv:3"), std::string::npos) << problems.what();
  }
  std::filesystem::remove_all(folder);
}

TEST(SceneFile, KeysWithoutEffectAreWarnedOf) {
  EXPECT_EQ(load(sized + "[bond]\ncontact_coupling = \"replaces_keeping_force\"\n").warnings.size(), 1u);
  EXPECT_EQ(load(sized + "[hydrate]\nsaturation = 0.15\n").warnings.size(), 1u);
  EXPECT_EQ(load(sized + "[hydrate]\nsaturation = 0.55\n[bond]\ncritical_thickness = \"10 um\"\n").warnings.size(), 1u);
  EXPECT_TRUE(load(sized).warnings.empty());
}

TEST(SceneFile, TheResolvedEchoLoadsToTheSameScene) {
  LoadedScene const first = load(
      "[specimen]\nwidth = \"10.1 mm\"\n[hydrate]\nsaturation = 0.407\n[test]\nstrain_rate = \"5 "
      "%/min\"\n[grains]\nnormal_stiffness = "
      "123456789.1\n"
      "[output]\nfolder = \"a \\\"b\\\"\"\n");
  std::string const echo = resolved_scene(first.scene, "elsewhere");
  Scene const again = parse_scene(echo, "resolved.toml", "elsewhere").scene;
  for (Key const& key : schema()) EXPECT_EQ(value_text(key, first.scene), value_text(key, again)) << key.name;
}

TEST(SceneFile, ANegativeZeroIsZero) {
  Scene const scene = load("[specimen]\nparticles = 110\n[hydrate]\nsaturation = \"-0 %\"\n").scene;
  EXPECT_FALSE(std::signbit(scene.hydrate.saturation));
  EXPECT_EQ(scene.hydrate.saturation, 0);
}

TEST(SceneFile, EveryExampleIsRight) {
  int count = 0;
  for (std::filesystem::path const& path : example_scenes()) {
    LoadedScene const loaded = load_scene(path);
    EXPECT_TRUE(loaded.warnings.empty()) << path << ": " << loaded.warnings.front();
    ++count;
  }
  EXPECT_GE(count, 17);
}

/// Counts the members of an aggregate: the most initialisers that it takes.
struct Anything {
  template <class T>
  operator T() const;
};
template <class T, class... Members>
consteval int member_count() {
  if constexpr (requires { T{Members{}..., Anything{}}; })
    return member_count<T, Members..., Anything>();
  else
    return sizeof...(Members);
}

TEST(Schema, HasAKeyForEveryFieldOfTheScene) {
  int const fields = member_count<SpecimenScene>() + member_count<GrainScene>() + member_count<GradingScene>() +
                     member_count<HydrateScene>() + member_count<BondScene>() + member_count<DampingScene>() +
                     member_count<TestScene>() + member_count<RunScene>() + member_count<OutputScene>();
  EXPECT_EQ(fields, static_cast<int>(schema().size()));
  EXPECT_EQ(member_count<Scene>(), 10) << "nine sections and the stages";
}

TEST(Schema, ItsKeysReachDifferentFieldsAndItsDefaultsAreAllowed) {
  Scene const defaults;
  for (Key const& key : schema()) {
    EXPECT_FALSE(key.help.empty()) << key.name;
    Scene scene;
    std::string const text(unquoted(value_text(key, defaults)));
    EXPECT_NO_THROW(set_from_text(key, scene, text)) << key.name << " = " << text;
  }
}

}  // namespace
}  // namespace clathra
