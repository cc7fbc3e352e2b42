/// To be preloaded: a file system that knows no locks, as Lustre without -o flock.
#include <dlfcn.h>
#include <fcntl.h>

#include <cerrno>
#include <cstdarg>

namespace {

int unless_a_lock(char const* name, int descriptor, int command, void* argument) {
  if (command == F_OFD_SETLK || command == F_SETLK || command == F_SETLKW || command == F_OFD_SETLKW) {
    errno = ENOSYS;
    return -1;
  }
  return reinterpret_cast<int (*)(int, int, ...)>(::dlsym(RTLD_NEXT, name))(descriptor, command, argument);
}

}  // namespace

extern "C" int flock(int, int) noexcept {
  errno = ENOSYS;
  return -1;
}
extern "C" int fcntl(int descriptor, int command, ...) {
  va_list arguments;
  va_start(arguments, command);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  return unless_a_lock("fcntl", descriptor, command, argument);
}
extern "C" int fcntl64(int descriptor, int command, ...) {
  va_list arguments;
  va_start(arguments, command);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  return unless_a_lock("fcntl64", descriptor, command, argument);
}
