/// Stages in scene files: what is read, refused and written back.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <tuple>

#include "command.hpp"
#include "domain/scene/loading_stage.hpp"
#include "file_content.hpp"
#include "io/results/run_record.hpp"
#include "io/scene/scene_comparison.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/schema.hpp"
#include "io/scene/stage_keys.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

std::string const sized = "[specimen]\nparticles = 300\nvoid_ratio = 0.24\n";
std::string const two_stages =
    sized +
    "[[stage]]\nname = \"shear\"\nvertical = { inertial_number = 5e-4 }\nlateral = { stress = \"1 MPa\" }\n"
    "until = { axial_strain = \"0.5 %\" }\n"
    "[[stage]]\nname = \"unloading\"\nvertical.inertial_number = -5e-4\nlateral.stress = \"1 MPa\"\nuntil.deviator_stress = 0\n"
    "until.path = \"2 %\"\n";

LoadedScene load(std::string const& text, std::vector<std::string> const& overrides = {}) {
  return parse_scene(text, "my.toml", "folder", overrides);
}

std::string problems_of(std::string const& text, std::vector<std::string> const& overrides = {}) {
  try {
    load(text, overrides);
  } catch (SceneProblems const& problems) {
    return problems.what();
  }
  ADD_FAILURE() << "taken:\n" << text;
  return {};
}

void expect_problem(std::string const& text, std::string const& message, std::vector<std::string> const& overrides = {}) {
  std::string const all = problems_of(text, overrides);
  EXPECT_NE(all.find(message), std::string::npos) << "got:\n" << all << "\nwanted: " << message;
}

TEST(StagesInAScene, AreAListWithoutSayingSo) {
  Scene const scene = load(two_stages).scene;
  EXPECT_EQ(scene.test.kind, TestKind::list);
  ASSERT_EQ(scene.stages.size(), 2u);
  EXPECT_EQ(scene.stages[0].until.axial_strain, 0.005);
  EXPECT_FALSE(is_given(scene.stages[0].until.deviator_stress));
  EXPECT_EQ(scene.stages[1].vertical.inertial_number, -5e-4);
  EXPECT_EQ(scene.stages[1].until.deviator_stress, 0) << "0 is a mark, too";
  EXPECT_EQ(scene.stages[1].lateral.stress, 1e6);
}

TEST(StagesInAScene, AreWrittenBackAsTheyAre) {
  Scene const scene = load(two_stages).scene;
  std::string const resolved = resolved_scene(scene, "folder");
  Scene const again = parse_scene(resolved, "resolved.toml", "folder").scene;
  EXPECT_EQ(stages_toml(again.stages), stages_toml(scene.stages));
  Scene const recorded = scene_of(scene_json(scene));
  EXPECT_EQ(stages_toml(recorded.stages), stages_toml(scene.stages));
  EXPECT_EQ(recorded.test.kind, TestKind::list);
  SceneTexts const texts = scene_texts(scene, "folder");
  EXPECT_EQ(scene_differences(texts, scene, "folder", Agreement::same_test), "");
  Scene const other = load(two_stages, {"stage.unloading.until.path=3 %"}).scene;
  EXPECT_NE(scene_differences(texts, other, "folder", Agreement::same_test).find("[[stage]]"), std::string::npos);
}

