#include "kernels/integrate.hpp"

#include <algorithm>
#include <type_traits>

#include "kernels/reference_configuration.hpp"
#include "kernels/verlet_skin.hpp"

namespace clathra {

namespace {

/// Velocity after a kick by `force` with local damping against the velocity relative to `frame`; `lost` gains the damping's work.
template <bool Ledger, class L>
KOKKOS_FORCEINLINE_FUNCTION L kicked(L const& velocity, L const& frame, L const& force, L const& inverse_mass, scalar_of<L> alpha,
                                     scalar_of<L> dt, L& lost) {
  L const relative = velocity - frame;
  L const damping = select(relative != L(0), lane_copysign(alpha * force, relative), L(0));
  L const after = velocity + (force - damping) * inverse_mass * dt;
  if constexpr (Ledger) lost += damping * (constant<L>(0.5) * (velocity + after)) * dt;
  return after;
}

/// What a step of motion needs to know, in either precision.
struct Moving {
  ParticleSoA p;
  MotionLaw law;
  StepLengths dt;
  Field<StepState> steps;
  Field<Accum> lost_to_damping;
  Faults faults;

  /// @param displacement  of the discs i .., of which those without a finite one are faults
  template <class L>
  KOKKOS_FUNCTION void report(std::size_t i, L const& displacement) const {
    for (int l = 0; l < lane_count_of<scalar_of<L>>; ++l) {
      if (!(lane(displacement, l) < 1e5)) faults.report(Fault::not_finite, p.id(i + static_cast<std::size_t>(l)));
    }
  }
  /// The displacements of owned discs; ghosts share the last group.
  template <class L>
  KOKKOS_FORCEINLINE_FUNCTION L of_owned(std::size_t i, L const& displacement) const {
    constexpr int lanes = lane_count_of<scalar_of<L>>;
    int const left = p.owned - static_cast<int>(i);
    return left < lanes ? select(first_lanes<scalar_of<L>>(left), displacement, L(0)) : displacement;
  }
};

/// Numbers of a step, on the stack of who goes through many groups, where no store can change them.
template <class R>
struct MotionConstants {
  R damping, kick, pull_x, pull_y;
  Real drift, per_tick;
  AffineFrame frame;
  explicit KOKKOS_FUNCTION MotionConstants(Moving const& m)
      : damping(static_cast<R>(m.law.damping)),
        kick(static_cast<R>(m.dt.kick)),
        pull_x(static_cast<R>(m.law.gravity_x * m.dt.kick)),
        pull_y(static_cast<R>(m.law.gravity_y * m.dt.kick)),
        drift(m.dt.drift),
        per_tick(1 / m.p.mirror.tick),
        frame(m.steps(0).frame) {
    if (!m.law.in_frame) frame.gradient = {}, frame.drift_x = frame.drift_y = 0;
  }
};

/// Kick and drift.
template <bool Ledger>
struct KickAndDrift : Moving {
  using R = Real;

