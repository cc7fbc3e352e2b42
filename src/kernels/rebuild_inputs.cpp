#include "kernels/rebuild_inputs.hpp"

#include <algorithm>
#include <cstdint>

#include "kernels/light_launch.hpp"

namespace clathra {

namespace {

/// A number as an integer that orders likewise, so that one array holds sums and maxima; and the way back.
KOKKOS_INLINE_FUNCTION std::int64_t folded(std::int64_t bits) { return bits ^ ((bits >> 63) & INT64_MAX); }
KOKKOS_INLINE_FUNCTION std::int64_t ordered(double value) {
  std::int64_t bits;
  __builtin_memcpy(&bits, &value, sizeof bits);
  return folded(bits);
}
double number_of(std::int64_t order) {
  std::int64_t const bits = folded(order);
  double value;
  __builtin_memcpy(&value, &bits, sizeof value);
  return value;
}

/// One group of discs.
struct ReduceRebuildInputs {
  using value_type = std::int64_t[];
  static constexpr int value_number = int{RebuildInputs::sum_count} + int{RebuildInputs::largest_count};
  unsigned value_count = value_number;
  ParticleSoA p;
  ContactRows rows;
  AffineFrame frame_of_host;
  Faults faults;
  Real per_unit;
  bool bonds;
  Field<StepState> steps;  ///< whose frame it then is, or empty

  KOKKOS_FUNCTION void operator()(int group, std::int64_t* out) const {
    bool const of_steps = steps.extent(0) > 0;
    if (of_steps && !is_asked(steps(0))) return;
    AffineFrame const frame = of_steps ? steps(0).frame : frame_of_host;
    int const first = group * lane_count, end = first + lane_count < p.owned ? first + lane_count : p.owned;
    Real most[RebuildInputs::faults] = {-1e300, -1e300, -1e300, -1e300, 0, 0};
    for (int i = first; i < end; ++i) {
      Real const x = p.x(i), y = p.y(i), speed = wandering_speed(p, frame, i);
      most[RebuildInputs::leftwards] = lane_max(most[RebuildInputs::leftwards], -x);
      most[RebuildInputs::rightwards] = lane_max(most[RebuildInputs::rightwards], x);
      most[RebuildInputs::downwards] = lane_max(most[RebuildInputs::downwards], -y);
      most[RebuildInputs::upwards] = lane_max(most[RebuildInputs::upwards], y);
      most[RebuildInputs::speed] = lane_max(most[RebuildInputs::speed], speed);
      add(speed, out);
    }
    if (bonds) most[RebuildInputs::bonded_gap] = widest_gap(static_cast<std::size_t>(first));
    for (int n = 0; n < RebuildInputs::faults; ++n) raise(out, n, most[n]);
    if (group > 0) return;
    for (int fault = 0; fault < fault_count; ++fault) raise(out, RebuildInputs::faults + fault, faults.disc(fault));
  }

  KOKKOS_INLINE_FUNCTION static bool is_asked(StepState const& now) {
    return now.stop == StepStop::after_move && (now.search_is_due || now.orders.host_synchronous);
  }

  KOKKOS_INLINE_FUNCTION void add(Real speed, std::int64_t* sums) const {
    if (!FixedPoint::add(lane_min(speed, Real(1e6)) * per_unit, sums + RebuildInputs::speed_digits))
      ++sums[RebuildInputs::speeds_out_of_range];
    sums[RebuildInputs::discs] += 1;
  }

  /// Of the bonds in the rows of the group.
  KOKKOS_INLINE_FUNCTION Real widest_gap(std::size_t i) const {
    int const shift = rows.features.format.slice_shift();
    auto const slice = static_cast<int>(i >> shift);
    std::size_t const in_slice = i & ((std::size_t(1) << shift) - 1);
    Lanes const x = load(&p.x(i)), y = load(&p.y(i)), radius = load(&p.radius(i));
    Lanes widest(0);
    for (int k = rows.slice_start(slice); k < rows.slice_start(slice + 1); ++k) {
      std::size_t const e = (static_cast<std::size_t>(k) << shift) | in_slice;
      auto const bonded = is_bonded(load(rows.formation_overlap, e));
      if (!any(bonded)) continue;
      int const* const other = &rows.neighbour(e);
      Lanes const dx = gather(p.x.data(), other) - x, dy = gather(p.y.data(), other) - y;
      Lanes const gap = lane_sqrt(dx * dx + dy * dy) - (radius + gather(p.radius.data(), other));
      widest = lane_max(widest, select(bonded, gap, Lanes(0)));
    }
    return lane_max(largest(widest), Real(0));
  }

