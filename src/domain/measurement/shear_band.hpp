#pragma once
/// How far breakage is gathered in shear bands.
#include <cstddef>
#include <vector>

namespace clathra {

/// A straight band: points with `from` <= x cos(angle) + y sin(angle) <= `to`.
struct Band {
  double angle = 0;         ///< of its normal [rad], 0 to pi from the horizontal, anticlockwise
  double from = 0, to = 0;  ///< along the normal [m]
  std::size_t points = 0;   ///< in it
  bool holds(double x, double y) const;
};

/// The band of a width [m] that holds the most of the points (x, y) [m], over directions a degree apart.
Band best_band(std::vector<double> const& x, std::vector<double> const& y, double width);

/// Shares of the points in the best band, and in it together with the best band of what it leaves: a conjugate pair.
struct BandShares {
  double one = 0, two = 0;
};
/// Of no points both are 0. Points that fill a box evenly give what a band of that width covers of it.
BandShares band_shares(std::vector<double> const& x, std::vector<double> const& y, double width);

}  // namespace clathra
