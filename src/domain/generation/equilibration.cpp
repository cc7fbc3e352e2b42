#include "domain/generation/equilibration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "domain/scene/scene_laws.hpp"

namespace clathra {

namespace {

constexpr int chunk = 200;  // steps between checks of the assembly

/// Of the servo's integral time and the transit time of a compression wave. Records of a specimen of 20,000 discs with 55 %
/// hydrate at the usual rate to 6 % strain whose sigma_3 is right to 1 %: 99.3 % with this and the gain of ServoLaw, 96.9 % with
/// twice this, 73.8 % with a quarter of the transit and half the gain. A fifth of it holds a specimen of 2,000 discs still.
constexpr double integral_share_of_transit = 0.05;

std::string percent_text(double value, int digits) {
  std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + 1 + static_cast<std::size_t>(digits));
}

/// Steers the isotropic stretching of a periodic cell for the next chunk of steps.
void steer_cell(Simulation& simulation, double stress, double largest_rate) {
  double const modulus = packing_modulus(simulation.laws().contact.grain);  // a tenth of the error is taken out in a chunk
  double const rate = 0.1 * (stress - mean_stress(simulation)) / (modulus * chunk * simulation.time_step);
  simulation.stretch_cell(std::clamp(rate, -largest_rate, largest_rate));
}

/// Rates that take a part of what the stresses lack out in a chunk: of their mean by the bulk modulus, of their difference by the
/// shear modulus of a dense packing.
BoxRates rates_towards(Simulation const& simulation, Measures const& m, double stress) {
  constexpr double part = 0.4, twice_bulk = 1.0, twice_shear = 0.25;  // moduli over k_n
  double const per_strain = part / (simulation.laws().contact.grain.normal_stiffness * chunk * simulation.time_step),
               largest = 0.02 / (1000 * simulation.time_step);
  double const lacking_x = stress - m.stress_area_xx / simulation.area(),
               lacking_y = stress - m.stress_area_yy / simulation.area();
  double const mean = 0.5 * (lacking_x + lacking_y) / twice_bulk, difference = 0.5 * (lacking_x - lacking_y) / twice_shear;
  auto const rate = [&](double lacking) { return std::clamp(per_strain * lacking, -largest, largest); };
  return {rate(mean + difference), rate(mean - difference)};
}

/// Closes the assembly to the target's void ratio, ever slower towards it, so that it arrives at rest: the force network of a
/// flowing assembly would collapse once it stops. The friction is the servo of the stress here: too much stress, less friction.
/// @return the lowest share of the friction that was needed
double compress_until_void_ratio(Simulation& simulation, Scene const& scene, GenerationFriction& friction,
                                 CompressionTarget const& target, ProgressCallback const& progress) {
  constexpr int interval = 10;             // steps between checks of the stress
  constexpr double loose_margin = 0.1;     // in void ratio: further above, far from touching all over, it may close much faster
  constexpr double slowing_range = 0.004;  // in void ratio
  double const full_rate = strain_rate_of(target.inertial_number, target.stress, simulation.moving_density(), target.d50);
  double lowest = 1;
  BoxRates present;
  while (simulation.void_ratio() > target.void_ratio + 1e-5) {
    double const above = simulation.void_ratio() - target.void_ratio;
    double const rate_factor = 1 + 30 * std::clamp((above - loose_margin) / 0.2, 0.0, 1.0);
    double const slowed = full_rate * rate_factor * std::clamp(above / slowing_range, 0.1, 1.0);
    stretch(simulation, {slowed, slowed}, present);
    simulation.step(interval);
    double const excess = std::clamp(mean_stress(simulation) / target.stress - 1, -1.0, 1.0);
    friction.share = std::clamp(friction.share * (1 - 0.02 * excess), 1e-4, 1.0);
    lowest = std::min(lowest, friction.share);
    simulation.set_laws(closing_laws(scene, friction));
    if (friction.share < 1e-3 && mean_stress(simulation) > 4 * target.stress) {
      throw Refused("without friction these grains resist densification beyond a void ratio of " +
                    std::to_string(simulation.void_ratio()) + " at " + std::to_string(target.stress / 1e3) + " kPa; " +
                    std::to_string(target.void_ratio) + " is denser");
    }
    if (simulation.steps() % 1000 == 0) {
      report(progress, {"generate", 0.7,
                        "void ratio " + percent_text(simulation.void_ratio(), 4) + " -> " + percent_text(target.void_ratio, 4),
                        simulation.steps() * simulation.discs()});
    }
  }
  stretch(simulation, {}, present);
  return lowest;
}

/// An assembly at the target's void ratio, not yet at rest.
struct Closed {
  Specimen specimen;
  double share;        ///< of the friction, the lowest that was needed
  std::int64_t steps;  ///< until then
};

Closed close_to_void_ratio(Specimen const& loose, Scene const& scene, GenerationFriction friction,
                           CompressionTarget const& target, double skin, ProgressCallback const& progress, Ranks const& ranks) {
  Simulation simulation(loose, closing_laws(scene, friction), skin, ranks);
  prepare_servo(simulation, target.stress, target.inertial_number, target.d50, StepChoice{});
  double const share = compress_until_void_ratio(simulation, scene, friction, target, progress);
  return {simulation.specimen(), share, simulation.steps()};
}

/// Steps in chunks, steered before each by the measures, until there is no unrest() in three checks on end.
template <class Steer>
bool step_to_rest(Simulation& simulation, double stress, double rest, std::int64_t most_steps, ProgressCallback const& progress,
                  char const* stage, Steer const& steer) {
  std::int64_t const first = simulation.steps();
  int checks_at_rest = 0;
  Measures m = simulation.measures();
  while (simulation.steps() - first < most_steps && checks_at_rest < 3) {
    steer(m);
    simulation.step(std::min<std::int64_t>(chunk, first + most_steps - simulation.steps()));
    m = simulation.measures();
    checks_at_rest = unrest(simulation, m, stress, rest).empty() ? checks_at_rest + 1 : 0;
    report(progress,
           {stage, static_cast<double>(simulation.steps() - first) / static_cast<double>(most_steps),
            "stress " + percent_text(mean_stress(simulation) / 1e3, 1) + " kPa, e " + percent_text(simulation.void_ratio(), 4),
            simulation.steps() * simulation.discs()});
  }
  return checks_at_rest >= 3;
}

}  // namespace