/// All presets, each key of a stage away from its default.
TEST(StagesInAScene, OfEachKindAreWrittenOutAndReadBack) {
  for (std::string_view const kind : find_key("test.kind")->choices) {
    if (kind == "list") continue;
    Scene const scene = load(sized, {"test.kind=" + std::string(kind), "test.dead_load=1 MPa", "hydrate.saturation=41 %"}).scene;
    std::string const resolved = resolved_scene(scene, "folder"), mark = "# [[stage]]";
    EXPECT_NE(resolved.find(mark), std::string::npos) << kind;
    std::vector<LoadingStage> const stages = stages_of(scene);
    Scene const list = load(sized + "[hydrate]\nsaturation = 0.41\n" + stages_toml(stages)).scene;
    EXPECT_EQ(stages_toml(stages_of(list)), stages_toml(stages)) << kind;
  }
  for (Key const& key : stage_schema()) {
    EXPECT_EQ(find_stage_key(key.name), &key);
    std::string const value = key.name == "name"                                        ? "\"other\""
                              : key.kind == Kind::boolean                               ? "true"
                              : key.name == "hydrate.dissociation"                      ? "\"kim_1987\""
                              : key.kind == Kind::choice                                ? "\"constant_volume\""
                              : key.kind == Kind::quantities                            ? "[0, 0.125]"
                              : key.kind == Kind::integer                               ? "7"
                              : key.leaf() == "temperature"                             ? "\"7 degC\""
                              : key.leaf() == "pore_pressure"                           ? "\"3 MPa\""
                              : key.leaf() == "stress" || key.leaf() == "fluid_modulus" ? "\"3 MPa\""
                                                                                        : "0.125";
    LoadingStage const stage = stage_of_texts({{std::string(key.name), value}});
    auto const texts = stage_texts(stage);
    ASSERT_EQ(texts.size(), 1u) << key.name;
    EXPECT_EQ(texts[0].first, key.name);
    EXPECT_EQ(stages_toml({stage_of_texts(texts)}), stages_toml({stage}));
  }
}

TEST(StagesInAScene, SayAllThatIsWrongAtOnceWithItsLine) {
  std::string const wrong =
      sized +
      "[[stage]]\nname = \"a,b\"\nvertical = { hold = true, stress = \"1 MPa\" }\nlateral = { hold = true }\n"     // lines 4 to 7
      "[[stage]]\nname = \"generate\"\nvertical = { inertial_number = 1e-4 }\nlateral = { stress = \"1 MPa\" }\n"  // 8 to 11
      "increments = 3\nuntil = { rest = true, cycles = 3 }\n";
  std::string const all = problems_of(wrong);
  for (char const* const part :
       {"my.toml:4:", "stage 1 ('a,b'): 'name' must be given, of letters", "'vertical' needs exactly one of", "2 are given",
        "'until' states no end", "my.toml:8:", "stage 2 ('generate'): this name is that of a part of each run",
        "'until.rest' needs sides that hold or have a stress", "'until.cycles' needs 'turn'", "'increments' need a stress"})
    EXPECT_NE(all.find(part), std::string::npos) << part << "\nin\n" << all;
}

TEST(StagesInAScene, SayWhichKeyIsNotKnown) {
  expect_problem(two_stages + "untl.path = 1\n", "unknown key 'untl' in [[stage]]");
  expect_problem(two_stages + "until.axial_stain = 1\n", "did you mean 'until.axial_strain'?");
  expect_problem(two_stages + "until.volumetric_strain = \"80 %\"\n", "'until.volumetric_strain' must lie between");
  expect_problem(two_stages + "until.mean_stress = true\n", "'until.mean_stress' needs");
  expect_problem(two_stages + "vertical = 3\n", "vertical");
  expect_problem(sized + "[stage]\nname = \"a\"\n", "write [[stage]]");
  expect_problem("[test]\nkind = \"list\"\n" + sized, "needs sections [[stage]]");
  expect_problem("[test]\nkind = \"biaxial\"\n" + two_stages, "'test.kind' names a list of stages of its own");
  expect_problem(two_stages, "there is no stage '3'", {"stage.3.until.path=1 %"});
  expect_problem(two_stages, "unknown key 'stage.2.until.pth'", {"stage.2.until.pth=1 %"});
  expect_problem(sized + "[test]\nkind = \"creep\"\n", "needs 'test.dead_load'");
  expect_problem(sized + "[test]\nkind = \"unload_reload\"\nunload_at = [\"20 %\"]\n", "must lie below 'test.axial_strain'");
}

