/// Whole-step throughput on fixed packings: particle-steps per second of Simulation::step() with walls, servo and neighbour
/// searches.
///   step_bench [--discs N] [--case rolling|bonded] [--seconds S] [--repeat R] [--skin S]
/// Threads: OMP_NUM_THREADS. Prints one row per repeat and the median. `clathra bench` gives a user the same numbers.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "domain/throughput.hpp"

namespace {

using namespace clathra;

struct Options {
  ThroughputSetup setup;
  double seconds = 3;
  int repeat = 3;
};

Options read_options(int argc, char** argv) {
  Options options;
  for (int k = 1; k + 1 < argc; k += 2) {
    std::string const name = argv[k], value = argv[k + 1];
    if (name == "--discs")
      options.setup.discs = std::atoll(value.c_str());
    else if (name == "--case" && (value == "rolling" || value == "bonded"))
      options.setup.what = value == "bonded" ? ThroughputCase::bonded : ThroughputCase::rolling;
    else if (name == "--seconds")
      options.seconds = std::atof(value.c_str());
    else if (name == "--skin")
      options.setup.skin = std::atof(value.c_str());
    else if (name == "--repeat")
      options.repeat = std::atoi(value.c_str());
    else {
      std::fprintf(stderr, "step_bench: unknown option or value '%s %s'\n", name.c_str(), value.c_str());
      std::exit(64);
    }
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  Options const options = read_options(argc, argv);
  ::setenv("OMP_PROC_BIND", "false", 0);
  Kokkos::ScopeGuard const guard(argc, argv);
  Simulation simulation = throughput_simulation(options.setup);
  std::printf(
      "case,discs,threads,lanes,particle_steps_per_s,ns_per_particle_step,contact_steps_per_s,steps,rebuilds,rebuild_share,"
      "bytes_per_disc,entries_per_disc\n");
  std::vector<double> rates;
  for (int n = 0; n < options.repeat; ++n) {
    Throughput const t = measure_throughput(simulation, options.seconds);
    rates.push_back(t.particle_steps_per_s);
    std::printf("%s,%d,%d,%d,%.4g,%.2f,%.4g,%lld,%lld,%.3f,%.0f,%.2f\n",
                options.setup.what == ThroughputCase::bonded ? "bonded" : "rolling", simulation.discs(),
                ExecutionSpace::concurrency(), lane_count, rates.back(), 1e9 / rates.back(), t.contact_steps_per_s,
                static_cast<long long>(t.steps), static_cast<long long>(t.rebuilds), t.rebuild_share, t.bytes_per_disc,
                static_cast<double>(simulation.contact_entries()) / simulation.discs());
  }
  std::sort(rates.begin(), rates.end());
  std::printf("median %.4g particle-steps/s\n", rates[rates.size() / 2]);
  return 0;
}
