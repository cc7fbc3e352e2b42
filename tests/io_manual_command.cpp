#include <gtest/gtest.h>

#include "command.hpp"
#include "io/scene/schema.hpp"

namespace clathra {
namespace {

/// The manual as troff prints it: without the backslashes before hyphens.
std::string manual() {
  std::string text = run_clathra("man").output;
  for (std::size_t at = 0; (at = text.find("\\-", at)) != std::string::npos;) text.erase(at, 1);
  return text;
}

TEST(Manual, NamesEveryVerbOfTheHelpEveryKeyAndEveryExitCode) {
  std::string const text = manual();
  std::string const help = run_clathra("--help").output;
  std::size_t const list = help.find("Commands:");
  ASSERT_NE(list, std::string::npos) << help;
  int verbs = 0;
  for (std::size_t at = list; (at = help.find("\n  ", at)) != std::string::npos; ++at) {
    std::string const verb = help.substr(at + 3, help.find(' ', at + 3) - at - 3);
    if (verb.empty()) continue;
    EXPECT_NE(text.find(".SS \"clathra " + verb + "\""), std::string::npos) << verb;
    ++verbs;
  }
  EXPECT_GE(verbs, 6);
  for (Key const& key : schema()) EXPECT_NE(text.find(".B " + std::string(key.name) + "\n"), std::string::npos) << key.name;
  for (int const code : {0, 64, 65, 66, 70, 71, 73, 74, 75, 76, 77, 78, 79, 130})
    EXPECT_NE(text.find(".B " + std::to_string(code) + "\n"), std::string::npos) << code;
}

TEST(Manual, NamesNoHiddenOption) { EXPECT_EQ(manual().find("--only"), std::string::npos); }

TEST(Help, ShowsTheManualPageAndWhereThePagesAre) {
  CommandResult const help = run_clathra("--help");
  EXPECT_TRUE(says(help, "\n  man                         Print the manual page\n"));
  EXPECT_TRUE(says(help, "\nPages that texts call docs/NAME.md: "));
  EXPECT_NE(manual().find("docs/NAME.md"), std::string::npos);
}

}  // namespace
}  // namespace clathra
