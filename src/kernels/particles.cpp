#include "kernels/particles.hpp"

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>

namespace clathra {

namespace {

/// Visits the fields that are computed from the state.
template <class Visit>
void for_each_derived_field(ParticleSoA& p, Visit&& visit) {
  visit("force_x", p.force_x);
  visit("force_y", p.force_y);
  visit("torque", p.torque);
  visit("reference_x", p.reference_x);
  visit("reference_y", p.reference_y);
  visit("leeway", p.leeway);
}

template <class T>
struct Gather {
  Field<T> from, to;
  Field<int> order;
  KOKKOS_FUNCTION void operator()(int i) const { to(i) = from(order(i)); }
};

struct FillPadding {
  ParticleSoA p;
  int first;
  KOKKOS_FUNCTION void operator()(int k) const {
    int const i = first + k;
    p.id(i) = -1;
    p.x(i) = p.y(i) = p.reference_x(i) = p.reference_y(i) = 1e10;
    p.angle(i) = p.vx(i) = p.vy(i) = p.omega(i) = p.radius(i) = p.inverse_mass(i) = p.inverse_inertia(i) = 0;
    p.force_x(i) = p.force_y(i) = p.torque(i) = 0;
    p.leeway(i) = 1;
  }
};

struct AddAffineVelocity {
  ParticleSoA p;
  Real rate_x, rate_y;
  Coord centre_x, centre_y;
  KOKKOS_FUNCTION void operator()(int i) const {
    p.vx(i) -= rate_x * (p.x(i) - centre_x);
    p.vy(i) -= rate_y * (p.y(i) - centre_y);
  }
};

struct ScalePositions {
  ParticleSoA p;
  Real factor;
  Coord fixed_x, fixed_y;
  KOKKOS_FUNCTION void operator()(int i) const {
    p.x(i) = fixed_x + factor * (p.x(i) - fixed_x);
    p.y(i) = fixed_y + factor * (p.y(i) - fixed_y);
  }
};

}  // namespace

ParticleSoA allocate_particles(int discs) {
  ParticleSoA particles;
  reserve(particles, discs);
  particles.owned = discs;
  fill_padding(particles);
  return particles;
}

void reserve(ParticleSoA& particles, int discs) {
  std::size_t const wanted = static_cast<std::size_t>(slice_count(discs) + 1) * lane_count + 1;
  if (particles.x.extent(0) >= wanted) return;
  std::size_t const size = particles.x.extent(0) == 0 ? wanted : wanted + wanted / 8;
  auto const grow = [&](char const* name, auto& field) {
    using T = typename std::decay_t<decltype(field)>::value_type;
    Field<T> larger((std::string(name)), size);
    if (particles.owned > 0) {
      auto const range = std::pair<std::size_t, std::size_t>(0, static_cast<std::size_t>(particles.owned));
      Kokkos::deep_copy(Kokkos::subview(larger, range), Kokkos::subview(field, range));
    }
    field = larger;
  };
  for_each_field(particles, grow);
  for_each_derived_field(particles, grow);
}

void fill_padding(ParticleSoA const& particles) {
  int const first = particles.all();
  Kokkos::parallel_for("fill_padding", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(particles.x.extent(0)) - first),
                       FillPadding{particles, first});
}

void permute(ParticleSoA& particles, Field<int> const& order) {
  particles.owned = static_cast<int>(order.extent(0));
  particles.ghosts = 0;
  // Each field is gathered into the storage that the one before it left free.
  Field<int> free_int;
  Field<Real> free_real;
  for_each_field(particles, [&](char const* name, auto& field) {
    using T = typename std::decay_t<decltype(field)>::value_type;
    auto& to = [&]() -> Field<T>& {
      if constexpr (std::is_same_v<T, int>)
        return free_int;
      else
        return free_real;
    }();
    if (to.extent(0) != field.extent(0)) to = uninitialised<T>(name, field.extent(0));
    Kokkos::parallel_for("permute", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned), Gather<T>{field, to, order});
    std::swap(field, to);
  });
  fill_padding(particles);
}

void add_affine_velocity(ParticleSoA const& particles, Real rate_x, Real rate_y, Coord centre_x, Coord centre_y) {
  Kokkos::parallel_for("add_affine_velocity", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                       AddAffineVelocity{particles, rate_x, rate_y, centre_x, centre_y});
}

void scale_positions(ParticleSoA const& particles, Real factor, Coord fixed_x, Coord fixed_y) {
  Kokkos::parallel_for("scale_positions", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                       ScalePositions{particles, factor, fixed_x, fixed_y});
}

namespace {

template <class T>
Field<T> gathered(Field<T> const& field, Field<int> const& order, std::size_t size) {
  Field<T> to("permuted", size);
  Kokkos::parallel_for("permuted", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(order.extent(0))),
                       Gather<T>{field, to, order});
  return to;
}

}  // namespace

Field<Accum> permuted(Field<Accum> const& field, Field<int> const& order, std::size_t size) {
  return gathered(field, order, size);
}
Field<int> permuted(Field<int> const& field, Field<int> const& order, std::size_t size) { return gathered(field, order, size); }

void stop_motion(ParticleSoA const& particles) {
  Kokkos::deep_copy(particles.vx, 0);
  Kokkos::deep_copy(particles.vy, 0);
  Kokkos::deep_copy(particles.omega, 0);
}

std::size_t bytes(ParticleSoA const& particles) {
  ParticleSoA copy = particles;
  std::size_t total = 0;
  auto const count = [&](char const*, auto const& field) {
    total += field.span() * sizeof(typename std::decay_t<decltype(field)>::value_type);
  };
  for_each_field(copy, count);
  for_each_derived_field(copy, count);
  return total;
}

}  // namespace clathra
