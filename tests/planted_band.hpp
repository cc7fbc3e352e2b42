#pragma once
/// A specimen with a shear band that is known.
#include <algorithm>
#include <cmath>

#include "domain/measurement/snapshot.hpp"
#include "draw.hpp"

namespace clathra {

/// Before and after.
struct Sheared {
  Snapshot start, now;
};

struct PlantedBand {
  static constexpr double d50 = 1e-3;  ///< [m]
  double inclination = 0;              ///< from the horizontal [rad], anticlockwise
  double thickness = 0;                ///< [m]
  double noise = 0;                    ///< single discs are displaced up to this in each direction [m]
  double shear = 0.3;                  ///< across the band

  /// Equal discs on a shaken lattice 70 by 140, displaced along a straight band through the middle: linearly across it, rigidly
  /// beside it. In it they turn as what is around them, tan(phi) = -shear / 2.
  Sheared specimen() const {
    Draw draw(7);
    Sheared s;
    s.start.d50 = s.now.d50 = d50;
    double const nx = -std::sin(inclination), ny = std::cos(inclination);  // of the band's normal
    for (int row = 0; row < 140; ++row)
      for (int column = 0; column < 70; ++column) {
        double const x = (column - 35 + draw.between(-0.3, 0.3)) * d50, y = (row - 70 + draw.between(-0.3, 0.3)) * d50;
        double const across = nx * x + ny * y, along = shear * std::clamp(across, -thickness / 2, thickness / 2);
        double const ux = along * ny + draw.between(-noise, noise), uy = -along * nx + draw.between(-noise, noise);
        double const before = draw.between(-3, 3), turned = std::abs(across) < thickness / 2 ? -std::atan(shear / 2) : 0;
        add(s.start, x, y, 0, 0, before);
        add(s.now, x + ux, y + uy, ux, uy, before + turned);
      }
    return s;
  }

 private:
  static void add(Snapshot& s, double x, double y, double ux, double uy, double angle) {
    s.id.push_back(static_cast<int>(s.id.size()));
    s.x.push_back(x), s.y.push_back(y);
    s.ux.push_back(static_cast<float>(ux)), s.uy.push_back(static_cast<float>(uy));
    s.radius.push_back(static_cast<float>(d50 / 2)), s.angle.push_back(static_cast<float>(angle));
  }
};

}  // namespace clathra
