/// Whole-step throughput on fixed packings: particle-steps per second of Simulation::step() with walls, servo and neighbour
/// searches.
///   [mpirun -n RANKS] step_bench [--discs N] [--case rolling|bonded|breaking] [--seconds S] [--repeat R] [--skin S] [--relax
///   STEPS]
/// Threads: OMP_NUM_THREADS. Prints one row per repeat, the median, and where the time of one more run went, kernel by kernel.
/// `clathra bench` gives a user the same numbers.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string>
#include <vector>

#include "domain/parallel/host_memory.hpp"
#include "kernels/phases.hpp"
#include "throughput/throughput.hpp"

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
    else if (auto const at = std::find(std::begin(throughput_case_names), std::end(throughput_case_names), value);
             name == "--case" && at != std::end(throughput_case_names))
      options.setup.what = static_cast<ThroughputCase>(at - std::begin(throughput_case_names));
    else if (name == "--relax")
      options.setup.relaxation_steps = std::atoi(value.c_str());
    else if (name == "--seconds")
      options.seconds = std::atof(value.c_str());
    else if (name == "--precision" && (value == "double" || value == "mixed"))
      options.setup.precision = value == "mixed" ? Precision::mixed : Precision::full;
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

/// The kernels that took the most time, in ns a disc and step and in shares of the step.
void print_phases(Simulation& simulation, double seconds) {
  Phases const listening;
  Throughput const t = measure_throughput(simulation, seconds);
  double const disc_steps = static_cast<double>(t.steps) * simulation.assembly().particles.owned;  // of this rank
  std::vector<std::pair<double, std::string>> phases;
  double in_kernels = 0;
  for (auto const& [label, time] : Phases::seconds()) {
    phases.emplace_back(time, label);
    in_kernels += time;
  }
  phases.emplace_back(t.seconds - in_kernels, "between kernels");
  std::sort(phases.rbegin(), phases.rend());
  std::printf("phase,ns_per_disc_step,share\n");
  for (auto const& [time, label] : phases) {
    if (time > 0.002 * t.seconds) std::printf("%s,%.3f,%.3f\n", label.c_str(), 1e9 * time / disc_steps, time / t.seconds);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Options const options = read_options(argc, argv);
  ::setenv("OMP_PROC_BIND", "false", 0);
  set_up_host_memory();
  RankSession const session;
  bool const root = session.ranks().root();
  if (!root) std::freopen("/dev/null", "w", stdout);  // one of the ranks speaks
  Kokkos::ScopeGuard const guard(argc, argv);
  Simulation simulation = throughput_simulation(options.setup, session.ranks());
  std::printf(
      "case,discs,ranks,threads,lanes,disc_steps_per_second,ns_per_disc_step,contact_steps_per_s,steps,rebuilds,rebuild_share,"
      "bytes_per_disc,entries_per_disc,bandwidth_share,flop_share,broken,search_bytes_per_disc\n");
  double const bandwidth = update_bandwidth(simulation.bytes()), arithmetic = arithmetic_rate();  // of this rank
  std::vector<double> rates;
  for (int n = 0; n < options.repeat; ++n) {
    Throughput const t = measure_throughput(simulation, options.seconds);
    rates.push_back(t.disc_steps_per_second);
    int const ranks = session.ranks().count();
    std::printf("%s,%d,%d,%d,%d,%.4g,%.2f,%.4g,%lld,%lld,%.3f,%.0f,%.2f,%.3f,%.3f,%lld,%.0f\n",
                throughput_case_names[static_cast<int>(options.setup.what)], simulation.assembly().discs(), ranks,
                ExecutionSpace().concurrency(), lane_count, rates.back(), 1e9 / rates.back(), t.contact_steps_per_s,
                static_cast<long long>(t.steps), static_cast<long long>(t.rebuilds), t.rebuild_share, t.bytes_per_disc,
                static_cast<double>(simulation.assembly().contact_entries()) / std::max(simulation.assembly().particles.owned, 1),
                rates.back() * t.moved_per_step / (bandwidth * ranks), t.flops_per_s / (arithmetic * ranks),
                static_cast<long long>(t.broken), t.search_bytes_per_disc);
  }
  std::sort(rates.begin(), rates.end());
  std::printf("median %.4g particle-steps/s\n", rates[rates.size() / 2]);
  print_phases(simulation, options.seconds);
  return 0;
}
