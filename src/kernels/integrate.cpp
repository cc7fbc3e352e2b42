#include "kernels/integrate.hpp"

namespace clathra {

namespace {

/// Velocity after a kick by `force` with local damping against the velocity relative to `frame`; `lost` gains the damping's work.
template <bool Ledger>
KOKKOS_FORCEINLINE_FUNCTION Lanes kicked(Lanes const& velocity, Lanes const& frame, Lanes const& force, Lanes const& inverse_mass,
                                         Real alpha, Real dt, Lanes& lost) {
  Lanes const drag = alpha * lane_abs(force);
  Lanes const damping = select(velocity > frame, -drag, select(velocity < frame, drag, Lanes(0)));
  Lanes const after = velocity + (force + damping) * inverse_mass * dt;
  if constexpr (Ledger) lost -= damping * (Lanes(0.5) * (velocity + after)) * dt;
  return after;
}

/// One slice of discs: kick and drift.
template <bool Ledger>
struct KickAndDrift {
  ParticleSoA p;
  MotionLaw law;
  StepLengths dt;
  AffineFrame frame;
  Field<Accum> lost_to_damping;
  Faults faults;
  int groups, share;  ///< in all, and of a thread

  /// A thread goes through its share backwards, since what the forces touched last is still in its cache.
  KOKKOS_FUNCTION int backwards(int place) const {
    int const first = place / share * share, next = first + share;
    return first + (next < groups ? next : groups) - 1 - place;
  }

  KOKKOS_FUNCTION void operator()(int place, Real& largest_displacement) const {
    auto const i = static_cast<std::size_t>(backwards(place)) * lane_count;
    Lanes const inverse_mass = load(&p.inverse_mass(i));
    auto const free = inverse_mass > Lanes(0);  // padding discs have none
    Lanes lost(0);
    Lanes const fx = load(&p.force_x(i)), fy = load(&p.force_y(i));
    Lanes const x0 = load(&p.x(i)), y0 = load(&p.y(i));
    Lanes const vx = kicked<Ledger>(load(&p.vx(i)), frame.velocity_x(x0), fx, inverse_mass, law.damping, dt.kick, lost) +
                     select(free, Lanes(law.gravity_x * dt.kick), Lanes(0));
    Lanes const vy = kicked<Ledger>(load(&p.vy(i)), frame.velocity_y(y0), fy, inverse_mass, law.damping, dt.kick, lost) +
                     select(free, Lanes(law.gravity_y * dt.kick), Lanes(0));
    Lanes const omega =
        kicked<Ledger>(load(&p.omega(i)), Lanes(0), load(&p.torque(i)), load(&p.inverse_inertia(i)), law.damping, dt.kick, lost);
    Lanes const x = x0 + vx * dt.drift, y = y0 + vy * dt.drift;
    store(&p.vx(i), vx);
    store(&p.vy(i), vy);
    store(&p.omega(i), omega);
    store(&p.x(i), x);
    store(&p.y(i), y);
    store(&p.angle(i), load(&p.angle(i)) + omega * dt.drift);
    if constexpr (Ledger) store(&lost_to_damping(i), load(&lost_to_damping(i)) + lost);

    Lanes displacement = lane_abs(x - x0) + lane_abs(y - y0) + lane_abs(omega) * Lanes(0);
    for (auto l = p.owned - static_cast<int>(i); l < lane_count; ++l)
      set_lane(displacement, l, 0);  // ghosts share the last group
    if (any(!(displacement < Lanes(1e5)))) report(i, displacement);
    largest_displacement = lane_max(largest_displacement, largest(select(displacement > Lanes(0), displacement, Lanes(0))));
  }

  KOKKOS_FUNCTION void report(std::size_t i, Lanes const& displacement) const {
    for (int l = 0; l < lane_count; ++l) {
      if (!(lane(displacement, l) < 1e5)) faults.report(Fault::not_finite, p.id(i + static_cast<std::size_t>(l)));
    }
  }
};

}  // namespace

Real integrate(ParticleSoA const& particles, MotionLaw const& law, StepLengths const& dt, AffineFrame const& frame,
               EnergyLosses const& losses, Faults const& faults) {
  int const groups = group_count(particles.owned), threads = ExecutionSpace().concurrency();
  int const share = (groups + threads - 1) / threads;
  Real largest_displacement = 0;
  auto const run = [&](auto const& kernel) {
    Kokkos::parallel_reduce("kick_and_drift", Kokkos::RangePolicy<ExecutionSpace>(0, groups), kernel,
                            Kokkos::Max<Real>(largest_displacement));
  };
  if (losses.damping.extent(0) > 0) {
    run(KickAndDrift<true>{particles, law, dt, frame, losses.damping, faults, groups, share});
  } else {
    run(KickAndDrift<false>{particles, law, dt, frame, losses.damping, faults, groups, share});
  }
  return largest_displacement;
}

}  // namespace clathra
