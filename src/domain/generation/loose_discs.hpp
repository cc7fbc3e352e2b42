#pragma once
/// The loose start of every generator: discs of a grading, dealt out to layers and placed at random without overlap.
#include <cstdint>
#include <vector>

#include "domain/generation/random_sequential_addition.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/scene/grading.hpp"
#include "domain/scene/specimen.hpp"

namespace clathra {

inline constexpr double loose_solid_fraction = 0.46;    ///< of the random placement
inline constexpr double looser = 0.9;                   ///< times that, again and again, where discs find no place
inline constexpr std::int64_t most_in_patch = 100'000;  ///< discs placed one after the other

/// All discs of a specimen in layers of equal numbers, each in patches side by side, which are placed one by one, whatever the
/// number of ranks. Together they are the grading's quantiles; every patch has its share of all sizes.
class LooseDiscs {
 public:
  LooseDiscs(Grading const& grading, std::int64_t particles, int layers, std::uint64_t seed);

  int layers() const { return layers_; }
  double solid_area(int layer) const;  ///< [m^2]
  /// Adds the discs of a layer (from 0 on) above `from` [m] over the whole width, at a solid fraction of 0.46 or, where
  /// equal discs find no place at that, less, and lifts the top wall over them; ranks take the patches by turns. They are at
  /// rest.
  void add_layer(Specimen& specimen, int layer, double from, Ranks const& ranks) const;

  /// Radii [m] of a patch, in random order. Of each `patches` neighbouring sizes of the grading every patch has one.
  std::vector<double> radii(std::int64_t patch) const;

 private:
  std::int64_t patches() const { return patches_in_layer_ * layers_; }
  std::int64_t discs_before(std::int64_t patch) const;
  std::optional<Placement> placed(std::int64_t patch, std::vector<double> const& radii, Specimen const& specimen, double from,
                                  double height) const;

  int layers_;
  std::int64_t patches_in_layer_;
  std::uint64_t seed_;
  std::vector<double> sizes_;  // diameters of all, increasing [m]
};

}  // namespace clathra