void stretch(Simulation& simulation, BoxRates const& wanted, BoxRates& present) {
  if (simulation.periodic())
    simulation.stretch_cell(0.5 * (wanted.x + wanted.y));
  else
    simulation.drive(AxisDrive::at_rate(wanted.x), AxisDrive::at_rate(wanted.y), wanted.x - present.x, wanted.y - present.y);
  present = wanted;
}

SimulationLaws closing_laws(Scene const& scene, GenerationFriction const& friction) {
  SimulationLaws laws = generation_laws(scene, friction);
  laws.scaling.inertia = RunScene::usual_inertia_scaling;
  if (mixed_precision_resolves(scene.grains.kn, scene.bond.stress)) laws.precision = Precision::mixed;
  return laws;
}

double strain_rate_of(double inertial_number, double stress, double density, double d50) {
  return inertial_number * std::sqrt(stress / density) / d50;
}

double contact_stress(Simulation const& simulation) {
  Measures const m = simulation.measures();
  return 0.5 * (m.stress_area_xx + m.stress_area_yy) / simulation.area();
}

double mean_stress(Simulation const& simulation) {
  if (simulation.periodic()) return contact_stress(simulation);
  WallStress const stress = simulation.stress();
  return 0.5 * (stress.x + stress.y);
}

double wave_speed(Simulation const& simulation) {
  double const bulk_density = simulation.moving_density() / (1 + simulation.void_ratio());
  return std::sqrt(packing_modulus(simulation.laws().contact.grain) / bulk_density);
}

std::string unrest(Simulation const& simulation, Measures const& m, double stress, double rest) {
  constexpr double tolerance = 0.005;
  std::string text;
  auto const say = [&](char const* format, auto... numbers) {
    char words[200];
    std::snprintf(words, sizeof words, format, numbers...);
    text += (text.empty() ? "" : ", ") + std::string(words);
  };
  auto const require = [&](char const* what, double value) {
    if (std::abs(value / stress - 1) < tolerance) return;
    say("%s %.4g of %.4g MPa (at rest within %g %%)", what, value * 1e-6, stress * 1e-6, 100 * tolerance);
  };
  double const area = simulation.area();
  if (simulation.periodic()) {
    require("mean stress of the contacts", 0.5 * (m.stress_area_xx + m.stress_area_yy) / area);
  } else {
    require("lateral stress on the walls", simulation.stress().x);
    require("vertical stress on the walls", simulation.stress().y);
    require("lateral stress of the contacts less the shear of the walls", (m.stress_area_xx - m.wall_shear_xx) / area);
    require("vertical stress of the contacts less the shear of the walls", (m.stress_area_yy - m.wall_shear_yy) / area);
  }
  double const unbalanced = m.unbalanced_ratio(simulation.discs());
  if (!(unbalanced < rest)) say("unbalanced ratio %.2g (at rest below %g)", unbalanced, rest);
  return text;
}

SimulationLaws generation_laws(Scene const& scene, GenerationFriction const& friction) {
  SimulationLaws laws;
  laws.contact.grain = friction.apply(grain_law(scene));
  laws.contact.grain.damping_ratio = 0;
  laws.wall = wall_law(scene, 0);
  laws.motion.damping = 0.7;
  return laws;
}

