#pragma once
/// How the contacts and their forces are oriented.
#include <array>
#include <cstddef>

#include "domain/measurement/snapshot.hpp"

namespace clathra {

/// Over the directions of contact normals, 0 to 180 degrees from the horizontal, anticlockwise, in equal bins.
struct Rose {
  static constexpr std::size_t bins = 18;
  std::array<double, bins> normals{};  ///< pairs in the bin over the mean of all bins
  std::array<double, bins> forces{};   ///< mean normal force in the bin over the mean of all pairs, pulling ones negative
  std::size_t pairs = 0;               ///< those that press or hold each other
  /// 1 + a cos 2(theta - direction): a and direction [rad, 0 to pi] of the normals (from the principal axes of their fabric
  /// tensor <n n>, a = 2 (F_1 - F_2)) and of the mean forces (from the bins).
  double normal_anisotropy = 0, normal_direction = 0, force_anisotropy = 0, force_direction = 0;
};

/// Of all pairs that press or hold each other, bonds among them, weak ones as well as strong ones.
Rose rose_of(Snapshot const& snapshot);

}  // namespace clathra
