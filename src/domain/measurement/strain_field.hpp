#pragma once
/// How much the specimen was sheared, place by place. Two fields that see different things: shear_strain() averages over many
/// grains, so that single ones do not show; grain_strain() follows single grains and their rotations, at the resolution of a
/// grain.
#include <array>
#include <limits>
#include <vector>

#include "domain/measurement/snapshot.hpp"

namespace clathra {

/// A strain where none can be told.
inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Width of the window over which shear_strain() averages, in mean diameters.
inline constexpr double strain_window = 7.5;

/// Natural shear strain since the shear began at each disc: ln(l1 / l2), the difference of the principal natural strains. In a
/// homogeneous test it is eps_1 - eps_3. The gradient of the displacements is a least-squares fit over the 3 x 3 cells around the
/// disc where it was at first, so that the motion of single grains averages out and rigid rotation does not count. NaN where
/// fewer than six discs are near, or these do not fix a gradient.
std::vector<float> shear_strain(Snapshot const& snapshot);

/// Standard deviation [m] of the Gaussian that smooths a field of strain as shear_strain() does: a slope by least squares over a
/// window w weighs the strains in it by a parabola, of variance w^2 / 20; between cells w / 3 apart it is interpolated, (w / 3)^2
/// / 6.
double smoothing_of_shear_strain(Snapshot const& snapshot);

/// Strains of the square cells of a regular grid, row by row from the left lower corner.
struct StrainGrid {
  double left = 0, bottom = 0;                     ///< the first cell's corner [m]
  double spacing = 0;                              ///< of the nodes [m]
  int columns = 0, rows = 0;                       ///< of cells
  double smoothing = 0;                            ///< deviation of the Gaussian that smooths as the grid does [m]
  std::vector<double> x, y;                        ///< [columns rows] middles of the cells [m]
  std::vector<std::array<double, 4>> deformation;  ///< [columns rows] F: xx, xy, yx, yy; NaN where not known
  std::vector<float> shear;                        ///< [columns rows] E_1 - E_2 >= 0; NaN where not known
};

/// Mesh-free strain with the rotations of the grains (Wang, Gutierrez and Dove, Int. J. Numer. Anal. Meth. Geomech. 31 (2007)
/// 1349-1366). Each node of a grid over the discs at the start is tied once to the disc whose centre is nearest, of equally near
/// ones that of the smallest id, and moves rigidly with it:
///   u = u_disc + (R(phi) - 1) l,  l from the centre to the node, phi the disc's rotation, anticlockwise.
/// F = 1 + grad u at the middle of a cell from its four nodes (bilinear), E = (F^T F - 1) / 2 (Green's strain), shear E_1 - E_2,
/// which is eps_1 - eps_3 where these are small. A turning specimen has none. Of a homogeneous strain with grains that do not
/// turn the mean of F is right to the strain times 2 r / L; single cells scatter, as each node follows one grain, and the shear,
/// being no less than 0, is larger in the mean for it. Nodes farther than two d50 from any centre belong to no disc; cells with
/// one are not known. The same bits for any order of the discs.
/// @param start,now  the whole specimen: the strain is that from the one to the other;  @param spacing  of the nodes [d50]
/// @return an empty grid where the discs do not fill one cell
StrainGrid grain_strain(Snapshot const& start, Snapshot const& now, double spacing = 1);

/// The shear of a grid at each disc of a snapshot: of the cell in which the disc was at the start of the shear, or the nearest
/// one.
std::vector<float> shear_at_discs(StrainGrid const& grid, Snapshot const& snapshot);

}  // namespace clathra
