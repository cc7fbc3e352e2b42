/// What the schema says of itself: reference, JSON Schema, commented scenes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "command.hpp"
#include "file_content.hpp"
#include "io/results/run_record.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/scene_reference.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

std::string content_of(fs::path const& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(SceneReference, ACommentedSceneLoadsToTheSameScene) {
  ASSERT_GE(example_scenes().size(), 12u);
  for (fs::path const& file : example_scenes()) {
    LoadedScene const original = load_scene(file);
    for (std::string const& source : {original.source, std::string()}) {
      std::string const text = commented_scene(original.scene, original.stated, "# opening\n", source);
      LoadedScene const again = parse_scene(text, "again.toml", file.parent_path());
      EXPECT_EQ(scene_json(again.scene), scene_json(original.scene)) << file;
      EXPECT_EQ(again.stated, original.stated) << file;
    }
  }
}

/// Taking the comment signs away from one key after the other never makes a scene wrong: what is shown is allowed.
TEST(SceneReference, EveryCommentedValueIsAllowed) {
  std::istringstream lines(commented_scene(Scene{}, {}, ""));
  std::string line, section;
  int values = 0;
  while (std::getline(lines, line)) {
    if (line.starts_with("[")) section = line;
    if (!line.starts_with("# ") || line.find(" = ") == std::string::npos ||
        find_key(section.substr(1, section.size() - 2) + "." + line.substr(2, line.find(" = ") - 2)) == nullptr)
      continue;
    ++values;
    try {
      parse_scene("[specimen]\nparticles = 1000\n" + (section == "[specimen]" ? "" : section + "\n") + line.substr(2) + "\n",
                  "one.toml", ".");
    } catch (SceneProblems const& problems) {
      // Some defaults need another key beside them, which is said of the whole scene, not of the value.
      EXPECT_EQ(std::string(problems.what()).find("must lie between"), std::string::npos) << problems.what();
      EXPECT_EQ(std::string(problems.what()).find("must be one of"), std::string::npos) << problems.what();
    }
  }
  EXPECT_GT(values, 30);
}

TEST(SceneReference, NamesEveryKeyInBothForms) {
  std::string page = schema_markdown();
  for (std::size_t at; (at = page.find("\n  ")) != page.npos;) page.replace(at, 3, " ");  // lines are wrapped
  nlohmann::json const json = nlohmann::json::parse(schema_json());
  for (Key const& key : schema()) {
    EXPECT_NE(page.find("- **`" + std::string(key.leaf()) + "`**: " + std::string(key.help)), std::string::npos) << key.name;
    auto const& entry = json["properties"][std::string(key.section())]["properties"][std::string(key.leaf())];
    EXPECT_TRUE(entry.contains("description")) << key.name;
    if (key.kind == Kind::choice) {
      EXPECT_EQ(entry["enum"].size(), key.choices.size()) << key.name;
    }
  }
}

TEST(SceneReference, ThePageInTheDocumentationIsTheProgramsOwn) {
  fs::path const page = fs::path(CLATHRA_EXAMPLES).parent_path() / "docs" / "reference" / "scene-keys.md";
  EXPECT_EQ(content_of(page), schema_markdown()) << "renew it: clathra schema > docs/reference/scene-keys.md";
}

TEST(SceneReference, LinesOfThePageFitAPageOf110Columns) {
  std::istringstream lines(schema_markdown());
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 110u) << line;
}

TEST(InitCommand, WritesASceneThatIsRightAndNeverOverwrites) {
  fs::path const file = fs::temp_directory_path() / ("clathra_init_" + std::to_string(::getpid()) + ".toml");
  CommandResult const first = run_clathra("init quick -o " + file.string());
  EXPECT_EQ(first.code, 0) << first.output;
  EXPECT_EQ(run_clathra("check " + file.string()).code, 0);
  EXPECT_NE(content_of(file).find("\nsaturation = \"55 %\"\n"), std::string::npos) << "as the example spells it";
  std::ofstream(file, std::ios::app) << "# mine\n";
  auto const size = fs::file_size(file);
  EXPECT_EQ(run_clathra("init quick -o " + file.string()).code, 73);
  EXPECT_EQ(fs::file_size(file), size);
  fs::remove(file);
  CommandResult const wrong = run_clathra("init quik");
  EXPECT_EQ(wrong.code, 64);
  EXPECT_NE(wrong.output.find("did you mean 'quick'"), std::string::npos) << wrong.output;
  EXPECT_EQ(run_clathra("init -o a.toml").code, 64);
  CommandResult const list = run_clathra("init");
  EXPECT_EQ(run_clathra("init --list").output, list.output);
  for (fs::path const& example : example_scenes())
    EXPECT_NE(list.output.find(fs::relative(example, CLATHRA_EXAMPLES).replace_extension().string()), std::string::npos)
        << example;
}

TEST(InitCommand, WritesAStudyBesideItsScene) {
  fs::path const folder = fs::temp_directory_path() / ("clathra_init_study_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::string const study = (folder / "mine.toml").string();
  CommandResult const written = run_clathra("init studies/saturations -o '" + study + "'");
  EXPECT_EQ(written.code, 0) << written.output;
  EXPECT_TRUE(says(written, "mine.toml is written; see what it costs with: clathra study "));
  CommandResult const cost = run_clathra("study --dry-run '" + study + "'");
  EXPECT_EQ(cost.code, 0) << cost.output;
  EXPECT_TRUE(says(cost, "mine.toml: 6 groups of 5 seeds\n"));
  EXPECT_NE(content_of(study).find("clathra study " + study + " --output"), std::string::npos) << "its comment names it";
  // Neither is overwritten.
  std::ofstream(folder / "quick.toml", std::ios::app) << "# mine\n";
  auto const size = fs::file_size(folder / "quick.toml");
  EXPECT_EQ(run_clathra("init studies/saturations -o '" + study + "'").code, 73);
  EXPECT_NE(run_clathra("init saturations").output.find("did you mean 'studies/saturations'?"), std::string::npos);
  CommandResult const second = run_clathra("init studies/saturations -o '" + (folder / "second.toml").string() + "'");
  EXPECT_EQ(second.code, 0) << second.output;
  EXPECT_TRUE(says(second, "quick.toml is there already and stays\n"));
  EXPECT_EQ(fs::file_size(folder / "quick.toml"), size);
  EXPECT_TRUE(says(run_clathra("init"), "studies/saturations      Three saturations at two confining stresses"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace clathra
