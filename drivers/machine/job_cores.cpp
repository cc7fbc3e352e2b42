#include "machine/job_cores.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>

namespace clathra {
namespace {

constexpr std::string_view launchers[] = {"mpirun",  "mpiexec", "orterun",         "orted",
                                          "prterun", "prted",   "hydra_pmi_proxy", "mpiexec.hydra"};

struct Process {
  std::string name;
  long parent = 0;
};

/// By /proc/PID/stat: "PID (NAME) STATE PARENT ..."; a name may hold blanks and brackets.
Process process(long id) {
  std::ifstream file("/proc/" + std::to_string(id) + "/stat");
  std::string const text(std::istreambuf_iterator<char>(file), {});
  std::size_t const open = text.find('('), close = text.rfind(')');
  if (open == text.npos || close == text.npos) return {};
  Process found{text.substr(open + 1, close - open - 1), 0};
  std::istringstream rest(text.substr(close + 1));
  std::string state;
  rest >> state >> found.parent;
  return found;
}

int cores_of(long process) {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  return ::sched_getaffinity(static_cast<pid_t>(process), sizeof cores, &cores) == 0 ? CPU_COUNT(&cores) : 0;
}

/// Of the nearest launcher among our ancestors, 0 where there is none.
int cores_of_launcher() {
  constexpr int most = 8;  // scripts may stand between
  long ancestor = ::getppid();
  for (int i = 0; i < most && ancestor > 1; ++i) {
    Process const found = process(ancestor);
    if (std::find(std::begin(launchers), std::end(launchers), found.name) != std::end(launchers)) return cores_of(ancestor);
    ancestor = found.parent;
  }
  return 0;
}

}  // namespace

int job_cores(int own) {
  char const* const of_slurm = std::getenv("SLURM_STEP_NUM_TASKS") ? std::getenv("SLURM_CPUS_ON_NODE") : nullptr;
  int const job = of_slurm ? std::atoi(of_slurm) : cores_of_launcher();
  return std::max(own, job);
}

}  // namespace clathra
