/// What `clathra run` does in a folder that has a run already.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "command.hpp"
#include "file_content.hpp"
#include "io/results/checkpoint.hpp"
#include "io/results/checkpoint_content.hpp"
#include "io/scene/scene_file.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

void change_byte(fs::path const& path, std::size_t at) {
  std::string text = content(path);
  text.at(at) ^= 1;
  put(path, text);
}

/// One bonded specimen, a test of it that was left alone, and one that was stopped twice: it has two checkpoints. Made once;
/// every test works on copies.
class RunFolder : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    fs::create_directories(base());
    put(base() / "scene.toml",
        "[specimen]\nparticles = 100\nvoid_ratio = 0.28\n[grading]\nfile = \"sizes.csv\"\n[hydrate]\nsaturation = \"55 "
        "%\"\n[test]\n"
        "axial_strain = \"0.3 %\"\n[output]\nrecords = 200\nsnapshots = 2\nkeep_checkpoint = false\n");
    put(base() / "sizes.csv", "d_mm,percent_finer\n0.12,0\n0.15,30\n0.17,50\n0.2,80\n0.24,100\n");
    fs::copy_file(base() / "sizes.csv", base() / "same.csv");
    CommandResult const alone = run("alone");
    ASSERT_EQ(alone.code, 0) << alone.output;
    // Told to stop at their first poll of the clock.
    ASSERT_EQ(run("stopped", "--max-walltime 0.001s --checkpoint-every 0s").code, 75);
    ASSERT_EQ(run("stopped", "--max-walltime 0.001s --checkpoint-every 0s --resume").code, 75);
    ASSERT_EQ(find_checkpoints(base() / "stopped").usable.size(), 2u);
  }
  static void TearDownTestSuite() { fs::remove_all(base()); }
  void TearDown() override { fs::remove_all(base() / "copy"); }

  static fs::path base() { return fs::temp_directory_path() / ("clathra_resume_" + std::to_string(::getpid())); }
  static CommandResult run(std::string const& name, std::string const& more = "", std::string const& scene = "") {
    return run_clathra("run " + (scene.empty() ? (base() / "scene.toml").string() : scene) + " --output " +
                       (base() / name).string() + " " + more);
  }
  static nlohmann::json record(std::string const& name) { return nlohmann::json::parse(content(base() / name / "run.json")); }
  static fs::path copy_of(char const* name) {
    fs::remove_all(base() / "copy");
    fs::copy(base() / name, base() / "copy", fs::copy_options::recursive);
    return base() / "copy";
  }
  static void expect_as_left_alone() {
    EXPECT_EQ(content(base() / "copy" / "history.csv"), content(base() / "alone" / "history.csv"));
    EXPECT_EQ(content(base() / "copy" / "events.csv"), content(base() / "alone" / "events.csv"));
    EXPECT_EQ(record("copy")["state_hash"], record("alone")["state_hash"]);
    EXPECT_EQ(record("copy")["stages"]["shear"], record("alone")["stages"]["shear"]);
    EXPECT_FALSE(fs::exists(base() / "copy" / "ckpt"));
  }
  static FoundCheckpoint newest() { return find_checkpoints(base() / "copy").usable.at(0); }
};

TEST_F(RunFolder, OfAnUnfinishedRunIsNotClearedUnlessAsked) {
  fs::path const folder = copy_of("stopped");
  std::string const history = content(folder / "history.csv");
  CommandResult const refused = run("copy");
  EXPECT_EQ(refused.code, 73) << refused.output;
  EXPECT_TRUE(says(refused, "copy: holds a run that is not finished (stopped as its wall time is over "));
  EXPECT_TRUE(says(refused, "--resume goes on with it, --overwrite puts the new run in its place"));
  EXPECT_EQ(content(folder / "history.csv"), history);
  EXPECT_EQ(find_checkpoints(folder).usable.size(), 2u);
  // Killed: the record says that it runs; damaged: nobody can go on, but nothing is deleted unasked.
  put(folder / "run.json", "{\"exit\": {\"code\": 0, \"reason\": \"running\"}}");
  EXPECT_TRUE(says(run("copy"), "not finished (it was killed)"));
  for (char const* const file : {"ckpt/0.h5", "ckpt/1.h5"}) change_byte(folder / file, 3000);
  EXPECT_EQ(run("copy").code, 73);
  EXPECT_EQ(run("copy", "--resume --overwrite").code, 64);
  EXPECT_EQ(run("copy", "--overwrite").code, 0);
  expect_as_left_alone();
}

