#pragma once
/// The discs as a structure of arrays: the storage of record.
#include <variant>

#include "kernels/lane.hpp"

namespace clathra {

/// A field of whatever kind, for those who only carry it.
using AnyField = std::variant<Field<int>, Field<float>, Field<double>>;

/// Discs `0 .. owned` have neighbour rows and move; `owned .. owned + ghosts` are images of discs across a periodic boundary.
/// Behind them every field holds `slice_width` padding discs or more of radius 0 far outside, so that vector loads may overrun
/// and unused row entries have a disc to point at. The order is spatial and changes; `id` is the identity of a disc.
struct ParticleSoA {
  int owned = 0;
  int ghosts = 0;
  Field<int> id;
  Field<Coord> x, y;            ///< centre [m]
  Field<Coord> angle;           ///< accumulated rotation [rad], never wrapped
  Field<Real> vx, vy;           ///< velocity half a step behind the position [m/s]
  Field<Real> omega;            ///< angular velocity, likewise [rad/s]
  Field<Real> radius;           ///< [m]
  Field<Real> inverse_mass;     ///< 1 / (pi r^2 rho) [m/kg]
  Field<Real> inverse_inertia;  ///< 2 / (m r^2) [1/(kg m)]
  // Derived, not part of the state:
  Field<Real> force_x, force_y;           ///< [N/m]
  Field<Real> torque;                     ///< [N m/m]
  Field<Coord> reference_x, reference_y;  ///< centre at the last neighbour search [m]
  Field<Real> verlet_skin;                ///< how far from there, beside the homogeneous motion, until the next one [m]

  int all() const { return owned + ghosts; }
  /// The index of a padding disc.
  KOKKOS_FUNCTION int padding() const { return static_cast<int>(x.extent(0)) - 1; }
};

/// What there is to know of a field of a disc beside its values.
struct DiscField {
  char const* name;
  Real padding = 0;    ///< value of a padding disc
  bool moves = false;  ///< changes in each step, and neighbours need to know it
};
inline constexpr Coord far_outside = 1e10;  ///< where padding discs are [m]

/// The state of a disc, field by field, here and in kernels: visit(DiscField, field). It drives allocation, padding, permutation,
/// ghosts, the hash of the state, files, other ranks and byte counts, so that a new field cannot be forgotten.
template <class Particles, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_field(Particles&& p, Visit&& visit) {
  visit(DiscField{"id", -1}, p.id);
  visit(DiscField{"x", far_outside, true}, p.x);
  visit(DiscField{"y", far_outside, true}, p.y);
  visit(DiscField{"angle"}, p.angle);
  visit(DiscField{"vx", 0, true}, p.vx);
  visit(DiscField{"vy", 0, true}, p.vy);
  visit(DiscField{"omega", 0, true}, p.omega);
  visit(DiscField{"radius"}, p.radius);
  visit(DiscField{"inverse_mass"}, p.inverse_mass);
  visit(DiscField{"inverse_inertia"}, p.inverse_inertia);
}

/// Likewise what is computed from the state: the forces
template <class Particles, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_force(Particles& p, Visit&& visit) {
  visit(DiscField{"force_x"}, p.force_x);
  visit(DiscField{"force_y"}, p.force_y);
  visit(DiscField{"torque"}, p.torque);
}
/// and what the last neighbour search has left.
template <class Particles, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_mark_of_search(Particles& p, Visit&& visit) {
  visit(DiscField{"reference_x", far_outside}, p.reference_x);
  visit(DiscField{"reference_y", far_outside}, p.reference_y);
  visit(DiscField{"verlet_skin", 1}, p.verlet_skin);
}
template <class Particles, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_derived_field(Particles& p, Visit&& visit) {
  for_each_force(p, visit);
  for_each_mark_of_search(p, visit);
}

/// Number of slices of `slice_width` discs that cover `discs`.
KOKKOS_INLINE_FUNCTION int slice_count(int discs) { return (discs + slice_width - 1) / slice_width; }
/// Number of groups of `lane_count` discs, which kernels treat side by side.
KOKKOS_INLINE_FUNCTION int group_count(int discs) { return (discs + lane_count - 1) / lane_count; }

/// Storage for `discs` discs and their padding; the padding is filled in, the discs are not.
ParticleSoA allocate_particles(int discs);

/// Makes room for at least `discs` discs, keeping the state of the first `owned`.
void reserve(ParticleSoA& particles, int discs);

/// Writes the padding discs behind the last disc. To be called whenever the number of discs changed.
void fill_padding(ParticleSoA const& particles);

/// Reorders the owned discs: disc `order(i)` becomes disc i. Discs that `order` does not name, and ghosts, are dropped.
void permute(ParticleSoA& particles, Field<int> const& order);

/// Adds the velocity field of a homogeneous strain rate: v += -rate * (x - centre), compression positive [1/s]; a uniform strain
/// starts without waves when the discs and not only the walls begin to move.
void add_affine_velocity(ParticleSoA const& particles, Real rate_x, Real rate_y, Coord centre_x, Coord centre_y);

/// Scales all owned centres about a fixed point: x = fixed + factor (x - fixed).
void scale_positions(ParticleSoA const& particles, Real factor, Coord fixed_x, Coord fixed_y);

/// Gathers from(order(i)) into to(i).
template <class T>
struct GatherField {
  Field<T> from, to;
  Field<int> order;
  KOKKOS_FUNCTION void operator()(int i) const { to(i) = from(order(i)); }
};

/// `field` in the order `order`, as permute() does, in a new field of `size` places.
template <class T>
Field<T> permuted(Field<T> const& field, Field<int> const& order, std::size_t size) {
  Field<T> const to(field.label(), size);
  Kokkos::parallel_for("permuted", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(order.extent(0))),
                       GatherField<T>{field, to, order});
  return to;
}

/// Sets all velocities to zero.
void stop_motion(ParticleSoA const& particles);

/// Bytes held by the fields.
std::size_t bytes(ParticleSoA const& particles);

}  // namespace clathra
