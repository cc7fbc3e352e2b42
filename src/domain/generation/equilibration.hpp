#pragma once
/// Bringing an assembly to rest under an isotropic stress, and the laws of its discs on the way there.
#include <cmath>

#include "domain/scene/grading.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/stage.hpp"
#include "domain/simulation/simulation.hpp"

namespace clathra {

/// Friction and shape factor used in generation: a single knob between the loosest (share 1) and the densest (share 0) packing.
/// Rolling resistance joins in only where friction alone packs too densely.
struct GenerationFriction {
  double friction = 0.5;
  double shape_factor = 0;
  double share = 1;
  GrainLaw apply(GrainLaw law) const {
    law.friction = friction * share;
    law.shape_factor = shape_factor > 0 ? shape_factor * std::max(share, 1e-6) : 0;
    return law;
  }
};

/// The friction to begin with. Friction alone packs to a void ratio of about 0.25, with impacts to 0.24.
GenerationFriction generation_friction(double void_ratio);

/// The laws of generation for a scene: frictionless walls, no bonds, strong local damping (0.7).
SimulationLaws generation_laws(Scene const& scene, GenerationFriction const& friction);

/// The same while an assembly closes and comes to rest, where masses do not matter: with the mass of the median disc for all that
/// are smaller, moments of inertia times 4, in mixed precision where that resolves the overlaps.
SimulationLaws closing_laws(Scene const& scene, GenerationFriction const& friction, Grading const& grading);

/// Laws for discs that only meet or flow, for time steps that are far longer: springs that are just stiff enough for the stress
/// (overlaps of half a percent), the finest 30 % (by mass) of the grading as heavy as the next disc, moments of inertia times 4,
/// mixed precision.
SimulationLaws flowing_laws(SimulationLaws laws, double stress, Grading const& grading);

/// A packed specimen (this rank's share), resting under the stress of the design, with its generation friction.
struct PackedSpecimen {
  Specimen specimen;
  double friction = 0, shape_factor = 0;  ///< in generation, at its end
  double unbalanced = 0;
  double deep_overlap_share = 0;      ///< of the contacts: overlaps above 10 % of the smaller radius
  double stress_x = 0, stress_y = 0;  ///< on the walls [Pa]; of a periodic cell 0
  std::int64_t disc_steps = 0;
};

/// What is called rest.
struct RestCriterion {
  double unbalanced = 1e-3;    ///< ratio, at most
  double deviator = HUGE_VAL;  ///< of the stresses on the walls, over the stress that is held, at most, at the last check
};

/// What keeps a specimen from resting under two stresses, in words with the numbers; empty where nothing does. It rests where the
/// walls press with them within 0.5 %, the contacts inside with what that comes to (a wave on its way shows in them first; the
/// shear of rough walls carries its part), and what `rest` asks for holds.
/// @param stress  [Pa]; nan where a pair of walls is not to have a certain one
std::string unrest(Simulation const& simulation, Measures const& m, WallStress const& stress, RestCriterion const& rest);
inline std::string unrest(Simulation const& simulation, Measures const& m, double stress, RestCriterion const& rest) {
  return unrest(simulation, m, WallStress{stress, stress}, rest);
}

/// Looks every now and then whether an assembly rests under an isotropic stress: without unrest() in three looks on end, and
/// without a deviator at the last.
struct RestWatch {
  std::int64_t first_step = 0;  ///< that of the assembly when it began
  std::int64_t looks_at_rest = 0;
  bool rests = false;

  std::int64_t steps_to_look(Simulation const& simulation) const;
  void look(Simulation const& simulation, Measures const& m, double stress, RestCriterion const& rest);
  /// Mean stress and void ratio, for those who wait.
  static std::string text(Simulation const& simulation);

  template <class Visit>
  void for_each_number(Visit&& visit) {
    visit("rest_first_step", first_step);
    visit("rest_looks", looks_at_rest);
    visit("rest_rests", rests);
  }
};

/// Steps with walls steered to an isotropic stress until it rests (RestWatch).
/// @return false if that took more than `most_steps`
bool hold_stress(Simulation& simulation, double stress, RestCriterion const& rest, std::int64_t most_steps,
                 ProgressCallback const& progress, char const* stage);

/// The same for an assembly that is about to rest, from prepare_servo() on: box and discs close together by what the stresses
/// inside lack, either direction for itself, and the walls follow these, so that no wave has to carry the stress through a large
/// assembly.
bool settle(Simulation& simulation, double stress, RestCriterion const& rest, std::int64_t most_steps,
            ProgressCallback const& progress);

inline constexpr RestCriterion rest_of_specimens;            ///< that are generated
inline constexpr std::int64_t most_steps_to_rest = 200'000;  ///< of these

/// Why a specimen that was generated did not come to rest in so many steps.
std::string text_of_unrest(Simulation const& simulation, double stress);

/// What was packed, with its proof but for the disc-steps. @param lowest_share  of the friction, that was needed
PackedSpecimen packed_at_rest(Simulation const& resting, double stress, GenerationFriction friction, double lowest_share);

inline constexpr std::int64_t steering = 10;  ///< steps between two strains of a box that closes

/// Of a box, closing positive.
struct Strains {
  double x = 0, y = 0;
};

/// Stress inside [Pa], of the contacts: in a large assembly that closes its walls are far away from what happens there.
WallStress stress_inside(Simulation const& simulation);

/// Closes box and discs together by these strains, once; between that the walls are steered to a stress of their own. Strains
/// leave the discs without a common speed, which their damping would take away, and waves from the walls need not carry the
/// stress.
void close_together(Simulation& simulation, Strains const& strains, WallStress const& stress_at_walls);

/// Sets time step, servo constants and speed caps of a simulation for an isotropic stress.
void prepare_servo(Simulation& simulation, double stress, double inertial_number, double d50, StepChoice const& step);

/// Speed of compression waves in the assembly [m/s], from a modulus of 0.8 k_n and the bulk density.
double wave_speed(Simulation const& simulation);

/// Time that such a wave takes through the longer side of the box [s].
double wave_transit(Simulation const& simulation);

/// Mean stress [Pa] now: from the walls, or from the contacts of a periodic cell.
double mean_stress(Simulation const& simulation);

/// Strain rate [1/s] of an inertial number, I = rate * d50 * sqrt(density / stress).
double strain_rate_of(double inertial_number, double stress, double density, double d50);

}  // namespace clathra
