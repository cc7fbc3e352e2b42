#include "kernels/particles.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "kernels/reference_configuration.hpp"

namespace clathra {

namespace {

KOKKOS_INLINE_FUNCTION void set_row(ParticleSoA const& p, std::size_t i) {
  p.disc_rows.set(i, p.x(i), p.y(i), p.radius(i), p.vx(i), p.vy(i), p.omega(i));
}

struct FillPadding {
  ParticleSoA p;
  int first;
  KOKKOS_FUNCTION void operator()(int k) const {
    auto const set_padding = [i = static_cast<std::size_t>(first + k)](DiscField const& about, auto const& field) {
      set(field, i, about.padding);
    };
    for_each_field(p, set_padding);
    for_each_derived_field(p, set_padding);
    if (p.precision == Precision::full) set_row(p, static_cast<std::size_t>(first + k));
  }
};

struct UpdateMirror {
  ParticleSoA p;
  int first;
  Real per_tick;
  KOKKOS_FUNCTION void operator()(int k) const {
    auto const i = static_cast<std::size_t>(first + k);
    bool const padding = first + k >= p.owned + p.ghosts;
    float* const row = DiscMirror::numbers(p.mirror.places) + DiscMirror::row * i;
    row[0] = from_bits(padding ? 0 : DiscMirror::ticks(p.x(i), per_tick));
    row[1] = from_bits(padding ? 0 : DiscMirror::ticks(p.y(i), per_tick));
    row[2] = padding ? p.mirror.padding_radius : static_cast<float>(p.radius(i));
  }
};

struct UpdateDiscRows {
  ParticleSoA p;
  int first;
  KOKKOS_FUNCTION void operator()(int k) const { set_row(p, static_cast<std::size_t>(first + k)); }
};

/// The same of the rows, which hold copies of velocities too. In mixed precision these stand in the mirror alone.
void update_disc_rows(ParticleSoA const& particles, int first, int count) {
  if (!for_gpu || particles.precision == Precision::mixed) return;
  Kokkos::parallel_for("update_disc_rows", Kokkos::RangePolicy<ExecutionSpace>(0, count), UpdateDiscRows{particles, first});
}

struct AddAffineVelocity {
  ParticleSoA p;
  Real rate_x, rate_y;
  Coord centre_x, centre_y;
  KOKKOS_FUNCTION void operator()(int i) const {
    p.vx.add(i, -(rate_x * (p.x(i) - centre_x)));
    p.vy.add(i, -(rate_y * (p.y(i) - centre_y)));
  }
};

struct CountTurnsOn {
  ParticleSoA p;
  KOKKOS_FUNCTION void operator()(int i) const {
    auto const increment = static_cast<float>(p.rotation_increment(i));
    p.angle(i) += increment - rotation_from_now_on(increment);
    p.rotation_increment.set(i, rotation_from_now_on(increment));
  }
};

struct ScalePositions {
  ParticleSoA p;
  Real factor_x, factor_y;
  Coord fixed_x, fixed_y, least_y;
  KOKKOS_FUNCTION void operator()(int i) const {
    if (p.y(i) < least_y) return;
    p.x(i) = fixed_x + factor_x * (p.x(i) - fixed_x);
    p.y(i) = fixed_y + factor_y * (p.y(i) - fixed_y);
  }
};

}  // namespace

Real DiscMirror::tick_for(Real largest_diameter) {
  return largest_diameter > 0 ? std::ldexp(Real(1), std::ilogb(largest_diameter) - 28) : 1;
}

Real rounding_slack(ParticleSoA const& particles, Real largest_radius) {
  if (particles.precision == Precision::full) return 0;
  constexpr Real half_ulp = 0x1p-24;
  return 1.5 * particles.mirror.tick + 8 * half_ulp * (2 * largest_radius);
}

namespace {

using MirrorTable = Field<std::uint32_t>;
/// Takes these tables for the mirror, and their columns for the fields that have their place there.
void set_mirror(ParticleSoA& particles, MirrorTable const& places, MirrorTable const& motion) {
  particles.mirror.places = places;
  particles.mirror.motion = motion;
  constexpr int columns = DiscMirror::row;
  for_each_field(particles, [&](DiscField const& about, auto& field) {
    if constexpr (std::is_same_v<std::decay_t<decltype(field)>, RealField>)
      if (about.mirror_at >= 0)
        field = RealField::column(about.mirror_at < columns ? places : motion, columns, about.mirror_at % columns);
  });
}

struct GatherRows {
  MirrorTable places, motion, to_places, to_motion;
  Field<int> order;
  KOKKOS_FUNCTION void operator()(int i) const {
    std::size_t const to = DiscMirror::row * static_cast<std::size_t>(i),
                      from = DiscMirror::row * static_cast<std::size_t>(order(i));
    for (std::size_t n = 0; n < DiscMirror::row; ++n) {
      to_places(to + n) = places(from + n);
      to_motion(to + n) = motion(from + n);
    }
  }
};

void permute_mirror(ParticleSoA& particles, Field<int> const& order, Scratch& scratch) {
  if (particles.precision == Precision::full) return;
  auto const room = [&](MirrorTable const& table) { return take_like(scratch, table, "mirror", table.extent(0)); };
  MirrorTable const places = room(particles.mirror.places), motion = room(particles.mirror.motion);
  Kokkos::parallel_for("permute_mirror", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                       GatherRows{particles.mirror.places, particles.mirror.motion, places, motion, order});
  set_mirror(particles, places, motion);
}

}  // namespace

ParticleSoA allocate_particles(int discs, Precision precision, Real largest_radius) {
  ParticleSoA particles;
  particles.precision = precision;
  particles.mirror.tick = DiscMirror::tick_for(2 * largest_radius);
  particles.mirror.padding_radius = static_cast<float>(-4 * largest_radius);
  auto const choose = [format = kept_by_discs(precision)](DiscField const&, RealField& field) {
    field = RealField("", 0, format);
  };
  for_each_force(particles, choose);
  choose({}, particles.inverse_inertia);
  reserve(particles, discs);
  particles.owned = discs;
  fill_padding(particles);
  return particles;
}

void reserve(ParticleSoA& particles, int discs) {
  std::size_t const wanted = static_cast<std::size_t>(group_count(discs, widest_slice) + 1) * widest_slice + 1;
  if (particles.x.extent(0) >= wanted) return;
  std::size_t const size = particles.x.extent(0) == 0 ? wanted : wanted + wanted / 8;
  bool const mixed = particles.precision == Precision::mixed;
  auto const kept_discs = static_cast<std::size_t>(particles.owned);
  auto const grow = [&](DiscField const& about, auto& field) {
    if (mixed && about.mirror_at >= 0) return;
    auto const larger = like(field, about.name, size);
    if (kept_discs > 0) copy_first(field, larger, kept_discs);
    field = larger;
  };
  for_each_field(particles, grow);
  for_each_derived_field(particles, grow);
  if (!mixed) {
    particles.disc_rows.resize(size);
    update_disc_rows(particles, 0, particles.owned);
    return;
  }
  auto const larger = [&](char const* name, MirrorTable const& table) {
    MirrorTable const rows(std::string(name), DiscMirror::row * size);
    if (kept_discs > 0) copy_first(table, rows, DiscMirror::row * kept_discs);
    return rows;
  };
  set_mirror(particles, larger("mirror.places", particles.mirror.places), larger("mirror.motion", particles.mirror.motion));
}

void fill_padding(ParticleSoA const& particles) {
  int const first = particles.all(), count = static_cast<int>(particles.x.extent(0)) - first;
  Kokkos::parallel_for("fill_padding", Kokkos::RangePolicy<ExecutionSpace>(0, count), FillPadding{particles, first});
  if (particles.precision == Precision::mixed) update_mirror(particles, first, count);
}

void update_mirror(ParticleSoA const& particles, int first, int count) {
  update_disc_rows(particles, first, count);
  if (particles.precision == Precision::full) return;
  Kokkos::parallel_for("update_mirror", Kokkos::RangePolicy<ExecutionSpace>(0, count),
                       UpdateMirror{particles, first, 1 / particles.mirror.tick});
}

void permute(ParticleSoA& particles, Field<int> const& order, Scratch& scratch) {
  particles.owned = static_cast<int>(order.extent(0));
  particles.ghosts = 0;
  bool const mixed = particles.precision == Precision::mixed;
  // What one field has left is free for the next one of its type.
  for_each_field(particles, [&](DiscField const& about, auto& field) {
    if (!mixed || about.mirror_at < 0) field = permuted(field, order, field.extent(0), scratch);
  });
  permute_mirror(particles, order, scratch);
  fill_padding(particles);
}

void add_affine_velocity(ParticleSoA const& particles, Real rate_x, Real rate_y, Coord centre_x, Coord centre_y) {
  Kokkos::parallel_for("add_affine_velocity", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                       AddAffineVelocity{particles, rate_x, rate_y, centre_x, centre_y});
  update_disc_rows(particles, 0, particles.owned);
}

void scale_positions(ParticleSoA const& particles, Real factor_x, Real factor_y, Coord fixed_x, Coord fixed_y, Coord least_y) {
  Kokkos::parallel_for("scale_positions", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                       ScalePositions{particles, factor_x, factor_y, fixed_x, fixed_y, least_y});
  update_mirror(particles, 0, particles.owned);
}

void count_turns_on(ParticleSoA const& particles) {
  if (particles.precision == Precision::full) return;
  Kokkos::parallel_for("count_turns_on", Kokkos::RangePolicy<ExecutionSpace>(0, particles.all()), CountTurnsOn{particles});
}

std::vector<double> rotations(ParticleSoA const& particles) {
  auto const size = static_cast<std::size_t>(particles.owned);
  std::vector<double> angle = on_host(particles.angle, size);
  if (particles.precision == Precision::full) return angle;
  std::vector<double> const increment = on_host(particles.rotation_increment, size);
  for (std::size_t i = 0; i < size; ++i) angle[i] += increment[i];
  return angle;
}

void stop_motion(ParticleSoA const& particles) {
  for (RealField const& field : {particles.vx, particles.vy, particles.omega}) fill(field, 0);
  update_disc_rows(particles, 0, particles.all());
}

std::size_t bytes(ParticleSoA const& particles) {
  std::size_t total = 0;
  auto const count = [&](DiscField const&, auto const& field) { total += field_bytes(field); };
  for_each_field(particles, count);
  for_each_derived_field(particles, count);
  return total + field_bytes(particles.mirror.places) + field_bytes(particles.mirror.motion) + particles.disc_rows.bytes();
}

}  // namespace clathra
