/// What each feature costs that a scene can switch on: pairs of runs in turns, with and without it, on the packing of step_bench.
///   features [--discs N] [--seconds S] [--rounds R]
/// Threads: OMP_NUM_THREADS. Prints a Markdown table; a price of 1.10 makes a step a tenth longer.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "domain/parallel/host_memory.hpp"
#include "throughput/throughput.hpp"

namespace {

using namespace clathra;

struct Options {
  std::int64_t discs = 20000;
  double seconds = 0.6;
  int rounds = 5;
};

Options read_options(int argc, char** argv) {
  Options options;
  for (int k = 1; k + 1 < argc; k += 2) {
    std::string const name = argv[k];
    if (name == "--discs")
      options.discs = std::atoll(argv[k + 1]);
    else if (name == "--seconds")
      options.seconds = std::atof(argv[k + 1]);
    else if (name == "--rounds")
      options.rounds = std::atoi(argv[k + 1]);
    else {
      std::fprintf(stderr, "features: unknown option '%s'\n", name.c_str());
      std::exit(64);
    }
  }
  return options;
}

void with_laws(Simulation& s, std::function<void(SimulationLaws&)> const& change) {
  SimulationLaws laws = s.assembly().laws;
  change(laws);
  s.set_laws(laws);
  s.request_search();
}

struct Feature {
  char const* name;
  ThroughputCase base;
  std::function<void(Simulation&)> without, with;
};

void nothing(Simulation&) {}

std::vector<Feature> features() {
  auto const rolling = ThroughputCase::rolling, bonded = ThroughputCase::bonded;
  auto const shape_factor = [](double value) {
    return [value](Simulation& s) { with_laws(s, [=](SimulationLaws& l) { l.contact.grain.shape_factor = value; }); };
  };
  auto const dashpot = [](Simulation& s) { with_laws(s, [](SimulationLaws& l) { l.contact.grain.damping_ratio = 0.02; }); };
  auto const rough = [](Simulation& s) { with_laws(s, [](SimulationLaws& l) { l.wall.friction = 0.3; }); };
  auto const ledger = [](Simulation& s) { s.set_ledger(true); };
  auto const marks = [](Simulation& s) { s.mark_start(); };
  auto const driven = [](AxisDrive (*lateral)(Assembly const&)) {
    return [lateral](Simulation& s) { s.drive(lateral(s.assembly()), AxisDrive::at_rate(1e-3), 0, 0); };
  };
  auto const at_stress = driven([](Assembly const& a) { return AxisDrive::at_stress(a.stress().x, 1); });
  auto const at_volume = driven([](Assembly const& a) { return AxisDrive::at_constant_area(a.area()); });
  auto const at_mean = driven([](Assembly const& a) { return AxisDrive::at_constant_mean(a.stress().x, a.stress().y, 1e-5, 1); });
  return {{"constant volume (`test.kind`)", rolling, at_stress, at_volume},
          {"constant mean stress (`test.kind`)", rolling, at_stress, at_mean},
          {"rolling resistance (`grains.rolling_width_factor`)", rolling, shape_factor(0), nothing},
          {"contact dashpots (`damping.viscous_ratio`)", rolling, nothing, dashpot},
          {"rough walls (`test.wall_friction`)", rolling, nothing, rough},
          {"energy ledger (`output.energy`)", rolling, nothing, ledger},
          {"displacements of snapshots (`output.snapshots`)", rolling, nothing, marks},
          {"contact dashpots, bonded", bonded, nothing, dashpot},
          {"energy ledger, bonded", bonded, nothing, ledger},
          {"displacements of snapshots, bonded", bonded, nothing, marks}};
}

struct Price {
  double without, with, ratio;  // [ns a disc and step]
};

/// Medians of the rounds; the ratio is that of the pairs.
Price price(Simulation& without, Simulation& with, Options const& options) {
  std::vector<double> off, on, ratio;
  for (int n = 0; n < options.rounds; ++n) {
    off.push_back(1e9 / measure_throughput(without, options.seconds).disc_steps_per_second);
    on.push_back(1e9 / measure_throughput(with, options.seconds).disc_steps_per_second);
    ratio.push_back(on.back() / off.back());
  }
  auto const median = [](std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  };
  return {median(off), median(on), median(ratio)};
}

void print(char const* name, Price const& p) {
  std::printf("| %s | %.1f | %.1f | %.3f |\n", name, p.without, p.with, p.ratio);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Options const options = read_options(argc, argv);
  ::setenv("OMP_PROC_BIND", "false", 0);
  set_up_host_memory();
  Kokkos::ScopeGuard const guard(argc, argv);
  std::printf("| feature | ns a disc and step without | with | price |\n|---|---|---|---|\n");
  Simulation sand = throughput_simulation({ThroughputCase::rolling, options.discs, 0.1});
  Simulation hydrate = throughput_simulation({ThroughputCase::bonded, options.discs, 0.1});
  print("the same twice: what the measurement can tell apart", price(sand, sand, options));
  print("bonds in parallel to the contacts (`hydrate.saturation`)", price(sand, hydrate, options));
  for (Feature const& f : features()) {
    Simulation without = throughput_simulation({f.base, options.discs, 0.1}),
               with = throughput_simulation({f.base, options.discs, 0.1});
    f.without(without);
    f.with(with);
    print(f.name, price(without, with, options));
  }
  return 0;
}
