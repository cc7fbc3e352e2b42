#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "file_content.hpp"
#include "io/formats/digest.hpp"
#include "io/formats/hdf5_file.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/checkpoint.hpp"
#include "io/results/checkpoint_content.hpp"
#include "io/results/run_record.hpp"
#include "io/scene/scene_file.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// A hand-made specimen, sheared through breakage in some thousand steps.
char const scene_text[] =
    "[specimen]\nparticles = 144\n[hydrate]\nsaturation = \"41 %\"\n[bond]\npreset = \"first_crack\"\nstrength_from = "
    "\"printed\"\n[test]\naxial_strain = \"2 "
    "%\"\n"
    "inertial_number = 5e-3\nwall_friction = 0.2\n[output]\nrecords = 20\nenergy = true\n[run]\nprecision = "
    "\"double\"\nignore_guards = "
    "true\n";

Scene test_scene() { return parse_scene(scene_text, "golden.toml", ".").scene; }

BiaxialTest begun() {
  Specimen s = disordered_patch(12, 12);
  s.d50 = grain_d50;
  return BiaxialTest(test_scene(), s, {});
}

void go_on(BiaxialTest& test, int records) {
  for (int n = 0; n < records && !test.finished(); ++n) {
    while (!test.advance(100)) {
    }
    (void)test.take_events();
  }
}

class CheckpointFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  /// Two generations of a test: after 5 records and after 10.
  BiaxialTest two_generations() {
    BiaxialTest test = begun();
    CheckpointSeries series(folder, {}, {});
    for (int step : {5, 10}) {
      go_on(test, 5);
      RunProgress progress;
      progress.history = {1000u * static_cast<unsigned>(step), "of the rows"};
      progress.snapshots = {{"snap/000000000000.h5", 0, 0.0, 144, 300}};
      series.write(test_scene(), test.state(), step, progress);
    }
    return test;
  }

  fs::path const folder = fs::temp_directory_path() / ("clathra_checkpoint_" + std::to_string(::getpid()));
};

TEST_F(CheckpointFile, GoesOnWithTheBitsOfTheTestThatWasLeftAlone) {
  BiaxialTest alone = two_generations();
  FoundCheckpoints const both = find_checkpoints(folder);
  ASSERT_EQ(both.usable.size(), 2u);
  EXPECT_TRUE(both.damaged.empty());
  EXPECT_EQ(both.usable[1].step, 5);
  FoundCheckpoint const* const found = &both.usable[0];
  EXPECT_EQ(found->step, 10);
  EXPECT_EQ(found->progress.history.bytes, 10000u);
  EXPECT_EQ(found->progress.history.digest, "of the rows");
  ASSERT_EQ(found->progress.snapshots.size(), 1u);
  EXPECT_EQ(found->progress.snapshots[0].pairs, 300u);
  BiaxialTest again(test_scene(), read_checkpoint(*found, test_scene(), {}), {});
  EXPECT_EQ(again.state_hash(), alone.state_hash());
  EXPECT_EQ(hash_text(again.state_hash()), checkpoint_state_hash(found->file));
  EXPECT_EQ(again.preparation(), alone.preparation());
  EXPECT_EQ(again.warnings(), alone.warnings());
  go_on(alone, 100);
  go_on(again, 100);
  EXPECT_EQ(again.state_hash(), alone.state_hash());
  HistoryRow const a = again.record(), b = alone.record();
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.q_Pa, b.q_Pa);
  EXPECT_EQ(a.broken[BreakMode::shear], b.broken[BreakMode::shear]);
  EXPECT_GT(
      a.broken[BreakMode::tension] + a.broken[BreakMode::shear] + a.broken[BreakMode::rolling] + a.broken[BreakMode::compression],
      2);
  EXPECT_EQ(again.energy().residual, alone.energy().residual);
  EXPECT_EQ(again.events_after(0).rows.size(), alone.events_after(0).rows.size());
}

/// Bytes changed, or an end cut off.
std::string damaged(std::string bytes, std::uint64_t n) {
  auto const draw = [&](std::uint64_t salt, std::size_t size) {
    return static_cast<std::size_t>(uniform_random(n, salt, 1) * static_cast<double>(size));
  };
  if (n % 10 == 9) {
    bytes.resize(draw(1, bytes.size()));
  } else {
    for (std::uint64_t k = 0; k <= n % 8; ++k) bytes[draw(2 + k, bytes.size())] ^= static_cast<char>(1 + draw(20 + k, 255));
  }
  return bytes;
}

