/// `clathra reproduce` as a user calls it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "io/formats/text_file.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

class ReproduceCommand : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(folder); }
  CommandResult reproduce(std::string const& name, std::string const& more = "") const {
    return run_clathra(
        "reproduce --particles 200 --set specimen.void_ratio=0.26 --set test.inertial_number=9e-4 --set run.ignore_guards=true "
        "--output '" +
        (folder / name).string() + "' " + more);
  }
  std::string content(std::string const& file) const { return read_text_file(folder / file, 1 << 25); }
  /// Without the line that tells how long it took.
  std::string scorecard(std::string const& name) const {
    std::string text = content(name + "/scorecard.md");
    std::size_t const at = text.find("- cost: ");
    return text.erase(at, text.find('\n', at) - at);
  }
  /// The first lines of the CSV files in a folder of figures that have more, by their names without numbers.
  std::map<std::string, std::string> heads_of_figures() const {
    std::map<std::string, std::string> heads;
    for (auto const& entry : fs::directory_iterator(folder / "figures")) {
      if (entry.path().extension() != ".csv") continue;
      std::string const text = read_text_file(entry.path(), 1 << 25);
      if (std::size_t const end = text.find('\n'); end + 1 < text.size())
        heads[entry.path().stem().string().substr(3)] = text.substr(0, end);
    }
    return heads;
  }
  fs::path const folder = fs::temp_directory_path() / ("clathra_reproduce_command_" + std::to_string(::getpid()));
};

TEST_F(ReproduceCommand, ScoresEachClaimWithNumbersAndDrawsEachFigure) {
  CommandResult const result = reproduce("one", "--figures '" + (folder / "figures").string() + "'");
  ASSERT_EQ(result.code, 0) << result.output;
  nlohmann::json const card = nlohmann::json::parse(content("one/scorecard.json"));
  ASSERT_EQ(card.at("claims").size(), 17U);
  for (nlohmann::json const& claim : card.at("claims"))
    for (nlohmann::json const& part : claim.at("parts"))
      EXPECT_TRUE(part.at("mean").is_number()) << claim.at("id") << ": " << part.at("what");
  std::string const page = content("one/reproduce.html");
  for (char const* const figure : {"Figure 6:",
                                   "Figure 8b",
                                   "Figure 9",
                                   "Figure 10",
                                   "Figure 11",
                                   "Figure 12 (26 %)",
                                   "Figures 13",
                                   "Figure 14",
                                   "Figure 15 (3 MPa)",
                                   "Figure 16 (55 %)",
                                   "Figure 17a",
                                   "Figure 18a",
                                   "Figure 18b",
                                   "Figure 19",
                                   "Figure 20",
                                   "shear strain, grain by grain",
                                   "shear strain, over 7.5 grain diameters",
                                   "Figure 21",
                                   "touching or bonded",
                                   "Tables 1 and 2",
                                   "Table 3"})
    EXPECT_NE(page.find(figure), std::string::npos) << figure;
  std::map<std::string, std::string> const heads = heads_of_figures();
  std::size_t drawn = 0;
  for (std::size_t at = page.find("<figure"); at != page.npos; at = page.find("<figure", at + 1)) ++drawn;
  EXPECT_EQ(heads.size(), drawn) << "each as a file with the numbers behind it";
  for (auto const& [name, head] : std::map<std::string, std::string>{
           {"figure-8b-shear-strength-of-a-bond", "series,normal_force_N_per_m,R_s_N_per_m"},
           {"figure-14-cohesion-against-hydrate-saturation", "series,saturation_pct,peak_cohesion_Pa"},
           {"figure-19-intact-bonds", "series,eps1,bonded_contacts_pct"},
           {"figure-20-shear-strain", "series,x_m,y_m,radius_m,shear_strain"}})
    EXPECT_EQ(heads.contains(name) ? heads.at(name) : "", head) << name;
}

TEST_F(ReproduceCommand, GoesOnWhereItWasStoppedAndScoresTheSame) {
  ASSERT_EQ(reproduce("one", "--screening --seeds 2").code, 0);
  EXPECT_EQ(reproduce("two", "--screening --seeds 2 --max-walltime 1s").code, 75);
  EXPECT_EQ(reproduce("two", "--screening --seeds 2").code, 0);
  EXPECT_EQ(scorecard("two"), scorecard("one"));
}

