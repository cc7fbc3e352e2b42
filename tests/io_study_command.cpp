#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>

#include "command.hpp"
#include "file_content.hpp"
#include "io/formats/text_file.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

class StudyCommand : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder);
    std::string const rest =
        "[hydrate]\nsaturation = 0.55\n[test]\naxial_strain = \"0.4 %\"\n[output]\nrecords = 10\nsnapshots = 0\n";
    std::ofstream(folder / "base.toml") << "[specimen]\nparticles = 100\nvoid_ratio = 0.28\ncompaction_layers = 1\n" << rest;
    std::ofstream(folder / "read.toml") << "[specimen]\nfile = \"" CLATHRA_GOLDEN "/specimen.h5\"\n" << rest;
  }
  void TearDown() override { fs::remove_all(folder); }
  CommandResult study(std::string const& text, std::string const& more = "", std::string const& scene = "base.toml") const {
    std::ofstream(folder / "many.toml") << "scene = \"" << scene << "\"\n" << text;
    return run_clathra("study '" + (folder / "many.toml").string() + "' --output '" + out.string() + "' " + more);
  }
  std::string csv() const { return read_text_file(out / "study.csv", 1 << 24); }
  /// The cells of a column in the rows of a kind.
  std::vector<std::string> cells(std::string const& row, std::string const& column) const {
    auto const rows = csv_rows(csv());
    auto const at = std::find(rows[0].begin(), rows[0].end(), column) - rows[0].begin();
    std::vector<std::string> found;
    for (auto const& cells : rows)
      if (cells[0] == row && at < static_cast<std::ptrdiff_t>(cells.size())) found.push_back(cells[static_cast<std::size_t>(at)]);
    return found;
  }

  fs::path const folder = fs::temp_directory_path() / ("clathra_study_command_" + std::to_string(::getpid()));
  fs::path const out = folder / "out";
  std::string const two = "seeds = 2\n[matrix]\ntest.confining_stress = [\"1 MPa\", \"2 MPa\"]\n";
};