TEST(StagesInAScene, SayWhatADissociationNeeds) {
  std::string const text = sized +
                           "[hydrate]\nsaturation = \"41 %\"\n[[stage]]\nname = \"warm\"\nvertical.stress = \"1.5 MPa\"\n" +
                           "lateral.stress = \"1 MPa\"\nuntil.rest = true\n";
  std::string const rate = text + "hydrate.dissociation = \"kim_1987\"\n", timed = rate + "hydrate.duration = \"3 h\"\n";
  EXPECT_EQ(load(timed).scene.stages[0].hydrate.duration, 3 * 3600);
  EXPECT_EQ(load(text + "hydrate.dissociation = \"instant\"\n").scene.stages[0].hydrate.dissociation, Dissociation::instant);
  expect_problem(rate, "a rate of 'hydrate.dissociation' needs 'hydrate.duration'");
  expect_problem(text + "hydrate = { temperature = \"9 degC\", duration = \"3 h\" }\n", "else nothing in a stage knows a time");
  expect_problem(timed + "hydrate.saturation = 0.3\n", "'hydrate.saturation' follows from 'hydrate.dissociation'");
  expect_problem(timed + "hydrate.temperature = \"12 degC\"\nhydrate.undrained = true\n", "keeps hydrate on the boundary");
  expect_problem(text + "hydrate.dissociation = \"kim\"\n",
                 "must be one of 'given', 'instant', 'clarke_2001', 'kim_1987', 'slow'");
  expect_problem(rate + "hydrate.duration = \"3 mm\"\n", "needs a time, got a length ('3 mm'); example: \"3 h\"");
  std::string const next =
      "[[stage]]\nname = \"rest\"\nvertical.stress = \"1.5 MPa\"\nlateral.stress = \"1 MPa\"\nuntil.rest = true\n";
  expect_problem(timed + next + "hydrate.saturation = \"30 %\"\n", "may be above what a stage before it leaves");
  EXPECT_EQ(load(timed + next + "hydrate.saturation = \"20 %\"\n").scene.stages.size(), 2u);
}

