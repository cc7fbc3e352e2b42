#pragma once
/// How the contact kernel reads discs and writes their accounts, in either precision.
#include <type_traits>

#include "kernels/history.hpp"

namespace clathra {

/// @tparam P  FullPrecision or MixedPrecision;  @tparam Masses  whether masses are read
template <class P, bool Masses>
struct DiscReader {
  using R = typename P::Real;
  using V = LanesOf<R>;
  using VMask = MaskOf<V>;
  static constexpr bool mixed = P::precision == Precision::mixed;
  static constexpr int lanes = lane_count_of<R>;

  /// Places, which only their differences are taken of.
  using Places = std::conditional_t<mixed, IntLanes, Lanes>;

  /// The discs of a group.
  struct Own {
    Places x, y;
    V vx, vy, omega, radius, inverse_mass;
  };
  KOKKOS_FORCEINLINE_FUNCTION static Own own(ParticleSoA const& p, std::size_t first) {
    if constexpr (mixed) {
      RowsOfDiscs const rows = p.mirror.load(first);
      return {bits_of(rows.places.x), bits_of(rows.places.y), rows.motion.vx,          rows.motion.vy,
              rows.places.omega,      rows.places.radius,     rows.motion.inverse_mass};
    } else if constexpr (for_gpu) {
      DiscRow const& row = p.disc_rows.of(static_cast<int>(first));
      return {row.x, row.y, row.vx, row.vy, row.omega, row.radius, Masses ? load(p.inverse_mass.data<R>() + first) : V(0)};
    } else {
      return {load(&p.x(first)),
              load(&p.y(first)),
              load(p.vx.data<R>() + first),
              load(p.vy.data<R>() + first),
              load(p.omega.data<R>() + first),
              load(&p.radius(first)),
              Masses ? load(p.inverse_mass.data<R>() + first) : V(0)};
    }
  }

  /// What the test for touch needs of the neighbours: branches [m], in mixed precision in ticks,
  /// exact to half a tick at either end and then rounded once, and radii [m].
  struct Other {
    V dx, dy, radius;
  };
  struct OtherMotion {
    V vx, vy, omega, inverse_mass;
  };
  /// @param wanted  whether the motion is needed for sure: in mixed precision it is read along;  @param motion  set then
  KOKKOS_FORCEINLINE_FUNCTION static Other other(ParticleSoA const& p, int const* j, Own const& own, [[maybe_unused]] bool wanted,
                                                 [[maybe_unused]] OtherMotion& motion) {
    if constexpr (mixed) {
      PlacesOfDiscs at;
      if (wanted) {
        RowsOfDiscs const rows = p.mirror.gather(j);
        at = rows.places;
        motion = {rows.motion.vx, rows.motion.vy, at.omega, rows.motion.inverse_mass};
      } else {
        at = p.mirror.gather_places(j);
        motion.omega = at.omega;
      }
      return {to_float(difference(bits_of(at.x), own.x)), to_float(difference(bits_of(at.y), own.y)), at.radius};
    } else if constexpr (for_gpu) {
      DiscRow const& row = p.disc_rows.of(*j);
      return {row.x - own.x, row.y - own.y, row.radius};
    } else {
      return {gather(p.x.data(), j) - own.x, gather(p.y.data(), j) - own.y, gather(p.radius.data(), j)};
    }
  }
  /// Sets what other() has not.
  KOKKOS_FORCEINLINE_FUNCTION static void complete(ParticleSoA const& p, int const* j, [[maybe_unused]] bool wanted,
                                                   OtherMotion& motion) {
    if constexpr (mixed) {
      if (wanted) return;
      MotionOfDiscs const read = p.mirror.gather_motion(j);
      motion = {read.vx, read.vy, motion.omega, read.inverse_mass};
    } else if constexpr (for_gpu) {
      DiscRow const& row = p.disc_rows.of(*j);
      motion = {row.vx, row.vy, row.omega, Masses ? gather(p.inverse_mass.data<R>(), j) : V(0)};
    } else {
      motion = {gather(p.vx.data<R>(), j), gather(p.vy.data<R>(), j), gather(p.omega.data<R>(), j),
                Masses ? gather(p.inverse_mass.data<R>(), j) : V(0)};
    }
  }

  /// The square of a branch; one of ticks is a little more than zero, for the same reason as distance_of().
  KOKKOS_FORCEINLINE_FUNCTION static V squared(V const& dx, V const& dy) {
    if constexpr (mixed)
      return times_plus(dx, dx, times_plus(dy, dy, constant<V>(1e-30)));
    else
      return dx * dx + dy * dy;
  }
  /// More than zero, so that discs in the same place have no direction instead of one that is no number.
  KOKKOS_FORCEINLINE_FUNCTION static V distance_of(V const& distance2) {
    if constexpr (mixed)
      return lane_sqrt(distance2);
    else
      return lane_max(lane_sqrt(distance2), constant<V>(1e-30));
  }
  /// A length [m] in what branches count in.
  KOKKOS_FORCEINLINE_FUNCTION static V as_branch(V const& length, [[maybe_unused]] R per_tick) {
    if constexpr (mixed)
      return length * per_tick;
    else
      return length;
  }
  /// reach - distance [m]
  /// @param distance  in what branches count in
  KOKKOS_FORCEINLINE_FUNCTION static V overlap_at(V const& distance, V const& reach, [[maybe_unused]] R tick) {
    if constexpr (mixed)
      return minus_times(distance, V(tick), reach);
    else
      return reach - distance;
  }

  /// Neighbours lie scattered, and a load that waits for the outer caches holds up everything behind it. So the discs some groups
  /// ahead are fetched in their order, before a neighbour needs them.
  /// @param ahead  how many discs, discs_ahead()
  KOKKOS_FORCEINLINE_FUNCTION static void fetch_ahead(ParticleSoA const& p, std::size_t first, std::size_t ahead) {
    std::size_t const wanted = first + ahead, last = p.x.extent(0) - 1;
    std::size_t const i = wanted < last ? wanted : last;
    if constexpr (mixed) {
      constexpr int lines = static_cast<int>(lanes * DiscMirror::row * sizeof(float) / 64);
      for (int line = 0; line < lines; ++line) prefetch(p.mirror.numbers() + i * DiscMirror::row + line * 16);
    } else {
      prefetch(&p.x(i));
      prefetch(&p.y(i));
      prefetch(&p.radius(i));
      prefetch(p.vx.data<R>() + i);
      prefetch(p.vy.data<R>() + i);
      prefetch(p.omega.data<R>() + i);
    }
  }

  /// Adds a group's losses to its accounts, which are sums in double precision.
  KOKKOS_FORCEINLINE_FUNCTION static void book(Field<Accum> const& account, std::size_t first, V const& loss) {
    if constexpr (mixed) {
      clathra::book(account, first, loss);
    } else {
      store(&account(first), load(&account(first)) + loss);
    }
  }
};

}  // namespace clathra