TEST_F(StudyCommand, LeavesATableWithARowForEachMemberAndStatisticsOfEachGroup) {
  CommandResult const result = study(two);
  ASSERT_EQ(result.code, 0) << result.output;
  EXPECT_EQ(cells("member", "group"), (std::vector<std::string>{"1MPa", "1MPa", "2MPa", "2MPa"}));
  EXPECT_EQ(cells("member", "seed"), (std::vector<std::string>{"1", "2", "1", "2"}));
  EXPECT_EQ(cells("mean", "n").front(), "2");
  EXPECT_EQ(cells("member", "test.confining_stress"), (std::vector<std::string>{"1000000", "1000000", "2000000", "2000000"}));
  EXPECT_EQ(cells("member", "label").back(), "2 MPa");
  EXPECT_NE(cells("member", "program")[0].find(" ("), std::string::npos);
  EXPECT_EQ(cells("member", "specimen_digest")[0].size(), 32u);
  EXPECT_NE(cells("member", "specimen_digest")[0], cells("member", "specimen_digest")[1]) << "another seed";
  EXPECT_EQ(cells("member", "specimen_digest")[0], cells("member", "specimen_digest")[2]) << "the same at another stress";
  for (std::size_t group = 0; group < 2; ++group) {
    std::vector<std::string> const q = cells("member", "peak_q_Pa");
    double const mean = (std::stod(q[2 * group]) + std::stod(q[2 * group + 1])) / 2;
    EXPECT_DOUBLE_EQ(std::stod(cells("mean", "peak_q_Pa")[group]), mean);
    EXPECT_LE(std::stod(cells("interval_low", "peak_q_Pa")[group]), mean);
    EXPECT_GE(std::stod(cells("interval_high", "peak_q_Pa")[group]), mean);
  }
  auto const rows = csv_rows(csv());
  for (auto const& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  EXPECT_EQ(rows[0].back(), "particle_steps_per_second");
  EXPECT_NE(read_text_file(out / "study.html", 1 << 24).find("<polygon data-name=\"1MPa\""), std::string::npos) << "a band";
  std::string const before = csv();
  EXPECT_EQ(study(two, "--figures '" + (folder / "figures").string() + "'").code, 0);
  std::string small, numbers;
  for (auto const& entry : fs::directory_iterator(folder / "figures"))
    if (std::string const name = entry.path().filename().string(); name.find("-1mpa-stress-and-strain.") != name.npos)
      (entry.path().extension() == ".csv" ? numbers : small) += content(entry.path());
  EXPECT_NE(small.find(">deviator stress q [MPa]<"), std::string::npos) << "its page says that once above all";
  for (char const* const line : {"series,eps1,q_Pa\n", "\n\"1MPa, seed 2 of 2\",", "\n1MPa,0,", "\n\"1MPa, lower edge\","})
    EXPECT_NE(numbers.find(line), std::string::npos) << line;
  EXPECT_EQ(csv(), before) << "what is finished is not run again, its times stay, too";
}

TEST_F(StudyCommand, NamesAMemberThatFailsAndGoesOnWithTheOthers) {
  CommandResult const result = study("seeds = 1\n[matrix]\nspecimen.void_ratio = [0.1, 0.28, 0.29]\n");
  EXPECT_EQ(result.code, 78) << result.output;
  EXPECT_EQ(cells("member", "state"), (std::vector<std::string>{"failed", "finished", "finished"}));
  EXPECT_NE(cells("member", "message")[0].find(" without friction: looser than the 0.1 that was asked for"), std::string::npos)
      << csv();
  EXPECT_NE(result.output.find("failed    the specimen of specimen.void_ratio = 0.1, seed 1: refused: "), std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find("needed by void-ratio0.1-seed1\n"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("specimens 3, each for 1 member: 2 made, 1 could not be made\n"), std::string::npos)
      << result.output;
  std::string const why = " without friction: looser than";
  EXPECT_EQ(result.output.find(why), result.output.rfind(why)) << "said once\n" << result.output;
  std::string const page = read_text_file(out / "study.html", 1 << 24);
  EXPECT_NE(page.find("Members that are missing"), std::string::npos);
  for (std::string const& text : {result.output, page})
    EXPECT_FALSE(std::regex_search(text, std::regex("[0-9a-f]{10}-seed"))) << "the name of a file is no name for people";
}

TEST_F(StudyCommand, AsksTheGuardsOfAllGroupsBeforeItStarts) {
  std::string const four = "seeds = 1\n[matrix]\ntest.inertial_number = [0.5, 1e-3, 2e-3, 0.3]\n";
  for (char const* const option : {"", "--dry-run"}) {
    CommandResult const result = study(four, option);
    EXPECT_EQ(result.code, 77) << result.output;
    for (char const* const part :
         {"2 of 4 groups would be refused, so nothing was started: --skip-refused goes on without them, --ignore-guards",
          "the group inertial-number0.5 would be refused: inertial number I = 0.5",
          "the group inertial-number0.3 would be refused: inertial number I = 0.3"})
      EXPECT_NE(result.output.find(part), std::string::npos) << part << "\n" << result.output;
    EXPECT_FALSE(fs::exists(out));
  }
  CommandResult const skipped = study(four, "--skip-refused");
  EXPECT_EQ(skipped.code, 0) << skipped.output;
  EXPECT_EQ(cells("member", "state"), (std::vector<std::string>{"refused", "finished", "finished", "refused"}));
  EXPECT_NE(cells("member", "message")[0].find("inertial number"), std::string::npos) << csv();
  EXPECT_NE(skipped.output.find("2 finished, 2 refused by guards and left out"), std::string::npos) << skipped.output;
  EXPECT_NE(skipped.output.find("specimens 1, each for 2 members\n"), std::string::npos) << skipped.output;
  EXPECT_EQ(skipped.output.find("/4 members"), std::string::npos) << skipped.output;
  EXPECT_EQ(study(four, "--collect --skip-refused").code, 0);
  EXPECT_EQ(cells("member", "state")[3], "refused");
  CommandResult const ignored =
      study("seeds = 1\n[matrix]\ntest.inertial_number = [0.02, 1e-3]\n", "--ignore-guards --allow-mixed");
  EXPECT_EQ(ignored.code, 0) << ignored.output;
}

/// Of the scene as of the forecast.
TEST_F(StudyCommand, SkipsGroupsWhoseSceneIsRefused) {
  std::string const sizes = "seeds = 1\n[matrix]\nspecimen.particles = [20, 100]\n";
  CommandResult const asked = study(sizes, "--dry-run");
  EXPECT_EQ(asked.code, 77) << asked.output;
  for (char const* const part :
       {"the group particles20 would be refused: specimen.particles=20: the specimen is ", "1 of 2 groups would be refused"})
    EXPECT_NE(asked.output.find(part), std::string::npos) << part << "\n" << asked.output;
  CommandResult const forecast = study(sizes, "--skip-refused --dry-run");
  EXPECT_EQ(forecast.code, 0) << forecast.output;
  EXPECT_TRUE(std::regex_search(forecast.output, std::regex("  members +1, .*; 1 refused by guards and left out\n")))
      << forecast.output;
  CommandResult const skipped = study(sizes, "--skip-refused");
  EXPECT_EQ(skipped.code, 0) << skipped.output;
  EXPECT_EQ(cells("member", "state"), (std::vector<std::string>{"refused", "finished"}));
  for (CommandResult const& result : {forecast, skipped})
    EXPECT_TRUE(std::regex_search(result.output, std::regex("specimens +1, each for 1 member\n"))) << result.output;
  std::size_t files = 0;
  for (auto const& file : fs::directory_iterator(out / "specimens")) files += file.path().extension() == ".h5" ? 1 : 0;
  EXPECT_EQ(files, 1u);
  EXPECT_EQ(study("seeds = 1\n[matrix]\nspecimen.particles = [5, 100]\n", "--skip-refused").code, 65) << "a mistake is none";
}

TEST_F(StudyCommand, ShowsTheWarningsOfItsMembers) {
  ASSERT_EQ(study("seeds = 1\n[matrix]\ntest.inertial_number = [2e-3, 3e-3]\n").code, 0);
  for (std::string const& warning : cells("member", "warnings"))
    EXPECT_NE(warning.find("inertial number"), std::string::npos) << csv();
  std::string const page = read_text_file(out / "study.html", 1 << 24);
  EXPECT_NE(page.find("Warnings of members"), std::string::npos);
  // Both say it with numbers of their own, which is one line, not two.
  std::size_t const line = page.find("inertial-number0.002-seed1, inertial-number0.003-seed1 (each with its own numbers");
  ASSERT_NE(line, std::string::npos) << page.substr(page.find("Warnings of members"), 2000);
  std::string const said = page.substr(line, page.find("</li>", line) - line);
  EXPECT_NE(said.find("0.002"), std::string::npos) << said;
}

TEST_F(StudyCommand, HasOnePrecedenceAndSaysWhatItSets) {
  ASSERT_EQ(study("seeds = 1\n[matrix]\ngrains.friction = 0.3\n", "--set grains.friction=0.4").code, 0);
  EXPECT_EQ(cells("member", "grains.friction"), std::vector<std::string>{"0.4"});
  std::string const record = read_text_file(out / "members" / "all-seed1" / "run.json", 1 << 24);
  EXPECT_NE(record.find("\"friction\": 0.4,"), std::string::npos) << record;
  for (auto const& [set, why] : std::vector<std::pair<std::string, std::string>>{
           {"run.seed=7", "'run.seed' cannot be set for all members: 'seeds' of the study gives the seeds, or --seeds"},
           {"run.threads=2", "'run.threads' cannot be set for all members"},
           {"output.folder=x", "'output.folder' cannot be set for all members"},
           {"test.confining_stress=3MPa", "'test.confining_stress' is what the groups of "},
           {"grains.friction=wet", "'grains.friction' needs a"}}) {
    CommandResult const refused = study(two, "--set " + set);
    EXPECT_EQ(refused.code, 64) << refused.output;
    EXPECT_NE(refused.output.find(why), std::string::npos) << refused.output;
  }
}

TEST_F(StudyCommand, RefusesSeedsThatChangeNothing) {
  for (std::string const& text : {std::string("seeds = 2\n"), std::string("precision_target = \"peak_q_Pa=1%\"\n")}) {
    CommandResult const result = study(text, "", "read.toml");
    EXPECT_EQ(result.code, 65) << result.output;
    EXPECT_NE(result.output.find("seeds change nothing in the group all, whose specimen comes from a file"), std::string::npos)
        << result.output;
  }
  EXPECT_EQ(study("", "", "read.toml").code, 0);
  EXPECT_EQ(cells("member", "seed"), std::vector<std::string>{"1"});
}

TEST_F(StudyCommand, MakesNewSpecimensOfAGradingThatWasEditedInPlace) {
  std::ofstream(folder / "sizes.csv") << "d_mm,percent_finer\n0.12,0\n0.15,30\n0.17,50\n0.2,80\n0.24,100\n";
  std::string const graded = "seeds = 1\n[matrix]\ngrading.file = \"sizes.csv\"\n";
  ASSERT_EQ(study(graded).code, 0);
  std::string const before = csv();
  std::ofstream(folder / "sizes.csv") << "d_mm,percent_finer\n0.14,0\n0.16,30\n0.17,50\n0.18,80\n0.2,100\n";
  CommandResult const again = study(graded);
  EXPECT_EQ(again.code, 78) << again.output;
  EXPECT_NE(again.output.find("holds the finished run of another scene"), std::string::npos) << again.output;
  EXPECT_NE(csv().find("the specimen file had digest"), std::string::npos) << csv();
}

TEST_F(StudyCommand, TakesNothingThatAnotherProgramMadeUnlessAsked) {
  ASSERT_EQ(study("seeds = 1\n").code, 0);
  fs::path const record = out / "members" / "all-seed1" / "run.json";
  std::string text = read_text_file(record, 1 << 24);
  std::size_t const at = text.find("\"git_hash\": \"") + 13;
  std::ofstream(record) << text.replace(at, text.find('"', at) - at, "of-somebody");
  for (char const* const option : {"", "--collect", "--member 1"}) {
    CommandResult const refused = study("seeds = 1\n", option);
    EXPECT_EQ(refused.code, 77) << refused.output;
    EXPECT_NE(refused.output.find("all-seed1 was made by another program (0.1.0 (of-somebody); this is"), std::string::npos)
        << refused.output;
  }
  EXPECT_EQ(study("seeds = 1\n", "--allow-mixed").code, 0);
  EXPECT_EQ(cells("member", "program"), std::vector<std::string>{"0.1.0 (of-somebody)"});
}

TEST_F(StudyCommand, NamesAMemberWithABadNumberAndGoesOnWithTheOthers) {
  ASSERT_EQ(study(two).code, 0);
  fs::path const record = out / "members" / "1MPa-seed1" / "run.json";
  std::string const whole = read_text_file(record, 1 << 24);
  for (auto const& [number, bad] :
       std::vector<std::pair<std::string, std::string>>{{"\"peak_q_Pa\": ", "\"high\", \"was\": "},
                                                        {"\"shear\": ", "[1], \"was\": "},
                                                        {"\"particle_steps_per_second\": ", "{}, \"was\": "}}) {
    std::string text = whole;
    std::ofstream(record) << text.insert(text.rfind(number) + number.size(), bad);
    CommandResult const result = study(two);
    EXPECT_EQ(result.code, 78) << result.output;
    EXPECT_EQ(cells("member", "state"), (std::vector<std::string>{"failed", "finished", "finished", "finished"})) << number;
    EXPECT_NE(cells("member", "message")[0].find("run.json"), std::string::npos) << csv();
  }
}

TEST_F(StudyCommand, ThatCannotWriteItsTableStopsItsMembersWithACheckpoint) {
  std::ofstream(folder / "many.toml") << "scene = \"base.toml\"\nseeds = 1\n[matrix]\ntest.inertial_number = [1e-6, 1.1e-6]\n";
  // Both members run when study.csv becomes a folder; then one of them is killed, and once more, so that it fails.
  std::ofstream(folder / "launch.sh") << "case \"$*\" in *number1e-06*) echo $$ >'" << folder.string() << "/next'; mv '"
                                      << folder.string() << "/next' '" << folder.string() << "/pid' ;; esac\nexec \"$@\"\n";
  std::ofstream(folder / "disturb.sh")
      << "cd '" << folder.string()
      << "'\nrows() { until [ -s out/members/inertial-number$1-seed1/history.csv ]; do sleep 0.05; done; }\n"
      << "rows 1e-06; rows 1.1e-06\nmv out/study.csv out/old.csv; mkdir out/study.csv\n"
      << "first=$(cat pid); kill -KILL $first\nuntil [ $(cat pid) != $first ]; do sleep 0.05; done\nkill -KILL $(cat pid)\n";
  std::string const in_folder = "'" + folder.string() + "/";
  CommandResult const result = run_clathra("--version > /dev/null; bash " + in_folder + "disturb.sh' & " + program_in_shell +
                                           " study " + in_folder + "many.toml' --jobs 2 --launcher \"bash " +
                                           (folder / "launch.sh").string() + "\" --output " + in_folder + "out'");
  EXPECT_TRUE(says(result, "study.csv: cannot"));
  EXPECT_TRUE(says(result, "stopping 1 member with a checkpoint"));
  EXPECT_TRUE(fs::exists(out / "members" / "inertial-number1.1e-06-seed1" / "ckpt" / "0.json"));
}

TEST_F(StudyCommand, GivesItsMembersTheirThreadsBehindALauncherToo) {
  ASSERT_EQ(study("seeds = 1\n", "--threads 1 --launcher 'env NOTE=\"a b\"'").code, 0);
  std::string const record = read_text_file(out / "members" / "all-seed1" / "run.json", 1 << 24);
  EXPECT_NE(record.find("\"run.threads=1\""), std::string::npos) << record;
}

TEST_F(StudyCommand, AddsSeedsUntilANumberIsKnown) {
  CommandResult const result = study("precision_target = \"peak_q_Pa=60%\"\n");
  ASSERT_EQ(result.code, 0) << result.output;
  EXPECT_EQ(cells("mean", "n").front(), "6") << "five are enough, a sixth confirms it";
  CommandResult const few = study("seeds = 3\nmax_seeds = 3\n", "--precision-target peak_q_Pa=0.0001%");
  EXPECT_NE(few.output.find("with 3 seeds, not to 0.0001 %"), std::string::npos) << few.output;
  CommandResult const wrong = study("", "--precision-target peek_q=1%");
  EXPECT_EQ(wrong.code, 64);
  EXPECT_TRUE(says(wrong, "--precision-target: error: names no number of a test: 'peek_q'; did you mean 'peak_q'?\n"));
  CommandResult const in_file = study("precision_target = \"peek_q=1%\"\n");
  EXPECT_EQ(in_file.code, 65);
  EXPECT_TRUE(says(in_file, "many.toml:2:"));
}

TEST_F(StudyCommand, SaysWhatItCostsAndDoesNothing) {
  CommandResult const result = study(two, "--dry-run");
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_NE(result.output.find("many.toml: 2 groups of 2 seeds\n"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("  members            4, "), std::string::npos) << result.output;
  EXPECT_TRUE(std::regex_search(result.output, std::regex("\n  shear +[0-9]+ s at "))) << result.output;
  CommandResult const nothing = study(two, "--dry-run --quiet");
  EXPECT_EQ(nothing.code, 64) << "it does nothing but print";
  EXPECT_TRUE(says(nothing, "--dry-run excludes --quiet"));
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(StudyCommand, RunsMembersOneByOneForAnArray) {
  EXPECT_EQ(study(two, "--member 5").code, 77);
  for (char const* const specimen : {"1", "2"}) EXPECT_EQ(study(two, std::string("--threads 1 --specimen ") + specimen).code, 0);
  for (char const* const member : {"1", "2", "3"}) EXPECT_EQ(study(two, std::string("--threads 1 --member ") + member).code, 0);
  CommandResult const part = study(two, "--collect");
  EXPECT_EQ(part.code, 75) << part.output;
  EXPECT_EQ(cells("member", "state"), (std::vector<std::string>{"finished", "finished", "finished", "waiting"}));
  EXPECT_EQ(study(two, "--member 4 --launcher 'env SOMETHING=1'").code, 0);
  EXPECT_EQ(study(two, "--collect").code, 0);
  EXPECT_EQ(cells("mean", "n").front(), "2");
}

TEST_F(StudyCommand, ByHandIsOneThatIsGoneOnWithAndStaysOutOfOthersFolders) {
  ASSERT_EQ(study(two, "--specimen 1").code, 0);
  CommandResult const early = study(two, "--member 2");
  EXPECT_EQ(early.code, 66) << early.output;
  EXPECT_NE(early.output.find("make it first (--specimen 2)"), std::string::npos) << early.output;
  ASSERT_EQ(study(two, "--member 1").code, 0);
  EXPECT_EQ(study(two, "--collect").code, 75);
  EXPECT_EQ(study(two).code, 0);
  EXPECT_EQ(cells("member", "state"), std::vector<std::string>(4, "finished"));
  fs::remove_all(out);
  fs::create_directories(out);
  std::ofstream(out / "study.csv") << "my precious table";
  for (char const* const part : {"--collect", "--member 1", "--specimen 1", "--slurm array.sh", ""}) {
    CommandResult const result = study(two, part);
    EXPECT_EQ(result.code, 73) << result.output;
    EXPECT_EQ(csv(), "my precious table") << part;
  }
  fs::remove_all(out);
  for (std::string const taken : {"array.sh", "array.sh.toml"}) {
    std::ofstream(folder / taken) << "mine";
    CommandResult const result = study(two, "--slurm '" + (folder / "array.sh").string() + "'");
    EXPECT_EQ(result.code, 73) << result.output;
    EXPECT_EQ(read_text_file(folder / taken, 100), "mine");
    fs::remove(folder / taken);
  }
}

TEST_F(StudyCommand, KnowsAMemberWhoseRowsAreNotThoseOfItsRun) {
  ASSERT_EQ(study("seeds = 2\n").code, 0);
  fs::path const rows = out / "members" / "all-seed1" / "history.csv";
  std::string const whole = read_text_file(rows, 1 << 24);
  std::ofstream(rows) << whole.substr(0, whole.size() * 95 / 100);
  CommandResult const result = study("seeds = 2\n", "--collect");
  EXPECT_EQ(result.code, 78) << result.output;
  EXPECT_EQ(cells("member", "state"), (std::vector<std::string>{"failed", "finished"}));
  EXPECT_NE(result.output.find("history.csv: is not the one that its run.json says"), std::string::npos) << result.output;
}

TEST_F(StudyCommand, DoesNotExtendMembersOfAShorterTest) {
  ASSERT_EQ(study("seeds = 1\n").code, 0);
  std::string const before = csv();
  CommandResult const longer = study("seeds = 1\n", "--set test.axial_strain=0.005");
  EXPECT_EQ(longer.code, 78) << longer.output;
  EXPECT_NE(longer.output.find("a study does not extend it"), std::string::npos) << longer.output;
  EXPECT_EQ(study("seeds = 1\n").code, 0);
  EXPECT_EQ(csv(), before);
}

TEST_F(StudyCommand, SaysWhereAMistakeIs) {
  std::string const file = "[matrix]\n\"grading.file\" = [\"nofile.csv\"]\n";
  EXPECT_NE(study(file).output.find("many.toml: error: 'grading.file' names a file that is not there: "), std::string::npos)
      << study(file).output;
  for (std::string const option :
       {"--precision-target peak_q_Pa", "--precision-target peak_q_Pa=0", "--precision-target peak_q_Pa=200%",
        "--launcher \"'open\"", "--max-walltime 0s", "--member 0"}) {
    CommandResult const result = study("", option);
    EXPECT_EQ(result.code, 64) << result.output;
    EXPECT_NE(result.output.find(option.substr(0, option.find(' '))), std::string::npos) << result.output;
  }
  CommandResult const loose = study("seeds = 1\n", "--set specimen.void_ratio=0.9");
  EXPECT_EQ(loose.code, 78) << loose.output;
  EXPECT_NE(cells("member", "message")[0].find("could not be made: "), std::string::npos) << csv();
  EXPECT_NE(cells("member", "message")[0].find("denser"), std::string::npos) << csv();
}

TEST_F(StudyCommand, RefusesGroupsThatAreTheSameAndAScenesFaultsOnce) {
  CommandResult const same = study("[groups.a]\ngrains.friction = 0.5\n[groups.b]\ntest.confining_stress = \"1 MPa\"\n");
  EXPECT_EQ(same.code, 65);
  EXPECT_NE(same.output.find("the groups a and b are the same scene"), std::string::npos) << same.output;
  CommandResult const refused = study("[matrix]\ntest.inertial_number = [0.5]\ngrains.friction = [0.4, 0.5]\n");
  EXPECT_NE(
      refused.output.find("the groups inertial-number0.5_friction0.4 and inertial-number0.5_friction0.5 would be refused: "),
      std::string::npos)
      << refused.output;
  CommandResult const wrong = study("[matrix]\ntest.confining_stress = [\"1 MPa\", \"2 MPa\"]\n", "--set grains.fricton=1");
  EXPECT_EQ(wrong.code, 64);
  std::string const text = "unknown key 'grains.fricton'";
  EXPECT_EQ(wrong.output.find(text), wrong.output.rfind(text)) << wrong.output;
}

TEST_F(StudyCommand, StopsItsMembersWithACheckpointAndGoesOn) {
  std::string const longer = "seeds = 2\n[matrix]\ntest.axial_strain = \"12 %\"\ntest.inertial_number = 2e-5\n";
  EXPECT_EQ(study(longer, "--max-walltime 0.1s").code, 75);
  EXPECT_EQ(cells("member", "state"), (std::vector<std::string>{"waiting", "waiting"}));
  // Told to stop when both members have rows, however long their specimens took.
  std::ofstream(folder / "stop.sh")
      << "cd '" << folder.string() << "'\n"
      << program_in_shell
      << " study many.toml --jobs 2 --output out &\nstudy=$!\nfor seed in 1 2; do until [ -s "
         "out/members/all-seed$seed/history.csv ]; do sleep 0.05; done; done\nkill -TERM $study\nwait $study\n";
  CommandResult const stopped = run_clathra("--version > /dev/null; bash '" + (folder / "stop.sh").string() + "'");
  EXPECT_EQ(stopped.code, 75) << stopped.output;
  EXPECT_EQ(cells("member", "state"), (std::vector<std::string>{"waiting", "waiting"}));
  for (char const* const member : {"all-seed1", "all-seed2"})
    EXPECT_TRUE(fs::exists(out / "members" / member / "ckpt" / "0.json"));
  CommandResult const done = study(longer);
  EXPECT_EQ(done.code, 0) << done.output;
}

}  // namespace
}  // namespace clathra
