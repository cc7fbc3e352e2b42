#include "domain/biaxial/scene_cost.hpp"

#include <algorithm>
#include <cmath>

#include "domain/biaxial/quasi_static.hpp"
#include "domain/scene/hydrate.hpp"
#include "domain/scene/sample_design.hpp"
#include "domain/scene/scene_laws.hpp"

namespace clathra {

namespace {

/// The time step that a specimen of this scene will get [s]: its smallest disc in six contacts, bonded if the scene has hydrate;
/// the factors of the limit and of scaled masses (docs/accuracy.md) are those of specimens of the paper's grading.
double estimated_time_step(Scene const& scene, Grading const& grading, bool bonded) {
  double const r = 0.5 * grading.smallest(), mass = pi * r * r * scene.grains.density;
  double const bond_share = bonded ? 0.5 : 0;  // Eq. 16: k_bn < k_n / 2
  double const ks = scene.grains.ks + bond_share * scene.grains.kn * 2 / 3;
  double const rolling = grain_law(scene).rolling_factor() * (1 + 2 * bond_share) * 1.5;
  double const turn = 6 * (ks + rolling) * r * r;
  RunScene const& run = scene.run;
  double const limit = run.time_step == TimeStepRule::spectrum ? 1.39 / std::sqrt(1 + run.damping) : 1,
               scaling = std::min(std::sqrt(run.inertia_scaling), bonded ? 1.37 : 1.3) * (1 + 0.3 * run.mass_scaling);
  return run.step_choice().safety * limit * scaling * std::sqrt(2 * 0.5 * mass * r * r / turn);
}

/// Disc-steps until a specimen is packed and at rest, to about 20 %: fitted to specimens of 300 to 20,000 discs at a void
/// ratio of 0.24. Larger ones take longer to come to rest. Of tiles one cell is packed, then all come to rest together.
double generation_disc_steps(Scene const& scene, double discs) {
  constexpr double at_rest = 3000, packed_in_cell = 145e3;  // a disc
  if (scene.sample.generator == Generator::file) return 0;
  if (scene.sample.generator == Generator::under_compaction) return 20e3 * discs * std::pow(discs, 0.146);
  return packed_in_cell * std::min(discs, static_cast<double>(scene.sample.tile_particles)) + at_rest * discs;
}

/// The largest resident memory of all ranks together [bytes], as measured with samples of 1,000,000 discs.
double memory_of_run(Scene const& scene, bool bonded, double discs, int ranks) {
  // Numbers of an entry: shear, moment, u_0, width and the two of a separate bond; with the index, and one number and two indices
  // more while neighbours are searched.
  int const numbers = 1 + (scene.grains.shape_factor > 0 || bonded ? 1 : 0) + (bonded ? 2 : 0) +
                      (bonded && scene.bond.composite == Composite::parallel ? 2 : 0);
  constexpr double entries = 5.2;                                               // a disc, empty places of slices included
  int const of_a_break = bonded && scene.output.takes_event_details() ? 7 : 0;  // a disc may break one bond or so
  int const extras = (scene.output.energy ? 5 : 0) + (scene.output.takes_snapshots() ? 2 : 0) +
                     (scene.test.wall_friction > 0 ? 4 : 0) + of_a_break;
  bool const mixed = scene.run.precision == Precision::mixed;
  double const of_number = mixed ? 4 : 8, of_disc = mixed ? 8 * (10 + extras) + 32 + 12 : 8 * (18 + extras);
  double const state = of_disc + 4 + entries * (4 + of_number * numbers + 8 + of_number);
  // Beside the state there is, in turns, the specimen that it was made from, a checkpoint and the last specimen; ranks also send
  // parts of these to each other.
  double const beside = ranks > 1 ? 1 : 0.85;
  constexpr double program = 25e6, program_with_messages = 35e6;
  return discs * state * (1 + beside) + (ranks > 1 ? ranks * program_with_messages : program);
}

}  // namespace

StageRecord predict(Scene const& scene, int ranks) {
  SampleDesign const design = design_sample(scene);
  bool const bonded = has_bonds(scene);
  RateNumbers const rate = rate_numbers(scene, design.grading.d50(), design.height, design.void_ratio);
  auto const discs = static_cast<double>(design.particles);
  StageRecord p;
  p["particles"] = discs;
  p["width_m"] = design.width;
  p["height_m"] = design.height;
  p["void_ratio"] = design.void_ratio;
  p["d50_m"] = design.grading.d50();
  p["time_step_s"] = estimated_time_step(scene, design.grading, bonded);
  p["strain_rate_per_s"] = rate.strain_rate;
  p["inertial_number"] = rate.inertial_number;
  p["wave_number"] = rate.wave_number;
  p["rate_share"] = rate.share;
  p["steps"] = std::ceil(scene.test.axial_strain / (rate.strain_rate * p["time_step_s"]));
  p["disc_steps"] = p["steps"] * discs;
  p["generation_disc_steps"] = generation_disc_steps(scene, discs);
  p["memory_bytes"] = memory_of_run(scene, bonded, discs, ranks);
  constexpr double checkpoint_bytes = 600;                                                 // a disc
  double const snapshot_bytes = scene.output.full_precision ? 120 : 35;                    // a disc, compressed
  double const event_bytes = !bonded ? 0 : scene.output.takes_event_details() ? 130 : 40;  // a disc
  p["disk_bytes"] = discs * 2 * 150 + scene.output.records * 400 + discs * event_bytes +
                    discs * snapshot_bytes * (scene.output.snapshots > 0 ? scene.output.snapshots + 1 : 0) +
                    discs * snapshot_bytes * static_cast<double>(scene.output.snapshots_at.size()) +
                    (scene.output.keep_checkpoint ? discs * checkpoint_bytes : 0);
  return p;
}

}  // namespace clathra
