#include "kernels/integrate.hpp"

namespace clathra {

namespace {

/// Velocity after a kick by `force` with local damping against the velocity relative to `frame`; `lost` gains the damping's work.
template <bool Ledger, class L>
KOKKOS_FORCEINLINE_FUNCTION L kicked(L const& velocity, L const& frame, L const& force, L const& inverse_mass, scalar_of<L> alpha,
                                     scalar_of<L> dt, L& lost) {
  L const drag = alpha * lane_abs(force);
  L const damping = select(velocity > frame, -drag, select(velocity < frame, drag, L(0)));
  L const after = velocity + (force + damping) * inverse_mass * dt;
  if constexpr (Ledger) lost -= damping * (constant<L>(0.5) * (velocity + after)) * dt;
  return after;
}

/// How threads go through the groups of discs.
struct Shares {
  int groups, share;  ///< in all, and of a thread

  /// A thread goes through its share backwards, since what the forces touched last is still in its cache.
  KOKKOS_FUNCTION int backwards(int place) const {
    int const first = place / share * share, next = first + share;
    return first + (next < groups ? next : groups) - 1 - place;
  }
};

/// What a step of motion needs to know, in either precision.
struct Moving {
  ParticleSoA p;
  MotionLaw law;
  StepLengths dt;
  AffineFrame frame;
  Field<Accum> lost_to_damping;
  Faults faults;
  Shares shares;

  /// @param displacement  of the discs i .., of which those without a finite one are faults
  template <class L>
  KOKKOS_FUNCTION void report(std::size_t i, L const& displacement) const {
    for (int l = 0; l < lane_count_of<scalar_of<L>>; ++l) {
      if (!(lane(displacement, l) < 1e5)) faults.report(Fault::not_finite, p.id(i + static_cast<std::size_t>(l)));
    }
  }
};

/// One group of discs: kick and drift.
template <bool Ledger>
struct KickAndDrift : Moving {
  KOKKOS_FUNCTION void operator()(int place, Real& largest_displacement) const {
    auto const i = static_cast<std::size_t>(shares.backwards(place)) * lane_count;
    Lanes const inverse_mass = load(p.inverse_mass.data<Real>() + i);
    auto const free = inverse_mass > Lanes(0);  // padding discs have none
    Lanes lost(0);
    Real* const vx_of = p.vx.data<Real>() + i;
    Real* const vy_of = p.vy.data<Real>() + i;
    Real* const omega_of = p.omega.data<Real>() + i;
    Lanes const fx = load(p.force_x.data<Real>() + i), fy = load(p.force_y.data<Real>() + i);
    Lanes const x0 = load(&p.x(i)), y0 = load(&p.y(i));
    Lanes const vx = kicked<Ledger>(load(vx_of), frame.velocity_x(x0), fx, inverse_mass, law.damping, dt.kick, lost) +
                     select(free, Lanes(law.gravity_x * dt.kick), Lanes(0));
    Lanes const vy = kicked<Ledger>(load(vy_of), frame.velocity_y(y0), fy, inverse_mass, law.damping, dt.kick, lost) +
                     select(free, Lanes(law.gravity_y * dt.kick), Lanes(0));
    Lanes const omega = kicked<Ledger>(load(omega_of), Lanes(0), load(p.torque.data<Real>() + i),
                                       load(p.inverse_inertia.data<Real>() + i), law.damping, dt.kick, lost);
    Lanes const x = x0 + vx * dt.drift, y = y0 + vy * dt.drift;
    store(vx_of, vx);
    store(vy_of, vy);
    store(omega_of, omega);
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
};

/// The same in mixed precision: velocities in single precision, places and angles in double.
template <bool Ledger>
struct KickAndDriftMixed : Moving {
  using V = FloatLanes;
  Real per_tick;

