#include "throughput/throughput_card.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "kernels/phases.hpp"

namespace clathra {

namespace {

/// Kernels that are launched in a step, on the average over some.
double launches_per_step(Simulation& simulation) {
  constexpr int steps = 100;
  Phases const listening;
  simulation.step(steps);
  return static_cast<double>(Phases::launches()) / steps;
}

/// 2,000 and ten times as many each time, then `most_discs`.
std::vector<std::int64_t> card_sizes(std::int64_t most_discs) {
  std::vector<std::int64_t> sizes;
  for (std::int64_t discs = 2000; discs < most_discs; discs *= 10) sizes.push_back(discs);
  sizes.push_back(most_discs);
  return sizes;
}

int relaxation_steps(std::int64_t discs) {
  constexpr std::int64_t disc_steps = 600'000'000, least = 100, most = 3000;
  return static_cast<int>(std::clamp(disc_steps / discs, least, most));
}

}  // namespace

ThroughputRow throughput_row(ThroughputSetup const& setup, double seconds) {
  Simulation simulation = throughput_simulation(setup);
  measure_throughput(simulation, 0.2 * seconds);  // caches and clock speed settle
  ThroughputRow row;
  row.precision = setup.precision;
  row.discs = simulation.assembly().discs();
  row.measured = measure_throughput(simulation, seconds);
  row.bandwidth = update_bandwidth(simulation.bytes());
  row.launches_per_step = launches_per_step(simulation);
  return row;
}

void throughput_card(ThroughputSetup setup, std::int64_t most_discs, double seconds,
                     std::function<void(ThroughputRow const&)> const& visit) {
  for (std::int64_t const discs : card_sizes(most_discs)) {
    for (Precision const precision : {Precision::full, Precision::mixed}) {
      setup.discs = discs;
      setup.precision = precision;
      setup.relaxation_steps = relaxation_steps(discs);
      visit(throughput_row(setup, seconds));
    }
  }
}

std::string card_head() {
  return "   discs  precision  M particle-steps/s  us a step  bytes a disc  moved a particle-step  "
         "% of bandwidth   GB/s  launches a step  % searching\n";
}

std::string card_line(ThroughputRow const& row) {
  Throughput const& t = row.measured;
  char line[200];
  std::snprintf(line, sizeof line, "%8lld  %-9s  %18.4g  %9.4g  %12.0f  %21.0f  %14.3g  %5.4g  %15.3g  %11.3g\n",
                static_cast<long long>(row.discs), precision_names[static_cast<int>(row.precision)],
                t.disc_steps_per_second * 1e-6, row.microseconds_per_step(), t.bytes_per_disc, t.moved_per_step,
                100 * row.bandwidth_share(), row.bandwidth * 1e-9, row.launches_per_step, 100 * t.rebuild_share);
  return line;
}

}  // namespace clathra