  /// One group of discs, from i on. @return their displacements [m]
  KOKKOS_FORCEINLINE_FUNCTION Lanes step(MotionConstants<R> const& by, std::size_t i) const {
    Lanes const inverse_mass = load(p.inverse_mass.data<Real>() + i);
    auto const free = inverse_mass > Lanes(0);  // padding discs have none
    Lanes lost(0);
    Real* const vx_of = p.vx.data<Real>() + i;
    Real* const vy_of = p.vy.data<Real>() + i;
    Real* const omega_of = p.omega.data<Real>() + i;
    Lanes const fx = load(p.force_x.data<Real>() + i), fy = load(p.force_y.data<Real>() + i);
    Lanes const x0 = load(&p.x(i)), y0 = load(&p.y(i));
    Lanes const vx = kicked<Ledger>(load(vx_of), by.frame.velocity_x(x0, y0), fx, inverse_mass, by.damping, by.kick, lost) +
                     select(free, Lanes(by.pull_x), Lanes(0));
    Lanes const vy = kicked<Ledger>(load(vy_of), by.frame.velocity_y(y0), fy, inverse_mass, by.damping, by.kick, lost) +
                     select(free, Lanes(by.pull_y), Lanes(0));
    Lanes const omega = kicked<Ledger>(load(omega_of), Lanes(0), load(p.torque.data<Real>() + i),
                                       load(p.inverse_inertia.data<Real>() + i), by.damping, by.kick, lost);
    Lanes const x = x0 + vx * by.drift, y = y0 + vy * by.drift;
    store(vx_of, vx);
    store(vy_of, vy);
    store(omega_of, omega);
    store(&p.x(i), x);
    store(&p.y(i), y);
    store(&p.angle(i), load(&p.angle(i)) + omega * by.drift);
    p.disc_rows.set(i, x, y, p.radius(i), vx, vy, omega);
    if constexpr (Ledger) store(&lost_to_damping(i), load(&lost_to_damping(i)) + lost);
    return lane_abs(x - x0) + lane_abs(y - y0) + lane_abs(omega) * Lanes(0);
  }
};

/// The same in mixed precision: velocities in single precision, places and angles in double.
template <bool Ledger>
struct KickAndDriftMixed : Moving {
  using R = float;
  using V = FloatLanes;

  KOKKOS_FORCEINLINE_FUNCTION V step(MotionConstants<R> const& by, std::size_t i) const {
    PlacesOfDiscs places = p.mirror.load_places(i);
    MotionOfDiscs motion = p.mirror.load_motion(i);
    fetch_ahead(i);
    V &vx = motion.vx, &vy = motion.vy, &omega = motion.omega;
    V const inverse_mass = motion.inverse_mass, inverse_inertia = load(p.inverse_inertia.data<float>() + i);
    if (auto const far = has_rotated_far(places.rotation_increment); any(far)) {
      count_on(far, i);
      places.rotation_increment = rotation_from_now_on(places.rotation_increment);
    }
    LanesOfHalves x = load_halves(&p.x(i)), y = load_halves(&p.y(i));
    AffineFrame const& frame = by.frame;
    V const from_x = from_centre(x, frame.centre_x), from_y = from_centre(y, frame.centre_y);
    // Velocity of the homogeneous motion, from the exact distances from its centre.
    V const frame_x = multiply_add(single(frame.gradient.xx), from_x,
                                   multiply_add(single(frame.gradient.xy), from_y, single(frame.drift_x))),
            frame_y = multiply_add(single(frame.gradient.yy), from_y, single(frame.drift_y));
    V const of_force = inverse_mass * by.kick;
    V lost(0);
    vx = kicked_mixed(vx, frame_x, load(p.force_x.data<float>() + i), of_force, by, lost);
    vy = kicked_mixed(vy, frame_y, load(p.force_y.data<float>() + i), of_force, by, lost);
    omega = kicked_mixed(omega, V(0), load(p.torque.data<float>() + i), inverse_inertia * by.kick, by, lost);
    if (by.pull_x != 0 || by.pull_y != 0) {
      auto const free = inverse_mass > V(0);  // padding discs have none
      vx += select(free, V(by.pull_x), V(0));
      vy += select(free, V(by.pull_y), V(0));
    }
    places.rotation_increment = multiply_add(omega, V(static_cast<R>(by.drift)), places.rotation_increment);
    x = move(&p.x(i), x, vx, by.drift);
    y = move(&p.y(i), y, vy, by.drift);
    places.x = ticks_of(x, by.per_tick);
    places.y = ticks_of(y, by.per_tick);
    p.mirror.store(i, places);
    p.mirror.store(i, motion);
    if constexpr (Ledger) add_dissipation(lost_to_damping, i, lost);
    // At least the way: more by a millionth than its rounding takes away. No number where a spin or a place is none, whose frame
    // has no velocity either.
    return multiply_add(lane_abs(vx) + lane_abs(vy), constant<V>(by.drift * (1 + 1e-6)), (omega + frame_x + frame_y) * V(0));
  }

