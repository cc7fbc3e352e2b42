#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "command.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// What a short run that has a warning to show writes to stderr.
class ProgressOutput : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder);
    std::ofstream(folder / "small.toml") << "[specimen]\nparticles = 300\n[test]\naxial_strain = \"0.5 %\"\n"
                                            "confining_stress = \"10 MPa\"\n[output]\nrecords = 40\n";
  }
  void TearDown() override { fs::remove_all(folder); }

  /// @param settings  of the environment, as in "NO_COLOR=1"
  std::string on_terminal(std::string const& settings) const {
    return output("script -qefc '" + settings + " " + command() + "' /dev/null");
  }
  std::string in_a_file() const { return output(command()); }

  fs::path const folder = fs::temp_directory_path() / ("clathra_progress_" + std::to_string(::getpid()));

 private:
  std::string command() const {
    return std::string(program_in_shell) + " run " + (folder / "small.toml").string() + " --overwrite --output " +
           (folder / "out").string();
  }
  std::string output(std::string const& command) const {
    EXPECT_EQ(std::system((command + " > " + (folder / "all").string() + " 2>&1 </dev/null").c_str()), 0);
    std::ifstream file(folder / "all");
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
};

bool has_script() { return std::system("command -v script > /dev/null") == 0; }

TEST_F(ProgressOutput, IsALineEveryFivePercentWhereItIsNoTerminal) {
  std::string const text = in_a_file();
  EXPECT_EQ(text.find('\033'), std::string::npos) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos) << text;
  std::regex const line("shear ([0-9]+)% eps1 [0-9.]+/0.5% \\| .* particle-steps/s \\| ETA .* \\| q .* MPa \\| I [0-9.e-]+\n");
  int lines = 0, last = -5;
  for (std::sregex_iterator found(text.begin(), text.end(), line), end; found != end; ++found, ++lines) {
    int const percent = std::stoi((*found)[1]);
    EXPECT_GT(percent / 5, last / 5) << text;
    last = percent;
  }
  EXPECT_EQ(last, 100) << text;
  EXPECT_EQ(text.find(" 0 particle-steps/s"), std::string::npos) << "nothing is claimed before there is something to tell from\n"
                                                                 << text;
  EXPECT_LE(lines, 21);
  EXPECT_NE(text.find("2 warnings:\n  - kn / sigma_1"), std::string::npos) << text;
}

TEST_F(ProgressOutput, IsOneLineOnATerminalWithColourUnlessTheUserWantsNone) {
  if (!has_script()) GTEST_SKIP() << "no program `script` to make a terminal";
  std::string const coloured = on_terminal("TERM=xterm");
  EXPECT_NE(coloured.find("\r\033[K"), std::string::npos);
  EXPECT_NE(coloured.find("\033[33m"), std::string::npos);
  EXPECT_EQ(coloured.find("%\n"), std::string::npos);
  std::string const plain = on_terminal("NO_COLOR=1 TERM=xterm");
  EXPECT_NE(plain.find("\r\033[K"), std::string::npos);
  EXPECT_EQ(plain.find("\033[33m"), std::string::npos);
  EXPECT_EQ(on_terminal("TERM=dumb").find('\033'), std::string::npos);
}

}  // namespace
}  // namespace clathra
