#pragma once
/// Which specimen a scene describes: any three of {particles, box, void ratio, grading} fix the fourth.
#include <string>

#include "domain/scene/grading.hpp"

namespace clathra {

/// The consistent set of numbers.
struct SpecimenDesign {
  std::int64_t particles = 0;
  double width = 0, height = 0;  ///< [m], at the bonding stress
  double void_ratio = 0;         ///< nominal
  Grading grading = Grading::toyoura();
};

/// Completes a scene: particles + void ratio + grading give the box (with the aspect ratio, or one given side), box + void ratio
/// + grading give the particles, particles + box + grading give the void ratio, particles + box + void ratio scale the grading's
/// d50. A void ratio that is neither given nor follows is 0.24.
/// @throws std::invalid_argument where all four are given, or fewer than needed
SpecimenDesign design_sample(Scene const& scene);

/// Layers in which a design is compacted: as many as the scene wants, but each of 50 discs at the least and as high as its
/// largest grain.
int compaction_layers(Scene const& scene, SpecimenDesign const& design);

/// How far the bonds of a scene reach beyond touching [m], at the most.
double reach_of_bonds(Scene const& scene, double d50);

/// How many discs may lie around the largest of a grading, no farther than `reach` [m]: the smallest ones, side by side, and
/// where they lie within reach those of a second ring.
double most_neighbours(Grading const& grading, double reach);
/// How far apart, surface to surface, a disc and its neighbours may be listed so that a row holds them all, in radii of the
/// smallest disc. @param ratio  of the largest radius to the smallest
double reach_of_a_full_row(double ratio);

/// Why the sizes of grains differ too much for the rows of neighbours, with the ratio that does not; empty where they fit.
/// @param smallest,largest  diameters [m];  @param reach  beyond touching, of bonds [m]
std::string crowding(double smallest, double largest, double reach);
/// Why a Verlet skin [m], 0 = chosen, is too wide for the rows of neighbours, with the widest that is not; empty where it fits.
std::string wide_skin(Grading const& grading, double skin);

/// Why a specimen will hardly come to rest at the void ratio that a scene asks for: it is beyond the densest or the loosest
/// packings of as many particles that were made; empty where it may. Which one there is, is known when it is made.
std::string far_void_ratio(Scene const& scene, SpecimenDesign const& design);

inline constexpr double fewest_grains_across = 3;

/// Why a specimen is too narrow to be one of sand, its smaller side being less than `fewest` of its largest grains; empty where
/// it is not. @param width, height, largest  [m]
std::string narrowness(double width, double height, double largest, double fewest = fewest_grains_across);

}  // namespace clathra