 private:
  /// kicked(), where a product and a sum may be one operation.
  /// @param of_force  the velocity that a force gives: dt over the inertia
  KOKKOS_FORCEINLINE_FUNCTION static V kicked_mixed(V const& velocity, V const& frame, V const& force, V const& of_force,
                                                    MotionConstants<R> const& by, [[maybe_unused]] V& lost) {
    V const relative = velocity - frame;
    V const damping = select(relative != V(0), lane_copysign(by.damping * force, relative), V(0));
    V const after = multiply_add(force - damping, of_force, velocity);
    if constexpr (Ledger) lost += damping * (constant<V>(0.5) * (velocity + after)) * by.kick;
    return after;
  }

  KOKKOS_FORCEINLINE_FUNCTION static V from_centre(LanesOfHalves places, Coord centre) {
    for (Lanes& half : places.of) half = half - Lanes(centre);
    return in_single(places);
  }
  KOKKOS_FORCEINLINE_FUNCTION static V single(Real number) { return V(static_cast<R>(number)); }

  /// Their pairs have been re-referenced: the discs count their rotation from now on.
  CLATHRA_COLD_FUNCTION void count_on(MaskOf<V> const& far, std::size_t i) const {
    for_each_set(far, [&](int l) { p.angle(i + static_cast<std::size_t>(l)) += p.rotation_increment(static_cast<int>(i) + l); });
  }

  /// Rows of discs that come later, backwards (perf/reports/0.1/performance.md).
  KOKKOS_FORCEINLINE_FUNCTION void fetch_ahead(std::size_t i) const {
    constexpr std::size_t discs_ahead = 256, numbers_a_line = 16;
    std::size_t const wanted = DiscMirror::row * (i >= discs_ahead ? i - discs_ahead : 0);
    for (std::size_t n = 0; n < DiscMirror::row * lane_count_of<R>; n += numbers_a_line) {
      prefetch(DiscMirror::numbers(p.mirror.places) + wanted + n);
      prefetch(DiscMirror::numbers(p.mirror.motion) + wanted + n);
    }
  }

  /// Moves places on and stores them.
  KOKKOS_FORCEINLINE_FUNCTION static LanesOfHalves move(double* to, LanesOfHalves places, V const& velocity, Real drift) {
    LanesOfHalves const rate = in_double(velocity);
    for (int h = 0; h < halves; ++h) {
      places.of[h] = fused_multiply_add(rate.of[h], Lanes(drift), places.of[h]);
      store(to + h * lane_count, places.of[h]);
    }
    return places;
  }
};

/// The reduction to the largest displacements, with the end of the move.
template <class Kernel>
struct LargestOfDiscs {
  using value_type = LargestDisplacements;
  Kernel kernel;

  KOKKOS_FUNCTION void init(LargestDisplacements& largest_of) const { largest_of = {}; }
  KOKKOS_FUNCTION void join(LargestDisplacements& into, LargestDisplacements const& from) const { join_each(into, from); }
  // Kokkos before 4 calls join with volatile numbers.
  KOKKOS_FUNCTION void join(LargestDisplacements volatile& into, LargestDisplacements const volatile& from) const {
    join_each(into, from);
  }
  /// Called once, when all are done.
  KOKKOS_FUNCTION void final(LargestDisplacements& largest_of) const {
    if (!is_stopped(kernel.steps)) kernel.steps(0).end_move(largest_of);
  }

 private:
  template <class To, class From>
  KOKKOS_FORCEINLINE_FUNCTION static void join_each(To& into, From& from) {
    into.of_step = lane_max(Real(into.of_step), Real(from.of_step));
    into.since_search2 = lane_max(Real(into.since_search2), Real(from.since_search2));
    into.since_update2 = lane_max(Real(into.since_update2), Real(from.since_update2));
  }
};

/// The groups of one thread, backwards, since what the forces touched last is still in its cache.
template <class Kernel>
struct ByShares : LargestOfDiscs<Kernel> {
  int groups, share;  ///< in all, and of a thread
  using LargestOfDiscs<Kernel>::kernel;

