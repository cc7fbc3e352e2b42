#include "machine/threads.hpp"

#include <Kokkos_Core.hpp>
#ifdef _OPENMP
#include <omp.h>
#endif
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "domain/parallel/host_memory.hpp"
#include "domain/parallel/ranks.hpp"
#include "machine/job_cores.hpp"

namespace clathra {
namespace {

// Of a waiting thread before it sleeps, about 0.1 ms. Below 1,000 threads fall asleep between the kernels of a step, above 30,000
// a thread keeps a core from the program that its partner waits for (table in perf/reports/0.1/performance.md).
constexpr int spins = 10000;

/// What was found before the program started itself anew: OMP_NUM_THREADS is no longer the user's since.
struct Found {
  int cores = 1;  ///< that this process may use
  int asked = 0;  ///< threads, by OMP_NUM_THREADS; 0 = not
};
constexpr char found_name[] = "CLATHRA_FOUND";

Found look() {
  Found found;
#ifdef _OPENMP
  found.cores = std::max(1, omp_get_num_procs());  // knows them where OMP_PROC_BIND has bound this thread to one of them already
#else
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (::sched_getaffinity(0, sizeof cores, &cores) == 0) found.cores = std::max(1, CPU_COUNT(&cores));
#endif
  if (char const* const set = std::getenv("OMP_NUM_THREADS")) found.asked = std::max(0, std::atoi(set));
  return found;
}

Found const& found() {
  static Found const found = [] {
    // The number of the process says that it was this one: a child inherits the variable, too.
    long process = 0;
    Found before;
    char const* const text = std::getenv(found_name);
    bool const mine =
        text && std::sscanf(text, "%ld %d %d", &process, &before.cores, &before.asked) == 3 && process == ::getpid();
    return mine ? before : look();
  }();
  return found;
}

void keep_for_the_new_start() {
  std::string const text = std::to_string(::getpid()) + " " + std::to_string(found().cores) + " " + std::to_string(found().asked);
  ::setenv(found_name, text.c_str(), 1);
}

/// Sets a variable; true if that changed it.
bool set_variable(char const* name, std::string const& value) {
  char const* const now = std::getenv(name);
  if (now && value == now) return false;
  ::setenv(name, value.c_str(), 1);
  return true;
}

}  // namespace

int thread_count(int wanted) {
  int const asked = wanted > 0 ? wanted : found().asked;
  int const share = std::max(1, job_cores(found().cores) / launched_ranks_here());  // a launcher may have bound this rank already
  return std::min(found().cores, asked > 0 ? asked : share);
}

std::string thread_warning(int wanted) {
  int const asked = wanted > 0 ? wanted : found().asked, cores = found().cores;
  if (asked <= cores) return {};
  return std::to_string(asked) + " threads were asked for, this process may use " + std::to_string(cores) + " core" +
         (cores == 1 ? "" : "s") + ": it takes " + std::to_string(cores) + ", since more would only wait for each other";
}

void set_up_threads(int wanted) {
  int const threads = thread_count(wanted);
  keep_for_the_new_start();
  bool changed = set_variable("OMP_NUM_THREADS", std::to_string(threads));
  if (launched_ranks() > 1) ::setenv("KOKKOS_DISABLE_WARNINGS", "1", 0);  // more ranks than cores is for the user to choose
  ::setenv("KOKKOS_NUM_THREADS", std::to_string(threads).c_str(), 1);
  if (!std::getenv("OMP_PROC_BIND")) {
    bool const all = threads == found().cores;
    changed = set_variable("OMP_PROC_BIND", all ? "true" : "false") || changed;
    if (all && !std::getenv("OMP_PLACES")) ::setenv("OMP_PLACES", "cores", 1);
  }
  if (!std::getenv("OMP_WAIT_POLICY") && !std::getenv("GOMP_SPINCOUNT"))
    changed = set_variable("GOMP_SPINCOUNT", std::to_string(spins)) || changed;
  changed = ask_for_huge_pages() || changed;
  if (changed) start_anew();
}

struct KokkosSession::Guard {
  char name[8] = "clathra";  // Kokkos looks through arguments of its own; ours are not for it
  int argument_count = 1;
  char* arguments[2] = {name, nullptr};
  Kokkos::ScopeGuard scope{argument_count, arguments};
};

KokkosSession::KokkosSession() : guard_(std::make_unique<Guard>()) { keep_freed_memory(); }
KokkosSession::~KokkosSession() = default;

}  // namespace clathra
