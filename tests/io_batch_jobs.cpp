/// Batch systems: which ranks, cores and memory a job has, and the signals that it gets.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "command.hpp"
#include "domain/parallel/ranks.hpp"
#include "io/formats/text_file.hpp"
#include "machine/available_memory.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

TEST(BatchJob, HasTheRanksOfItsOwnNode) {
  EXPECT_EQ(ranks_on_node("4", 0), 4);
  EXPECT_EQ(ranks_on_node("2(x3),1", 0), 2);
  EXPECT_EQ(ranks_on_node("2(x3),1", 2), 2);
  EXPECT_EQ(ranks_on_node("2(x3),1", 3), 1);
  EXPECT_EQ(ranks_on_node("16,8(x2)", 2), 8);
  for (char const* const wrong : {"", "x", "2(x3),1"}) EXPECT_EQ(ranks_on_node(wrong, 9), 0) << wrong;
}

class MadeUpMachine : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(root); }
  void put(std::string const& name, std::string const& text) const {
    fs::create_directories((root / name).parent_path());
    std::ofstream(root / name) << text;
  }
  fs::path const root = fs::temp_directory_path() / ("clathra_machine_" + std::to_string(::getpid()));
};

TEST_F(MadeUpMachine, GivesNoMoreMemoryThanTheControlGroupsAbove) {
  put("proc/meminfo", "MemTotal: 64000000 kB\nMemAvailable:   50000000 kB\n");
  EXPECT_EQ(available_memory(root), 50000000.0 * 1024);
  put("proc/self/cgroup", "0::/slurm/job_7/step_0\n");
  put("sys/fs/cgroup/slurm/job_7/step_0/memory.max", "max\n");
  put("sys/fs/cgroup/slurm/job_7/step_0/memory.current", "1000000000\n");
  EXPECT_EQ(available_memory(root), 50000000.0 * 1024);
  put("sys/fs/cgroup/slurm/job_7/memory.max", "8000000000\n");
  put("sys/fs/cgroup/slurm/job_7/memory.current", "3000000000\n");
  put("sys/fs/cgroup/slurm/job_7/memory.stat", "anon 1000\ninactive_file 1000000000\n");
  EXPECT_EQ(available_memory(root), 6e9) << "what it keeps of files can be had";
  put("proc/self/cgroup", "12:cpu,cpuacct:/x\n5:memory:/slurm/job_7\n");
  put("sys/fs/cgroup/memory/slurm/job_7/memory.limit_in_bytes", "4000000000\n");
  put("sys/fs/cgroup/memory/slurm/job_7/memory.usage_in_bytes", "1000000000\n");
  EXPECT_EQ(available_memory(root), 3e9) << "version 1";
}

class BatchSignals : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  /// Runs a test of some seconds, sends what a shell sends, and gives the exit code of the program and what it said.
  CommandResult run_and(std::string const& sends, std::string const& before = "") const {
    std::string const script = (folder / "job.sh").string();
    std::ofstream(script) << before
                          << " '" CLATHRA_BINARY "' run " CLATHRA_EXAMPLES
                             "/quick.toml --threads 1 --set specimen.file=" CLATHRA_GOLDEN
                             "/specimen.h5 --set test.inertial_number=1e-6 --set output.snapshots=0 --output '"
                          << (folder / "out").string() << "' &\nrun=$!\nwhile [ ! -s '"
                          << (folder / "out" / "history.csv").string() << "' ]; do sleep 0.1; done\n"
                          << sends << "\nwait $run\n";
    return run_clathra("--version > /dev/null; bash '" + script + "'");
  }
  fs::path const folder = fs::temp_directory_path() / ("clathra_signals_" + std::to_string(::getpid()));
};

TEST_F(BatchSignals, ThatComeTwiceCostNoCheckpoint) {
  for (char const* const sends : {"kill -TERM $run; kill -TERM $run", "kill -HUP $run; kill -TERM $run; kill -USR1 $run"}) {
    CommandResult const result = run_and(sends);
    EXPECT_EQ(result.code, 75) << result.output;
    EXPECT_TRUE(fs::exists(folder / "out" / "ckpt" / "0.json"));
    fs::remove_all(folder / "out");
  }
}

TEST_F(BatchSignals, LikeCtrlCTwiceEndItAtOnce) {
  // A background job of a script ignores SIGINT; env --default-signal gives it back.
  CommandResult const result = run_and("kill -STOP $run; kill -INT $run; kill -CONT $run; sleep 0.02; kill -INT $run 2>/dev/null",
                                       "env --default-signal=INT");
  EXPECT_TRUE(result.code == 130 || result.code == 75) << result.code << result.output;
}

TEST_F(BatchSignals, LikeHangUpAreIgnoredUnderNohup) {
  CommandResult const result = run_and("kill -HUP $run; sleep 1; kill -0 $run && echo still there; kill -TERM $run", "nohup");
  EXPECT_NE(result.output.find("still there"), std::string::npos) << result.output;
  EXPECT_EQ(result.code, 75);
}

class BoundTask : public BatchSignals {};

/// A short run with made-up variables of a launcher. @return threads that it took
int threads_under(std::string const& variables, fs::path const& folder) {
  CommandResult const result = run_clathra("--version > /dev/null; env -u OMP_NUM_THREADS -u SLURM_CPUS_ON_NODE " + variables +
                                           " '" CLATHRA_BINARY "' bench --particles 1000 --seconds 0.01 --json > '" +
                                           (folder / "card.json").string() + "'");
  EXPECT_EQ(result.code, 0) << result.output;
  std::string const text = read_text_file(folder / "card.json", 1 << 20);
  std::size_t const at = text.find("\"threads\": ");
  return at == std::string::npos ? 0 : std::stoi(text.substr(at + 11));
}

TEST_F(BoundTask, HasAllCoresThatItIsBoundTo) {
  int const cores = static_cast<int>(::sysconf(_SC_NPROCESSORS_ONLN));
  std::string const tasks = "SLURM_STEP_NUM_TASKS=1 SLURM_STEP_TASKS_PER_NODE=" + std::to_string(cores);
  // As many tasks as cores; each is bound to all of them, or to as many as there are here out of many more.
  EXPECT_EQ(threads_under(tasks + " SLURM_CPUS_ON_NODE=" + std::to_string(cores), folder), 1);
  EXPECT_EQ(threads_under(tasks + " SLURM_CPUS_ON_NODE=" + std::to_string(cores * cores), folder), cores);
}

}  // namespace
}  // namespace clathra
