#pragma once
/// How far breakage is gathered in shear bands.
#include <cstddef>
#include <optional>
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

/// A shear band in a field of shear strain. Places along its normal are from the middle of the points.
struct BandProfile {
  double inclination = 0;          ///< of the band from the horizontal [rad, 0 to pi], anticlockwise
  double position = 0;             ///< of its middle along the normal [m]
  double thickness = 0;            ///< of the band of even strain that would look the same [m]
  double gaussian_deviation = 0;   ///< of the Gaussian across the band [m], as it looks, with what the field's smoothing adds
  double inside = 0, outside = 0;  ///< shear strain in the even band, and beside it
  double explained = 0;            ///< share of the variance of the strains that the profile across the band explains
};

/// Fits a band to shear strains of discs or of cells of a grid. Its direction is the one whose profile, mean strains of slices
/// half a d50 wide, explains most of the variance; its thickness that of a box which, smoothed as the field is, comes nearest to
/// the profile.
/// @param x,y,strain  of each disc or cell [m]; strains that are not finite are left out
/// @param smoothing  deviation of the Gaussian that smooths as the field does [m], > 0: smoothing_of_shear_strain(),
///                   StrainGrid::smoothing
/// @return nothing for fewer than 50 strains, or where no band stands out
std::optional<BandProfile> fit_band(std::vector<double> const& x, std::vector<double> const& y, std::vector<float> const& strain,
                                    double d50, double smoothing);

/// What was fitted at an axial strain of a test; nothing where no band was found.
struct BandAt {
  double eps1 = 0;
  std::optional<BandProfile> band;
};

/// The axial strain from which on a test has its shear band: the first at which a band stands out (`inside` is twice `outside` or
/// more) in the direction of the last one, within 10 degrees, and from which on that holds to the end. A field always has some
/// best direction, and until past the peak faint bands come and go in several; the one that lasts is the one along which the
/// specimen fails. Twice is where the band has taken as much strain of its own as all places have. Where the fit before already
/// had that direction, inside - 2 outside is taken as linear between the two, and the onset is where it is 0; else it is the
/// strain of the first that stands out, and the true one lies between that and the one before.
/// @param series  in the order of the strains;  @return nothing where the last fit does not stand out
std::optional<double> band_onset(std::vector<BandAt> const& series);

}  // namespace clathra
