#include <gtest/gtest.h>

#include <cstdlib>

#include "command.hpp"

namespace clathra {
namespace {

TEST(SelftestCommand, FindsThisBuildRight) {
  CommandResult const result = run_clathra("selftest");
  EXPECT_EQ(result.code, 0);
  for (char const* const line : {"ok      bond law", "ok      collision", "ok      threads", "ok      specimen file"})
    EXPECT_NE(result.output.find(line), std::string::npos) << result.output;
}

TEST(SelftestCommand, GoesOnAfterACheckThatFailsAndEndsWithTheCodeOfAFault) {
  ::setenv("TMPDIR", "/proc/self", 1);
  CommandResult const result = run_clathra("selftest");
  ::unsetenv("TMPDIR");
  EXPECT_EQ(result.code, 70);
  EXPECT_NE(result.output.find("FAILED  specimen file"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("ok      bond law"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("1 of 4 checks failed"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace clathra
