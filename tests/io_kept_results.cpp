/// What `clathra` does not delete: results of earlier runs, and files of others.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "command.hpp"
#include "file_content.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// Every file of a folder with what it holds.
std::map<std::string, std::string> contents(fs::path const& folder) {
  std::map<std::string, std::string> files;
  for (auto const& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path().string()] = content(entry.path());
  return files;
}

/// A scene of a hundred discs that are made, and one of discs from a file.
class KeptResults : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder);
    put(folder / "made.toml",
        "[specimen]\nparticles = 100\nvoid_ratio = 0.28\n[hydrate]\nsaturation = 0.55\n[test]\naxial_strain = \"0.2 %\"\n"
        "[output]\nrecords = 20\nsnapshots = 1\n");
  }
  void TearDown() override { fs::remove_all(folder); }
  CommandResult run(std::string const& more = "") const {
    return run_clathra("run '" + (folder / "made.toml").string() + "' --output '" + out.string() + "' " + more);
  }
  nlohmann::json record() const { return nlohmann::json::parse(content(out / "run.json")); }

  /// A run that is killed when it has some rows and no checkpoint yet.
  void kill_one_with_rows() const {
    pid_t const child = ::fork();
    if (child == 0) {
      if (!std::freopen("/dev/null", "w", stdout) || !std::freopen("/dev/null", "w", stderr)) ::_exit(1);
      ::execl(CLATHRA_BINARY, CLATHRA_BINARY, "run", (folder / "made.toml").c_str(), "--output", out.c_str(), "--set",
              "test.inertial_number=1e-6", "--set", "output.records=4000", static_cast<char*>(nullptr));
      ::_exit(127);
    }
    auto const rows = [&] {
      std::string const text = content(out / "history.csv");
      return std::count(text.begin(), text.end(), '\n');
    };
    for (int i = 0; i < 6000 && rows() < 10; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ASSERT_GE(rows(), 10);
    ASSERT_FALSE(fs::exists(out / "ckpt"));
  }

  fs::path const folder = fs::temp_directory_path() / ("clathra_kept_" + std::to_string(::getpid()));
  fs::path const out = folder / "out";
};

TEST_F(KeptResults, OfAFinishedRunGoOnlyWhenAskedAndWhenThereAreNewOnes) {
  ASSERT_EQ(run().code, 0);
  auto const before = contents(out);
  CommandResult const again = run("--set damping.local=0.2");
  EXPECT_EQ(again.code, 73) << again.output;
  EXPECT_TRUE(says(again, "out: holds a finished run: --output names another folder"));
  EXPECT_EQ(contents(out), before);
  // Refused a moment later: when the folder is taken hold of, and while its specimen is made.
  for (std::string const refused : {"--set test.inertial_number=0.5", "--set specimen.void_ratio=0.1"}) {
    CommandResult const result = run("--overwrite " + refused);
    EXPECT_EQ(result.code, 77) << result.output;
    EXPECT_EQ(contents(out), before) << refused;
  }
  EXPECT_TRUE(says(run("--overwrite --set specimen.void_ratio=0.1"), "as it was"));
  // Or when the new specimen is made, which such short steps do not bring to rest.
  CommandResult const unconsolidated = run("--overwrite --set run.time_step_safety=1e-3 --set specimen.void_ratio=0.3");
  EXPECT_EQ(unconsolidated.code, 77) << unconsolidated.output;
  EXPECT_TRUE(says(unconsolidated, "consolidation did not come to rest"));
  EXPECT_EQ(contents(out), before);
  CommandResult const other = run("--overwrite --set damping.local=0.2");
  EXPECT_EQ(other.code, 0) << other.output;
  EXPECT_EQ(record()["scene"]["damping"]["local"], 0.2);
  EXPECT_FALSE(fs::exists(out / "specimen.h5.next"));
  EXPECT_EQ(content(out / "specimen.h5").substr(1, 3), "HDF");
  EXPECT_EQ(run_clathra("verify '" + out.string() + "'").code, 0);
}

TEST_F(KeptResults, AreNoneOfARunThatWasRefusedAtOnce) {
  EXPECT_EQ(run("--set specimen.void_ratio=0.1").code, 77);
  EXPECT_TRUE(fs::exists(out / "run.json")) << "says why";
  EXPECT_EQ(run().code, 0);
}

