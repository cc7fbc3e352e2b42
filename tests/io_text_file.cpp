/// Text files: what is read and what is not, pipes among them, and names under which something can be written.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <condition_variable>
#include <fstream>
#include <functional>
#include <mutex>
#include <thread>

#include "command.hpp"
#include "io/errors/problems.hpp"
#include "io/formats/text_file.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class TextFile : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder);
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  }
  void TearDown() override { fs::remove_all(folder); }

  static std::string complaint(std::function<void()> const& act, ExitCode code) {
    try {
      act();
    } catch (FileProblem const& problem) {
      EXPECT_EQ(problem.code, code) << problem.what();
      return problem.what();
    }
    return "none";
  }

  fs::path const folder = fs::temp_directory_path() / ("clathra_text_" + std::to_string(::getpid()));
};

/// A writer that says something and then keeps the pipe open until it is told to leave, or for five seconds.
class Writer {
 public:
  Writer(fs::path const& pipe, std::string const& text)
      : descriptor_(::open(pipe.c_str(), O_RDWR | O_CLOEXEC)), thread_([this] { wait(); }) {
    EXPECT_EQ(::write(descriptor_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  ~Writer() {
    leave();
    thread_.join();
  }
  void leave() {
    std::lock_guard const lock(mutex_);
    leaving_ = true;
    told_.notify_all();
  }

 private:
  void wait() {
    std::unique_lock lock(mutex_);
    told_.wait_for(lock, 5s, [this] { return leaving_; });
    ::close(descriptor_);
  }
  int descriptor_;
  bool leaving_ = false;
  std::mutex mutex_;
  std::condition_variable told_;
  std::thread thread_;
};

TEST_F(TextFile, OfAPipeIsReadToItsEnd) {
  std::thread writer([this] { std::ofstream(folder / "pipe") << std::string(200000, 'a'); });
  EXPECT_EQ(read_text_file(folder / "pipe", 1 << 20), std::string(200000, 'a'));
  writer.join();
}

TEST_F(TextFile, OfAPipeThatFallsSilentIsGivenUp) {
  Writer const writer(folder / "pipe", "[specimen]\n");
  std::string const text = complaint([&] { read_text_file(folder / "pipe", 1 << 20, 50ms); }, ExitCode::file_missing);
  EXPECT_EQ(text, (folder / "pipe").string() + ": is a pipe that gave nothing for 0.05 s");
}

TEST_F(TextFile, OfAPipeThatNobodyWritesIntoIsGivenUp) {
  std::string const text = complaint([&] { read_text_file(folder / "pipe", 1 << 20, 50ms); }, ExitCode::file_missing);
  EXPECT_NE(text.find("is a pipe that gave nothing for 0.05 s"), std::string::npos) << text;
}

TEST_F(TextFile, IsNeitherAFolderNorADevice) {
  EXPECT_NE(complaint([&] { read_text_file(folder, 10); }, ExitCode::file_missing).find(": is a folder, not a file"),
            std::string::npos);
  EXPECT_EQ(complaint([] { read_text_file("/dev/zero", 10); }, ExitCode::file_missing), "/dev/zero: is a device, not a file");
}

TEST_F(TextFile, CanOnlyBeMadeWhereThereIsAFolderForIt) {
  require_creatable(folder / "new");
  std::ofstream(folder / "old") << "kept";
  require_creatable(folder / "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 2) << "the pipe and the old file";
  EXPECT_EQ(fs::file_size(folder / "old"), 4u);
  auto const problem_of = [&](fs::path const& path) {
    return complaint([&] { require_creatable(path); }, ExitCode::cannot_create);
  };
  EXPECT_EQ(problem_of(folder / "none" / "new"),
            (folder / "none" / "new").string() + ": cannot be created: No such file or directory");
  EXPECT_EQ(problem_of(folder), folder.string() + ": is a folder; name a file");
  EXPECT_EQ(problem_of(folder / ""), (folder / "").string() + ": is a folder; name a file");
  EXPECT_EQ(problem_of("/proc/new").find("/proc/new: cannot be created: "), 0u);
}

TEST_F(TextFile, OfASceneMayComeThroughAPipeButNotFromADeviceOrFolder) {
  std::ofstream(folder / "my.toml") << "[specimen]\nparticles = 300\n";
  std::string const scene = (folder / "my.toml").string(), program = CLATHRA_BINARY;
  EXPECT_EQ(run_clathra("--version && cat " + scene + " | " + program + " check /dev/stdin").code, 0);
  EXPECT_EQ(run_clathra("--version && " + program + " check /dev/stdin < " + scene).code, 0);
  CommandResult const zero = run_clathra("check /dev/zero");
  EXPECT_EQ(zero.code, 66);
  EXPECT_EQ(zero.output, "clathra: /dev/zero: is a device, not a file\n");
  EXPECT_EQ(run_clathra("check " + folder.string()).output, "clathra: " + folder.string() + ": is a folder, not a file\n");
  CommandResult const endless = run_clathra("--version > /dev/null; yes | " + program + " check /dev/stdin");
  EXPECT_EQ(endless.code, 65);
  EXPECT_EQ(endless.output, "/dev/stdin: error: has 1048577 bytes, at most 1048576 are allowed\n");
}

// A verb that computes starts itself anew when it has read the scene, and the pipe is empty then.
TEST_F(TextFile, OfASceneThroughAPipeIsThatOfARunToo) {
  std::ofstream(folder / "my.toml")
      << "[specimen]\nparticles = 77\nvoid_ratio = 0.285\ncompaction_layers = 1\n[run]\nthreads = 1\n";
  std::string const scene = (folder / "my.toml").string(), generate = std::string(CLATHRA_BINARY) + " generate --overwrite ";
  fs::path const named = folder / "named";
  ASSERT_EQ(::mkfifo(named.c_str(), 0600), 0);
  for (std::string const& command :
       {"cat " + scene + " | " + generate + "/dev/stdin",
        "cat " + scene + " > " + named.string() + " & " + generate + named.string(), generate + "/dev/stdin < " + scene}) {
    CommandResult const made = run_clathra("--version > /dev/null; env -u GLIBC_TUNABLES -u OMP_NUM_THREADS " + command + " -o " +
                                           (folder / "made.h5").string());
    EXPECT_EQ(made.code, 0) << made.output;
    EXPECT_NE(made.output.find("made.h5: 77 particles\n"), std::string::npos) << command << ": " << made.output;
  }
}

TEST_F(TextFile, ThatCameMeanwhileIsKept) {
  fs::path const file = folder / "file";
  replace_text_file(file, "first", Existing::kept);
  EXPECT_EQ(read_text_file(file, 100), "first");
  auto const again = [&] { replace_text_file(file, "second", Existing::kept); };
  EXPECT_NE(complaint(again, ExitCode::cannot_create).find("file: exists already and is left as it is"), std::string::npos);
  EXPECT_EQ(read_text_file(file, 100), "first");
  replace_text_file(file, "second");
  EXPECT_EQ(read_text_file(file, 100), "second");
  auto const nowhere = [&] { replace_text_file(folder / "none" / "study.csv", ""); };
  EXPECT_NE(complaint(nowhere, ExitCode::cannot_create).find("none/study.csv: cannot be created"), std::string::npos);
  int files = 0;
  for (auto const& entry : fs::directory_iterator(folder)) files += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(files, 1) << "no temporary one is left";
}

}  // namespace
}  // namespace clathra
