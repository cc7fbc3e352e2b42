#pragma once
/// Programs that run side by side, each with its messages in a file and on cores of its own.
#include <signal.h>
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace clathra {

/// What stops a program with a checkpoint: mpirun and srun pass it on to all ranks, of SIGTERM they make a SIGKILL.
inline constexpr int stop_signal = SIGUSR1;

/// How a program ended.
struct ProcessEnd {
  pid_t process = 0;
  int code = 0;    ///< of its exit; 0 where a signal ended it
  int signal = 0;  ///< that ended it, 0 = none
};

/// The path of this program.
std::string own_path();

/// The cores that this process may use.
std::vector<int> own_cores();

/// Starts a program in a process group of its own, so that Ctrl-C on the terminal reaches only us; should we be killed, it is
/// sent the stop signal. Its stdout and stderr are appended to a file. @param cores  on which it stays; empty = where it likes
/// @throws std::runtime_error where it cannot be started, with the reason
pid_t start_process(std::vector<std::string> const& command, std::filesystem::path const& log, std::vector<int> const& cores);

/// One of our programs that has ended since, if any has.
std::optional<ProcessEnd> ended_process();

/// The words of a command line, as a shell would take them: blanks separate, quotes hold together.
/// @throws std::invalid_argument where a quote is not closed
std::vector<std::string> words_of(std::string const& command);
/// What is wrong with such a command line; nothing where nothing is. For options.
std::string words_problem(std::string const& command);

/// The whole process becomes another program. @throws std::runtime_error where it cannot be started
[[noreturn]] void become(std::vector<std::string> const& command);

}  // namespace clathra