TEST_F(RunFolder, OfAFinishedRunIsClearedWhenAsked) {
  fs::path const folder = copy_of("alone");
  EXPECT_EQ(run("copy", "--overwrite").code, 0);
  // Killed after run.json said that it is finished, before its checkpoints were gone.
  fs::copy(base() / "stopped" / "ckpt", folder / "ckpt");
  EXPECT_EQ(run("copy", "--overwrite").code, 0);
  expect_as_left_alone();
}

TEST_F(RunFolder, GoesOnFromTheOtherCheckpointWhereTheNewestGivesAnotherState) {
  fs::path const folder = copy_of("stopped");
  FoundCheckpoints const found = find_checkpoints(folder);
  Scene const scene = load_scene(base() / "scene.toml").scene;
  TestState state = read_checkpoint(found.usable.at(0), scene, {});
  state.hash ^= 1;
  // Takes the place of the newest, with a manifest that vouches for it.
  CheckpointSeries(folder, {}, found.usable.at(1)).write(scene, state, found.usable[0].step, found.usable[0].progress);
  ASSERT_EQ(newest().file, found.usable[0].file);
  CommandResult const resumed = run("copy", "--resume");
  EXPECT_EQ(resumed.code, 0) << resumed.output;
  EXPECT_TRUE(says(resumed, "goes on from step " + std::to_string(found.usable[1].step) + " "));
  EXPECT_NE(record("copy")["warnings"].dump().find("does not give the state that it was written with"), std::string::npos);
  expect_as_left_alone();
}

TEST_F(RunFolder, WithoutEventsGoesOn) {
  std::string const sand = "--set hydrate.saturation=0 ";
  ASSERT_EQ(run("copy", sand + "--max-walltime 0.001s").code, 75);
  EXPECT_FALSE(fs::exists(base() / "copy/events.csv"));
  CommandResult const resumed = run("copy", sand + "--resume");
  EXPECT_EQ(resumed.code, 0) << resumed.output;
}

TEST_F(RunFolder, NamesADamagedCheckpointThatItPassesOver) {
  copy_of("stopped");
  fs::path const damaged = newest().file;
  change_byte(damaged, 3000);
  CommandResult const resumed = run("copy", "--resume");
  EXPECT_EQ(resumed.code, 0) << resumed.output;
  EXPECT_TRUE(says(resumed, "warning: a checkpoint is passed over: " + damaged.string() + ": has digest "));
  EXPECT_NE(record("copy")["warnings"].dump().find("has digest "), std::string::npos);
  expect_as_left_alone();
}

TEST_F(RunFolder, NamesTheNewestManifestWhereItIsMissing) {
  copy_of("stopped");
  fs::path manifest = newest().file;
  fs::remove(manifest.replace_extension("json"));
  CommandResult const resumed = run("copy", "--resume");
  EXPECT_EQ(resumed.code, 0) << resumed.output;
  EXPECT_TRUE(says(resumed, "warning: a checkpoint is passed over: " + manifest.string() + ": is missing, so "));
  EXPECT_NE(record("copy")["warnings"].dump().find("is missing, so "), std::string::npos);
  expect_as_left_alone();
}

TEST_F(RunFolder, NamesManifestsWhereAllAreMissing) {
  fs::path const folder = copy_of("stopped");
  std::string const history = content(folder / "history.csv");
  for (char const* const name : {"0.json", "1.json"}) fs::remove(folder / "ckpt" / name);
  CommandResult const refused = run("copy", "--resume");
  EXPECT_EQ(refused.code, 66) << refused.output;
  EXPECT_TRUE(says(refused, "1.json: is missing"));
  EXPECT_EQ(content(folder / "history.csv"), history);
  fs::remove(folder / "ckpt" / "1.h5");  // as where a kill came before the first manifest
  CommandResult const anew = run("copy", "--resume");
  EXPECT_EQ(anew.code, 0) << anew.output;
  EXPECT_TRUE(says(anew, "warning: a checkpoint is not used: " + (folder / "ckpt" / "0.json").string() + ": is missing"));
  expect_as_left_alone();
}

