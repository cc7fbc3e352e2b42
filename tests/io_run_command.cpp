#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "command.hpp"
#include "file_content.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// A folder with a scene of a few hundred discs, sheared a little: about a second.
class RunCommand : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder);
    std::ofstream(scene)
        << "# a small one\n[specimen]\nparticles = 300\n[hydrate]\nsaturation = \"55 %\"\n[test]\naxial_strain = \"0.5 %\"\n"
           "[output]\nrecords = 20\nenergy = true\n";
  }
  void TearDown() override { fs::remove_all(folder); }

  CommandResult run(std::string const& name, std::string const& more = "") {
    return run_clathra("run " + scene.string() + " --output " + (folder / name).string() + " " + more);
  }
  nlohmann::json record(std::string const& name) const { return nlohmann::json::parse(content(folder / name / "run.json")); }

  fs::path const folder = fs::temp_directory_path() / ("clathra_run_" + std::to_string(::getpid()));
  fs::path const scene = folder / "small.toml";
};

TEST_F(RunCommand, LeavesEverythingThatARunPromises) {
  CommandResult const result = run("out");
  ASSERT_EQ(result.code, 0) << result.output;
  for (char const* const name :
       {"run.json", "input.toml", "resolved.toml", "history.csv", "events.csv", "specimen.h5", "final.h5", "report.html"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  EXPECT_EQ(content(folder / "out" / "input.toml"), content(scene));
  auto const json = record("out");
  EXPECT_EQ(json["exit"]["code"], 0);
  EXPECT_EQ(json["exit"]["reason"], "finished");
  EXPECT_EQ(json["state_hash"].get<std::string>().size(), 18u);
  EXPECT_GT(json["stages"]["shear"]["peak_q_Pa"].get<double>(), 1e5);
  std::string const history = content(folder / "out" / "history.csv");
  EXPECT_GE(std::count(history.begin(), history.end(), '\n'), 21);
  EXPECT_NE(result.output.find("peak "), std::string::npos);
  std::string const info = run_clathra("info " + (folder / "out").string()).output;
  EXPECT_NE(info.find("scene              saturation 55 %, confining stress 1 MPa, seed 1\n"), std::string::npos) << info;
}

TEST_F(RunCommand, SaysOverWhatItsResidualIsTakenAndWhatItsSecondsCount) {
  CommandResult const result = run("out");
  ASSERT_EQ(result.code, 0) << result.output;
  EXPECT_NE(result.output.find("largest   q "), std::string::npos) << "0.5 % is before any peak" << result.output;
  EXPECT_NE(result.output.find("a peak may lie beyond"), std::string::npos);
  EXPECT_EQ(result.output.find("residual"), std::string::npos);
  auto const json = record("out");
  EXPECT_EQ(json["stages"]["shear"]["peak_passed"], 0);
  EXPECT_DOUBLE_EQ(json["stages"]["shear"]["residual_from_eps1"], 0.8 * json["stages"]["shear"]["end_eps1"].get<double>());
  EXPECT_NEAR(json["stages"]["shear"]["residual_from_eps1"], 0.004, 1e-5);
  EXPECT_NE(json["meaning"]["stages.shear.residual_q_Pa"].get<std::string>().find("residual_from_eps1"), std::string::npos);
  for (char const* const stage : {"generate", "prepare", "shear"})
    EXPECT_TRUE(json["meaning"].contains("wall_seconds." + std::string(stage))) << stage;
  // The numbers of a report are those of the run.
  std::string const numbers = (folder / "numbers.json").string();
  EXPECT_EQ(run_clathra("report " + (folder / "out").string() + " --numbers " + numbers).output, numbers + " is written\n");
  auto const reported = nlohmann::json::parse(content(numbers))["runs"][0]["numbers"];
  EXPECT_GE(reported.size(), 11u);
  for (auto const& [name, value] : reported.items()) EXPECT_EQ(json["stages"]["shear"][name], value) << name;
  // 300 discs are made in ten times the time in which they are bonded and consolidated.
  EXPECT_LT(json["wall_seconds"]["prepare"].get<double>(), json["wall_seconds"]["generate"].get<double>());
}

TEST_F(RunCommand, GenerateFindsOutThatItCannotWriteBeforeItStarts) {
  fs::create_directories(folder / "in the way");
  for (char const* const name : {"none/specimen.h5", "'in the way'", "'in the way'/"}) {
    CommandResult const result = run_clathra("generate " + scene.string() + " -o " + folder.string() + "/" + name);
    EXPECT_EQ(result.code, 73) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
  }
}

TEST_F(RunCommand, FullPrecisionIsAKeyOfTheScene) {
  ASSERT_EQ(run("out", "--set output.lossless_snapshots=true --set output.snapshots=2").code, 0);
  EXPECT_NE(content(folder / "out" / "contacts.xdmf")
                .find("Precision=\"8\" Format=\"HDF\">snap/000000000000.h5:/contacts/normal_force"),
            std::string::npos);
  EXPECT_EQ(run_clathra("report " + (folder / "out").string()).code, 0);
}

TEST_F(RunCommand, AReportThatCannotBeWrittenIsAWarningAndLosesNothing) {
  fs::create_directories(folder / "out" / "report.html" / "in the way");
  std::ofstream(folder / "out" / ".lock") << "clathra run\n";
  CommandResult const result = run("out", "--overwrite");
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_NE(result.output.find("there is no report: "), std::string::npos) << result.output;
  auto const json = record("out");
  EXPECT_EQ(json["exit"]["reason"], "finished");
  EXPECT_NE(json["warnings"].dump().find("there is no report: "), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "out" / "final.h5"));
}

TEST_F(RunCommand, TheResolvedSceneAndTheKeptSpecimenGiveTheSameBits) {
  ASSERT_EQ(run("first").code, 0);
  std::string const again = " --output " + (folder / "second").string();
  ASSERT_EQ(run_clathra("run " + (folder / "first" / "resolved.toml").string() + again).code, 0);
  EXPECT_EQ(record("second")["state_hash"], record("first")["state_hash"]);
  EXPECT_EQ(content(folder / "second" / "history.csv"), content(folder / "first" / "history.csv"));
  std::string const kept = (folder / "first" / "specimen.h5").string();
  ASSERT_EQ(run("third", "--set specimen.file=" + kept).code, 0);
  EXPECT_EQ(record("third")["state_hash"], record("first")["state_hash"]);
  EXPECT_FALSE(record("third")["input"]["specimen_digest_xxh3_128"].get<std::string>().empty());
  EXPECT_FALSE(fs::exists(folder / "third" / "specimen.h5"));
  // The specimen of the folder itself may be read; it stays.
  ASSERT_EQ(run("first", "--overwrite --set specimen.file=" + kept).code, 0);
  EXPECT_TRUE(fs::exists(kept));
}

TEST_F(RunCommand, GenerateAndInfoShareTheSpecimenFile) {
  fs::path const file = folder / "specimen.h5";
  CommandResult const made = run_clathra("generate " + scene.string() + " -o " + file.string());
  ASSERT_EQ(made.code, 0) << made.output;
  ASSERT_EQ(run("out").code, 0);
  std::string const hash = run_clathra("info --state-hash " + file.string()).output;
  EXPECT_EQ(hash.size(), 19u) << hash;
  EXPECT_EQ(run_clathra("info --state-hash " + (folder / "out" / "specimen.h5").string()).output, hash);
  EXPECT_EQ(run_clathra("info --state-hash " + (folder / "out").string()).output,
            record("out")["state_hash"].get<std::string>() + "\n");
  CommandResult const info = run_clathra("info " + file.string());
  EXPECT_EQ(info.code, 0);
  EXPECT_NE(info.output.find("particles          300\n"), std::string::npos) << info.output;
  EXPECT_NE(info.output.find("void ratio         0.2"), std::string::npos) << info.output;
  EXPECT_NE(run_clathra("info " + (folder / "out").string()).output.find("peak_q_Pa"), std::string::npos);
}

TEST_F(RunCommand, ClosedOrFullStandardStreamsChangeNoByteOfTheResults) {
  ASSERT_EQ(run("first").code, 0);
  std::string const program =
      std::string(program_in_shell) + " run " + scene.string() + " --output " + (folder / "second").string();
  ASSERT_EQ(std::system((program + " <&- >&- 2>&-").c_str()), 0);
  EXPECT_EQ(content(folder / "second" / "history.csv"), content(folder / "first" / "history.csv"));
  ASSERT_EQ(std::system((program + " --overwrite >/dev/full 2>/dev/full").c_str()), 0);
  EXPECT_EQ(record("second")["state_hash"], record("first")["state_hash"]);
}

TEST_F(RunCommand, AFullDiskEndsWithTheFileAndItsCode) {
  // A limit of 100 blocks of 512 bytes for each file stands for a full disk.
  CommandResult const full = run_clathra("--version; ulimit -f 100; " + std::string(program_in_shell) + " run " + scene.string() +
                                         " --output " + (folder / "out").string() + " --set output.records=500");
  EXPECT_EQ(full.code, 74) << full.output;
  EXPECT_NE(full.output.find("out/"), std::string::npos) << full.output;
  EXPECT_EQ(record("out")["exit"]["code"], 74);
  for (auto const& entry : fs::directory_iterator(folder / "out"))
    EXPECT_EQ(entry.path().string().find(".tmp-"), std::string::npos) << entry.path();
}

TEST_F(RunCommand, AFolderWithoutTheRightToWriteCannotBeUsed) {
  fs::create_directories(folder / "closed");
  ::chmod((folder / "closed").c_str(), 0500);
  if (::geteuid() == 0)
    EXPECT_EQ(run_clathra("run " + scene.string() + " --output /proc/out").code, 73);  // rights do not bind root
  else
    EXPECT_EQ(run("closed/out").code, 73);
}

/// A run in the background that takes long enough to be disturbed.
class RunningCommand : public RunCommand {
 protected:
  void start() {
    child = ::fork();
    if (child != 0) return;
    std::string const out = (folder / "out").string();
    if (!std::freopen("/dev/null", "w", stdout) || !std::freopen("/dev/null", "w", stderr)) ::_exit(1);
    ::execl(CLATHRA_BINARY, CLATHRA_BINARY, "run", scene.c_str(), "--output", out.c_str(), "--set", "test.axial_strain=0.2",
            "--set", "output.records=4000", static_cast<char*>(nullptr));
    ::_exit(127);
  }
  /// Waits until history.csv has rows of the shear. @return false after 60 s
  bool wait_for_rows() const {
    for (int i = 0; i < 600; ++i) {
      std::string const text = content(folder / "out" / "history.csv");
      std::size_t const first = text.find("\nshear,");
      if (first != text.npos && text.find("\nshear,", first + 1) != text.npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
  }
  int finish() const {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  pid_t child = 0;
};

TEST_F(RunningCommand, CtrlCEndsItCleanly) {
  start();
  ASSERT_TRUE(wait_for_rows());
  ::kill(child, SIGINT);
  EXPECT_EQ(finish(), 75);
  EXPECT_EQ(record("out")["exit"]["code"], 75);
  EXPECT_NE(record("out")["exit"]["reason"].get<std::string>().find("stopped by a signal at an axial strain of"),
            std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "out" / "ckpt" / "0.h5"));
  EXPECT_FALSE(record("out").contains("state_hash"));
  std::string const history = content(folder / "out" / "history.csv");
  EXPECT_EQ(history.back(), '\n');
  EXPECT_FALSE(fs::exists(folder / "out" / "final.h5"));
  EXPECT_NE(content(folder / "out" / "report.html").find("the run is not complete: stopped by a signal"), std::string::npos);
}

TEST_F(RunningCommand, ASecondRunInItsFolderIsRefused) {
  start();
  ASSERT_TRUE(wait_for_rows());
  CommandResult const second = run("out");
  EXPECT_EQ(second.code, 73);
  EXPECT_NE(second.output.find("another run is writing into this folder"), std::string::npos) << second.output;
  EXPECT_EQ(record("out")["exit"]["reason"], "running");
  ::kill(child, SIGTERM);
  EXPECT_EQ(finish(), 75);
}

TEST_F(RunCommand, SnapshotsFollowTheStrainAndVerifyNoticesAChangedFile) {
  ASSERT_EQ(run("out", "--set output.snapshots=4").code, 0);
  std::size_t snapshots = 0;
  for (auto const& entry : fs::directory_iterator(folder / "out" / "snap"))
    snapshots += entry.path().extension() == ".h5" ? 1 : 0;
  EXPECT_EQ(snapshots, 5u);
  std::string const out = (folder / "out").string();
  EXPECT_EQ(run_clathra("verify " + out).code, 0);
  CommandResult const listed = run_clathra("events " + out + " --csv");
  EXPECT_EQ(listed.code, 0) << listed.output;
  std::string const events = content(folder / "out" / "events.csv");
  EXPECT_EQ(std::count(listed.output.begin(), listed.output.end(), '\n'), std::count(events.begin(), events.end(), '\n'));
  EXPECT_EQ(run_clathra("events " + out + " --mode shear --parts 3").code, 0);
  fs::create_directories(folder / "one");
  fs::copy_file(folder / "out" / "history.csv", folder / "one" / "history.csv");
  std::ofstream(folder / "one" / "events.csv") << events << "shear,7,1,2,rolling,0,0\n";
  CommandResult const counted = run_clathra("events " + (folder / "one").string() + " --parts 2");
  EXPECT_NE(counted.output.find("\n        0 - 0.25 "), std::string::npos) << counted.output;
  CommandResult const first = run_clathra("info " + out + "/snap/000000000000.h5");
  EXPECT_NE(first.output.find("bonded "), std::string::npos) << first.output;
  CommandResult const exported = run_clathra("export " + out + " --to csv");
  EXPECT_EQ(exported.code, 0) << exported.output;
  EXPECT_TRUE(fs::exists(folder / "out" / "export" / "particles_000000000000.csv"));
  EXPECT_EQ(run_clathra("export " + out + "/snap/000000000000.h5 --to lammpsdump").code, 0);
  EXPECT_TRUE(fs::exists(folder / "out" / "export" / "particles_000000000000.lammpstrj"));
  std::ofstream(folder / "out" / "history.csv", std::ios::app) << "1\n";
  fs::remove(folder / "out" / "final.h5");
  CommandResult const changed = run_clathra("verify " + out);
  EXPECT_EQ(changed.code, 65);
  EXPECT_NE(changed.output.find("2 of "), std::string::npos) << changed.output;
  EXPECT_EQ(run_clathra("verify " + folder.string()).code, 66);
  ASSERT_EQ(run("bare", "--set output.snapshots=0").code, 0);
  EXPECT_FALSE(fs::exists(folder / "bare" / "snap"));
  EXPECT_EQ(run_clathra("export " + (folder / "bare").string() + " --to vtu").code, 66);
  ASSERT_EQ(run("sand", "--set hydrate.saturation=0").code, 0);
  CommandResult const none = run_clathra("events " + (folder / "sand").string());
  EXPECT_EQ(none.code, 66);
  EXPECT_NE(none.output.find("the sand is clean"), std::string::npos) << none.output;
}

}  // namespace
}  // namespace clathra
