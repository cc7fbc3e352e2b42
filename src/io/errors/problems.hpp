#pragma once
/// What can go wrong with a user's files, and the exit code that says so.
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace clathra {

/// Exit codes of every verb (after sysexits.h).
enum class ExitCode {
  done = 0,
  usage = 64,          ///< a wrong command line, values of options and of --set included
  bad_input = 65,      ///< a scene or file with wrong content
  file_missing = 66,   ///< an input file that is not there or cannot be read
  internal = 70,       ///< a fault of Clathra
  out_of_memory = 71,  ///< more memory than there is
  cannot_create = 73,  ///< an output file or folder that cannot be made, or would take the place of what is there
  io_error = 74,       ///< a read or write that failed half way (full disk)
  to_be_resumed = 75,  ///< stopped early with a checkpoint: --resume goes on
  diverged = 76,       ///< the run became unstable
  refused = 77,        ///< a guard that --ignore-guards overrides
  member_failed = 78,  ///< members of a study failed; the others have results
  undetermined = 79,   ///< what was asked for cannot be told from the runs that there are
  interrupted = 130,   ///< stopped by Ctrl-C, without a checkpoint
};

/// A file that cannot be read, understood, made or written. The text is "path: reason".
struct FileProblem : std::runtime_error {
  FileProblem(ExitCode exit_code, std::filesystem::path const& path, std::string const& why)
      : std::runtime_error(path.string() + ": " + why), code(exit_code), file(path.string()), reason(why) {}
  FileProblem(ExitCode exit_code, std::string const& text) : std::runtime_error(text), code(exit_code), reason(text) {}
  ExitCode code;
  std::string file, reason;  ///< no file where the text alone is known
};

enum class Severity { error, missing_file, refusal };

/// One thing wrong in a scene or a command line. `line` and `column` count from 1; 0 where it has no place in a file.
struct Problem {
  std::string file;  ///< or the option: "--set key=value", "--tolerance"
  int line = 0, column = 0;
  std::string text;
  Severity severity = Severity::error;
  /// "my.toml:4:22: error: ..."
  std::string message() const;
  bool of_command_line() const { return file.starts_with("--"); }
};

/// Everything wrong with a scene, at once. what() holds one message a line.
struct SceneProblems : std::runtime_error {
  explicit SceneProblems(std::vector<Problem> all);
  /// bad_input if there is an error in a file, else usage for one of the command line, else file_missing, else refused.
  ExitCode code() const;
  std::vector<Problem> problems;
};

}  // namespace clathra