TEST_F(ReproduceCommand, DrawsPointsOfALaboratoryAndNamesMistakesInThem) {
  fs::create_directories(folder);
  std::ofstream(folder / "mine.csv") << "figure,name,strain,saturation_pct,confining_stress_MPa,x,y\n"
                                        "q,my own triaxial test,natural,26,1,1,2\n";
  std::string const data = "--data '" + (folder / "mine.csv").string() + "'";
  ASSERT_EQ(reproduce("one", "--screening --seeds 1 " + data).code, 0);
  EXPECT_NE(content("one/reproduce.html").find("my own triaxial test"), std::string::npos);
  std::ofstream(folder / "mine.csv", std::ios::app) << "q,b,natural,26,1,two,2\n";
  CommandResult const wrong = reproduce("one", "--screening --seeds 1 --collect " + data);
  EXPECT_EQ(wrong.code, 65);
  EXPECT_NE(wrong.output.find("line 3: column 'x' must be a number, got 'two'"), std::string::npos) << wrong.output;
}

TEST_F(ReproduceCommand, ASecondPaperIsASecondFile) {
  std::string const paper =
      "reproduce --paper " CLATHRA_EXAMPLES "/papers/tiny.toml --output '" + (folder / "tiny").string() + "'";
  CommandResult const result = run_clathra(paper);
  ASSERT_EQ(result.code, 0) << result.output;
  nlohmann::json const card = nlohmann::json::parse(content("tiny/scorecard.json"));
  EXPECT_EQ(card.at("title"), "Clean sand, claim by claim");
  std::vector<std::string> verdicts, parts;
  for (nlohmann::json const& claim : card.at("claims")) {
    verdicts.push_back(claim.at("verdict"));
    for (nlohmann::json const& part : claim.at("parts"))
      parts.push_back(part.at("what").get<std::string>() + " [" + part.at("unit").get<std::string>() + "]");
  }
  EXPECT_EQ(verdicts, (std::vector<std::string>{"pass", "pass", "fail"}));
  EXPECT_EQ(parts, (std::vector<std::string>{"peak q, 3 less 1 MPa [MPa]", "slope of peak q [MPa/MPa]",
                                             "peak q, 1 MPa less 3 MPa [MPa]"}));
  std::string const page = content("tiny/reproduce.html");
  for (char const* const shown :
       {"<h1>Clean sand, claim by claim</h1>", "Table 1: Parameters", "<td>2.6 g/cm3</td><td>2.6 g/cm3</td>",
        "Figure 1: Stress and strain", "The paper: the strength grows with the confining stress."})
    EXPECT_NE(page.find(shown), std::string::npos) << shown;
  EXPECT_EQ(page.find("Jiang"), std::string::npos);
  CommandResult const quick = run_clathra(paper + " --quick");
  EXPECT_EQ(quick.code, 65);
  EXPECT_NE(quick.output.find("tiny.toml: has no 'quick': particles and seeds for a first look"), std::string::npos)
      << quick.output;
}

TEST_F(ReproduceCommand, RefusesAPaperWithMistakes) {
  fs::create_directories(folder);
  std::ofstream(folder / "mine.toml") << "title = \"Mine\"\nparticles = 300\nseeds = 2\n[groups.a]\n\"hydrate.saturation\" = 2\n"
                                         "[series.x]\ngroups = [\"b\"]\n";
  CommandResult const result =
      run_clathra("reproduce --paper '" + (folder / "mine.toml").string() + "' --output '" + (folder / "mine").string() + "'");
  EXPECT_EQ(result.code, 65);
  EXPECT_NE(result.output.find("mine.toml:5:24: error: 'hydrate.saturation' "), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("mine.toml:7:10: error: there is no group or material 'b'; did you mean 'a'?; there are a"),
            std::string::npos)
      << result.output;
  EXPECT_FALSE(fs::exists(folder / "mine")) << "nothing is written";
}

TEST_F(ReproduceCommand, SaysBeforeWhatItWillCost) {
  CommandResult const result = reproduce("one", "--seeds 2 --dry-run");
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.output.find("28, "), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("2, each for "), std::string::npos) << result.output;
  EXPECT_FALSE(fs::exists(folder / "one")) << "nothing is written";
}

}  // namespace
}  // namespace clathra
