#pragma once
/// The discs as a structure of arrays: the storage of record.
#include <variant>
#include <vector>

#include "kernels/disc_mirror.hpp"
#include "kernels/disc_rows.hpp"
#include "kernels/scratch.hpp"

namespace clathra {

/// A field of whatever kind, for those who only carry it.
using AnyField = std::variant<Field<int>, Field<float>, Field<double>, RealField>;

/// Discs `0 .. owned` have neighbour rows and move; `owned .. owned + ghosts` are images of discs across a periodic boundary.
/// Behind them every field holds `widest_slice` padding discs or more of radius 0 far outside, so that vector loads may overrun
/// and unused row entries have a disc to point at. The order is spatial and changes; `id` is the identity of a disc.
struct ParticleSoA {
  Precision precision = Precision::full;
  int owned = 0;
  int ghosts = 0;
  Field<int> id;
  Field<Coord> x, y;             ///< centre [m]
  Field<Coord> angle;            ///< accumulated rotation [rad], never wrapped; in mixed precision without `rotation_increment`
  RealField vx, vy;              ///< velocity half a step behind the position [m/s]
  RealField omega;               ///< angular velocity, likewise [rad/s]
  Field<Real> radius;            ///< [m]
  RealField inverse_mass;        ///< 1 / (pi r^2 rho) [m/kg]
  RealField inverse_inertia;     ///< 2 / (m r^2) [1/(kg m)]
  RealField rotation_increment;  ///< mixed precision: the rotation since its pairs were last re-referenced for it [rad]
                                 ///< (reference_configuration.hpp)
  // Derived, not part of the state:
  RealField force_x, force_y;                ///< [N/m]
  RealField torque;                          ///< [N m/m]
  Field<Coord> reference_x, reference_y;     ///< centre at the last neighbour search [m]
  Field<Real> verlet_skin;                   ///< how far from there, beside the homogeneous motion, until the next one [m]
  DiscMirror mirror;                         ///< mixed precision: what the contact kernel reads
  [[no_unique_address]] DiscRows disc_rows;  ///< double precision on a GPU: likewise

