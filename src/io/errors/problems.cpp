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

bool any_of(std::vector<Problem> const& problems, Severity severity) {
  return std::any_of(problems.begin(), problems.end(), [&](Problem const& p) { return p.severity == severity; });
}

}  // namespace

std::string Problem::message() const {
  std::string_view const kind = severity == Severity::refusal ? "refused" : "error";
  if (line == 0) return fmt::format("{}: {}: {}", file, kind, text);
  return fmt::format("{}:{}:{}: {}: {}", file, line, column, kind, text);
}

SceneProblems::SceneProblems(std::vector<Problem> all) : std::runtime_error(joined(all)), problems(std::move(all)) {}

ExitCode SceneProblems::code() const {
  if (any_of(problems, Severity::error)) return ExitCode::bad_input;
  return any_of(problems, Severity::missing_file) ? ExitCode::file_missing : ExitCode::refused;
}

}  // namespace clathra