TEST(StagesInAScene, SayWhatALawOfLossLeavesAside) {
  std::string const text = sized + "[test]\nkind = \"heating\"\n[hydrate]\nsaturation = ";
  auto const warned = [&](std::string const& more, std::string const& of) {
    for (std::string const& warning : load(text + more).warnings)
      if (warning.find(of) != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(
      warned("0.41\nloss_exponent = 2\n", "hydrate.loss_exponent has no effect with hydrate.loss = \"critical_thickness\""));
  EXPECT_TRUE(warned("0.41\nloss = \"uniform\"\nspread_of_loss = 0.1\n", "hydrate.spread_of_loss has no effect with"));
  EXPECT_FALSE(warned("0.41\nloss = \"recession\"\nspread_of_loss = 0.1\n", "no effect"));
  expect_problem(text + "0.21\nloss = \"recession\"\n", "above 22 %: 20 % and hydrate.spread_of_loss");
  EXPECT_FALSE(warned("0.21\nloss = \"uniform\"\n", "above 20 %"));
  expect_problem(text + "0.41\nloss = \"uniforn\"\n", "did you mean 'uniform'?");
}

TEST(StagesInAScene, AreSetByNumberAndByName) {
  Scene const scene =
      load(two_stages, {"stage.1.until.axial_strain=0.7 %", "stage.unloading.until.deviator_stress=0.2 MPa"}).scene;
  EXPECT_EQ(scene.stages[0].until.axial_strain, 0.007);
  EXPECT_EQ(scene.stages[1].until.deviator_stress, 0.2e6);
  EXPECT_EQ(scene.stages[0].name, "shear");
}

/// Hydrate forms once, where there is some, and changes after that.
TEST(StagesInAScene, SayWhereHydrateForms) {
  std::string const hydrate = "[hydrate]\nsaturation = \"41 %\"\n", at_rest = "stage.1.until.rest=true",
                    in_1 = "stage.1.forms_hydrate=true", in_2 = "stage.2.forms_hydrate=true";
  EXPECT_TRUE(load(hydrate + two_stages, {in_2}).scene.stages[1].forms_hydrate);
  expect_problem(hydrate + two_stages, "hydrate forms in stage 1 already", {in_1, in_2});
  expect_problem(two_stages, "hydrate is to form in a stage, and the scene has none", {in_2});
  expect_problem(hydrate + two_stages, "'forms_hydrate' in a stage", {in_2, "bond.after_consolidation=false"});
  expect_problem(hydrate + two_stages, "'hydrate' changes before it forms in stage 2",
                 {in_2, at_rest, "stage.1.vertical.inertial_number=", "stage.1.vertical.stress=2 MPa",
                  "stage.1.hydrate.temperature=6 degC"});
}

/// Taken, with a word on what is likely not meant.
TEST(StagesInAScene, WarnOfHydrateThatDoesNotGoAsItsStateDoes) {
  auto const warnings = [](std::string const& change) {
    std::string const text = sized +
                             "[hydrate]\nsaturation = \"41 %\"\n[[stage]]\nname = \"s\"\nvertical.stress = \"2 MPa\"\n"
                             "lateral.stress = \"1 MPa\"\nuntil.rest = true\nhydrate = { " +
                             change + " }\n";
    std::string all;
    for (std::string const& warning : load(text).warnings) all += warning + "\n";
    return all;
  };
  std::pair<char const*, char const*> const cases[] = {
      {"temperature = \"5 degC\", saturation = \"41 %\"", "'hydrate' changes nothing"},
      {"temperature = \"14 degC\", saturation = \"20 %\", constant_total_stress = true", "the pore pressure stays"},
      {"temperature = \"14 degC\", undrained = true, constant_total_stress = true", "keeps the total stresses already"},
      {"pore_pressure = \"7 MPa\", dissociation = \"instant\"", "hydrate stays stable, by"},
      {"temperature = \"2 degC\", saturation = \"20 %\"", "the hydrate that is lost is stable, by"},
      {"temperature = \"14 degC\"", "the hydrate stays, "}};
  for (auto const& [change, warning] : cases)
    EXPECT_NE(warnings(change).find(warning), std::string::npos) << change << "\n" << warnings(change);
  EXPECT_EQ(warnings("temperature = \"14 degC\", saturation = \"20 %\"").find("stage 's'"), std::string::npos);
  EXPECT_EQ(warnings("temperature = \"7 degC\"").find("stage 's'"), std::string::npos);
}

/// What may grow when a run is extended is the end of its last stage, not what decides how it goes there.
TEST(StagesInAScene, GrowOnlyWhereTheStrainIsTheirEnd) {
  for (auto const& [kind, more, grows] : {std::tuple{"biaxial", "", true},
                                          {"constant_volume", "", true},
                                          {"cyclic", "", false},
                                          {"oedometer", "", false},
                                          {"unload_reload", "", false},
                                          {"unload_reload", "test.unload_at=1 %", true}}) {
    std::vector<std::string> settings{"test.kind=" + std::string(kind)};
    if (*more) settings.emplace_back(more);
    SceneTexts const then = scene_texts(load(sized, settings).scene, "folder");
    settings.emplace_back("test.axial_strain=20 %");
    std::string const differences = scene_differences(then, load(sized, settings).scene, "folder", Agreement::further);
    EXPECT_EQ(differences.empty(), grows) << kind << differences;
  }
}

TEST(StagesInAStudy, AreVariedByTheirKeys) {
  CommandResult const result = run_clathra("study " CLATHRA_EXAMPLES "/studies/response-envelope.toml --dry-run --output " +
                                           (fs::temp_directory_path() / "clathra_no_study").string());
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_NE(result.output.find("72"), std::string::npos) << result.output;
}

class StagesOfARun : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    fs::create_directories(folder());
    put(folder() / "stages.toml", two_stages + "[output]\nrecords = 20\nsnapshots = 4\nenergy = true\n");
    CommandResult const result = run_clathra("run " + (folder() / "stages.toml").string() + " -o " + out().string());
    ASSERT_EQ(result.code, 0) << result.output;
    said() = result.output;
  }
  static void TearDownTestSuite() { fs::remove_all(folder()); }
  static fs::path folder() { return fs::temp_directory_path() / ("clathra_stages_" + std::to_string(::getpid())); }
  static fs::path out() { return folder() / "out"; }
  static std::string& said() {
    static std::string text;
    return text;
  }
};