TEST_F(RunFolder, IsRidOfWhatAKillLeftHalfWritten) {
  fs::path const folder = copy_of("stopped");
  for (char const* const name : {"run.json.tmp-17", "ckpt/0.h5.tmp-17", "snap/000000000003.h5.tmp-17"})
    put(folder / name, "half");
  put(folder / ".lock.tmp-17", "of another program that waits");
  ASSERT_EQ(run("copy", "--resume --max-walltime 0.001s").code, 75);
  for (char const* const name : {"run.json.tmp-17", "ckpt/0.h5.tmp-17", "snap/000000000003.h5.tmp-17"})
    EXPECT_FALSE(fs::exists(folder / name)) << name;
  EXPECT_TRUE(fs::exists(folder / ".lock.tmp-17"));
  EXPECT_EQ(run("copy", "--resume").code, 0);
  expect_as_left_alone();
}

TEST_F(RunFolder, NoticesRowsThatWereChangedBehindItsBack) {
  for (char const* const name : {"history.csv", "events.csv"}) {
    fs::path const folder = copy_of("stopped");
    FoundCheckpoints const found = find_checkpoints(folder);
    std::string const before = content(folder / "run.json");
    change_byte(folder / name, 5);
    std::string const changed = content(folder / name);
    CommandResult const refused = run("copy", "--resume");
    EXPECT_EQ(refused.code, 65) << refused.output;
    EXPECT_TRUE(says(refused, std::string(name) + ": its first "));
    EXPECT_TRUE(says(refused, "nothing was changed: put back what was there, or begin again with --overwrite"));
    EXPECT_EQ(content(folder / name), changed);
    EXPECT_EQ(content(folder / "run.json"), before);
    EXPECT_EQ(find_checkpoints(folder).usable.size(), 2u);
    fs::resize_file(folder / name, 10);
    EXPECT_TRUE(says(run("copy", "--resume"), "has 10 bytes, at least "));
  }
}

TEST_F(RunFolder, TakesTheOlderCheckpointWhereRowsBehindItWereChanged) {
  fs::path const folder = copy_of("stopped");
  FoundCheckpoints const found = find_checkpoints(folder);
  // A row between the two, as if more had been written before the second.
  FoundCheckpoint const& newest = found.usable.at(0);
  put(folder / "history.csv", content(folder / "history.csv") + "1,2,3\n");
  RunProgress longer = newest.progress;
  longer.history = {fs::file_size(folder / "history.csv"), "00000000000000000000000000000000"};
  Scene const scene = load_scene(base() / "scene.toml").scene;
  CheckpointSeries(folder, {}, found.usable.at(1)).write(scene, read_checkpoint(newest, scene, {}), newest.step, longer);
  CommandResult const resumed = run("copy", "--resume");
  EXPECT_EQ(resumed.code, 0) << resumed.output;
  EXPECT_TRUE(says(resumed, "a checkpoint is passed over: " + (folder / "history.csv").string() + ": its first "));
  expect_as_left_alone();
}

TEST_F(RunFolder, IsThatOfTheSameSceneHoweverItsPathsAreWrittenAndWhoeverComputes) {
  std::string const here = "cd " + base().string() + " && ", program = CLATHRA_BINARY;
  std::string const ways[] = {here + program + " run scene.toml --output copy --resume --threads 2",
                              here + program + " run ./scene.toml --output ./copy/ --resume --ignore-guards",
                              here + "mkdir -p deep && cd deep && " + program + " run ../../" + base().filename().string() +
                                  "/scene.toml --output ../copy --resume",
                              program + " run " + (base() / "scene.toml").string() + " --output " + (base() / "copy").string() +
                                  " --resume --set grading.file=" + (base() / "deep/.." / "sizes.csv").string()};
  for (std::string const& way : ways) {
    for (char const* const name : {"alone", "stopped"}) {
      copy_of(name);
      CommandResult const resumed = run_clathra("--version >/dev/null; " + way);
      EXPECT_EQ(resumed.code, 0) << way << "\n" << resumed.output;
      EXPECT_EQ(resumed.output.find("this run is finished") == 0, name == std::string("alone")) << resumed.output;
      expect_as_left_alone();
    }
  }
}

