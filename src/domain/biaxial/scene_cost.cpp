#include "domain/biaxial/scene_cost.hpp"

#include <algorithm>
#include <cmath>

#include "domain/biaxial/quasi_static.hpp"
#include "domain/scene/hydrate.hpp"
#include "domain/scene/scene_laws.hpp"
#include "domain/scene/specimen_design.hpp"

namespace clathra {

namespace {

/// The time step that a specimen of this scene will get [s], to about 5 %. Its square frequency is that of its smallest disc,
/// which shakes among its contacts and turns against them; the two weights are fitted to specimens of the paper's grading, at
/// moments of inertia times 1, 2 and 3, of sand and of every reading of the bonds.
double estimated_time_step(Scene const& scene, Grading const& grading, bool bonded) {
  double const r = 0.5 * grading.smallest(), mass = pi * r * r * scene.grains.density;
  RunScene const& run = scene.run;
  // A bond beside its contact adds to the stiffness: of two grains in series (Eq. 16), nearly.
  bool const beside = bonded && scene.bond.contact_coupling == ContactCoupling::parallel;
  double const stiffer = beside ? 1 + 0.46 * scene.bond.grain_stiffness_factor : 1;
  double const shaking = 6.2 * scene.grains.normal_stiffness,
               turning = 14.07 * (scene.grains.shear_stiffness + 1.5 * grain_law(scene).rolling_factor()) /
                         run.rotational_inertia_factor;
  double const frequency = std::sqrt(std::sqrt(std::hypot(shaking * shaking, turning * turning)) * stiffer / mass);
  double const damped = std::sqrt(1 + scene.damping.local),
               dashpots = 1.3 / std::sqrt(stiffer) * scene.damping.viscous_ratio * damped,  // of the limit with dashpots
      limit = run.time_step_rule == TimeStepRule::adaptive ? 2 / damped * (std::sqrt(1 + dashpots * dashpots) - dashpots) : 1.53;
  return run.step_choice().safety * limit * (1 + 0.3 * run.mass_scaled_fraction) / frequency;
}

/// Disc-steps until a specimen is packed and at rest, to about 10 %: fitted to specimens of 300 to 60,000 discs, without layers
/// to 200,000, at a void ratio of 0.24; to about 30 % where the curve is wide: fitted to five of them up to a ratio of 20. What
/// has to be closed is measured in d50, the steps that it takes in the discs that set the step.
double generation_disc_steps(Scene const& scene, Grading const& grading, double discs) {
  if (scene.specimen.is_read()) return 0;
  double const coarse = grading.d50() / grading.diameter_finer(0.3);
  double const closing = 8.25e3 * std::pow(coarse, 1.07), layers = 4.85e3 * std::pow(coarse, 1.07),
               specimens = scene.specimen.void_ratio_at == VoidRatioAt::test ? 2.3 : 1;  // two as a rule, each consolidated
  return specimens * discs * (scene.specimen.generator == Generator::compression ? closing : closing + layers);
}

/// The memory of generating a specimen [bytes a disc], whose steps go by turns in mixed and double precision beside the specimen
/// that they return to: measured with 30,000 to 120,000 discs on a rank, and 10,000,000 on two.
double generation_memory(Scene const& scene) {
  if (scene.specimen.is_read()) return 0;
  return scene.specimen.generator == Generator::compression ? 1130 : 1200;
}

/// The largest resident memory of all ranks together [bytes], as measured with samples of 1,000,000 discs.
double memory_of_run(Scene const& scene, bool bonded, double discs, int ranks) {
  // Numbers of an entry: shear, moment, u_0, width and the two of a separate bond; with the index, and one number and two indices
  // more while neighbours are searched.
  int const numbers = 1 + (scene.grains.rolling_width_factor > 0 || bonded ? 1 : 0) + (bonded ? 2 : 0) +
                      (bonded && scene.bond.contact_coupling == ContactCoupling::parallel ? 2 : 0);
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
  // What ranks copy to check a specimen that they read, measured with 10,000,000 bonded discs on two of them [bytes a disc].
  double const checked = ranks > 1 ? 460 : 0;
  constexpr double program = 25e6, program_with_messages = 35e6;
  return discs * std::max(state * (1 + beside) + checked, generation_memory(scene)) +
         (ranks > 1 ? ranks * program_with_messages : program);
}

/// Bonds that break until the end, a disc: at 55 % as they did in eight tests, a third more in two with less hydrate.
double breaks_of_run(Scene const& scene) {
  constexpr double first = 0.025, last = 0.15;  // axial strains
  double const strain = scene.test.axial_strain;
  if (strain < first) return 0.05;
  return 0.9 * (scene.hydrate.saturation < 0.5 ? 1.3 : 1) * std::pow(std::min(1.0, strain / last), 0.7);
}

/// Snapshots, the one at the start of the shear among them.
double snapshots_of(OutputScene const& output) {
  int const regular = output.snapshots;
  return (regular > 0 ? regular + 1 : 0) + static_cast<double>(output.snapshots_at.size());
}

/// What a run leaves in its folder [bytes], to 10 %: sizes of the compressed files of 18 tests of 300 to 2,000 discs, before them
/// of up to 80,000.
double disk_of_run(Scene const& scene, bool bonded, double discs, double steps) {
  OutputScene const& output = scene.output;
  double const rows = std::min<double>(output.records, steps) + 1, snapshots = snapshots_of(output),
               digits = scene.run.precision == Precision::mixed ? 1 : 1.3;  // of double precision, which compress less
  double bytes = 20e3 + rows * (388 + (output.energy ? 203 : 0));
  if (!scene.specimen.is_read()) bytes += 43.5e3 + discs * 75.4;
  bytes += digits * (bonded ? 48e3 + 79 * discs : 42e3 + 56.5 * discs);  // at the end
  if (output.keep_checkpoint) bytes += digits * (bonded ? 105e3 + 229 * discs : 78e3 + 165 * discs);
  if (bonded && output.events) bytes += discs * breaks_of_run(scene) * (output.event_details ? 193 : 65);
  if (snapshots == 0) return bytes + 30e3;
  double const of_disc =
                   (output.lossless_snapshots ? (bonded ? 120 : 73) : (bonded ? 36.5 : 26)) + (output.event_details ? 18 : 0),
               maps = 1 - std::exp(-discs / 2000), of_report = bonded ? 0.25e6 + 3.05e6 * maps : 0.17e6 + 1.5e6 * maps;
  return bytes + snapshots * (74e3 + discs * of_disc) + (scene.test.axial_strain < 0.025 ? 0.78 : 1) * of_report;
}

/// What the report takes at the end of a run, when its simulation has gone [bytes], to 10 %: 30 tests of 300 to 20,000 discs.
double memory_of_report(Scene const& scene, bool bonded, double discs, double steps) {
  double const rows = std::min<double>(scene.output.records, steps);
  double const maps =
      snapshots_of(scene.output) > 0 ? (bonded ? 14e6 : 10e6) * (1 - std::exp(-discs / 600)) + 650 * discs : 1.5e6;
  return 26.4e6 + 550 * rows + maps;
}

}  // namespace

StageRecord predict(Scene const& scene, int ranks) { return predict(scene, design_sample(scene), ranks); }

StageRecord predict(Scene const& scene, SpecimenDesign const& design, int ranks) {
  bool const bonded = has_bonds(scene);
  RateNumbers rate;  // of the fastest stage
  for (LoadingStage const& stage : stages_of(scene)) {
    RateNumbers const own = rate_numbers(scene, stage, design.grading.d50(), design.height, design.void_ratio);
    if (own.strain_rate > rate.strain_rate) rate = own;
  }
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
  p["platen_wave_stress"] = rate.platen_wave_stress;
  p["rate_share"] = rate.share;
  p["steps"] = planned_steps(scene, rate.strain_rate, p["time_step_s"]);
  p["particle_steps"] = p["steps"] * discs;
  p["generation_particle_steps"] = generation_disc_steps(scene, design.grading, discs);
  p["memory_bytes"] = std::max(memory_of_run(scene, bonded, discs, ranks), memory_of_report(scene, bonded, discs, p["steps"]));
  p["disk_bytes"] = disk_of_run(scene, bonded, discs, p["steps"]);
  return p;
}

}  // namespace clathra
