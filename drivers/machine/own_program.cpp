#include "machine/own_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <stdexcept>

#include "clathra_version.hpp"
#include "domain/parallel/ranks.hpp"
#include "io/formats/hdf5_file.hpp"
#include "io/results/run_record.hpp"
#include "machine/processes.hpp"
#include "machine/system_failure.hpp"

namespace clathra {
namespace {

/// Starts the program with stdout on `descriptor`.
pid_t start(std::vector<std::string> arguments, int descriptor) {
  arguments.insert(arguments.begin(), "clathra");
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, descriptor, STDOUT_FILENO);
  pid_t child = 0;
  int const error = ::posix_spawn(&child, "/proc/self/exe", &actions, nullptr, pointers.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0) system_failure(error, "cannot start a second process");
  return child;
}

std::string read_to_end(int descriptor) {
  std::string text;
  std::array<char, 4096> buffer;
  while (true) {
    ssize_t const count = ::read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) system_failure(errno, "cannot wait for the second process");
  return status;
}

}  // namespace

std::string version_and_libraries() {
#if defined(__AVX512F__)
  constexpr char instruction_set[] = "AVX-512";
#elif defined(__AVX2__)
  constexpr char instruction_set[] = "AVX2";
#else
  constexpr char instruction_set[] = "generic";
#endif
  return fmt::format("clathra {}\nKokkos {}, {}\nMPI: {}\nHDF5 {}.{}.{}\ninstruction set: {}\n{}", own_version(),
                     kokkos_version(), backend_name(), message_passing_name(), H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE,
                     instruction_set, compiler_name());
}

std::string own_version() { return version_text(CLATHRA_VERSION, CLATHRA_GIT_HASH); }

std::string pages_folder() {
  std::error_code ignored;
  std::filesystem::path const installed = std::filesystem::path(own_path()).parent_path().parent_path() / "share/doc/clathra";
  return std::filesystem::exists(installed / "README.md", ignored)
             ? installed.string()
             : "in the source of Clathra; an installed program has them in share/doc/clathra";
}

std::string output_of_own_program(std::vector<std::string> const& arguments) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) system_failure(errno, "cannot make a pipe");
  pid_t const child = start(arguments, ends[1]);
  ::close(ends[1]);
  std::string const text = read_to_end(ends[0]);
  ::close(ends[0]);
  int const status = wait_for(child);
  if (WIFSIGNALED(status)) throw std::runtime_error(fmt::format("killed by signal {}", WTERMSIG(status)));
  if (WEXITSTATUS(status) != 0) throw std::runtime_error(fmt::format("ended with exit code {}", WEXITSTATUS(status)));
  return text;
}

}  // namespace clathra