  int all() const { return owned + ghosts; }
  /// The index of a padding disc.
  KOKKOS_FUNCTION int padding() const { return static_cast<int>(x.extent(0)) - 1; }
};

/// How the velocities, forces and masses of discs are kept.
inline NumberFormat kept_by_discs(Precision precision) {
  return {precision == Precision::full ? Storage::as_double : Storage::as_float};
}

/// What there is to know of a field of a disc beside its values.
struct DiscField {
  char const* name;
  Real padding = 0;    ///< value of a padding disc
  bool moves = false;  ///< changes in each step, and neighbours need to know it
  int mirror_at = -1;  ///< mixed precision: its column of the mirror, which is its only place; -1 for a field of its own
};
inline constexpr Coord far_outside = 1e10;  ///< where padding discs are [m]

/// The state of a disc, field by field, here and in kernels: visit(DiscField, field). It drives allocation, padding, permutation,
/// ghosts, the hash of the state, files, other ranks and byte counts, so that a new field cannot be forgotten.
CLATHRA_OF_THE_CALLERS_SIDE
template <class Particles, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_field(Particles&& p, Visit&& visit) {
  visit(DiscField{"id", -1}, p.id);
  visit(DiscField{"x", far_outside, true}, p.x);
  visit(DiscField{"y", far_outside, true}, p.y);
  visit(DiscField{"angle"}, p.angle);
  visit(DiscField{"vx", 0, true, DiscMirror::vx_at}, p.vx);
  visit(DiscField{"vy", 0, true, DiscMirror::vy_at}, p.vy);
  visit(DiscField{"omega", 0, true, DiscMirror::omega_at}, p.omega);
  visit(DiscField{"radius"}, p.radius);
  visit(DiscField{"inverse_mass", 0, false, DiscMirror::inverse_mass_at}, p.inverse_mass);
  visit(DiscField{"inverse_inertia"}, p.inverse_inertia);
  if (p.precision == Precision::full) return;
  visit(DiscField{"rotation_increment", 0, true, DiscMirror::rotation_increment_at}, p.rotation_increment);
}

/// Likewise what is computed from the state: the forces
CLATHRA_OF_THE_CALLERS_SIDE
template <class Particles, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_force(Particles& p, Visit&& visit) {
  visit(DiscField{"force_x"}, p.force_x);
  visit(DiscField{"force_y"}, p.force_y);
  visit(DiscField{"torque"}, p.torque);
}
/// and what the last neighbour search has left.
CLATHRA_OF_THE_CALLERS_SIDE
template <class Particles, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_mark_of_search(Particles& p, Visit&& visit) {
  visit(DiscField{"reference_x", far_outside}, p.reference_x);
  visit(DiscField{"reference_y", far_outside}, p.reference_y);
  visit(DiscField{"verlet_skin", 1}, p.verlet_skin);
}
CLATHRA_OF_THE_CALLERS_SIDE
template <class Particles, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_derived_field(Particles& p, Visit&& visit) {
  for_each_force(p, visit);
  for_each_mark_of_search(p, visit);
}

/// Number of groups of `lanes` discs, which kernels treat side by side.
KOKKOS_INLINE_FUNCTION int group_count(int discs, int lanes = lane_count) { return (discs + lanes - 1) / lanes; }

/// Storage for `discs` discs and their padding; the padding is filled in, the discs are not.
/// @param largest_radius  of all discs of all ranks [m]; mixed precision has its ticks from it
ParticleSoA allocate_particles(int discs, Precision precision = Precision::full, Real largest_radius = 0);

/// How much nearer two discs may seem to the contact kernel than they are [m], which neighbour searches, in double precision, add
/// to what they reach: no pair can be lost to rounding. In mixed precision each component of a branch is off by a tick at most
/// (half of one at either end), the branch by sqrt(2) ticks. Then it is rounded, with the operations on it: by half an ulp in
/// each of the components, by three in the sum of squares, of which the root has half, by half an ulp in the root, in either
/// radius and in their sum, all of numbers below 2 r_max while they touch: less than 8 half ulps of 2 r_max. In full precision:
/// none, as ever.
Real rounding_slack(ParticleSoA const& particles, Real largest_radius);

/// Derives what the contact kernel reads of the discs first .. first + count: ticks and radii in the mirror (mixed precision),
/// rows (double precision on a GPU). To be called whenever places or velocities have been changed from outside or by permute();
/// what else stands in this file and integrate() do it themselves.
void update_mirror(ParticleSoA const& particles, int first, int count);

/// Makes room for at least `discs` discs, keeping the state of the first `owned`.
void reserve(ParticleSoA& particles, int discs);

/// Writes the padding discs behind the last disc. To be called whenever the number of discs changed.
void fill_padding(ParticleSoA const& particles);

/// Reorders the owned discs: disc `order(i)` becomes disc i. Discs that `order` does not name, and ghosts, are dropped.
void permute(ParticleSoA& particles, Field<int> const& order, Scratch& scratch);

/// Adds the velocity field of a homogeneous strain rate: v += -rate * (x - centre), compression positive [1/s]; a uniform strain
/// starts without waves when the discs and not only the walls begin to move.
void add_affine_velocity(ParticleSoA const& particles, Real rate_x, Real rate_y, Coord centre_x, Coord centre_y);

/// Scales all owned centres about a fixed point: x = fixed + factor (x - fixed). @param least_y  those below it stay
void scale_positions(ParticleSoA const& particles, Real factor_x, Real factor_y, Coord fixed_x, Coord fixed_y,
                     Coord least_y = -HUGE_VAL);

/// Gathers from(order(i)) into to(i), and zeros into what is left of it.
template <class T>
struct GatherField {
  Field<T> from, to;
  Field<int> order;
  KOKKOS_FUNCTION void operator()(int i) const { to(i) = i < static_cast<int>(order.extent(0)) ? from(order(i)) : T(0); }
};
template <class T>
void gather_field(Field<T> const& from, Field<T> const& to, Field<int> const& order) {
  Kokkos::parallel_for("gather_field", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(to.extent(0))),
                       GatherField<T>{from, to, order});
}
inline void gather_field(RealField const& from, RealField const& to, Field<int> const& order) {
  visit_as_kept(from, [&]<class T>(Field<T> const& numbers) { gather_field(numbers, to.as<T>(), order); });
}
/// `field` in the order `order`, as permute() does, in `size` places.
template <class AField>
AField permuted(AField const& field, Field<int> const& order, std::size_t size, Scratch& scratch) {
  AField const to = take_like(scratch, field, "permuted", size);
  gather_field(field, to, order);
  return to;
}

/// In mixed precision: discs that have rotated far count on from zero. Their pairs have been re-referenced for that by the
/// forces; a step does it by itself.
void count_turns_on(ParticleSoA const& particles);

/// Accumulated rotations of the owned discs [rad], on the host.
std::vector<double> rotations(ParticleSoA const& particles);

/// Sets all velocities to zero.
void stop_motion(ParticleSoA const& particles);

/// Bytes held by the fields.
std::size_t bytes(ParticleSoA const& particles);

}  // namespace clathra
