#include "threads.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "domain/ranks.hpp"

namespace clathra {
namespace {

int core_count() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  return ::sched_getaffinity(0, sizeof cores, &cores) == 0 ? std::max(1, CPU_COUNT(&cores)) : 1;
}

/// Sets a variable; true if that changed it.
bool settle(char const* name, std::string const& value) {
  char const* const now = std::getenv(name);
  if (now && value == now) return false;
  ::setenv(name, value.c_str(), 1);
  return true;
}

/// Replaces this process by the same program with the same arguments. Returns only where the system does not let it.
void start_anew() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> arguments;
  for (std::string argument; std::getline(file, argument, '\0');) arguments.push_back(argument);
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  if (!arguments.empty()) ::execv("/proc/self/exe", pointers.data());
}

}  // namespace

int thread_count(int wanted) {
  if (wanted > 0) return wanted;
  char const* const set = std::getenv("OMP_NUM_THREADS");
  int const from_environment = set ? std::atoi(set) : 0;
  return from_environment > 0 ? from_environment : std::max(1, core_count() / launched_ranks_here());
}

void settle_threads(int wanted) {
  int const threads = thread_count(wanted);
  bool changed = settle("OMP_NUM_THREADS", std::to_string(threads));
  if (launched_ranks() > 1) ::setenv("KOKKOS_DISABLE_WARNINGS", "1", 0);  // more ranks than cores is for the user to choose
  ::setenv("KOKKOS_NUM_THREADS", std::to_string(threads).c_str(), 1);
  if (!std::getenv("OMP_PROC_BIND")) {
    bool const all = threads == core_count();
    changed = settle("OMP_PROC_BIND", all ? "true" : "false") || changed;
    if (all && !std::getenv("OMP_PLACES")) ::setenv("OMP_PLACES", "cores", 1);
  }
  if (changed) start_anew();
}

}  // namespace clathra
