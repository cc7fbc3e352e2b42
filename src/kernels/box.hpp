#pragma once
/// The box of an assembly, whatever bounds it, and its homogeneous motion.
#include <algorithm>
#include <cmath>

#include "kernels/lane.hpp"

namespace clathra {

/// An upper triangular matrix: of two edges of a cell, a = (xx, 0) and b = (xy, yy), of a strain or of its rate. Such matrices
/// keep the first edge along x.
struct CellMatrix {
  Real xx = 0, xy = 0, yy = 0;
};

/// Where the discs may be, and how that moves.
struct Box {
  Coord x = 0, y = 0;  ///< the point that its motion is told from: the middle of walls, a periodic cell's lower left corner [m]
  CellMatrix edges{2e9, 0, 2e9};  ///< H: the edges are its columns [m]
  CellMatrix rate;                ///< L = dH/dt H^-1: d v_x / d x, d v_x / d y, d v_y / d y [1/s]
  Real drift_x = 0, drift_y = 0;  ///< velocity of (x, y) [m/s]
  Real largest_speed = 0;         ///< of the motion anywhere inside, at most [m/s]
  bool periodic = false;          ///< images of the discs surround it

  KOKKOS_INLINE_FUNCTION Real width() const { return edges.xx; }   ///< along x [m]
  KOKKOS_INLINE_FUNCTION Real height() const { return edges.yy; }  ///< along y, whatever the tilt [m]
  KOKKOS_INLINE_FUNCTION Real area() const { return edges.xx * edges.yy; }
  /// The distance of the nearer pair of opposite edges [m]; sides that lean stand nearer than the width.
  Real narrowest() const { return std::min(edges.xx / std::hypot(1, edges.xy / edges.yy), edges.yy); }

  /// A periodic cell from its lower left corner on, with upright sides.
  static Box cell(Coord left, Coord bottom, Real width, Real height) {
    Box box;
    box.x = left;
    box.y = bottom;
    box.edges = {width, 0, height};
    box.periodic = true;
    return box;
  }
};

/// The homogeneous motion of the box. Neighbour lists may ignore it: r maps to centre + F (r_ref - reference_centre). Local
/// damping is taken against the motion relative to it, v_frame = L (r - centre) + drift: against the absolute velocity it would
/// drag every disc of a specimen under compression the same way and hold up a share of the platens' stress that no contact
/// carries.
struct AffineFrame {
  Coord centre_x = 0, centre_y = 0;
  Coord reference_centre_x = 0, reference_centre_y = 0;
  CellMatrix stretch{1, 0, 1};    ///< F
  CellMatrix gradient;            ///< L [1/s]
  Real drift_x = 0, drift_y = 0;  ///< velocity of the centre [m/s]

  /// Velocity of the homogeneous motion at a place [m/s].
  template <class P>
  KOKKOS_INLINE_FUNCTION P velocity_x(P const& x, P const& y) const {
    return gradient.xx * (x - centre_x) + gradient.xy * (y - centre_y) + drift_x;
  }
  template <class P>
  KOKKOS_INLINE_FUNCTION P velocity_y(P const& y) const {
    return gradient.yy * (y - centre_y) + drift_y;
  }
  /// Where it has brought what was at a place.
  template <class P>
  KOKKOS_INLINE_FUNCTION P mapped_x(P const& x, P const& y) const {
    return centre_x + (stretch.xx * (x - reference_centre_x) + stretch.xy * (y - reference_centre_y));
  }
  template <class P>
  KOKKOS_INLINE_FUNCTION P mapped_y(P const& y) const {
    return centre_y + stretch.yy * (y - reference_centre_y);
  }
  /// What it brings two discs nearer at most, relatively: no less than the norm of F - I.
  KOKKOS_INLINE_FUNCTION Real closing() const {
    Real const tilt = lane_abs(stretch.xy);
    return lane_max(lane_abs(1 - stretch.xx) + tilt, lane_abs(1 - stretch.yy) + tilt);
  }
};

/// The homogeneous motion since the box was another: F = H H_then^-1.
KOKKOS_INLINE_FUNCTION AffineFrame frame_since(Box const& now, Box const& then) {
  AffineFrame f;
  f.centre_x = now.x;
  f.centre_y = now.y;
  f.reference_centre_x = then.x;
  f.reference_centre_y = then.y;
  f.stretch.xx = now.edges.xx / then.edges.xx;
  f.stretch.yy = now.edges.yy / then.edges.yy;
  f.stretch.xy = (now.edges.xy - f.stretch.xx * then.edges.xy) / then.edges.yy;
  f.gradient = now.rate;
  f.drift_x = now.drift_x;
  f.drift_y = now.drift_y;
  return f;
}

}  // namespace clathra