TEST_F(RunFolder, OfAnotherSceneIsLeftAloneAndToldBeforeAnythingElse) {
  for (char const* const name : {"alone", "stopped"}) {
    fs::path const folder = copy_of(name);
    std::string const before = content(folder / "run.json");
    CommandResult const other = run("copy", "--resume --set damping.local=0.2");
    EXPECT_EQ(other.code, 73) << other.output;
    EXPECT_TRUE(says(other, "of another scene"));
    EXPECT_TRUE(says(other, "damping.local was 0.3, is 0.2"));
    EXPECT_EQ(other.output.find("goes on from step"), std::string::npos) << other.output;
    EXPECT_TRUE(says(run("copy", "--resume --set grading.file=" + (base() / "same.csv").string()), "grading.file was "));
    EXPECT_EQ(content(folder / "run.json"), before);
  }
}

TEST_F(RunFolder, GoesOnInItsOwnPrecisionOnly) {
  copy_of("stopped");
  CommandResult const other = run("copy", "--resume --set run.precision=double");
  EXPECT_EQ(other.code, 73) << other.output;
  EXPECT_TRUE(says(other, "of another scene"));
  EXPECT_TRUE(says(other, "run.precision was ")) << other.output;
}

TEST_F(RunFolder, OfAFinishedRunKnowsItsSpecimenByItsContent) {
  auto const from = [](fs::path const& file) { return " --set specimen.file=" + file.string(); };
  fs::copy_file(base() / "alone" / "specimen.h5", base() / "one.h5", fs::copy_options::overwrite_existing);
  fs::copy_file(base() / "alone" / "specimen.h5", base() / "two.h5", fs::copy_options::overwrite_existing);
  ASSERT_EQ(run("copy", from(base() / "one.h5")).code, 0);
  EXPECT_TRUE(says(run("copy", "--resume" + from(base() / "two.h5")), "this run is finished"));
  CommandResult const other = run("copy", "--resume" + from(base() / "alone" / "final.h5"));
  EXPECT_EQ(other.code, 73) << other.output;
  EXPECT_TRUE(says(other, "the specimen file had digest "));
}

#ifdef CLATHRA_DISK_LOG
// A power cut must find results or checkpoints: before the last checkpoint goes, everything else has reached the disk.
TEST_F(RunFolder, HasItsResultsOnTheDiskBeforeTheCheckpointsGo) {
  fs::path const log = base() / "disk.log";
  ASSERT_EQ(run_clathra("--version >/dev/null; LD_PRELOAD=" CLATHRA_DISK_LOG " CLATHRA_DISK_LOG=" + log.string() +
                        " " CLATHRA_BINARY " run " + (base() / "scene.toml").string() + " --checkpoint-every 0.001s --output " +
                        (base() / "copy").string())
                .code,
            0);
  std::vector<std::string> lines;
  std::istringstream text(content(log));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  auto const last = [&](std::string const& call, std::string const& name) {
    for (std::size_t k = lines.size(); k > 0; --k)
      if (lines[k - 1].find(call + " ") == 0 && lines[k - 1].find(name) != std::string::npos) return static_cast<int>(k);
    ADD_FAILURE() << "no " << call << " of " << name << "\n" << content(log);
    return 0;
  };
  for (std::string& line : lines) line += ' ';  // so that a name can be asked for with its end
  int const gone = last("remove", "copy/ckpt/0.h5 "), folder = last("fsync", "/copy ");
  for (char const* const file : {"copy/history.csv", "copy/events.csv"}) {
    EXPECT_LT(last("write", file), last("fsync", file)) << file;
    EXPECT_LT(last("fsync", file), gone) << file;
  }
  for (char const* const file : {"copy/final.h5", "copy/run.json"}) {
    EXPECT_LT(last("fsync", file), last("rename", file)) << file;
    EXPECT_LT(last("rename", file), folder) << file;
  }
  EXPECT_LT(folder, gone);
  EXPECT_LT(last("fsync", "copy/snap "), gone);
}
#endif

}  // namespace
}  // namespace clathra
