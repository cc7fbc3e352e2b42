#include "throughput/throughput.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "domain/biaxial/quasi_static.hpp"
#include "domain/generation/bonding.hpp"
#include "domain/generation/equilibration.hpp"
#include "domain/generation/periodic_cell.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/parallel/redistribution.hpp"
#include "domain/scene/hydrate.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/scene_laws.hpp"
#include "domain/scene/specimen.hpp"
#include "domain/scene/specimen_design.hpp"
#include "domain/scene/stage.hpp"
#include "domain/simulation/simulation.hpp"

namespace clathra {

namespace {

constexpr std::int64_t cell_discs = 2000;

/// The specimen under 1 MPa, with its scene's grains.
Specimen make_specimen(Scene const& scene, std::int64_t discs, Ranks const& ranks) {
  PackedSpecimen const cell = pack_periodic_cell(scene, design_sample(scene), cell_discs, {});
  double const area = static_cast<double>(discs) / cell_discs * cell.specimen.width() * cell.specimen.height();
  double const width = std::sqrt(area / 2);
  return replicate(cell.specimen, width, 2 * width, ranks);
}

std::int64_t total(Simulation const& simulation, std::size_t of_this_rank) {
  return simulation.assembly().ranks().sum(static_cast<std::int64_t>(of_this_rank));
}

/// Bytes that one step touches at the least, a disc: the contact pass reads discs and rows and writes forces and history, the
/// drift reads and writes the discs.
double moved_bytes(Simulation const& simulation) {
  double const entries =
      static_cast<double>(total(simulation, simulation.assembly().contact_entries())) / simulation.assembly().discs();
  ContactRows rows = simulation.assembly().rows;
  bool const mixed = rows.features.format.precision == Precision::mixed;
  double read = rows.features.bonds ? 1 : 0, written = 0;  // histories, and the width of bonds
  for_each_history(rows, [&](HistoryField const&, auto const& field) {
    bool const kept = &field == &rows.formation_overlap || &field == &rows.reference_branch;
    bool const slips = &field == &rows.shear || &field == &rows.moment;  // in mixed precision nothing else changes
    read += 1;
    written += !kept && (slips || !mixed) ? 1 : 0;
  });
  double const row = sizeof(int) + (mixed ? sizeof(float) : sizeof(double)) * (read + written);
  constexpr double contact_pass = 6 + 3, copies = for_gpu ? 1 + 6 : 0, drift = 11 + 6 + copies;  // numbers of a disc
  constexpr double table = sizeof(float) * DiscMirror::row, places = 2 * 2 * sizeof(double), forces = 3 * sizeof(float),
                   inertia = sizeof(float);
  return entries * row + (mixed ? (1 + 4) * table + places + inertia + 2 * forces : sizeof(double) * (contact_pass + drift));
}

/// Double precision operations of the laws, counted in their machine code: a pair in touch or bonded, once from either side, and
/// the drift of a disc.
constexpr double flops_of_contact = 58, flops_of_bonded_pair = 113, flops_of_drift = 33;

double flops_per_step(Simulation const& simulation, Measures const& m) {
  double const pairs = flops_of_bonded_pair * m.bonded + flops_of_contact * (m.interacting - m.bonded);
  return 2 * pairs + flops_of_drift * simulation.assembly().discs();
}

// Numbers that one call updates: on a GPU those of its neighbours stand beside them.
constexpr int block = for_gpu ? lane_count : 64 * lane_count;

struct UpdateBlock {
  Field<Real> values;
  KOKKOS_FUNCTION void operator()(int i) const {
    for (int k = 0; k < block; k += lane_count) {
      Real* const at = &values(static_cast<std::size_t>(i) * block + static_cast<std::size_t>(k));
      store(at, load(at) + Lanes(1));
    }
  }
};

constexpr int chains = 12;              // independent ones: more than the latency of a product or a sum
constexpr int links = 20000;            // of a chain
constexpr int strands_of_a_thread = 4;  // for an even load

/// Chains of products and sums that nothing but the arithmetic units holds up.
struct Arithmetic {
  Field<Real> result;
  KOKKOS_FUNCTION void operator()(int strand) const {
    Lanes values[chains];
    for (int c = 0; c < chains; ++c) values[c] = Lanes(1 + 0.001 * c);
    for (int n = 0; n < links; ++n) {
      for (int c = 0; c < chains; ++c) values[c] = values[c] * Lanes(0.999) + Lanes(0.001);
    }
    Lanes sum(0);
    for (int c = 0; c < chains; ++c) sum += values[c];
    result(static_cast<std::size_t>(strand)) = lane(sum, 0);
  }
};

/// Steps in which the walls find a cut packing, fast enough that it keeps its stress, before searches are those of a test; but no
/// faster than those of a million discs, a tenth of a grain in a step: those of twenty millions would pass through grains.
void let_walls_find_packing(Simulation& simulation, Scene const& scene, double d50, int steps) {
  constexpr double rate_of_large = 1e-2, large = 1e6;
  double const rate = rate_of_large / std::sqrt(std::max(1.0, simulation.assembly().discs() / large));
  prepare_servo(simulation, scene.specimen.preparation_stress, rate, d50, scene.run.step_choice());
  simulation.step(steps);
}

}  // namespace

Simulation throughput_simulation(ThroughputSetup const& setup, Ranks const& ranks) {
  bool const bonded = setup.what != ThroughputCase::rolling, breaking = setup.what == ThroughputCase::breaking;
  Scene scene;
  scene.specimen.particles = cell_discs;
  scene.specimen.void_ratio = 0.23;
  scene.specimen.preparation_stress = 1e6;
  scene.hydrate.saturation = bonded ? 0.55 : 0;
  Specimen specimen = make_specimen(scene, setup.discs, ranks);
  SimulationLaws laws;
  laws.precision = setup.precision;
  laws.contact.grain = grain_law(scene);
  laws.motion.damping = scene.damping.local;
  if (bonded) {
    StageRecord record;
    specimen = by_place(ranks, std::move(specimen));
    bond_specimen(scene, specimen, record, ranks);
    laws.contact.bond_kind = BondKind::parallel;
    laws.contact.bond = make_bond_law(scene, specimen.d50, specimen.critical_thickness);
  }
  Simulation simulation(specimen, laws, setup.skin * specimen.d50, ranks);
  let_walls_find_packing(simulation, scene, specimen.d50, setup.relaxation_steps);
  scene.test.inertial_number = breaking ? 1e-3 : 1e-4;
  prepare_servo(simulation, scene.specimen.preparation_stress, scene.test.inertial_number, specimen.d50, scene.run.step_choice());
  RateNumbers const rate =
      rate_numbers(scene, specimen.d50, simulation.assembly().walls().height(), simulation.assembly().void_ratio());
  simulation.drive(simulation.loading().x, AxisDrive::at_rate(rate.strain_rate), -0.25 * rate.strain_rate, rate.strain_rate);
  if (breaking) {
    // Faster to where bonds break, but platens no faster than those of a small specimen, or large ones burst; then a while for
    // the waves of that to die.
    constexpr double strain = 0.05, rate_factor_of_small = 10, calming_of_small = 500, small = 20000;
    double const length = std::sqrt(std::max(1.0, simulation.assembly().discs() / small)),
                 rate_factor = std::max(1.0, rate_factor_of_small / length);
    simulation.loading().y = AxisDrive::at_rate(rate_factor * rate.strain_rate);
    auto const steps = static_cast<int>(strain / (rate_factor * rate.strain_rate * simulation.time_step));
    simulation.step(steps);
    simulation.loading().y = AxisDrive::at_rate(rate.strain_rate);
    simulation.step(static_cast<std::int64_t>(std::ceil(calming_of_small * length)));
  }
  return simulation;
}

Throughput measure_throughput(Simulation& simulation, double seconds) {
  Throughput result;
  std::int64_t const first = simulation.assembly().steps(), first_rebuilds = simulation.assembly().upkeep.searches();
  int const broken = simulation.assembly().broken_bonds();
  double const rebuilding = simulation.assembly().upkeep.seconds();
  Kokkos::Timer const clock;
  while (simulation.assembly().ranks().max(clock.seconds()) < seconds) simulation.step(20);
  Kokkos::fence();
  result.seconds = clock.seconds();
  result.steps = simulation.assembly().steps() - first;
  result.rebuilds = simulation.assembly().upkeep.searches() - first_rebuilds;
  double const steps_per_s = static_cast<double>(result.steps) / result.seconds;
  result.disc_steps_per_second = steps_per_s * simulation.assembly().discs();
  Measures const m = simulation.assembly().measures();
  result.contact_steps_per_s = steps_per_s * m.interacting;
  result.flops_per_s = steps_per_s * flops_per_step(simulation, m);
  result.broken = simulation.assembly().broken_bonds() - broken;
  result.bytes_per_disc = static_cast<double>(total(simulation, simulation.bytes())) / simulation.assembly().discs();
  result.search_bytes_per_disc =
      static_cast<double>(total(simulation, simulation.assembly().search_bytes())) / simulation.assembly().discs();
  result.moved_per_step = moved_bytes(simulation);
  result.rebuild_share = (simulation.assembly().upkeep.seconds() - rebuilding) / result.seconds;
  return result;
}

double update_bandwidth(std::size_t bytes) {
  auto const blocks =
      static_cast<int>(std::clamp<std::size_t>(bytes / (block * sizeof(Real)), 1, std::numeric_limits<int>::max()));
  Field<Real> const values("bandwidth", static_cast<std::size_t>(blocks) * block);
  double const moved = 2.0 * blocks * block * sizeof(Real);
  int const passes = static_cast<int>(std::max(1.0, 2e8 / moved));  // long enough for the clock
  double best = 0;
  for (int n = 0; n < 5; ++n) {
    Kokkos::Timer const clock;
    for (int pass = 0; pass < passes; ++pass) {
      Kokkos::parallel_for("update_bandwidth", Kokkos::RangePolicy<ExecutionSpace>(0, blocks), UpdateBlock{values});
    }
    Kokkos::fence();
    best = std::max(best, passes * moved / clock.seconds());
  }
  return best;
}

double arithmetic_rate() {
  int const strands = strands_of_a_thread * ExecutionSpace().concurrency();
  Field<Real> const result("arithmetic", static_cast<std::size_t>(strands));
  double const operations = 2.0 * links * chains * lane_count * strands;
  double best = 0;
  for (int n = 0; n < 5; ++n) {
    Kokkos::Timer const clock;
    Kokkos::parallel_for("arithmetic", Kokkos::RangePolicy<ExecutionSpace>(0, strands), Arithmetic{result});
    Kokkos::fence();
    best = std::max(best, operations / clock.seconds());
  }
  return best;
}

}  // namespace clathra
