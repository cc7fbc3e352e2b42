#pragma once
/// How the contacts and their forces are oriented.
#include <array>
#include <cstddef>

#include "domain/measurement/snapshot.hpp"

namespace clathra {

/// Which pairs count as contacts. A bond may hold two discs that do not touch, and one that broke may leave them touching or
/// apart.
enum class ContactSet {
  touching,    ///< the discs overlap, bonded or not
  mechanical,  ///< they overlap or are bonded: all pairs that press or hold each other
  bonded       ///< an intact bond, with a gap or without
};

/// Whether a pair of a snapshot belongs to a set. Weak contacts do as well as strong ones: their force may be rounded to 0 in a
/// file, and their overlap to -0.
bool belongs(Snapshot const& snapshot, std::size_t pair, ContactSet set);

/// F_ij = <n_i n_j> over contact normals n (Satake 1982), of trace 1; all 0 where there are none.
struct Fabric {
  double xx = 0, yy = 0, xy = 0;
  double deviator = 0;   ///< F_d = F_1 - F_2, 0 = isotropic, 1 = all in one direction
  double direction = 0;  ///< of the axis of F_1 [rad, 0 to pi] from the horizontal, anticlockwise
  /// a of the density (1 + a cos 2 (theta - direction)) / 2 pi (Rothenburg and Bathurst 1989) with this tensor: of it
  /// <cos 2 (theta - direction)> = a / 2, and the same mean is F_1 - F_2.
  double anisotropy() const { return 2 * deviator; }
};

/// Over the directions of contact normals, 0 to 180 degrees from the horizontal, anticlockwise, in equal bins: a normal has two
/// ends, so the other half is the same.
struct Rose {
  static constexpr std::size_t bins = 18;
  std::array<double, bins> normals{};  ///< pairs in the bin over the mean of all bins
  std::array<double, bins> forces{};   ///< mean normal force in the bin over the mean of all pairs, pulling ones negative
  std::size_t pairs = 0;
  Fabric fabric;
  double force_anisotropy = 0,
         force_direction = 0;  ///< of 1 + a cos 2 (theta - direction), fitted to the bins of the mean forces
};

/// The same bits for any order of the pairs and of the discs, and for either disc first. Pairs without a direction (centres at
/// the same place) or a force that is a number are left out.
/// @param snapshot  the whole specimen, all ranks' discs
Rose rose_of(Snapshot const& snapshot, ContactSet set);

}  // namespace clathra