TEST_F(StagesOfARun, HaveTheirNumbersAndSayWhatTheyEndedBy) {
  auto const run = nlohmann::json::parse(content(out() / "run.json"));
  ASSERT_EQ(run["loading"].size(), 2u);
  EXPECT_EQ(run["loading"][0]["stage"], "shear");
  EXPECT_EQ(run["loading"][0]["ended_by"], "axial strain");
  EXPECT_EQ(run["loading"][1]["ended_by"], "deviator stress");
  EXPECT_GT(run["stages"]["unloading"]["secant_stiffness_Pa"].get<double>(), 1e7);
  EXPECT_GT(run["stages"]["unloading"]["checks"].get<double>(), 1);
  EXPECT_LT(run["stages"]["unloading"]["energy_residual"].get<double>(), 0.01);
  for (auto const& [stage, numbers] : run["stages"].items())
    for (auto const& [name, value] : numbers.items())
      EXPECT_NE(run["meaning"].value("stages." + stage + "." + name, ""), "") << stage << " " << name;
  EXPECT_NE(said().find("unloading"), std::string::npos) << said();
}

/// Too fast a stage is refused before the specimen is made, also in a dry run.
TEST_F(StagesOfARun, AreRefusedBeforeTheWorkWhereOneIsTooFast) {
  std::string const scene = (folder() / "stages.toml").string(),
                    fast = " --set stage.unloading.vertical.inertial_number= --set stage.unloading.vertical.strain_rate=-3000";
  for (std::string const& command : {"run " + scene + " -o " + (folder() / "fast").string(), "check " + scene}) {
    CommandResult const result = run_clathra(command + fast);
    EXPECT_NE(result.code, 0) << command;
    EXPECT_NE(result.output.find("is above 0.01: the loading is not quasi-static"), std::string::npos) << result.output;
    EXPECT_FALSE(fs::exists(folder() / "fast" / "history.csv"));
  }
}

TEST_F(StagesOfARun, AreAPageOfTheirOwn) {
  std::string const page = content(out() / "report.html");
  for (char const* const part : {"Stages", "Stress path", "deviator stress", "E<sub>ur</sub>", "Stress ratio"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find("Compression</figcaption>"), std::string::npos) << "no stress was put on in increments";
}

TEST_F(StagesOfARun, GoOnFromAnyCheckpointWithTheSameBytes) {
  fs::path const again = folder() / "again";
  std::string const command = "run " + (folder() / "stages.toml").string() + " -o " + again.string() +
                              " --set specimen.file=" + (out() / "specimen.h5").string();
  ASSERT_EQ(run_clathra(command + " --max-walltime 0.001s --checkpoint-every 0s").code, 75);
  int parts = 1;
  for (int code = 75; code == 75 && parts < 400; ++parts) {
    code = run_clathra(command + " --resume --max-walltime 0.5s --checkpoint-every 0s").code;
    ASSERT_TRUE(code == 0 || code == 75) << code;
  }
  EXPECT_GT(parts, 1);
  auto const rows = [](std::string const& history) { return history.substr(history.find("shear")); };
  EXPECT_EQ(rows(content(again / "history.csv")), rows(content(out() / "history.csv")));
  auto const one = nlohmann::json::parse(content(out() / "run.json")), two = nlohmann::json::parse(content(again / "run.json"));
  EXPECT_EQ(two["state_hash"], one["state_hash"]);
  EXPECT_EQ(two["stages"]["unloading"], one["stages"]["unloading"]);
  EXPECT_EQ(two["loading"], one["loading"]);
}

}  // namespace
}  // namespace clathra
