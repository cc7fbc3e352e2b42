#include "domain/generation/equilibration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "domain/scene/scene_laws.hpp"

namespace clathra {

namespace {

/// Of the servo's integral time and the transit time of a compression wave. Records of a specimen of 20,000 discs with 55 %
/// hydrate at the usual rate to 6 % strain whose sigma_3 is right to 1 %: 99.3 % with this and the gain of ServoLaw, 96.9 % with
/// twice this, 73.8 % with a quarter of the transit and half the gain. A fifth of it holds a specimen of 2,000 discs still.
constexpr double integral_share_of_transit = 0.05;

std::string percent_text(double value, int digits) {
  std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + 1 + static_cast<std::size_t>(digits));
}

/// The strains that take a part of that out which the stresses inside lack: of their mean by the bulk modulus, of their
/// difference by the shear modulus of a dense packing.
Strains strains_towards(Simulation const& simulation, WallStress const& inside, double stress) {
  constexpr double part = 0.05, twice_bulk = 1.0, twice_shear = 0.25;  // moduli over k_n
  auto const lacking = [&](double present) {
    return part * (stress - present) / simulation.assembly().laws.contact.grain.normal_stiffness;
  };
  double const x = lacking(inside.x), y = lacking(inside.y);
  double const mean = 0.5 * (x + y) / twice_bulk, difference = simulation.assembly().periodic() ? 0 : 0.5 * (x - y) / twice_shear;
  return {mean + difference, mean - difference};
}

/// @param advance  makes so many steps
template <class Advance>
bool step_to_rest(Simulation& simulation, double stress, RestCriterion const& rest, std::int64_t most_steps,
                  ProgressCallback const& progress, char const* stage, Advance const& advance) {
  std::int64_t const first = simulation.assembly().steps();
  RestWatch watch{first};
  while (simulation.assembly().steps() - first < most_steps && !watch.rests) {
    advance(std::min(watch.steps_to_look(simulation), first + most_steps - simulation.assembly().steps()));
    watch.look(simulation, simulation.assembly().measures(), stress, rest);
    report(progress, {stage, static_cast<double>(simulation.assembly().steps() - first) / static_cast<double>(most_steps),
                      RestWatch::text(simulation), simulation.assembly().steps() * simulation.assembly().discs()});
  }
  return watch.rests;
}

}  // namespace

std::int64_t RestWatch::steps_to_look(Simulation const& simulation) const {
  constexpr std::int64_t steps_between_looks = 200;
  return steps_between_looks - (simulation.assembly().steps() - first_step) % steps_between_looks;
}

void RestWatch::look(Simulation const& simulation, Measures const& m, double stress, RestCriterion const& rest) {
  looks_at_rest = unrest(simulation, m, stress, {rest.unbalanced}).empty() ? looks_at_rest + 1 : 0;
  rests = looks_at_rest >= 3 && unrest(simulation, m, stress, rest).empty();
}

std::string RestWatch::text(Simulation const& simulation) {
  return "stress " + percent_text(mean_stress(simulation) / 1e3, 1) + " kPa, e " +
         percent_text(simulation.assembly().void_ratio(), 4);
}

WallStress stress_inside(Simulation const& simulation) {
  Measures const m = simulation.assembly().measures();
  return {m.stress_area_xx / simulation.assembly().area(), m.stress_area_yy / simulation.assembly().area()};
}

void close_together(Simulation& simulation, Strains const& strains, WallStress const& stress_at_walls) {
  simulation.strain(strains.x, strains.y);
  if (simulation.assembly().periodic()) return;
  Loading& loading = simulation.loading();
  // In a small specimen the walls must not undo what the strains do; in a large one nothing else makes up for a difference
  // between the stress at them and inside, which a wave needs long_way steps and more to even out.
  constexpr double long_way = 1500, integral_steps = 2000;
  Walls const& walls = simulation.assembly().walls();
  bool const large = std::max(walls.width(), walls.height()) > long_way * wave_speed(simulation) * simulation.time_step;
  loading.servo.gain = large ? 0.8 : 0.2;
  loading.servo.integral_time = large ? integral_steps * simulation.time_step : HUGE_VAL;
  if (!large) loading.x.integral = loading.y.integral = 0;
  loading.x.target_stress = stress_at_walls.x;
  loading.y.target_stress = stress_at_walls.y;
}

SimulationLaws closing_laws(Scene const& scene, GenerationFriction const& friction, Grading const& grading) {
  SimulationLaws laws = generation_laws(scene, friction);
  laws.scaling = {4, 0.5 * grading.d50()};
  laws.motion.in_frame = false;
  if (mixed_precision_resolves(scene.grains.normal_stiffness, scene.specimen.preparation_stress))
    laws.precision = Precision::mixed;
  return laws;
}

double strain_rate_of(double inertial_number, double stress, double density, double d50) {
  return inertial_number * std::sqrt(stress / density) / d50;
}

double mean_stress(Simulation const& simulation) {
  WallStress const stress = simulation.assembly().periodic() ? stress_inside(simulation) : simulation.assembly().stress();
  return 0.5 * (stress.x + stress.y);
}

double wave_speed(Simulation const& simulation) {
  double const bulk_density = simulation.assembly().facts.moving_density() / (1 + simulation.assembly().void_ratio());
  return std::sqrt(packing_modulus(simulation.assembly().laws.contact.grain) / bulk_density);
}

