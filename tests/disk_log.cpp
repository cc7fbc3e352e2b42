/// To be preloaded: tells the file CLATHRA_DISK_LOG in which order a program writes, flushes, renames and removes files.
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

template <class Function>
Function next(char const* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}
using Write = ssize_t (*)(int, void const*, size_t);

void tell(char const* call, std::string const& what) {
  static char const* const name = std::getenv("CLATHRA_DISK_LOG");
  static int const log = name ? ::open(name, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644) : -1;
  std::string const line = std::string(call) + " " + what + "\n";
  if (log >= 0) (void)next<Write>("write")(log, line.data(), line.size());
}

std::string name_of(int descriptor) {
  char path[4096];
  ssize_t const size = ::readlink(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), path, sizeof path);
  return size > 0 ? std::string(path, static_cast<std::size_t>(size)) : "?";
}

}  // namespace

extern "C" {
ssize_t write(int descriptor, void const* bytes, size_t size) {
  if (descriptor > 2) tell("write", name_of(descriptor));
  return next<Write>("write")(descriptor, bytes, size);
}
int fsync(int descriptor) {
  tell("fsync", name_of(descriptor));
  return next<int (*)(int)>("fsync")(descriptor);
}
int rename(char const* from, char const* to) noexcept {
  tell("rename", to);
  return next<int (*)(char const*, char const*)>("rename")(from, to);
}
int remove(char const* path) noexcept {
  tell("remove", path);
  return next<int (*)(char const*)>("remove")(path);
}
}
