/// To be preloaded: a file system that knows no locks, as Lustre without -o flock.
#include <dlfcn.h>
#include <fcntl.h>

#include <cerrno>
#include <cstdarg>

extern "C" int flock(int, int) noexcept {
  errno = ENOSYS;
  return -1;
}
extern "C" int fcntl(int descriptor, int command, ...) {
  if (command == F_OFD_SETLK || command == F_OFD_SETLKW || command == F_SETLK || command == F_SETLKW) {
    errno = ENOSYS;
    return -1;
  }
  va_list arguments;
  va_start(arguments, command);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  return reinterpret_cast<int (*)(int, int, ...)>(::dlsym(RTLD_NEXT, "fcntl"))(descriptor, command, argument);
}
extern "C" [[gnu::alias("fcntl")]] int fcntl64(int descriptor, int command, ...);