TEST_F(KeptResults, OfARunKilledBeforeItsFirstCheckpoint) {
  kill_one_with_rows();
  auto const before = contents(out);
  CommandResult const again = run();
  EXPECT_EQ(again.code, 73) << again.output;
  EXPECT_TRUE(says(again, "holds a run that is not finished (it was killed)"));
  EXPECT_EQ(contents(out), before);
  CommandResult const other = run("--resume --set damping.local=0.2");
  EXPECT_EQ(other.code, 73) << other.output;
  EXPECT_TRUE(says(other, "damping.local was 0.3, is 0.2"));
  EXPECT_EQ(contents(out), before);
  // The same scene begins anew: its rows will be the same.
  std::string const same = "--set test.inertial_number=1e-6 --set output.records=4000";
  CommandResult const resumed = run("--resume --max-walltime 0.001s " + same);
  EXPECT_EQ(resumed.code, 75) << resumed.output;
  EXPECT_TRUE(says(resumed, "there is no checkpoint yet, so the run starts from the beginning"));
  std::string const rows = content(out / "history.csv"), killed = before.at((out / "history.csv").string());
  std::size_t const both = std::min(rows.size(), killed.size());
  EXPECT_GT(both, 1000u);
  EXPECT_EQ(killed.substr(0, both), rows.substr(0, both));
}

TEST_F(KeptResults, OfSomebodyElseAreNeverTouched) {
  fs::create_directories(out);
  for (char const* const lock : {"", "clathra", "clathra study\n"}) {
    put(out / ".lock", lock);
    put(out / "history.csv", "mine");
    put(out / "report.html", "mine, too");
    auto const before = contents(out);
    for (char const* const option : {"", "--overwrite", "--resume"}) {
      CommandResult const result = run(option);
      EXPECT_EQ(result.code, 73) << result.output;
      EXPECT_EQ(contents(out), before);
    }
  }
  EXPECT_TRUE(says(run(), "holds results of `clathra study`, not of `clathra run`"));
  // A program that was killed at once leaves an empty marker and nothing else.
  fs::remove_all(out);
  fs::create_directories(out);
  put(out / ".lock", "");
  EXPECT_EQ(run().code, 0);
}

TEST_F(KeptResults, WhoseRecordIsDamagedAreNeitherUnfinishedNorBegunAnew) {
  ASSERT_EQ(run().code, 0);
  std::string const whole = content(out / "run.json");
  std::string const too_long = whole.substr(0, whole.size() - 2) + std::string(std::size_t{65} << 20, ' ') + "}\n";
  for (std::string const& damaged : {whole.substr(0, whole.size() / 2), std::string("{}"), std::string(), too_long}) {
    put(out / "run.json", damaged);
    auto const before = contents(out);
    CommandResult const resumed = run("--resume");
    EXPECT_EQ(resumed.code, 65) << resumed.output;
    EXPECT_TRUE(says(resumed, "run.json: is damaged"));
    CommandResult const plain = run();
    EXPECT_EQ(plain.code, 73) << plain.output;
    EXPECT_TRUE(says(plain, "holds results of a run whose run.json is damaged"));
    EXPECT_EQ(contents(out), before);
  }
  fs::remove(out / "run.json");
  fs::remove_all(out / "ckpt");  // with it the run would go on from its end
  EXPECT_TRUE(says(run(), "holds results of a run whose run.json is missing"));
  EXPECT_EQ(run("--resume").code, 73);
  EXPECT_EQ(run("--overwrite").code, 0);
}

/// The end of the run, or what its scene was.
TEST_F(KeptResults, WhoseRecordIsOfTheWrongKindInsideAreDamagedToo) {
  ASSERT_EQ(run().code, 0);
  std::string const whole = content(out / "run.json");
  auto const with = [&](char const* at, nlohmann::json const& value) {
    nlohmann::json record = nlohmann::json::parse(whole);
    record[nlohmann::json::json_pointer(at)] = value;
    put(out / "run.json", record.dump());
  };
  std::vector<std::pair<char const*, nlohmann::json>> const wrong = {{"/exit", nlohmann::json::object()},
                                                                     {"/exit", 5},
                                                                     {"/exit", nlohmann::json::array()},
                                                                     {"/exit/reason", 0},
                                                                     {"/exit/reason", "blah"},
                                                                     {"/exit/code", "0"},
                                                                     {"/scene", nlohmann::json::array()},
                                                                     {"/scene/test", 5},
                                                                     {"/scene/specimen/particles", 1e300},
                                                                     {"/scene/specimen/particles", "100"},
                                                                     {"/scene/run/seed", -1},
                                                                     {"/scene/output/events", 1}};
  for (auto const& [at, value] : wrong) {
    with(at, value);
    auto const before = contents(out);
    CommandResult const resumed = run("--resume");
    EXPECT_EQ(resumed.code, 65) << at << " " << value << resumed.output;
    EXPECT_TRUE(says(resumed, "run.json: is "));
    EXPECT_EQ(run().code, 73) << at;
    EXPECT_EQ(contents(out), before) << at;
  }
}

