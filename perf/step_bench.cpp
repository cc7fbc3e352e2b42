/// Whole-step throughput on fixed packings: particle-steps per second of Simulation::step() with walls, servo and neighbour
/// searches.
///   step_bench [--discs N] [--case rolling|bonded] [--seconds S] [--repeat R] [--skin S]
/// The packing is a periodic cell of 2,000 discs under 1 MPa, replicated and cut by walls; `bonded` adds hydrate bonds of 55 %
/// saturation. It is sheared at the inertial number 1e-4. Threads: OMP_NUM_THREADS. Prints one row per repeat and the median.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "domain/bonding.hpp"
#include "domain/hydrate.hpp"
#include "domain/quasi_static.hpp"
#include "domain/settling.hpp"
#include "domain/tiled.hpp"
#include "kernels/stability.hpp"

namespace {

using namespace clathra;
using Clock = std::chrono::steady_clock;

struct Options {
  std::int64_t discs = 20000;
  bool bonded = true;
  double seconds = 3;
  int repeat = 3;
  double skin = 0.1;  // in d50
};

Options read_options(int argc, char** argv) {
  Options options;
  for (int k = 1; k + 1 < argc; k += 2) {
    std::string const name = argv[k], value = argv[k + 1];
    if (name == "--discs")
      options.discs = std::atoll(value.c_str());
    else if (name == "--case" && (value == "rolling" || value == "bonded"))
      options.bonded = value == "bonded";
    else if (name == "--seconds")
      options.seconds = std::atof(value.c_str());
    else if (name == "--skin")
      options.skin = std::atof(value.c_str());
    else if (name == "--repeat")
      options.repeat = std::atoi(value.c_str());
    else {
      std::fprintf(stderr, "step_bench: unknown option or value '%s %s'\n", name.c_str(), value.c_str());
      std::exit(64);
    }
  }
  return options;
}

/// The specimen of the bench, resting under 1 MPa.
Specimen make_specimen(Scene const& scene, std::int64_t discs) {
  SampleDesign design = design_sample(scene);
  PackedSpecimen const cell = pack_periodic_cell(scene, design, 2000, {});
  double const area = static_cast<double>(discs) / 2000 * cell.specimen.width() * cell.specimen.height();
  double const width = std::sqrt(area / 2);
  return replicate(cell.specimen, width, 2 * width);
}

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// One timed stretch of about `seconds`; returns particle-steps per second.
double timed(Simulation& simulation, double seconds, std::int64_t& rebuilds, std::int64_t& steps) {
  std::int64_t const first = simulation.steps(), first_rebuilds = simulation.rebuilds();
  auto const start = Clock::now();
  while (seconds_since(start) < seconds) {
    for (int n = 0; n < 20; ++n) simulation.step();
  }
  double const elapsed = seconds_since(start);
  steps = simulation.steps() - first;
  rebuilds = simulation.rebuilds() - first_rebuilds;
  return static_cast<double>(steps) * simulation.discs() / elapsed;
}

}  // namespace

int main(int argc, char** argv) {
  Options const options = read_options(argc, argv);
  ::setenv("OMP_PROC_BIND", "false", 0);
  Kokkos::ScopeGuard const guard(argc, argv);
  Scene scene;
  scene.sample.particles = 2000;
  scene.sample.void_ratio = 0.23;
  scene.bond.stress = 1e6;
  scene.hydrate.saturation = options.bonded ? 0.55 : 0;
  Specimen specimen = make_specimen(scene, options.discs);
  SimulationLaws laws;
  laws.contact.grain = {scene.grains.kn, scene.grains.ks, scene.grains.friction, scene.grains.shape_factor, 0};
  laws.motion.damping = scene.run.damping;
  if (options.bonded) {
    StageRecord record;
    specimen = bond_specimen(scene, specimen, record);
    laws.contact.bond_kind = BondKind::parallel;
    laws.contact.bond = make_bond_law(scene, specimen.critical_thickness);
  }
  Simulation simulation(specimen, laws, options.skin * specimen.d50);
  prepare_servo(simulation, scene.bond.stress, 1e-4, specimen.d50, scene.run.dt_safety);
  // The walls have to find the cut packing before its neighbour searches are those of a test.
  for (int n = 0; n < 3000; ++n) simulation.step();
  RateNumbers const rate = rate_numbers(scene, specimen.d50, simulation.walls().height(), simulation.void_ratio());
  simulation.loading.y = AxisDrive::at_rate(rate.strain_rate);
  simulation.add_uniform_strain_rate(-0.25 * rate.strain_rate, rate.strain_rate);
  std::printf(
      "case,discs,threads,lanes,particle_steps_per_s,ns_per_particle_step,steps,rebuilds,bytes_per_disc,entries_per_disc\n");
  std::vector<double> rates;
  for (int n = 0; n < options.repeat; ++n) {
    std::int64_t rebuilds = 0, steps = 0;
    rates.push_back(timed(simulation, options.seconds, rebuilds, steps));
    std::printf("%s,%d,%d,%d,%.4g,%.2f,%lld,%lld,%.0f,%.2f\n", options.bonded ? "bonded" : "rolling", simulation.discs(),
                ExecutionSpace::concurrency(), lane_count, rates.back(), 1e9 / rates.back(), static_cast<long long>(steps),
                static_cast<long long>(rebuilds), static_cast<double>(simulation.bytes()) / simulation.discs(),
                static_cast<double>(simulation.contact_entries()) / simulation.discs());
  }
  std::sort(rates.begin(), rates.end());
  std::printf("median %.4g particle-steps/s\n", rates[rates.size() / 2]);
  return 0;
}
