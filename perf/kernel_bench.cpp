/// The kernels of a time step one by one, on the packings of step_bench: time a call and discs per second.
///   kernel_bench [options of Google Benchmark]        threads: OMP_NUM_THREADS
#include <benchmark/benchmark.h>

#include <map>
#include <memory>

#include "domain/parallel/host_memory.hpp"
#include "kernels/integrate.hpp"
#include "kernels/measures.hpp"
#include "throughput/throughput.hpp"

namespace {

using namespace clathra;

constexpr std::int64_t rolling = 0, bonded = 1;

using Packings = std::map<std::pair<std::int64_t, std::int64_t>, std::unique_ptr<Simulation>>;

/// Packings are made once and shared: every kernel here leaves them as they are. Cleared before Kokkos ends.
Packings& packings() {
  static Packings made;
  return made;
}

Simulation& packing(std::int64_t what, std::int64_t discs) {
  auto& simulation = packings()[{what, discs}];
  if (!simulation) {
    ThroughputSetup setup;
    setup.what = what == bonded ? ThroughputCase::bonded : ThroughputCase::rolling;
    setup.discs = discs;
    simulation = std::make_unique<Simulation>(throughput_simulation(setup));
  }
  return *simulation;
}

template <class Call>
void measure_call(benchmark::State& state, Call const& call) {
  Simulation& simulation = packing(state.range(0), state.range(1));
  for (auto _ : state) call(simulation);
  state.SetItemsProcessed(state.iterations() * simulation.assembly().discs());
  state.SetLabel(state.range(0) == bonded ? "bonded" : "rolling");
}

/// A step of length 0: the whole arithmetic, and the history stays.
void contact_forces(benchmark::State& state) {
  Faults const faults = make_faults();
  measure_call(state, [&](Simulation& s) {
    compute_forces(s.assembly().particles, s.assembly().rows, s.assembly().laws.contact, 0, 0, BreakLog(), Dissipation(), faults);
    Kokkos::fence();
  });
}

void kick_and_drift(benchmark::State& state) {
  Faults const faults = make_faults();
  DeviceSteps const steps;
  StepState const start;
  measure_call(state, [&](Simulation& s) {
    steps.set(start);
    integrate(s.assembly().particles, s.assembly().laws.motion, {0, 0}, Dissipation(), faults, steps);
    benchmark::DoNotOptimize(steps.get().step_displacement);
  });
}

/// Sorting, binning and filling of the rows, and one evaluation of the forces.
void neighbour_search(benchmark::State& state) {
  measure_call(state, [](Simulation& s) {
    s.request_search();
    s.evaluate_forces();
    Kokkos::fence();
  });
}

void measures(benchmark::State& state) {
  measure_call(state, [](Simulation& s) { benchmark::DoNotOptimize(s.assembly().measures()); });
}

void state_hash_of_all(benchmark::State& state) {
  measure_call(state, [](Simulation& s) { benchmark::DoNotOptimize(s.assembly().hash()); });
}

void sizes(benchmark::internal::Benchmark* b) { b->ArgsProduct({{rolling, bonded}, {2000, 20000, 200000}})->UseRealTime(); }

BENCHMARK(contact_forces)->Apply(sizes);
BENCHMARK(kick_and_drift)->Apply(sizes);
BENCHMARK(neighbour_search)->Apply(sizes);
BENCHMARK(measures)->Apply(sizes);
BENCHMARK(state_hash_of_all)->Apply(sizes);

}  // namespace

int main(int argc, char** argv) {
  ::setenv("OMP_PROC_BIND", "false", 0);
  set_up_host_memory();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 64;
  Kokkos::ScopeGuard const guard(argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  packings().clear();
  return 0;
}