  KOKKOS_FUNCTION void operator()(int place, Real& largest_displacement) const {
    constexpr int lanes = lane_count_of<float>;
    auto const i = static_cast<std::size_t>(shares.backwards(place)) * lanes;
    FourOfDiscs at = p.mirror.load(i, DiscMirror::contact), moving = p.mirror.load(i, DiscMirror::motion);
    V &vx = moving.of[0], &vy = moving.of[1], &omega = at.of[3];
    V const inverse_mass = moving.of[2], inverse_inertia = moving.of[3];
    LanesOfHalves x = load_halves(&p.x(i)), y = load_halves(&p.y(i)), frame_x, frame_y;
    for (int h = 0; h < halves; ++h) {
      frame_x.of[h] = frame.velocity_x(x.of[h]);
      frame_y.of[h] = frame.velocity_y(y.of[h]);
    }
    auto const free = inverse_mass > V(0);  // padding discs have none
    auto const alpha = static_cast<float>(law.damping), kick = static_cast<float>(dt.kick);
    auto const pulled = [&](Real gravity) { return select(free, constant<V>(gravity * dt.kick), V(0)); };
    V lost(0);
    vx = kicked<Ledger>(vx, in_single(frame_x), load(p.force_x.data<float>() + i), inverse_mass, alpha, kick, lost) +
         pulled(law.gravity_x);
    vy = kicked<Ledger>(vy, in_single(frame_y), load(p.force_y.data<float>() + i), inverse_mass, alpha, kick, lost) +
         pulled(law.gravity_y);
    omega = kicked<Ledger>(omega, V(0), load(p.torque.data<float>() + i), inverse_inertia, alpha, kick, lost);
    add(&p.angle(i), load_halves(&p.angle(i)), omega);
    x = add(&p.x(i), x, vx);
    y = add(&p.y(i), y, vy);
    at.of[0] = ticks_of(x, per_tick);
    at.of[1] = ticks_of(y, per_tick);
    p.mirror.store(i, DiscMirror::contact, at);
    p.mirror.store(i, DiscMirror::motion, moving);
    if constexpr (Ledger) book(lost_to_damping, i, lost);

    // At least the way: more by a millionth than its rounding takes away.
    V displacement = (lane_abs(vx) + lane_abs(vy)) * constant<V>(dt.drift * (1 + 1e-6)) + lane_abs(omega) * V(0);
    for (auto l = p.owned - static_cast<int>(i); l < lanes; ++l) set_lane(displacement, l, 0.0F);
    if (any(!(displacement < constant<V>(1e5)))) report(i, displacement);
    largest_displacement = lane_max(largest_displacement, Real(largest(select(displacement > V(0), displacement, V(0)))));
  }

 private:
  /// Moves places (or angles) on and stores them.
  KOKKOS_FORCEINLINE_FUNCTION LanesOfHalves add(double* to, LanesOfHalves places, V const& velocity) const {
    LanesOfHalves const rate = in_double(velocity);
    for (int h = 0; h < halves; ++h) {
      places.of[h] = places.of[h] + rate.of[h] * dt.drift;
      store(to + h * lane_count, places.of[h]);
    }
    return places;
  }
};

}  // namespace

Real integrate(ParticleSoA const& particles, MotionLaw const& law, StepLengths const& dt, AffineFrame const& frame,
               EnergyLosses const& losses, Faults const& faults) {
  bool const mixed = particles.precision == Precision::mixed;
  int const groups = group_count(particles.owned, mixed ? lane_count_of<float> : lane_count);
  int const threads = ExecutionSpace().concurrency();
  Shares const shares{groups, (groups + threads - 1) / threads};
  Real largest_displacement = 0;
  auto const run = [&](auto const& kernel) {
    Kokkos::parallel_reduce("kick_and_drift", Kokkos::RangePolicy<ExecutionSpace>(0, groups), kernel,
                            Kokkos::Max<Real>(largest_displacement));
  };
  Moving const moving{particles, law, dt, frame, losses.damping, faults, shares};
  auto const run_with = [&](auto ledger) {
    if (mixed) {
      run(KickAndDriftMixed<ledger()>{moving, 1 / particles.mirror.tick});
    } else {
      run(KickAndDrift<ledger()>{moving});
    }
  };
  if (losses.damping.extent(0) > 0) {
    run_with(std::true_type());
  } else {
    run_with(std::false_type());
  }
  return largest_displacement;
}

}  // namespace clathra