TEST_F(CheckpointFile, IsTakenFromTheOtherGenerationWhereOneIsDamaged) {
  (void)two_generations();
  std::string const good[] = {content(folder / "ckpt/1.h5"), content(folder / "ckpt/1.json")};
  fs::path const files[] = {folder / "ckpt/1.h5", folder / "ckpt/1.json"};
  int cases = 0, named = 0;
  for (std::uint64_t n = 0; n < 1000; ++n) {
    auto const which = static_cast<std::size_t>(n % 4 == 0 ? 1 : 0);
    std::string const bad = damaged(good[which], n);
    if (bad == good[which]) continue;
    put(files[which], bad);
    FoundCheckpoints const found = find_checkpoints(folder);
    ASSERT_FALSE(found.usable.empty()) << n;
    // White space of a manifest means nothing: it may still be whole.
    if (found.usable[0].generation == 1) {
      EXPECT_EQ(which, 1u) << n;
      EXPECT_EQ(found.usable[0].step, 10) << n;
    } else {
      ASSERT_EQ(found.damaged.size(), 1u) << n;
      EXPECT_NE(std::string(found.damaged[0].what()).find("ckpt/1."), std::string::npos) << found.damaged[0].what();
      ++named;
    }
    put(files[which], good[which]);
    ++cases;
  }
  EXPECT_GT(cases, 990);
  EXPECT_GT(named, 950);
  put(files[0], good[0].substr(100));
  put(folder / "ckpt/0.h5", "x");
  try {
    (void)find_checkpoints(folder);
    FAIL() << "both are damaged";
  } catch (FileProblem const& problem) {
    EXPECT_EQ(problem.code, ExitCode::file_missing);
    EXPECT_NE(std::string(problem.what()).find("0.json"), std::string::npos) << problem.what();
    EXPECT_NE(std::string(problem.what()).find("1.json"), std::string::npos) << problem.what();
  }
}

TEST_F(CheckpointFile, OfAnotherSceneIsRefusedWithWhatDiffers) {
  (void)two_generations();
  FoundCheckpoint const found = find_checkpoints(folder).usable.at(0);
  Scene other = test_scene();
  other.damping.local = 0.2;
  other.run.threads = 7;  // these do not matter
  other.run.ignore_guards = !other.run.ignore_guards;
  other.output.folder = "elsewhere";
  try {
    (void)read_checkpoint(found, other, {});
    FAIL() << "another scene";
  } catch (FileProblem const& problem) {
    EXPECT_EQ(problem.code, ExitCode::cannot_create);
    EXPECT_NE(std::string(problem.what()).find("damping.local was 0.3, is 0.2"), std::string::npos) << problem.what();
    for (char const* const key : {"run.threads", "run.ignore_guards", "output.folder"})
      EXPECT_EQ(std::string(problem.what()).find(key), std::string::npos) << problem.what();
  }
}

/// What reading says of a file. @param code  that it must have
std::string problem_of(std::function<void()> const& read, ExitCode code) {
  try {
    read();
  } catch (FileProblem const& problem) {
    EXPECT_EQ(problem.code, code) << problem.what();
    return problem.what();
  }
  ADD_FAILURE() << "taken";
  return {};
}

TEST_F(CheckpointFile, OfAnotherVersionIsRefusedWithBothVersions) {
  (void)two_generations();
  fs::path const other = folder / "other.h5";
  std::string const format = Hdf5File::open(folder / "ckpt/1.h5").text_attribute("format");
  auto const relabel = [&](char const* name, std::int64_t version) {
    auto manifest = nlohmann::json::parse(content(folder / name));
    manifest["content"]["version"] = version;
    manifest["content_digest_xxh3_128"] = text_digest(manifest["content"].dump());
    put(folder / name, manifest.dump());
  };
  for (std::int64_t const version : {std::int64_t{0}, checkpoint_version + 1}) {
    std::string const wanted =
        "has version " + std::to_string(version) + ", this program reads " + std::to_string(checkpoint_version);
    {
      Hdf5File file = Hdf5File::create(other);
      file.set_attribute("format", format);
      file.set_attribute("version", version);
      file.close();
    }
    std::string const content_says =
        problem_of([&] { (void)read_checkpoint_content(other, test_scene(), {}); }, ExitCode::refused);
    EXPECT_NE(content_says.find(wanted), std::string::npos) << content_says;
    relabel("ckpt/0.json", checkpoint_version);
    relabel("ckpt/1.json", version);
    EXPECT_EQ(find_checkpoints(folder).usable.front().generation, 0);
    relabel("ckpt/0.json", version);
    std::string const manifests_say = problem_of([&] { (void)find_checkpoints(folder); }, ExitCode::file_missing);
    EXPECT_NE(manifests_say.find("0.json: " + wanted), std::string::npos) << manifests_say;
    EXPECT_NE(manifests_say.find("1.json: " + wanted), std::string::npos) << manifests_say;
  }
}

TEST_F(CheckpointFile, WithAHistoryThatIsNotFiniteIsRefused) {
  TestState state = begun().state();
  DiscColumns::Column& last = state.simulation.discs.history.back();
  last.numbers = [numbers = last.numbers()]() mutable {
    numbers.back() = std::numeric_limits<double>::quiet_NaN();
    return numbers;
  };
  fs::path const path = folder / "bad.h5";
  write_checkpoint_content(path, test_scene(), state, {});
  try {
    (void)read_checkpoint_content(path, test_scene(), {});
    FAIL() << "a history that is not finite";
  } catch (FileProblem const& problem) {
    EXPECT_EQ(problem.code, ExitCode::bad_input);
    EXPECT_NE(std::string(problem.what()).find("rows/" + last.name), std::string::npos) << problem.what();
  }
}

}  // namespace
}  // namespace clathra
