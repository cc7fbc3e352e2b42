#pragma once
/// Runs the program `clathra` as a user does.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace clathra {

struct CommandResult {
  int code;            ///< exit code
  std::string output;  ///< stdout and stderr together
};

/// The program as a shell takes it: the path may hold spaces.
inline constexpr char const* program_in_shell = "\"" CLATHRA_BINARY "\"";

/// @param arguments  as in a shell, after the program's name
inline CommandResult run_clathra(std::string const& arguments) {
  std::string const command = program_in_shell + (" " + arguments) + " 2>&1";
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  CommandResult result{-1, ""};
  if (!pipe) return result;
  std::array<char, 4096> buffer;
  while (std::size_t const count = std::fread(buffer.data(), 1, buffer.size(), pipe)) result.output.append(buffer.data(), count);
  result.code = WEXITSTATUS(::pclose(pipe));
  return result;
}

/// Whether the program said something.
inline testing::AssertionResult says(CommandResult const& result, std::string const& wanted) {
  if (result.output.find(wanted) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "code " << result.code << ", not said: " << wanted << "\n" << result.output;
}

}  // namespace clathra
