#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

int core_count() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  return ::sched_getaffinity(0, sizeof cores, &cores) == 0 ? CPU_COUNT(&cores) : 1;
}

class Threads : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  /// A short run of a hundred discs, begun by `env` with these options and variables.
  CommandResult run(std::string const& settings, std::string const& more, std::string const& name = "out") const {
    std::string const free = "env -u OMP_NUM_THREADS -u OMP_PROC_BIND -u OMP_PLACES -u OMP_WAIT_POLICY -u GOMP_SPINCOUNT ";
    return run_clathra("--version >/dev/null; " + free + settings +
                       " " CLATHRA_BINARY " run --overwrite " CLATHRA_EXAMPLES "/quick.toml " +
                       "--set specimen.file=" CLATHRA_GOLDEN "/specimen.h5 --set output.snapshots=0 " +
                       "--set test.axial_strain=\"0.01 %\" " + more + " --output " + (folder / name).string());
  }
  /// What OpenMP says of its settings when the program starts for the last time; the run itself is refused.
  std::string display(std::string const& settings) const {
    fs::create_directories(folder / "taken" / "by something");
    std::string const output = run("OMP_DISPLAY_ENV=verbose " + settings, "", "taken").output;
    std::size_t const at = output.rfind("OPENMP DISPLAY ENVIRONMENT BEGIN");
    return at == std::string::npos ? output : output.substr(at);
  }
  int used() const {
    return nlohmann::json::parse(std::ifstream(folder / "out" / "run.json")).at("program").at("threads").get<int>();
  }
  fs::path const folder = fs::temp_directory_path() / ("clathra_threads_" + std::to_string(::getpid()));
};

TEST_F(Threads, AboveTheCoresAreNotTakenAndWarnedOf) {
  for (auto const& [settings, more] :
       {std::pair{"", "--threads 1024"}, std::pair{"", "--set run.threads=4096"}, std::pair{"OMP_NUM_THREADS=1024", ""}}) {
    CommandResult const result = run(settings, more);
    EXPECT_EQ(result.code, 0) << more << result.output;
    EXPECT_NE(result.output.find(" threads were asked for, this process may use "), std::string::npos) << result.output;
    EXPECT_EQ(used(), core_count());
  }
  CommandResult const one = run("", "--threads 1");
  EXPECT_EQ(one.output.find("asked for"), std::string::npos) << one.output;
  EXPECT_EQ(used(), 1);
}

#if defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
TEST_F(Threads, ThatWaitGiveTheirCoreAwaySoon) {
  auto const spins = [&](std::string const& settings) {
    std::string const text = display(settings), name = "GOMP_SPINCOUNT = '";
    std::size_t const at = text.find(name);
    return at == std::string::npos ? text : text.substr(at + name.size(), text.find('\'', at + name.size()) - at - name.size());
  };
  EXPECT_EQ(spins(""), "10000");
  // The user's own choice stays.
  EXPECT_EQ(spins("GOMP_SPINCOUNT=77"), "77");
  EXPECT_EQ(spins("OMP_WAIT_POLICY=passive"), "0");
}

TEST_F(Threads, HaveAllCoresWhereTheUserBindsThem) {
  if (core_count() < 2) GTEST_SKIP() << "one core";
  std::string const text = display("OMP_PROC_BIND=true OMP_PLACES=threads");
  std::size_t const places = text.find("OMP_PLACES = '");
  ASSERT_NE(places, std::string::npos) << text;
  std::string const list = text.substr(places, text.find('\n', places) - places);
  EXPECT_EQ(std::count(list.begin(), list.end(), '{'), core_count()) << list;
}
#endif

/// By which `ps` shows it: a program that starts itself through /proc is called "exe" there.
TEST(StartedAnew, TheProgramKeepsItsName) {
  fs::path const none = fs::temp_directory_path() / ("clathra_named_" + std::to_string(::getpid()) + ".h5");
  CommandResult const named = run_clathra(
      "--version > /dev/null; env -u GLIBC_TUNABLES " CLATHRA_BINARY " generate " CLATHRA_EXAMPLES "/sand.toml -o '" +
      none.string() +
      "' > /dev/null 2>&1 & pid=$!; "
      "for n in $(seq 200); do grep -qz ^GLIBC_TUNABLES= /proc/$pid/environ && break; sleep 0.005; done; cat /proc/$pid/comm; "
      "kill $pid; wait");
  EXPECT_EQ(named.output, "clathra\n");
  EXPECT_FALSE(fs::exists(none)) << "told to stop";
}

}  // namespace
}  // namespace clathra
