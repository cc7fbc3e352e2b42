#pragma once
/// Random placement of discs without overlap: the loose start of every generator.
#include <cstdint>
#include <optional>
#include <vector>

namespace clathra {

/// A rectangle to fill [m]; periodic in both directions or bounded. Where a side is open, discs may reach over it.
struct Region {
  double left = 0, bottom = 0, width = 0, height = 0;
  bool periodic = false, open_left = false, open_right = false;
};

struct PlacedDisc {
  double x, y, radius;
};

struct Placement {
  std::vector<double> x, y;
};

/// Places discs of the given radii [m] at random by sequential addition, largest first, keyed by (seed, stream). They are dealt
/// out to parts of equal area, of about 50 discs each, so that the region is as dense in one half as in the other.
/// @param around  discs that are there already and may reach into it
/// @return centres in the order of `radii`; nothing where a disc finds no place, in a region about half of which is solid
std::optional<Placement> place_by_random_addition(std::vector<double> const& radii, Region const& region, std::uint64_t seed,
                                                  std::uint64_t stream, std::vector<PlacedDisc> const& around = {});

}  // namespace clathra
