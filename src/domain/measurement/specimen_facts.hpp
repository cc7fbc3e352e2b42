#pragma once
/// What the discs of a specimen show, whatever its numbers say of them. All calls are collective, with the same result on all
/// ranks, whatever their number.
#include <array>
#include <cstdint>

#include "domain/parallel/ranks.hpp"
#include "domain/scene/grading.hpp"
#include "domain/scene/specimen.hpp"
#include "domain/scene/specimen_design.hpp"

namespace clathra {

/// The disc next to a wall, or farthest beyond it.
struct DiscAtWall {
  int id = -1;
  double depth = 0;  ///< of its centre in the box: its distance from the wall [m], negative outside
  double space = 0;  ///< free between the wall and the discs [m], negative where one touches it
};

/// The disc with the largest speed, of its centre or of its edge by its spin.
struct FastestDisc {
  int id = -1;
  double speed = 0;  ///< [m/s]
};

struct SpecimenOutline {
  std::int64_t discs = 0;
  CurveSizes sizes;                   ///< by area [m]
  double void_ratio = 0;              ///< nominal
  double farthest = 0;                ///< the largest coordinate of a centre or a wall, either sign [m]
  std::array<DiscAtWall, 4> at_wall;  ///< left, right, bottom, top
  std::int64_t outside = 0;           ///< discs with their centre beyond a wall
  FastestDisc fastest;
};
inline constexpr char const* wall_names[] = {"left", "right", "bottom", "top"};

/// @param part  this rank's discs, numbers finite, radii above 0
SpecimenOutline outline_of(Specimen const& part, Ranks const& ranks = {});

/// A specimen as a scene would have described it: box, number of discs, void ratio and the grading that they have, with the d50
/// that the specimen states, if it does.
SpecimenDesign design_of(Specimen const& part, Ranks const& ranks = {});

/// Two discs that overlap; `share` is the overlap over the smaller radius.
struct OverlappingPair {
  double share = 0;
  int id_a = -1, id_b = -1;  ///< id_a < id_b
  double x = 0, y = 0;       ///< of id_a [m]
};

inline constexpr double deep_pair = 0.1;  ///< over the smaller radius: what the checks of a test count as deep, too

struct SpecimenOverlaps {
  std::int64_t touching = 0;  ///< pairs that overlap
  std::int64_t deep = 0;      ///< of these, by more than deep_pair
  std::int64_t through = 0;   ///< of these, by more than the smaller radius, which ends a run
  OverlappingPair deepest;
  double stress = 0;  ///< mean stress of the contacts between discs over their normal stiffness: sum(overlap x branch) / 2 A
};

/// In proportion to the discs for any mixture of sizes. Pairs across the edge of a periodic cell are not seen.
SpecimenOverlaps overlaps_of(Specimen const& part, Ranks const& ranks = {});

struct SpecimenFacts {
  SpecimenOutline outline;
  SpecimenOverlaps overlaps;
};

}  // namespace clathra