  KOKKOS_FUNCTION void operator()(int n, LargestDisplacements& largest_of) const {
    if (is_stopped(kernel.steps)) return;
    using R = typename Kernel::R;
    using V = LanesOf<R>;
    MotionConstants<R> const by(kernel);
    int const first = n * share, next = first + share < groups ? first + share : groups;
    V most(0);
    for (int group = next - 1; group >= first; --group) {
      auto const i = static_cast<std::size_t>(group) * lane_count_of<R>;
      V const displacement = kernel.of_owned(i, kernel.step(by, i));
      if (any(!(displacement < constant<V>(1e5)))) kernel.report(i, displacement);
      most = lane_max(displacement, most);  // not one that is no number
    }
    largest_of.of_step = lane_max(largest_of.of_step, Real(largest(most)));
  }
};

/// On a GPU a disc a thread, so that neighbouring threads touch neighbouring discs.
template <class Kernel>
struct ByDiscs : LargestOfDiscs<Kernel> {
  UpdatePlaces at_update;
  using LargestOfDiscs<Kernel>::kernel;

  KOKKOS_FUNCTION void operator()(int i, LargestDisplacements& largest_of) const {
    if (is_stopped(kernel.steps)) return;
    using R = typename Kernel::R;
    auto const disc = static_cast<std::size_t>(i);
    auto const displacement = kernel.of_owned(disc, kernel.step(MotionConstants<R>(kernel), disc));
    if (any(!(displacement < constant<LanesOf<R>>(1e5)))) kernel.report(disc, displacement);
    largest_of.of_step = lane_max(Real(largest(displacement)), largest_of.of_step);
    StepState const& now = kernel.steps(0);
    ParticleSoA const& p = kernel.p;
    if (now.measures_since_search)
      largest_of.since_search2 =
          lane_max(largest_of.since_search2, nonaffine_displacement2(p, p.reference_x, p.reference_y, now.frame, i));
    if (now.measures_since_update)
      largest_of.since_update2 =
          lane_max(largest_of.since_update2, nonaffine_displacement2(p, at_update.x, at_update.y, now.frame_since_update, i));
  }
};

}  // namespace

void integrate(ParticleSoA const& particles, MotionLaw const& law, StepLengths const& dt, Dissipation const& losses,
               Faults const& faults, DeviceSteps const& steps, UpdatePlaces const& at_update, StepLaunches const& launches) {
  bool const mixed = particles.precision == Precision::mixed;
  int const groups = group_count(particles.owned, mixed ? lane_count_of<float> : lane_count);
  int const threads = ExecutionSpace().concurrency(), share = std::max(1, (groups + threads - 1) / threads);
  auto const run = [&]<class Kernel>(std::type_identity<Kernel>) {
    if constexpr (for_gpu) {
      static_assert(lane_count_of<float> == 1 && lane_count == 1);
      launches.parallel_reduce("kick_and_drift", groups, uncounted([&] {
                                 return ByDiscs<Kernel>{{{{particles, law, dt, steps.state, losses.damping, faults}}}, at_update};
                               }),
                               steps.displacements);
    } else {
      launches.parallel_reduce(
          "kick_and_drift", (groups + share - 1) / share, uncounted([&] {
            return ByShares<Kernel>{{{{particles, law, dt, steps.state, losses.damping, faults}}}, groups, share};
          }),
          steps.displacements);
    }
  };
  auto const run_with = [&](auto ledger) {
    if (mixed) {
      run(std::type_identity<KickAndDriftMixed<ledger()>>());
    } else {
      run(std::type_identity<KickAndDrift<ledger()>>());
    }
  };
  if (losses.damping.extent(0) > 0) {
    run_with(std::true_type());
  } else {
    run_with(std::false_type());
  }
}

}  // namespace clathra
