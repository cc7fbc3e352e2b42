#include "machine/processes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <cerrno>
#include <stdexcept>

#include "machine/system_failure.hpp"

namespace clathra {
namespace {

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// What the new process does between fork and exec. Returns the error of whatever fails.
int prepare_child(int log, cpu_set_t const* cores, pid_t parent) {
  ::setpgid(0, 0);
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, stop_signal);
  if (::getppid() != parent) ::_exit(0);  // it was killed before that
#else
  (void)parent;
#endif
  if (cores && ::sched_setaffinity(0, sizeof *cores, cores) != 0) return errno;
  int const nothing = ::open("/dev/null", O_RDONLY);
  if (nothing < 0 || ::dup2(nothing, STDIN_FILENO) < 0 || ::dup2(log, STDOUT_FILENO) < 0 || ::dup2(log, STDERR_FILENO) < 0)
    return errno;
  for (int const ours : {SIGPIPE, SIGXFSZ, SIGINT, SIGTERM, SIGUSR1, SIGHUP}) ::signal(ours, SIG_DFL);
  return 0;
}

}  // namespace

std::string own_path() {
  std::string path(4096, '\0');
  ssize_t const length = ::readlink("/proc/self/exe", path.data(), path.size());
  if (length <= 0) system_failure(errno, "cannot find this program's file");
  path.resize(static_cast<std::size_t>(length));
  return path;
}

std::vector<int> own_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores;
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return {0};
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(static_cast<std::size_t>(core), &set)) cores.push_back(core);
  return cores;
}

pid_t start_process(std::vector<std::string> const& command, std::filesystem::path const& log, std::vector<int> const& cores) {
  std::vector<std::string> words = command;
  std::vector<char*> const pointers = pointers_to(words);
  int const file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) system_failure(errno, log.string());
  cpu_set_t set;
  CPU_ZERO(&set);
  for (int const core : cores) CPU_SET(static_cast<std::size_t>(core), &set);
  int ends[2];  // the new process says through it why it could not start; a program that starts closes it
  if (::pipe2(ends, O_CLOEXEC) != 0) system_failure(errno, "cannot make a pipe");
  pid_t const parent = ::getpid(), child = ::fork();
  if (child == 0) {
    int error = prepare_child(file, cores.empty() ? nullptr : &set, parent);
    if (error == 0) {
      ::execvp(pointers[0], pointers.data());
      error = errno;
    }
    (void)!::write(ends[1], &error, sizeof error);
    ::_exit(127);
  }
  int const fork_error = errno;
  ::close(ends[1]);
  ::close(file);
  int error = child < 0 ? fork_error : 0;
  if (child > 0 && ::read(ends[0], &error, sizeof error) == static_cast<ssize_t>(sizeof error))
    ::waitpid(child, nullptr, 0);
  else if (child > 0)
    error = 0;
  ::close(ends[0]);
  if (error != 0) system_failure(error, fmt::format("cannot start {}", command.front()));
  return child;
}

std::optional<ProcessEnd> ended_process() {
  int status = 0;
  pid_t const process = ::waitpid(-1, &status, WNOHANG);
  if (process <= 0) return {};
  if (WIFSIGNALED(status)) return ProcessEnd{process, 0, WTERMSIG(status)};
  return ProcessEnd{process, WEXITSTATUS(status), 0};
}

std::vector<std::string> words_of(std::string const& command) {
  std::vector<std::string> words;
  bool in_word = false;
  char quote = 0;
  for (char const c : command) {
    if (quote != 0 ? c == quote : c == '"' || c == '\'') {
      quote = quote != 0 ? '\0' : c;
      if (!in_word) words.emplace_back();
      in_word = true;
    } else if (quote == 0 && (c == ' ' || c == '\t')) {
      in_word = false;
    } else {
      if (!in_word) words.emplace_back();
      in_word = true;
      words.back() += c;
    }
  }
  if (quote != 0) throw std::invalid_argument("a quote is not closed");
  return words;
}

std::string words_problem(std::string const& command) {
  try {
    return words_of(command).empty() ? "needs a command" : "";
  } catch (std::invalid_argument const& problem) {
    return fmt::format("{}: {}", command.substr(0, 100), problem.what());
  }
}

void become(std::vector<std::string> const& command) {
  std::vector<std::string> words = command;
  ::execvp(words[0].c_str(), pointers_to(words).data());
  system_failure(errno, fmt::format("cannot start {}", command.front()));
}

}  // namespace clathra
