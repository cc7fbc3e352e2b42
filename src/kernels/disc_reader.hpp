#pragma once
/// How the contact kernel reads discs and writes their accounts, in either precision.
#include <type_traits>

#include "kernels/particles.hpp"

namespace clathra {

/// @tparam P  FullPrecision or MixedPrecision;  @tparam Motion,Masses  whether velocities and masses are read
template <class P, bool Motion, bool Masses>
struct DiscReader {
  using R = typename P::Real;
  using V = LanesOf<R>;
  using VMask = MaskOf<V>;
  static constexpr bool mixed = P::precision == Precision::mixed;
  static constexpr bool moves = Motion;
  static constexpr int lanes = lane_count_of<R>;

  /// Places, which only their differences are taken of.
  using Places = std::conditional_t<mixed, IntLanes, Lanes>;

  /// How discs move.
  struct MotionOf {
    V vx, vy, omega, inverse_mass;
  };
  /// The discs of a group.
  struct Own {
    Places x, y;
    V radius, rotation_increment;
    MotionOf motion;  ///< where it is read
  };
  KOKKOS_FORCEINLINE_FUNCTION static Own own(ParticleSoA const& p, std::size_t first) {
    if constexpr (mixed) {
      PlacesOfDiscs const at = p.mirror.load_places(first);
      if constexpr (Motion) return {bits_of(at.x), bits_of(at.y), at.radius, at.rotation_increment, own_motion(p, first)};
      return {bits_of(at.x), bits_of(at.y), at.radius, at.rotation_increment, {}};
    } else if constexpr (for_gpu) {
      DiscRow const& row = p.disc_rows.of(static_cast<int>(first));
      V const inverse_mass = Masses ? load(p.inverse_mass.data<R>() + first) : V(0);
      return {row.x, row.y, row.radius, V(0), {row.vx, row.vy, row.omega, inverse_mass}};
    } else {
      return {load(&p.x(first)), load(&p.y(first)), load(&p.radius(first)), V(0), own_motion(p, first)};
    }
  }
  KOKKOS_FORCEINLINE_FUNCTION static MotionOf own_motion(ParticleSoA const& p, std::size_t first) {
    if constexpr (mixed) {
      MotionOfDiscs const m = p.mirror.load_motion(first);
      return {m.vx, m.vy, m.omega, m.inverse_mass};
    } else {
      return {load(p.vx.data<R>() + first), load(p.vy.data<R>() + first), load(p.omega.data<R>() + first),
              Masses ? load(p.inverse_mass.data<R>() + first) : V(0)};
    }
  }

  /// What the test for touch needs of the neighbours: branches [m], in mixed precision in ticks,
  /// exact to half a tick at either end and then rounded once, and radii [m].
  struct Other {
    V dx, dy, radius;
    Places ticks_x, ticks_y;  ///< mixed precision: branches before they are rounded
    V rotation_increment;     ///< likewise: ParticleSoA::rotation_increment
  };
  KOKKOS_FORCEINLINE_FUNCTION static Other other(ParticleSoA const& p, int const* j, Own const& own) {
    if constexpr (mixed) {
      PlacesOfDiscs const at = p.mirror.gather_places(j);
      Places const dx = difference(bits_of(at.x), own.x), dy = difference(bits_of(at.y), own.y);
      return {to_float(dx), to_float(dy), at.radius, dx, dy, at.rotation_increment};
    } else if constexpr (for_gpu) {
      DiscRow const& row = p.disc_rows.of(*j);
      return {row.x - own.x, row.y - own.y, row.radius, {}, {}, V(0)};
    } else {
      return {gather(p.x.data(), j) - own.x, gather(p.y.data(), j) - own.y, gather(p.radius.data(), j), Lanes(0), Lanes(0), V(0)};
    }
  }
  KOKKOS_FORCEINLINE_FUNCTION static MotionOf other_motion(ParticleSoA const& p, int const* j) {
    if constexpr (mixed) {
      MotionOfDiscs const read = p.mirror.gather_motion(j);
      return {read.vx, read.vy, read.omega, read.inverse_mass};
    } else if constexpr (for_gpu) {
      DiscRow const& row = p.disc_rows.of(*j);
      return {row.vx, row.vy, row.omega, Masses ? gather(p.inverse_mass.data<R>(), j) : V(0)};
    } else {
      return {gather(p.vx.data<R>(), j), gather(p.vy.data<R>(), j), gather(p.omega.data<R>(), j),
              Masses ? gather(p.inverse_mass.data<R>(), j) : V(0)};
    }
  }

  /// The square of a branch; one of ticks is a little more than zero, for the same reason as distance_of().
  KOKKOS_FORCEINLINE_FUNCTION static V squared(V const& dx, V const& dy) {
    if constexpr (mixed)
      return multiply_add(dx, dx, multiply_add(dy, dy, constant<V>(1e-12)));
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
  /// The square of a reach [m] in what branches count in; below zero for a padding disc, whose radius is.
  KOKKOS_FORCEINLINE_FUNCTION static V squared_reach(V const& reach, [[maybe_unused]] R per_tick) {
    if constexpr (!mixed) return reach * reach;
    V const of_branch = reach * per_tick;
    return of_branch * lane_abs(of_branch);
  }
  /// reach - distance [m]
  /// @param distance  in what branches count in
  KOKKOS_FORCEINLINE_FUNCTION static V overlap_at(V const& distance, V const& reach, [[maybe_unused]] R tick) {
    if constexpr (mixed)
      return negative_multiply_add(distance, V(tick), reach);
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
      for (int line = 0; line < lines; ++line) {
        prefetch(DiscMirror::numbers(p.mirror.places) + i * DiscMirror::row + line * 16);
        if constexpr (Motion) prefetch(DiscMirror::numbers(p.mirror.motion) + i * DiscMirror::row + line * 16);
      }
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
  KOKKOS_FORCEINLINE_FUNCTION static void add_dissipation(Field<Accum> const& account, std::size_t first, V const& loss) {
    if constexpr (mixed) {
      clathra::add_dissipation(account, first, loss);
    } else {
      store(&account(first), load(&account(first)) + loss);
    }
  }
};

}  // namespace clathra
