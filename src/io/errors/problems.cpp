#include "io/errors/problems.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clathra {
namespace {

std::string joined(std::vector<Problem> const& problems) {
  std::string text;
  for (Problem const& problem : problems) {
    if (!text.empty()) text += '\n';
    text += problem.message();
  }
  return text;
}

template <class Test>
bool any_of(std::vector<Problem> const& problems, Test const& test) {
  return std::any_of(problems.begin(), problems.end(), test);
}

}  // namespace

std::string Problem::message() const {
  std::string_view const kind = severity == Severity::refusal ? "refused" : "error";
  if (line == 0) return fmt::format("{}: {}: {}", file, kind, text);
  return fmt::format("{}:{}:{}: {}: {}", file, line, column, kind, text);
}

SceneProblems::SceneProblems(std::vector<Problem> all) : std::runtime_error(joined(all)), problems(std::move(all)) {}

ExitCode SceneProblems::code() const {
  auto const is_error = [](Problem const& p) { return p.severity == Severity::error; };
  if (any_of(problems, [&](Problem const& p) { return is_error(p) && !p.of_command_line(); })) return ExitCode::bad_input;
  if (any_of(problems, is_error)) return ExitCode::usage;
  bool const missing = any_of(problems, [](Problem const& p) { return p.severity == Severity::missing_file; });
  return missing ? ExitCode::file_missing : ExitCode::refused;
}

}  // namespace clathra
