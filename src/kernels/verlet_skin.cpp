#include "kernels/verlet_skin.hpp"

namespace clathra {

namespace {

constexpr Real share = 0.2;  // of h, for a disc at the mean speed: rows grow by that much of the skin on the average

/// Speed against the homogeneous motion [m/s].
struct Wandering {
  ParticleSoA p;
  AffineFrame frame;
  KOKKOS_INLINE_FUNCTION Real speed(int i) const {
    Real const vx = p.vx(i) - frame.velocity_x(p.x(i)), vy = p.vy(i) - frame.velocity_y(p.y(i));
    return lane_sqrt(vx * vx + vy * vy);
  }
  KOKKOS_INLINE_FUNCTION void operator()(int i, Real* out) const {
    out[0] = lane_min(speed(i), Real(1e6));
    out[1] = 1;
  }
};

struct GiveLeeway {
  ParticleSoA p;
  Wandering wandering;
  SkinRange range;
  Real mean_speed;
  KOKKOS_FUNCTION void operator()(int i, Real& greatest) const {
    p.verlet_skin(i) = lane_min(range.least * (1 + share * wandering.speed(i) / mean_speed), range.most);
    greatest = lane_max(greatest, p.verlet_skin(i));
  }
};

/// One group of discs.
struct Stray {
  ParticleSoA p;
  Field<Coord> x, y;  ///< where they were
  AffineFrame frame;
  KOKKOS_FUNCTION void operator()(int group, Real& greatest2) const {
    auto const i = static_cast<std::size_t>(group) * lane_count;
    Lanes const dx = load(&p.x(i)) - (frame.centre_x + frame.stretch_x * (load(&x(i)) - frame.reference_centre_x));
    Lanes const dy = load(&p.y(i)) - (frame.centre_y + frame.stretch_y * (load(&y(i)) - frame.reference_centre_y));
    Lanes const skin = load(&p.verlet_skin(i));
    Lanes share2 = (dx * dx + dy * dy) / (skin * skin);
    for (auto l = p.owned - static_cast<int>(i); l < lane_count; ++l) set_lane(share2, l, 0);  // ghosts share the last group
    greatest2 = lane_max(greatest2, largest(select(share2 > Lanes(0), share2, Lanes(0))));
  }
};

}  // namespace

Real assign_verlet_skins(ParticleSoA const& particles, AffineFrame const& frame, SkinRange const& range,
                         Summation const& summation) {
  Wandering const wandering{particles, frame};
  Real sums[2];
  exact_sums<2>("mean_wandering", particles.owned, wandering, {summation.unit.speed(), 1}, sums, summation.over_ranks);
  Real const mean_speed = lane_max(sums[0] / lane_max(sums[1], Real(1)), Real(1e-300));
  Real greatest = 0;
  Kokkos::parallel_reduce("assign_verlet_skins", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                          GiveLeeway{particles, wandering, range, mean_speed}, Kokkos::Max<Real>(greatest));
  return lane_max(greatest, range.least);
}

void mark_reference(ParticleSoA const& particles) {
  Kokkos::deep_copy(particles.reference_x, particles.x);
  Kokkos::deep_copy(particles.reference_y, particles.y);
}

Real largest_nonaffine_displacement2(ParticleSoA const& particles, Field<Coord> const& x, Field<Coord> const& y,
                                     AffineFrame const& frame) {
  Real greatest2 = 0;
  Kokkos::parallel_reduce("largest_nonaffine_displacement", Kokkos::RangePolicy<ExecutionSpace>(0, group_count(particles.owned)),
                          Stray{particles, x, y, frame}, Kokkos::Max<Real>(greatest2));
  return greatest2;
}

}  // namespace clathra
