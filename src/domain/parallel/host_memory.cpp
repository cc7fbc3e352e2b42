#include "domain/parallel/host_memory.hpp"

#ifdef _OPENMP
#include <omp.h>
#endif
#include <sched.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>
#ifdef __GLIBC__
#include <malloc.h>
#include <sys/auxv.h>
#endif

namespace clathra {
namespace {

/// Takes back that OpenMP has bound this thread to one core: the program that is started anew would have no other.
void unbind() {
#ifdef _OPENMP
  cpu_set_t cores;
  CPU_ZERO(&cores);
  for (int place = 0; place < omp_get_num_places(); ++place) {
    std::vector<int> of_place(static_cast<std::size_t>(omp_get_place_num_procs(place)));
    omp_get_place_proc_ids(place, of_place.data());
    for (int const core : of_place) CPU_SET(static_cast<std::size_t>(core), &cores);
  }
  if (CPU_COUNT(&cores) > 0) ::sched_setaffinity(0, sizeof cores, &cores);
#endif
}

}  // namespace

bool ask_for_huge_pages() {
#ifdef __GLIBC__
  // A program with rights of its own is started without this variable each time.
  if (std::getenv("GLIBC_TUNABLES") || ::getauxval(AT_SECURE) != 0) return false;
  return ::setenv("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1", 1) == 0;
#else
  return false;
#endif
}

void start_anew() {
  unbind();
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> arguments;
  for (std::string argument; std::getline(file, argument, '\0');) arguments.push_back(argument);
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  if (arguments.empty()) return;
  // By its own path `ps` and `pkill` know it by its name; the link is there even where the program was replaced meanwhile.
  std::error_code ignored;
  std::filesystem::path const own = std::filesystem::read_symlink("/proc/self/exe", ignored);
  if (!ignored) ::execv(own.c_str(), pointers.data());
  ::execv("/proc/self/exe", pointers.data());
}

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kept = 1 << 30, in_one_piece = 1 << 25;  // [bytes]; the second is the largest that glibc takes
  ::mallopt(M_TRIM_THRESHOLD, kept);
  ::mallopt(M_MMAP_THRESHOLD, in_one_piece);
#endif
}

void set_up_host_memory() {
  if (ask_for_huge_pages()) start_anew();
  keep_freed_memory();
}

}  // namespace clathra