TEST_F(KeptResults, ThatTheNewRunReadsAreNotTakenThePlaceOf) {
  ASSERT_EQ(run().code, 0);
  auto const before = contents(out);
  std::string const from = "--overwrite --set specimen.file='" + out.string();
  CommandResult const result = run(from + "/final.h5'");
  EXPECT_EQ(result.code, 73) << result.output;
  EXPECT_TRUE(says(result, "final.h5: is a result that the new run would take the place of"));
  EXPECT_EQ(contents(out), before);
  // A run that reads its specimen makes none: that of the earlier one stays.
  EXPECT_EQ(run(from + "/specimen.h5'").code, 0);
  EXPECT_EQ(content(out / "specimen.h5"), before.at((out / "specimen.h5").string()));
}

TEST_F(KeptResults, OfOtherGrainsAreNotGoneOnWith) {
  put(folder / "sizes.csv", "d_mm,percent_finer\n0.12,0\n0.15,30\n0.17,50\n0.2,80\n0.24,100\n");
  std::string const graded = "--set grading.file='" + (folder / "sizes.csv").string() + "' --set test.axial_strain=0.1 ";
  ASSERT_EQ(run(graded + "--max-walltime 0.3s").code, 75);
  put(folder / "sizes.csv", "d_mm,percent_finer\n0.12,0\n0.15,30\n0.17,55\n0.2,80\n0.24,100\n");
  auto const before = contents(out);
  CommandResult const resumed = run(graded + "--resume");
  EXPECT_EQ(resumed.code, 73) << resumed.output;
  EXPECT_TRUE(says(resumed, "the grading file had digest "));
  EXPECT_EQ(contents(out), before);
}

TEST_F(KeptResults, OfARunThatWasResumedSayHowItsSpecimenWasMade) {
  std::string const longer = "--set test.axial_strain=0.05 ";
  ASSERT_EQ(run(longer + "--max-walltime 0.3s").code, 75);
  nlohmann::json const first = record();
  ASSERT_EQ(run(longer + "--resume").code, 0);
  nlohmann::json const whole = record();
  EXPECT_EQ(whole["stages"]["generate"], first["stages"]["generate"]);
  EXPECT_EQ(whole["stages"]["plan"], first["stages"]["plan"]);
  EXPECT_EQ(whole["layer_void_ratios"], first["layer_void_ratios"]);
  EXPECT_EQ(whole["wall_seconds"]["generate"], first["wall_seconds"]["generate"]);
  EXPECT_GT(whole["wall_seconds"]["shear"], first["wall_seconds"]["shear"]);
  fs::remove_all(out);
  ASSERT_EQ(run(longer).code, 0);
  EXPECT_EQ(whole["particle_steps"], record()["particle_steps"]) << "of the whole shear";
}

TEST_F(KeptResults, ASpecimenFileIsReplacedOnlyWhenAsked) {
  std::string const generate =
      "generate '" + (folder / "made.toml").string() + "' -o '" + (folder / "sand.h5").string() + "' --set run.seed=";
  ASSERT_EQ(run_clathra(generate + "1").code, 0);
  std::string const before = content(folder / "sand.h5");
  CommandResult const again = run_clathra(generate + "2");
  EXPECT_EQ(again.code, 73) << again.output;
  EXPECT_TRUE(says(again, "sand.h5: exists already and is left as it is"));
  EXPECT_EQ(content(folder / "sand.h5"), before);
  EXPECT_EQ(run_clathra(generate + "2 --overwrite").code, 0);
  EXPECT_NE(content(folder / "sand.h5"), before);
  // The same specimen is the same file, whenever and with however many threads it was made.
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  EXPECT_EQ(run_clathra(generate + "1 --overwrite --threads 1").code, 0);
  EXPECT_EQ(content(folder / "sand.h5"), before);
}

#ifdef CLATHRA_NO_LOCKS
TEST_F(KeptResults, WithoutLocksAllWhoWriteIntoAFolderWarn) {
  put(folder / "study.toml", "scene = \"made.toml\"\nseeds = 1\n");
  std::string const preload = "--version > /dev/null; LD_PRELOAD='" CLATHRA_NO_LOCKS "' " + std::string(program_in_shell) + " ";
  std::string const warning = ": its file system knows no locks, nothing keeps a second program from writing into it";
  std::string const scene = "'" + (folder / "made.toml").string() + "'";
  for (std::string const& command :
       {"run " + scene + " --output '" + out.string() + "'",
        "study '" + (folder / "study.toml").string() + "' --output '" + (folder / "study").string() + "'",
        "tune " + scene + " --particles 100 --max-walltime 20s --folder '" + (folder / "tune").string() + "' -o '" +
            (folder / "tuned.toml").string() + "'",
        "reproduce --particles 100 --seeds 1 --max-walltime 0.1s --output '" + (folder / "reproduce").string() + "'"}) {
    CommandResult const result = run_clathra(preload + command);
    EXPECT_TRUE(says(result, warning)) << command;
  }
}
#endif

}  // namespace
}  // namespace clathra
