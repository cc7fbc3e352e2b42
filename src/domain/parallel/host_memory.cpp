#include "domain/parallel/host_memory.hpp"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace clathra {

bool ask_for_huge_pages() {
#ifdef __GLIBC__
  if (std::getenv("GLIBC_TUNABLES")) return false;
  return ::setenv("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1", 1) == 0;
#else
  return false;
#endif
}

void start_anew() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> arguments;
  for (std::string argument; std::getline(file, argument, '\0');) arguments.push_back(argument);
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  if (!arguments.empty()) ::execv("/proc/self/exe", pointers.data());
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
