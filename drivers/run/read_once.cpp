#include "run/read_once.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "io/errors/problems.hpp"
#include "io/formats/text_file.hpp"

namespace clathra {
namespace {

constexpr char kept_name[] = "CLATHRA_PIPED_TEXT";  // process, descriptor: a child inherits the variable, too

/// Keeps the text in memory that outlives the program but not the process.
void keep(std::string_view text, std::filesystem::path const& path) {
  int const memory = ::memfd_create("piped_text", 0);
  bool kept = memory >= 0;
  while (kept && !text.empty()) {
    ::ssize_t const written = ::write(memory, text.data(), text.size());
    kept = written > 0;
    if (kept) text.remove_prefix(static_cast<std::size_t>(written));
  }
  if (!kept) throw FileProblem(ExitCode::io_error, path, "is a pipe whose text cannot be kept in memory: write it to a file");
  ::setenv(kept_name, fmt::format("{} {}", ::getpid(), memory).c_str(), 1);
}

}  // namespace

std::string read_once(std::filesystem::path const& path, std::size_t limit) {
  long process = 0;
  int memory = -1;
  char const* const kept = std::getenv(kept_name);
  if (kept && std::sscanf(kept, "%ld %d", &process, &memory) == 2 && process == ::getpid())
    return read_text_file(fmt::format("/proc/self/fd/{}", memory), limit);
  std::string text = read_text_file(path, limit);
  if (std::filesystem::is_fifo(path)) keep(text, path);
  return text;
}

}  // namespace clathra