  KOKKOS_INLINE_FUNCTION static void raise(std::int64_t* out, int which, double to) {
    std::int64_t& value = out[RebuildInputs::sum_count + which];
    value = ordered(to) > value ? ordered(to) : value;
  }
  KOKKOS_FUNCTION void init(std::int64_t* values) const {
    for (int n = 0; n < value_number; ++n) values[n] = n < RebuildInputs::sum_count ? 0 : ordered(-1e300);
  }
  KOKKOS_FUNCTION void join(std::int64_t* into, std::int64_t const* from) const { join_values(into, from); }
#if KOKKOS_VERSION < 40000  // which calls join with volatile pointers
  KOKKOS_FUNCTION void join(std::int64_t volatile* into, std::int64_t const volatile* from) const { join_values(into, from); }
#endif

  template <class To, class From>
  KOKKOS_INLINE_FUNCTION void join_values(To* into, From* from) const {
    for (int n = 0; n < value_number; ++n) {
      std::int64_t const mine = into[n], other = from[n];
      into[n] = n < RebuildInputs::sum_count ? mine + other : mine > other ? mine : other;
    }
  }
};

static_assert(ReduceRebuildInputs::value_number == numbers_of_rebuild_inputs);

ReduceRebuildInputs rebuild_inputs_kernel(ParticleSoA const& particles, ContactRows const& rows, AffineFrame const& frame,
                                          Faults const& faults, SumUnits const& unit, Field<StepState> const& steps) {
  bool const bonds = rows.formation_overlap.extent(0) > 0 && rows.length.extent(0) > 0;
  return {ReduceRebuildInputs::value_number, particles, rows, frame, faults, 1 / unit.speed(), bonds, steps};
}

/// Of group_count() at least one, which reads the faults.
int groups_of_rebuild_inputs(ParticleSoA const& particles) { return std::max(group_count(particles.owned), 1); }

RebuildInputs rebuild_inputs_in(std::int64_t const* values) {
  RebuildInputs all;
  for (int n = 0; n < RebuildInputs::sum_count; ++n) all.sums[n] = values[n];
  for (int n = 0; n < RebuildInputs::largest_count; ++n) all.largest[n] = number_of(values[RebuildInputs::sum_count + n]);
  return all;
}

}  // namespace

Real RebuildInputs::mean_of_speeds(SumUnits const& unit) const {
  require_in_range("speeds of particles", sums[speeds_out_of_range]);
  Real const speeds = FixedPoint::of(sums + speed_digits).value() * unit.speed();
  return lane_max(speeds / lane_max(static_cast<Real>(sums[discs]), Real(1)), Real(1e-300));
}

Bounds RebuildInputs::bounds() const {
  if (sums[discs] == 0) return {};
  return {-largest[leftwards], largest[rightwards], -largest[downwards], largest[upwards]};
}

RebuildInputs rebuild_inputs(ParticleSoA const& particles, ContactRows const& rows, AffineFrame const& frame,
                             Faults const& faults, SumUnits const& unit) {
  std::int64_t values[ReduceRebuildInputs::value_number];
  Kokkos::parallel_reduce("rebuild_inputs", light_launch(groups_of_rebuild_inputs(particles)),
                          rebuild_inputs_kernel(particles, rows, frame, faults, unit, {}),
                          Kokkos::View<std::int64_t*, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>(
                              &values[0], ReduceRebuildInputs::value_number));
  return rebuild_inputs_in(values);
}

void enqueue_rebuild_inputs(ParticleSoA const& particles, ContactRows const& rows, Faults const& faults, SumUnits const& unit,
                            DeviceSteps const& steps, StepLaunches const& launches) {
  launches.parallel_reduce("rebuild_inputs", groups_of_rebuild_inputs(particles),
                           rebuild_inputs_kernel(particles, rows, {}, faults, unit, steps.state), steps.rebuild_inputs());
}

RebuildInputs enqueued_rebuild_inputs(StepState const& steps) { return rebuild_inputs_in(steps.rebuild_inputs); }

}  // namespace clathra