SimulationLaws flowing_laws(SimulationLaws laws, double stress, Grading const& grading) {
  constexpr double stiffness = 240;  // k_n over the stress
  laws.scaling = {4, 0.5 * grading.diameter_finer(0.3)};
  double const share = std::min(1.0, stiffness * stress / laws.contact.grain.normal_stiffness);
  for (auto* spring : {&laws.contact.grain.normal_stiffness, &laws.contact.grain.shear_stiffness, &laws.wall.normal_stiffness,
                       &laws.wall.shear_stiffness})
    *spring *= share;
  laws.precision = Precision::mixed;
  return laws;
}

void prepare_servo(Simulation& simulation, double stress, double inertial_number, double d50, StepChoice const& step) {
  simulation.choose_time_step(step);
  if (simulation.periodic()) return;
  Walls const& walls = simulation.walls();
  double const rate = strain_rate_of(inertial_number, stress, simulation.moving_density(), d50);
  simulation.loading().servo.contact_stiffness = simulation.laws().wall.normal_stiffness;
  simulation.loading().servo.integral_time =
      integral_share_of_transit * std::max(walls.width(), walls.height()) / wave_speed(simulation);
  simulation.loading().x = AxisDrive::at_stress(stress, 0.5 * rate * walls.width());
  simulation.loading().y = AxisDrive::at_stress(stress, 0.5 * rate * walls.height());
}

bool hold_stress(Simulation& simulation, double stress, double rest, std::int64_t most_steps, ProgressCallback const& progress,
                 char const* stage) {
  double const largest_rate = 0.02 / (1000 * simulation.time_step);
  bool const rests = step_to_rest(simulation, stress, rest, most_steps, progress, stage, [&](Measures const&) {
    if (simulation.periodic()) steer_cell(simulation, stress, largest_rate);
  });
  simulation.stretch_cell(0);
  return rests;
}

bool settle(Simulation& simulation, double stress, double rest, std::int64_t most_steps, ProgressCallback const& progress) {
  BoxRates present;
  bool const rests = step_to_rest(simulation, stress, rest, most_steps, progress, "generate",
                                  [&](Measures const& m) { stretch(simulation, rates_towards(simulation, m, stress), present); });
  stretch(simulation, {}, present);
  return rests;
}

std::string text_of_unrest(Simulation const& simulation, double stress) {
  return "the specimen did not come to rest within " + std::to_string(most_steps_to_rest) +
         " steps: " + unrest(simulation, simulation.measures(), stress, rest_of_specimens);
}

PackedSpecimen packed_at_rest(Simulation const& resting, double stress, GenerationFriction friction, double lowest_share) {
  friction.share = lowest_share;
  GrainLaw const law = friction.apply({});
  Measures const m = resting.measures();
  PackedSpecimen packed;
  packed.specimen = resting.specimen();
  packed.specimen.stress = stress;
  packed.friction = law.friction;
  packed.shape_factor = law.shape_factor;
  packed.unbalanced = m.unbalanced_ratio(resting.discs());
  packed.deep_overlap_share = m.touching > 0 ? m.deep / m.touching : 0;
  if (resting.periodic()) return packed;
  packed.stress_x = resting.stress().x;
  packed.stress_y = resting.stress().y;
  return packed;
}

PackedSpecimen compress_to_void_ratio(Specimen const& loose, Scene const& scene, GenerationFriction friction,
                                      CompressionTarget const& target, double skin, ProgressCallback const& progress,
                                      Ranks const& ranks) {
  Closed const closed = close_to_void_ratio(loose, scene, friction, target, skin, progress, ranks);
  // With the full friction back the assembly creeps no further.
  Simulation resting(closed.specimen, generation_laws(scene, friction), skin, ranks);
  prepare_servo(resting, target.stress, target.inertial_number, target.d50, StepChoice{});
  ProgressCallback const counted = [&](Progress p) {
    p.disc_steps += closed.steps * resting.discs();
    return !progress || progress(p);
  };
  bool const rests = hold_stress(resting, target.stress, rest_of_specimens, most_steps_to_rest, counted, "generate");
  if (resting.void_ratio() < target.void_ratio - target.void_tolerance) {
    throw Refused("at " + std::to_string(target.stress / 1e3) + " kPa these grains pack to a void ratio of " +
                  std::to_string(resting.void_ratio()) + " with a friction of " + std::to_string(friction.friction) +
                  " and a shape factor of " + std::to_string(friction.shape_factor) + "; " + std::to_string(target.void_ratio) +
                  " is looser than they can hold");
  }
  if (resting.void_ratio() > target.void_ratio + target.void_tolerance) {
    throw Refused("at " + std::to_string(target.stress / 1e3) + " kPa these grains came to rest at a void ratio of " +
                  std::to_string(resting.void_ratio()) + "; " + std::to_string(target.void_ratio) + " is denser than they pack");
  }
  if (!rests) throw Refused(text_of_unrest(resting, target.stress));
  PackedSpecimen packed = packed_at_rest(resting, target.stress, friction, closed.share);
  packed.disc_steps = (closed.steps + resting.steps()) * resting.discs();
  return packed;
}

}  // namespace clathra
