#include "kernels/particles.hpp"

#include <algorithm>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

namespace clathra {

namespace {

struct FillPadding {
  ParticleSoA p;
  int first;
  KOKKOS_FUNCTION void operator()(int k) const {
    auto const fill = [i = first + k](DiscField const& about, auto const& field) {
      field(i) = static_cast<typename std::decay_t<decltype(field)>::value_type>(about.padding);
    };
    for_each_field(p, fill);
    for_each_derived_field(p, fill);
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
  std::size_t const wanted = static_cast<std::size_t>(slice_count(discs) + 1) * slice_width + 1;
  if (particles.x.extent(0) >= wanted) return;
  std::size_t const size = particles.x.extent(0) == 0 ? wanted : wanted + wanted / 8;
  auto const grow = [&](DiscField const& about, auto& field) {
    using T = typename std::decay_t<decltype(field)>::value_type;
    Field<T> larger((std::string(about.name)), size);
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
  // Each field is gathered into the storage that the one of its type before it left free.
  std::tuple<Field<int>, Field<float>, Field<double>> free;
  for_each_field(particles, [&](DiscField const& about, auto& field) {
    using T = typename std::decay_t<decltype(field)>::value_type;
    auto& to = std::get<Field<T>>(free);
    if (to.extent(0) != field.extent(0)) to = uninitialised<T>(about.name, field.extent(0));
    Kokkos::parallel_for("permute", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned), GatherField<T>{field, to, order});
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

void stop_motion(ParticleSoA const& particles) {
  Kokkos::deep_copy(particles.vx, 0);
  Kokkos::deep_copy(particles.vy, 0);
  Kokkos::deep_copy(particles.omega, 0);
}

std::size_t bytes(ParticleSoA const& particles) {
  std::size_t total = 0;
  auto const count = [&](DiscField const&, auto const& field) {
    total += field.span() * sizeof(typename std::decay_t<decltype(field)>::value_type);
  };
  for_each_field(particles, count);
  for_each_derived_field(particles, count);
  return total;
}

}  // namespace clathra
