/// The table of `clathra bench --card`, of kernels and domain alone: for machines without the libraries of files, like GPU nodes.
///   throughput_card [--case rolling|bonded|breaking] [--most-discs N] [--seconds S]
#include "throughput/throughput_card.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string>

#include "domain/parallel/host_memory.hpp"
#include "domain/parallel/ranks.hpp"

int main(int argc, char** argv) {
  using namespace clathra;
  ThroughputSetup setup;
  long long most_discs = 1'000'000;
  double seconds = 3;
  for (int k = 1; k < argc; k += 2) {
    std::string const name = argv[k], value = k + 1 < argc ? argv[k + 1] : "";
    auto const at = std::find(std::begin(throughput_case_names), std::end(throughput_case_names), value);
    if (name == "--case" && at != std::end(throughput_case_names)) {
      setup.what = static_cast<ThroughputCase>(at - std::begin(throughput_case_names));
    } else if (name == "--most-discs" && std::atoll(value.c_str()) >= 2000) {
      most_discs = std::atoll(value.c_str());
    } else if (name == "--seconds" && std::atof(value.c_str()) > 0) {
      seconds = std::atof(value.c_str());
    } else {
      std::fprintf(stderr, "throughput_card: unknown option or value '%s %s'\n", name.c_str(), value.c_str());
      return 64;
    }
  }
  ::setenv("OMP_PROC_BIND", "false", 0);
  set_up_host_memory();
  RankSession const session;
  Kokkos::ScopeGuard const guard(argc, argv);
  std::printf("%s, %d threads\n%s", ExecutionSpace::name(), ExecutionSpace().concurrency(), card_head().c_str());
  throughput_card(setup, most_discs, seconds, [](ThroughputRow const& row) {
    std::fputs(card_line(row).c_str(), stdout);
    std::fflush(stdout);
  });
  return 0;
}
