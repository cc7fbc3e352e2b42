#include "kernels/verlet_skin.hpp"

#include "kernels/light_launch.hpp"

namespace clathra {

namespace {

struct GiveLeeway {
  ParticleSoA p;
  AffineFrame frame;
  SkinRange range;
  Real mean_speed;
  KOKKOS_FUNCTION void operator()(int i) const {
    p.verlet_skin(i) = range.skin(wandering_speed(p, frame, i), mean_speed);
    p.reference_x(i) = p.x(i);
    p.reference_y(i) = p.y(i);
  }
};

/// One group of discs.
struct Stray {
  ParticleSoA p;
  Field<Coord> x, y;  ///< where they were
  AffineFrame frame;
  KOKKOS_FUNCTION void operator()(int group, Real& greatest2) const {
    greatest2 = lane_max(greatest2, nonaffine_displacement2(p, x, y, frame, group));
  }
};

}  // namespace

void assign_verlet_skins(ParticleSoA const& particles, AffineFrame const& frame, SkinRange const& range, Real mean_speed) {
  Kokkos::parallel_for("assign_verlet_skins", light_launch(particles.owned), GiveLeeway{particles, frame, range, mean_speed});
}

Real largest_nonaffine_displacement2(ParticleSoA const& particles, Field<Coord> const& x, Field<Coord> const& y,
                                     AffineFrame const& frame) {
  Real greatest2 = 0;
  Kokkos::parallel_reduce("largest_nonaffine_displacement", light_launch(group_count(particles.owned)),
                          Stray{particles, x, y, frame}, Kokkos::Max<Real>(greatest2));
  return greatest2;
}

}  // namespace clathra
