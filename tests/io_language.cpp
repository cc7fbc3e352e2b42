/// What a user reads keeps to docs/reference/glossary.md, and every example of a help text runs.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "command.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

fs::path const project = fs::path(CLATHRA_EXAMPLES).parent_path();

/// The left column of the glossary's last table.
std::vector<std::string> words_not_used() {
  std::ifstream file(project / "docs" / "reference" / "glossary.md");
  std::vector<std::string> words;
  bool there = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ")) there = line == "## Words that are not used";
    if (there && line.starts_with("| ") && !line.starts_with("| not |")) words.push_back(line.substr(2, line.find(" |", 2) - 2));
  }
  return words;
}

/// The first of the words in a text, or nothing.
std::string word_in(std::string const& text, std::vector<std::string> const& words) {
  for (std::string const& word : words) {
    std::regex const pattern("\\b" + word + "s?\\b", std::regex::icase);
    if (std::regex_search(text, pattern)) return word;
  }
  return {};
}

/// The texts of several words that a source file holds.
std::vector<std::string> texts_of(fs::path const& source) {
  std::ifstream file(source);
  std::vector<std::string> texts;
  std::regex const literal(R"x("((?:[^"\\]|\\.)*)")x");
  for (std::string line; std::getline(file, line);) {
    std::size_t const begin = line.find_first_not_of(' ');
    if (begin == line.npos || line.compare(begin, 2, "//") == 0 || line[begin] == '#') continue;
    for (std::sregex_iterator at(line.begin(), line.end(), literal), end; at != end; ++at)
      if (std::string const text = (*at)[1]; text.find(' ') != text.npos) texts.push_back(text);
  }
  return texts;
}

TEST(Language, OfMessagesAndReportsIsThatOfTheGlossary) {
  std::vector<std::string> const words = words_not_used();
  ASSERT_GE(words.size(), 10u);
  EXPECT_EQ(word_in("two discs and their particle-steps", words), "disc");
  EXPECT_EQ(word_in("their particle-steps", words), "");
  EXPECT_NE(word_in("their disc-steps", words), "");
  int texts = 0;
  for (char const* const folder : {"src", "drivers"})
    for (fs::directory_entry const& entry : fs::recursive_directory_iterator(project / folder)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      for (std::string const& text : texts_of(entry.path())) {
        ++texts;
        EXPECT_EQ(word_in(text, words), "") << entry.path() << ": " << text;
      }
    }
  EXPECT_GE(texts, 1000);
}

TEST(Language, OfHelpAndKeysIsThatOfTheGlossary) {
  std::vector<std::string> const words = words_not_used();
  for (char const* const command : {"--help", "man", "schema"}) {
    std::istringstream lines(run_clathra(command).output);
    for (std::string line; std::getline(lines, line);) EXPECT_EQ(word_in(line, words), "") << command << ": " << line;
  }
}

TEST(Language, KeysAreExplainedInOneLine) {
  std::istringstream lines(run_clathra("init quick -o /dev/stdout").output);
  EXPECT_NE(run_clathra("schema").output.find("**`saturation`**"), std::string::npos);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 260u) << line;
}

/// The lines behind "Example:" of a help text.
std::vector<std::string> examples_of(std::string const& help) {
  std::vector<std::string> examples;
  std::istringstream lines(help);
  bool there = false;
  for (std::string line; std::getline(lines, line);) {
    std::size_t const at = line.find("clathra ");
    there = line.starts_with("Example:") || (there && at != line.npos && line.find_first_not_of(' ') == at);
    if (there && at != line.npos) examples.push_back(line.substr(at));
  }
  return examples;
}

/// The example as it can be run within seconds: tests of small specimens, studies and reproductions to their forecast.
std::string shortened(std::string command) {
  auto const replace = [&](std::string const& from, std::string const& to) {
    if (std::size_t const at = command.find(from); at != command.npos) command.replace(at, from.size(), to);
  };
  if (command.starts_with("clathra run ") || command.starts_with("clathra generate ") || command.starts_with("clathra tune "))
    command += " --set specimen.particles=200 --set specimen.compaction_layers=2";
  if (command.starts_with("clathra run ")) command += " --overwrite --set test.axial_strain=\"1.5 %\"";
  if (command.starts_with("clathra run ") && command.find("specimen.file=") != command.npos)
    command += " --output out/read --set specimen.particles= --set specimen.compaction_layers=";
  if (command.starts_with("clathra tune ")) replace("\"10 min\"", "1s");
  if (command.starts_with("clathra study ") || command.starts_with("clathra reproduce ")) command += " --dry-run";
  replace("~/.local/share/bash-completion/completions/", "");
  if (command.starts_with("clathra bench ")) replace("--particles 20000", "--particles 2000 --seconds 0.2");
  if (std::size_t const pipe = command.find(" | "); pipe != command.npos) command.resize(pipe);
  return command;
}

TEST(HelpExamples, AllRunAsTheyStandInAFolderWithTheExamples) {
  fs::path const folder = fs::temp_directory_path() / ("clathra_help_" + std::to_string(::getpid()));
  fs::create_directories(folder / "bin");
  fs::create_directory_symlink(CLATHRA_EXAMPLES, folder / "examples");
  fs::create_symlink(CLATHRA_BINARY, folder / "bin" / "clathra");
  auto const shell = [&](std::string const& command) {
    return run_clathra("--version >/dev/null; cd '" + folder.string() + "' && PATH=\"$PWD/bin:$PATH\" OMP_NUM_THREADS=1 " +
                       command);
  };
  std::string const verbs =
      "check run study tune reproduce generate bond info events export report verify bench selftest init "
      "schema completion man";
  std::istringstream names(verbs);
  std::vector<std::string> commands = examples_of(run_clathra("--help").output);
  ASSERT_EQ(commands.size(), 1u);
  for (std::string verb; names >> verb;) {
    std::vector<std::string> const examples = examples_of(run_clathra(verb + " --help").output);
    EXPECT_GE(examples.size(), 1u) << verb;
    commands.insert(commands.end(), examples.begin(), examples.end());
  }
  for (char const* const run : {"s26", "s41", "s55"})  // what the example of `report` lays over each other
    ASSERT_EQ(shell(shortened("clathra run examples/quick.toml --output out/" + std::string(run))).code, 0);
  fs::remove_all(folder / "out" / "s41");  // which the example of `run` makes
  for (std::string const& command : commands) {
    CommandResult const result = shell(shortened(command));
    bool const tells = command.starts_with("clathra tune ") && result.code == 79;  // too little time to know
    EXPECT_TRUE(result.code == 0 || tells) << command << "\n" << result.output;
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace clathra
