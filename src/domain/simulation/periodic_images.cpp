#include "domain/simulation/periodic_images.hpp"

#include <stdexcept>

namespace clathra {

namespace {

struct Wrap {
  ParticleSoA p;
  PeriodicCell cell;
  KOKKOS_FUNCTION void operator()(int i) const {
    while (p.x(i) < cell.left) p.x(i) += cell.width;
    while (p.x(i) >= cell.left + cell.width) p.x(i) -= cell.width;
    while (p.y(i) < cell.bottom) p.y(i) += cell.height;
    while (p.y(i) >= cell.bottom + cell.height) p.y(i) -= cell.height;
  }
};

/// Lists the images of discs, as far as there is room: up to three of a disc, where it lies near a corner.
struct ListImages {
  ParticleSoA p;
  PeriodicCell cell;
  Real reach;
  Field<int> source, shift_x, shift_y;
  KOKKOS_FUNCTION void operator()(int i, int& slot, bool const final) const {
    int const sx = p.x(i) < cell.left + reach ? 1 : p.x(i) >= cell.left + cell.width - reach ? -1 : 0;
    int const sy = p.y(i) < cell.bottom + reach ? 1 : p.y(i) >= cell.bottom + cell.height - reach ? -1 : 0;
    if (sx != 0) add(i, sx, 0, slot, final);
    if (sy != 0) add(i, 0, sy, slot, final);
    if (sx != 0 && sy != 0) add(i, sx, sy, slot, final);
  }
  KOKKOS_INLINE_FUNCTION void add(int i, int sx, int sy, int& slot, bool final) const {
    if (final && slot < static_cast<int>(source.extent(0))) {
      source(slot) = i;
      shift_x(slot) = sx;
      shift_y(slot) = sy;
    }
    ++slot;
  }
};

/// Copies what changes in each step, or all of the state.
struct CopyImages {
  ParticleSoA p;
  PeriodicCell cell;
  Field<int> source, shift_x, shift_y;
  bool all;
  KOKKOS_FUNCTION void operator()(int g) const {
    int const from = source(g), to = p.owned + g;
    for_each_field(p, [&](DiscField const& about, auto const& field) {
      if (all || about.moves) set(field, static_cast<std::size_t>(to), field(from));
    });
    p.x(to) += shift_x(g) * cell.width;
    p.y(to) += shift_y(g) * cell.height;
  }
};

template <class AField>
struct CopyValues {
  AField field;
  Field<int> source;
  int first;
  KOKKOS_FUNCTION void operator()(int g) const { set(field, static_cast<std::size_t>(first + g), field(source(g))); }
};

}  // namespace

void PeriodicImages::rebuild(ParticleSoA& particles, PeriodicCell const& cell, Real reach) {
  if (2 * reach > cell.width || 2 * reach > cell.height)
    throw std::invalid_argument("the periodic cell is smaller than four disc diameters");
  Kokkos::RangePolicy<ExecutionSpace> const each(0, particles.owned);
  particles.ghosts = 0;
  Kokkos::parallel_for("wrap", each, Wrap{particles, cell});
  int count = 0;
  auto const list = [&] {
    Kokkos::parallel_scan("list_images", each, ListImages{particles, cell, reach, source_, shift_x_, shift_y_}, count);
  };
  list();
  if (auto const images = static_cast<std::size_t>(count); images > source_.extent(0)) {
    for (Field<int>* field : {&source_, &shift_x_, &shift_y_}) *field = uninitialised<int>("images", images + images / 8);
    list();
  }
  reserve(particles, particles.owned + count);
  particles.ghosts = count;
  fill_padding(particles);
  copy(particles, cell, true);
}

void PeriodicImages::copy(ParticleSoA const& particles, PeriodicCell const& cell, bool all) const {
  Kokkos::parallel_for("copy_images", Kokkos::RangePolicy<ExecutionSpace>(0, particles.ghosts),
                       CopyImages{particles, cell, source_, shift_x_, shift_y_, all});
  update_mirror(particles, particles.owned, particles.ghosts);
}

void PeriodicImages::refresh(ParticleSoA const& particles, PeriodicCell const& cell) const { copy(particles, cell, false); }

void PeriodicImages::refresh(ParticleSoA const& particles, AnyField const& field) const {
  auto const copy = [&]<class AField>(AField const& values) {
    Kokkos::parallel_for("refresh_images", Kokkos::RangePolicy<ExecutionSpace>(0, particles.ghosts),
                         CopyValues<AField>{values, source_, particles.owned});
  };
  std::visit(copy, field);
}

}  // namespace clathra
