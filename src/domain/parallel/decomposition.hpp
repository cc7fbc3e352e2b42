#pragma once
/// Which rank owns which part of the plane: rectangles by recursive bisection.
///
/// Bisection cuts a bonded specimen that shears in bands by the time that its parts take, which a fixed grid of cells could not;
/// and cuts that follow the strain of the box keep most discs where they are. Rectangles, unlike cell lists, need no table that
/// grows with the specimen: any rank can say who owns a place.
#include <array>
#include <vector>

#include "domain/parallel/ranks.hpp"
#include "kernels/integrate.hpp"
#include "kernels/particles.hpp"

namespace clathra {

/// Half-open: left <= x < right.
struct Rectangle {
  double left = -1e300, right = 1e300, bottom = -1e300, top = 1e300;
};

/// A cut of a rectangle. Ranks below it (smaller x or y) and at or above it are again cut, or are single ranks.
struct Cut {
  bool upright = true;         ///< at x = `at`, else at y = `at`
  Coord at = 0;                ///< [m]
  int below = -1, above = -1;  ///< index of the next cut, or -1 - rank
};

/// From the first of some cuts down to the rank that owns a place.
KOKKOS_INLINE_FUNCTION int owner_by(Cut const* cuts, std::size_t count, Coord x, Coord y) {
  int at = count > 0 ? 0 : -1;
  while (at >= 0) at = (cuts[at].upright ? x : y) < cuts[at].at ? cuts[at].below : cuts[at].above;
  return -1 - at;
}

/// Recursive bisection of the plane, one rectangle a rank. The cuts move with the homogeneous motion of the box, so that shear
/// alone makes few discs change their owner.
class Decomposition {
 public:
  /// One rectangle: the plane.
  Decomposition() = default;
  explicit Decomposition(std::vector<Cut> cuts);
  /// Cuts the discs of all ranks into parts of equal weight, always across the longer side.
  /// @param weight  of one of this rank's discs, > 0: the time it takes, in any unit
  static Decomposition bisect(Ranks const& ranks, ParticleSoA const& particles, std::int64_t weight);
  static Decomposition bisect(Ranks const& ranks, std::vector<double> const& x, std::vector<double> const& y,
                              std::int64_t weight);

  bool single() const { return cuts_.empty(); }
  int owner(Coord x, Coord y) const { return owner_by(cuts_.data(), cuts_.size(), x, y); }
  Rectangle rectangle(int rank) const;
  /// The cuts go with the box, which does not lean where there are several ranks.
  void follow(AffineFrame const& motion);

  /// The owner of a place, for kernels.
  struct OwnerOf {
    Field<Cut> cuts;
    KOKKOS_INLINE_FUNCTION int operator()(Coord x, Coord y) const { return owner_by(cuts.data(), cuts.extent(0), x, y); }
  };
  OwnerOf owner_of() const;

 private:
  std::vector<Cut> cuts_;
};

}  // namespace clathra
