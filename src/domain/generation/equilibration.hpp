#pragma once
/// Bringing an assembly to rest under an isotropic stress, at a wanted void ratio.
///
/// The void ratio is reached by closing the box at a rate with the friction as a knob, not by waiting for a servo: a servo at
/// constant friction stops wherever the grains jam, and says so only after the whole compression.
#include "domain/scene/grading.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/stage.hpp"
#include "domain/simulation/simulation.hpp"

namespace clathra {

/// The state that an assembly is to rest in.
struct CompressionTarget {
  double stress = 50e3;   ///< isotropic [Pa]
  double void_ratio = 0;  ///< nominal
  double void_tolerance = 0.004;
  double inertial_number = 1e-4;  ///< rate of the closing, and cap on the walls' rate
  double d50 = 0;                 ///< [m]
};

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

/// The laws of generation for a scene: frictionless walls, no bonds, strong local damping (0.7).
SimulationLaws generation_laws(Scene const& scene, GenerationFriction const& friction);

/// The same while an assembly closes: discs turn as heavily as in a test, and step in mixed precision where that resolves the
/// overlaps.
SimulationLaws closing_laws(Scene const& scene, GenerationFriction const& friction);

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

/// Closes the box homogeneously, walls and discs together, from a looser state to the target void ratio; the friction is lowered
/// where the stress exceeds the target and raised where it falls short, so that the assembly yields everywhere alike. Then it
/// comes to rest at the stress (unbalanced ratio < 1e-3, contacts and walls within 0.5 %) with the full friction back, so that it
/// creeps no further. No search for a friction is needed. It closes with the moments of inertia of a test and in mixed precision
/// where that resolves the overlaps, and rests with true ones in double precision.
/// @param skin [m] of the neighbour search
/// @throws Refused where the target is denser than frictionless grains pack, or looser than full friction holds, or where it does
/// not come to rest
PackedSpecimen compress_to_void_ratio(Specimen const& loose, Scene const& scene, GenerationFriction friction,
                                      CompressionTarget const& target, double skin, ProgressCallback const& progress,
                                      Ranks const& ranks = {});

/// What keeps a specimen from resting under an isotropic stress, in words with the numbers; empty where nothing does. It rests
/// where the walls press with that stress within 0.5 %, the contacts inside with what that comes to (a wave on its way shows in
/// them first; the shear of rough walls carries its part), and the unbalanced ratio is below `rest`.
std::string unrest(Simulation const& simulation, Measures const& m, double stress, double rest);

/// Steps with walls (or the periodic cell) steered to an isotropic stress until there is no unrest() in three checks on end.
/// @return false if that took more than `most_steps`
bool hold_stress(Simulation& simulation, double stress, double rest, std::int64_t most_steps, ProgressCallback const& progress,
                 char const* stage);

/// The same for an assembly that is about to rest: box and discs stretch together, either direction by what its stress in the
/// contacts lacks, so that no wave has to carry the mean stress in from the walls. What differs along a large assembly still
/// evens out by waves: 60,000 discs take some 2,000 steps, 200,000 more than 4,000. In the end the box is held.
bool settle(Simulation& simulation, double stress, double rest, std::int64_t most_steps, ProgressCallback const& progress);

inline constexpr double rest_of_specimens = 1e-3;            ///< unbalanced ratio of those that are generated
inline constexpr std::int64_t most_steps_to_rest = 200'000;  ///< of these

/// Why a specimen that was generated did not come to rest in so many steps.
std::string text_of_unrest(Simulation const& simulation, double stress);

/// What was packed, with its proof but for the disc-steps. @param lowest_share  of the friction, that was needed
PackedSpecimen packed_at_rest(Simulation const& resting, double stress, GenerationFriction friction, double lowest_share);

/// Closing rates of the box [1/s], positive inwards.
struct BoxRates {
  double x = 0, y = 0;
};

/// Stretches box and discs, or isotropically the periodic cell, together with these rates instead of the present ones.
void stretch(Simulation& simulation, BoxRates const& wanted, BoxRates& present);

/// Sets time step, servo constants and speed caps of a simulation for an isotropic stress.
void prepare_servo(Simulation& simulation, double stress, double inertial_number, double d50, StepChoice const& step);

/// Speed of compression waves in the assembly [m/s], from a modulus of 0.8 k_n and the bulk density.
double wave_speed(Simulation const& simulation);

/// Mean stress inside [Pa], of the contacts: in a large assembly that closes its walls are far away from what happens there.
double contact_stress(Simulation const& simulation);

/// Mean stress [Pa] now: from the walls, or from the contacts of a periodic cell.
double mean_stress(Simulation const& simulation);

/// Strain rate [1/s] of an inertial number, I = rate * d50 * sqrt(density / stress).
double strain_rate_of(double inertial_number, double stress, double density, double d50);

}  // namespace clathra