double wave_transit(Simulation const& simulation) {
  Walls const& walls = simulation.assembly().walls();
  return std::max(walls.width(), walls.height()) / wave_speed(simulation);
}

std::string unrest(Simulation const& simulation, Measures const& m, WallStress const& stress, RestCriterion const& rest) {
  constexpr double tolerance = 0.005;
  std::string text;
  auto const say = [&](char const* format, auto... numbers) {
    char words[200];
    std::snprintf(words, sizeof words, format, numbers...);
    text += (text.empty() ? "" : ", ") + std::string(words);
  };
  auto const require = [&](char const* what, double value, double wanted) {
    if (std::isnan(wanted) || std::abs(value / wanted - 1) < tolerance) return;
    say("%s %.4g of %.4g MPa (at rest within %g %%)", what, value * 1e-6, wanted * 1e-6, 100 * tolerance);
  };
  double const area = simulation.assembly().area();
  if (simulation.assembly().periodic()) {
    require("mean stress of the contacts", 0.5 * (m.stress_area_xx + m.stress_area_yy) / area, stress.x);
  } else {
    WallStress const walls = simulation.assembly().stress();
    require("lateral stress on the walls", walls.x, stress.x);
    require("vertical stress on the walls", walls.y, stress.y);
    if (double const deviator = walls.y - walls.x; std::abs(deviator) > rest.deviator * stress.x)
      say("vertical stress %.2g %% %s than the lateral one (at rest within %g %%)", 100 * std::abs(deviator) / stress.x,
          deviator > 0 ? "higher" : "lower", 100 * rest.deviator);
    require("lateral stress of the contacts less the shear of the walls", (m.stress_area_xx - m.wall_shear_xx) / area, stress.x);
    require("vertical stress of the contacts less the shear of the walls", (m.stress_area_yy - m.wall_shear_yy) / area, stress.y);
  }
  double const unbalanced = m.unbalanced_ratio(simulation.assembly().discs());
  if (!(unbalanced < rest.unbalanced)) say("unbalanced ratio %.2g (at rest below %g)", unbalanced, rest.unbalanced);
  return text;
}

GenerationFriction generation_friction(double void_ratio) {
  GenerationFriction friction;
  friction.shape_factor = void_ratio > 0.28 ? 2 : 1;
  return friction;
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
  laws.motion.in_frame = false;
  double const share = std::min(1.0, stiffness * stress / laws.contact.grain.normal_stiffness);
  for (auto* spring : {&laws.contact.grain.normal_stiffness, &laws.contact.grain.shear_stiffness, &laws.wall.normal_stiffness,
                       &laws.wall.shear_stiffness})
    *spring *= share;
  laws.precision = Precision::mixed;
  return laws;
}

void prepare_servo(Simulation& simulation, double stress, double inertial_number, double d50, StepChoice const& step) {
  simulation.choose_time_step(step);
  if (simulation.assembly().periodic()) return;
  Walls const& walls = simulation.assembly().walls();
  double const rate = strain_rate_of(inertial_number, stress, simulation.assembly().facts.moving_density(), d50);
  simulation.loading().servo.contact_stiffness = simulation.assembly().laws.wall.normal_stiffness;
  simulation.loading().servo.integral_time =
      integral_share_of_transit * std::max(walls.width(), walls.height()) / wave_speed(simulation);
  simulation.loading().x = AxisDrive::at_stress(stress, 0.5 * rate * walls.width());
  simulation.loading().y = AxisDrive::at_stress(stress, 0.5 * rate * walls.height());
}

bool hold_stress(Simulation& simulation, double stress, RestCriterion const& rest, std::int64_t most_steps,
                 ProgressCallback const& progress, char const* stage) {
  return step_to_rest(simulation, stress, rest, most_steps, progress, stage, [&](std::int64_t steps) { simulation.step(steps); });
}

bool settle(Simulation& simulation, double stress, RestCriterion const& rest, std::int64_t most_steps,
            ProgressCallback const& progress) {
  return step_to_rest(simulation, stress, rest, most_steps, progress, "generate", [&](std::int64_t steps) {
    for (; steps > 0; steps -= steering) {
      WallStress const inside = stress_inside(simulation);
      close_together(simulation, strains_towards(simulation, inside, stress), inside);
      simulation.step(std::min(steps, steering));
    }
  });
}

std::string text_of_unrest(Simulation const& simulation, double stress) {
  return "the specimen did not come to rest within " + std::to_string(most_steps_to_rest) +
         " steps: " + unrest(simulation, simulation.assembly().measures(), stress, rest_of_specimens);
}

PackedSpecimen packed_at_rest(Simulation const& resting, double stress, GenerationFriction friction, double lowest_share) {
  friction.share = lowest_share;
  GrainLaw const law = friction.apply({});
  Measures const m = resting.assembly().measures();
  PackedSpecimen packed;
  packed.specimen = resting.specimen();
  packed.specimen.stress = stress;
  packed.friction = law.friction;
  packed.shape_factor = law.shape_factor;
  packed.unbalanced = m.unbalanced_ratio(resting.assembly().discs());
  packed.deep_overlap_share = m.touching > 0 ? m.deep / m.touching : 0;
  if (resting.assembly().periodic()) return packed;
  packed.stress_x = resting.assembly().stress().x;
  packed.stress_y = resting.assembly().stress().y;
  return packed;
}

}  // namespace clathra
