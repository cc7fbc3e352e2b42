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
  KOKKOS_FUNCTION void operator()(int group, Real& greatest2) const { add(group, frame, greatest2); }
  KOKKOS_INLINE_FUNCTION void add(int group, AffineFrame const& by, Real& greatest2) const {
    auto const i = static_cast<std::size_t>(group) * lane_count;
    Lanes const dx = load(&p.x(i)) - (by.centre_x + by.stretch_x * (load(&x(i)) - by.reference_centre_x));
    Lanes const dy = load(&p.y(i)) - (by.centre_y + by.stretch_y * (load(&y(i)) - by.reference_centre_y));
    Lanes const skin = load(&p.verlet_skin(i));
    Lanes share2 = (dx * dx + dy * dy) / (skin * skin);
    for (auto l = p.owned - static_cast<int>(i); l < lane_count; ++l) set_lane(share2, l, 0);  // ghosts share the last group
    greatest2 = lane_max(greatest2, largest(select(share2 > Lanes(0), share2, Lanes(0))));
  }
};

/// The same since the last search, where steps have stopped in doubt.
struct StrayOfSteps {
  using value_type = Real;
  Stray discs;
  Field<StepState> steps;

  KOKKOS_FUNCTION void operator()(int group, Real& greatest2) const {
    if (in_doubt()) discs.add(group, steps(0).frame, greatest2);
  }
  KOKKOS_INLINE_FUNCTION bool in_doubt() const {
    StepState const& now = steps(0);
    return now.stop == StepStop::after_move && now.search_in_doubt && !now.orders.host_goes_along;
  }
  KOKKOS_FUNCTION void init(Real& greatest2) const { greatest2 = 0; }
  KOKKOS_FUNCTION void join(Real& into, Real const& from) const { into = lane_max(into, from); }
  // Kokkos before 4 calls join with volatile numbers.
  KOKKOS_FUNCTION void join(Real volatile& into, Real const volatile& from) const { into = lane_max(into, from); }
  /// Called once, when all are done.
  KOKKOS_FUNCTION void final(Real& greatest2) const {
    if (!in_doubt()) return;
    StepState& now = steps(0);
    now.search.strayed = lane_sqrt(greatest2);
    now.search_is_due = now.search.has_strayed(now.box, now.orders.reach, 1);
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

void ask_whether_search_is_due(ParticleSoA const& particles, DeviceSteps const& steps, StepLaunches const& launches) {
  launches.parallel_reduce("own_ways", group_count(particles.owned),
                           StrayOfSteps{{particles, particles.reference_x, particles.reference_y, {}}, steps.state},
                           steps.displacement);
}

}  // namespace clathra
