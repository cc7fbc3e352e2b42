#pragma once
/// Pictures of a snapshot.
#include <vector>

#include "domain/measurement/snapshot.hpp"
#include "io/report/canvas.hpp"

namespace clathra {

double mean_diameter(Snapshot const& s);  ///< [m]

/// A part of the plane [m] and how large it is drawn.
struct MapView {
  double left = 0, bottom = 0, width = 0, height = 0;
  int pixels = 0;  ///< height of the picture

  double scale() const { return pixels / height; }  ///< [pixels/m]
  double x(double metres) const { return (metres - left) * scale(); }
  double y(double metres) const { return pixels - (metres - bottom) * scale(); }
  Canvas canvas() const;
};

/// The view that shows all of these snapshots between their walls, with a margin for the walls.
MapView view_of(std::vector<Snapshot const*> const& snapshots);

/// A square in the middle of a snapshot, at most so many of its mean diameters wide.
MapView detail_of(Snapshot const& snapshot, double diameters);

/// Grains coloured by size, from dark (small) to light (large).
Canvas grain_map(Snapshot const& snapshot, MapView const& view);

/// Grains with the hydrate between them: bonds in their true width.
Canvas detail_map(Snapshot const& snapshot, MapView const& view);

/// Intact bonds as thin grey lines from centre to centre, broken ones thicker in the colour of their mode, on top. The mark of a
/// broken one is at most as long as the bond was, however far its grains are now.
Canvas bond_map(Snapshot const& snapshot, MapView const& view);

/// Pairs as lines whose width is proportional to the normal force: pressing ones dark, pulling ones vermilion; those with less
/// than the mean pressing force are paler.
Canvas force_map(Snapshot const& snapshot, MapView const& view);

/// Grains coloured by a value each, from 0 to `most`; grey where it is not known.
Canvas value_map(Snapshot const& snapshot, std::vector<float> const& values, double most, MapView const& view);

namespace map_colours {
inline constexpr Rgb grain{222, 205, 170}, rim{150, 130, 95}, hydrate{86, 180, 233}, wall{40, 40, 40}, unknown{205, 205, 205},
    pressing{20, 30, 60}, weak{165, 175, 190}, pulling{213, 94, 0};
}

}  // namespace clathra
