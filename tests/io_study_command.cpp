#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "command.hpp"
#include "io/formats/text_file.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// Rows of a CSV file without quotes, the header among them.
std::vector<std::vector<std::string>> rows_of(std::string const& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells(1);
    for (char const c : line)
      if (c == ',')
        cells.emplace_back();
      else
        cells.back() += c;
    rows.push_back(cells);
  }
  return rows;
}

class StudyCommand : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder);
    std::ofstream(folder / "base.toml")
        << "[sample]\ngenerator = \"file\"\nfile = \"" CLATHRA_GOLDEN
           "/specimen-1.h5\"\n"
           "[hydrate]\nsaturation = 0.55\n[test]\naxial_strain = \"0.4 %\"\n[output]\nrecords = 10\nsnapshots = 0\n";
  }
  void TearDown() override { fs::remove_all(folder); }
  CommandResult study(std::string const& text, std::string const& more = "") const {
    std::ofstream(folder / "many.toml") << "scene = \"base.toml\"\n" << text;
    return run_clathra("study '" + (folder / "many.toml").string() + "' --output '" + out.string() + "' " + more);
  }
  std::string csv() const { return read_text_file(out / "study.csv", 1 << 24); }
  /// The cells of a column in the rows of a kind.
  std::vector<std::string> cells(std::string const& row, std::string const& column) const {
    auto const rows = rows_of(csv());
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
  EXPECT_EQ(cells("mean", "n"), (std::vector<std::string>{"2", "2"}));
  for (std::size_t group = 0; group < 2; ++group) {
    std::vector<std::string> const q = cells("member", "peak_q_Pa");
    double const mean = (std::stod(q[2 * group]) + std::stod(q[2 * group + 1])) / 2;
    EXPECT_DOUBLE_EQ(std::stod(cells("mean", "peak_q_Pa")[group]), mean);
    EXPECT_LE(std::stod(cells("interval_low", "peak_q_Pa")[group]), mean);
    EXPECT_GE(std::stod(cells("interval_high", "peak_q_Pa")[group]), mean);
  }
  auto const rows = rows_of(csv());
  for (auto const& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  EXPECT_EQ(rows[0].back(), "disc_steps_per_second");
  EXPECT_NE(read_text_file(out / "study.html", 1 << 24).find("<polygon data-name=\"1MPa\""), std::string::npos) << "a band";
  std::string const before = csv();
  EXPECT_EQ(study(two).code, 0);
  EXPECT_EQ(csv(), before) << "what is finished is not run again, its times stay, too";
}

TEST_F(StudyCommand, NamesAMemberThatFailsAndGoesOnWithTheOthers) {
  CommandResult const result = study("seeds = 1\n[matrix]\ntest.inertial_number = [0.5, 1e-3, 2e-3]\n");
  EXPECT_EQ(result.code, 77) << result.output;
  EXPECT_EQ(cells("member", "state"), (std::vector<std::string>{"failed", "finished", "finished"}));
  EXPECT_NE(cells("member", "message")[0].find("inertial number"), std::string::npos) << csv();
  EXPECT_NE(result.output.find("failed    inertial-number0.5-seed1: "), std::string::npos) << result.output;
  EXPECT_NE(read_text_file(out / "study.html", 1 << 24).find("Members that are missing"), std::string::npos);
}

TEST_F(StudyCommand, AddsSeedsUntilANumberIsKnown) {
  // The specimen comes from a file, so that seeds make no difference: five show that, a sixth confirms it.
  CommandResult const result = study("until = \"peak_q_Pa=1%\"\n");
  ASSERT_EQ(result.code, 0) << result.output;
  EXPECT_EQ(cells("mean", "n"), std::vector<std::string>{"6"});
  CommandResult const few = study("seeds = 3\nmost_seeds = 3\n", "--until peak_eps1=1%");
  EXPECT_NE(few.output.find("all: peak_eps1 is known to 0 % with 3 seeds, not to 1 %"), std::string::npos) << few.output;
  CommandResult const wrong = study("", "--until peek_q_Pa=1%");
  EXPECT_EQ(wrong.code, 65);
  EXPECT_NE(wrong.output.find("no member has a number 'peek_q_Pa'; did you mean 'peak_q_Pa'?"), std::string::npos)
      << wrong.output;
}

TEST_F(StudyCommand, SaysWhatItCostsAndDoesNothing) {
  CommandResult const result = study(two, "--dry-run");
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_NE(result.output.find("many.toml: 2 groups of 2 seeds\n"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("  members            4, "), std::string::npos) << result.output;
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(StudyCommand, RunsMembersOneByOneForAnArray) {
  EXPECT_EQ(study(two, "--member 5").code, 77);
  for (char const* const member : {"1", "2", "3"}) EXPECT_EQ(study(two, std::string("--threads 1 --member ") + member).code, 0);
  CommandResult const part = study(two, "--collect");
  EXPECT_EQ(part.code, 75) << part.output;
  EXPECT_EQ(cells("member", "state"), (std::vector<std::string>{"finished", "finished", "finished", "waiting"}));
  EXPECT_EQ(study(two, "--member 4 --launcher 'env SOMETHING=1'").code, 0);
  EXPECT_EQ(study(two, "--collect").code, 0);
  EXPECT_EQ(cells("mean", "n"), (std::vector<std::string>{"2", "2"}));
}

TEST_F(StudyCommand, WritesAScriptForSlurm) {
  fs::path const script = folder / "array.sh";
  CommandResult const result = study(two, "--set 'grains.friction=0.4' --max-walltime 3h50m --slurm '" + script.string() + "'");
  ASSERT_EQ(result.code, 0) << result.output;
  std::string const text = read_text_file(script, 1 << 20);
  for (char const* const part :
       {"--array=1-4", "--time=03:50:00", "--requeue", "--signal=USR1@120", "scontrol requeue", "--collect"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_EQ(std::system(("bash -n '" + script.string() + "'").c_str()), 0);
  EXPECT_EQ(study("until = \"peak_q_Pa=2%\"\n", "--slurm '" + script.string() + "'").code, 77);
}

TEST_F(StudyCommand, RefusesGroupsThatAreTheSameAndAScenesFaultsOnce) {
  CommandResult const same = study("[groups.a]\ngrains.friction = 0.5\n[groups.b]\ntest.confining_stress = \"1 MPa\"\n");
  EXPECT_EQ(same.code, 65);
  EXPECT_NE(same.output.find("the groups a and b are the same scene"), std::string::npos) << same.output;
  CommandResult const wrong = study("[matrix]\ntest.confining_stress = [\"1 MPa\", \"2 MPa\"]\n", "--set grains.fricton=1");
  EXPECT_EQ(wrong.code, 65);
  std::string const text = "unknown key 'grains.fricton'";
  EXPECT_EQ(wrong.output.find(text), wrong.output.rfind(text)) << wrong.output;
}

TEST_F(StudyCommand, StopsItsMembersWithACheckpointAndGoesOn) {
  std::string const longer = "seeds = 2\n[matrix]\ntest.axial_strain = \"12 %\"\ntest.inertial_number = 2e-5\n";
  CommandResult const stopped = study(longer, "--max-walltime 1s");
  EXPECT_EQ(stopped.code, 75) << stopped.output;
  EXPECT_EQ(cells("member", "state"), (std::vector<std::string>{"waiting", "waiting"}));
  EXPECT_TRUE(fs::exists(out / "members" / "all-seed1" / "ckpt"));
  CommandResult const done = study(longer);
  EXPECT_EQ(done.code, 0) << done.output;
}

}  // namespace
}  // namespace clathra
