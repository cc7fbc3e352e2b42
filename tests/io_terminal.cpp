/// What a terminal gets to see of text that others wrote: never a control character.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "command.hpp"
#include "io/errors/printable.hpp"
#include "terminal/text.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

TEST(Durations, HaveTheirUnits) {
  for (auto const& [seconds, text] : {std::pair{0.4, "0 s"},
                                      {59.4, "59 s"},
                                      {60., "1 min"},
                                      {200., "3 min 20 s"},
                                      {185., "3 min 05 s"},
                                      {7500., "2 h 05 min"},
                                      {7200., "2 h"},
                                      {3 * 86400., "3 days"},
                                      {-1., "?"}})
    EXPECT_EQ(duration_text(seconds), text);
}

TEST(Printable, WritesControlCharactersOut) {
  EXPECT_EQ(printable("a\x1b[31mb\a\x7f"), "a\\x1b[31mb\\x07\\x7f");
  EXPECT_EQ(printable("two\nlines\t"), "two\\x0alines\\x09");
  EXPECT_EQ(printable("two\nlines\t\r", "\n\t"), "two\nlines\t\\x0d");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m")
      << "the control sequence introducer above ASCII";
  EXPECT_EQ(printable("\x9b\xff\xe2\x82"), "\\x9b\\xff\\xe2\\x82") << "no UTF-8";
  EXPECT_EQ(printable("\xe2\x80\xae"
                      "lmot"),
            "\\xe2\\x80\\xaelmot")
      << "text from right to left";
}

TEST(Printable, LeavesWhatIsReadAsItIs) {
  std::string const text = "out/s41: σ₃ = 1 MPa, größer\\x1b";
  EXPECT_EQ(printable(text), text);
  EXPECT_EQ(printable(printable("\x1b")), "\\x1b");
  EXPECT_EQ(printable(""), "");
}

class Terminal : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  /// What the program prints: with `escape` spelt out, and without any control character.
  void expect_escaped(std::string const& arguments, std::string const& escape, int code) const {
    CommandResult const result = run_clathra(arguments);
    EXPECT_EQ(result.code, code) << arguments;
    EXPECT_NE(result.output.find(escape), std::string::npos) << result.output;
    for (char const c : result.output) ASSERT_TRUE(c == '\n' || c == '\t' || static_cast<unsigned char>(c) >= 0x20) << arguments;
  }
  std::string scene(std::string const& text, std::string const& name = "my.toml") const {
    std::ofstream(folder / name) << text;
    return std::string("'").append(folder / name).append("'");
  }

  fs::path const folder = fs::temp_directory_path() / ("clathra_terminal_" + std::to_string(::getpid()));
};

TEST_F(Terminal, GetsNoControlCharacterOfASceneOrAName) {
  std::string const right = "[specimen]\nparticles = 300\n";
  expect_escaped("check " + scene(right + "\"a\\u001b[31mb\\n\" = 2\n"), "unknown key 'a\\x1b[31mb\\x0a'", 65);
  expect_escaped("check " + scene(right + "[\"x\\u001b]0;title\\u0007\"]\nkey = 2\n"), "unknown section [x\\x1b]0;title\\x07]",
                 65);
  expect_escaped("check " + scene(right) + " --set \"$(printf 'run.\\033[31mseed=3')\"", "unknown key 'run.\\x1b[31mseed'", 64);
  expect_escaped("check \"$(printf 'no\\033[31mfile\\n.toml')\"", "no\\x1b[31mfile\\x0a.toml: cannot be opened", 66);
  expect_escaped("check " + scene(right, "red\033[31m.toml"), "red\\x1b[31m.toml: valid", 0);
  expect_escaped("check a.toml \"$(printf -- '--\\033[31mred')\"", "\\x1b[31mred", 64);
  expect_escaped("\"$(printf 'ch\\033[31meck')\"", "no command 'ch\\x1b[31meck'", 64);
}

TEST_F(Terminal, GetsNoControlCharacterOfARecord) {
  scene(
      R"({"exit": {"reason": "finished", "code": 0}, "program": {"version": "\u001b[31m1", "git_hash": "a", "backend": "b",
         "threads": 1}, "stages": {}, "wall_seconds": {}, "particle_steps_per_second": 1, "warnings": ["a\u001b[2Jb"]})",
      "run.json");
  expect_escaped("info " + (folder / "run.json").string(), "warning: a\\x1b[2Jb", 0);
}

}  // namespace
}  // namespace clathra
