#include "terminal/print.hpp"

#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>

#include "domain/parallel/ranks.hpp"
#include "io/errors/printable.hpp"

namespace clathra {
namespace {

bool quiet = false;  // what --quiet asks for
bool printed_json = false;

/// @return 0 or errno
int put(int descriptor, std::string_view text) {
  while (!text.empty()) {
    ssize_t const written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

ExitCode print(std::string const& text) {
  if (launched_rank() != 0) return ExitCode::done;
  int const error = put(STDOUT_FILENO, printable(text, "\n\t"));
  if (error == 0 || error == EPIPE) return ExitCode::done;
  print_error("clathra: cannot write to standard output: " + std::generic_category().message(error));
  return ExitCode::io_error;
}

}  // namespace

void be_quiet() { quiet = true; }
bool is_quiet() { return quiet; }

ExitCode print_result(std::string const& text) { return quiet ? ExitCode::done : print(text); }

ExitCode print_json(std::string const& text) {
  printed_json = true;
  return print(text);
}

bool has_printed_json() { return printed_json; }

void print_error(std::string const& line) {
  if (launched_rank() == 0) put(STDERR_FILENO, printable(line) + "\n");
}

}  // namespace clathra
