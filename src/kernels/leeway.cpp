#include "kernels/leeway.hpp"

namespace clathra {

namespace {

// Measured: perf/machines. A larger share or reach makes searches rarer still and rows longer.
constexpr Real share = 0.2;  // of h, for a disc at the mean speed
constexpr Real most = 4;     // times h, for any

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
  Real least, mean_speed;
  KOKKOS_FUNCTION void operator()(int i, Real& greatest) const {
    p.leeway(i) = least * (1 + lane_min(share * wandering.speed(i) / mean_speed, most));
    greatest = lane_max(greatest, p.leeway(i));
  }
};

}  // namespace

Real give_leeway(ParticleSoA const& particles, AffineFrame const& frame, Real least, SumOverRanks const& over_ranks) {
  Wandering const wandering{particles, frame};
  Real sums[2];
  exact_sums<2>("mean_wandering", particles.owned, wandering, sums, over_ranks);
  Real const mean_speed = lane_max(sums[0] / lane_max(sums[1], Real(1)), Real(1e-300));
  Real greatest = 0;
  Kokkos::parallel_reduce("give_leeway", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                          GiveLeeway{particles, wandering, least, mean_speed}, Kokkos::Max<Real>(greatest));
  return lane_max(greatest, least);
}

}  // namespace clathra
