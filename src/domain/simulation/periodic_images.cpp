#include "domain/simulation/periodic_images.hpp"

#include <cmath>
#include <stdexcept>

namespace clathra {

namespace {

/// How far right of the left edge of the cell a place is [m].
KOKKOS_INLINE_FUNCTION Coord from_left_edge(Box const& cell, Coord x, Coord y) {
  return x - cell.x - cell.edges.xy / cell.edges.yy * (y - cell.y);
}

struct Wrap {
  ParticleSoA p;
  Box cell;
  KOKKOS_FUNCTION void operator()(int i) const {
    while (p.y(i) < cell.y) p.y(i) += cell.edges.yy, p.x(i) += cell.edges.xy;
    while (p.y(i) >= cell.y + cell.edges.yy) p.y(i) -= cell.edges.yy, p.x(i) -= cell.edges.xy;
    while (from_left_edge(cell, p.x(i), p.y(i)) < 0) p.x(i) += cell.edges.xx;
    while (from_left_edge(cell, p.x(i), p.y(i)) >= cell.edges.xx) p.x(i) -= cell.edges.xx;
  }
};

/// Lists the images of discs, as far as there is room: up to three of a disc, where it lies near a corner.
struct ListImages {
  ParticleSoA p;
  Box cell;
  Real reach;           ///< to the lower and upper edges
  Real reach_sideways;  ///< along x, to the left and right ones, which may lean
  Field<int> source, shift_x, shift_y;
  KOKKOS_FUNCTION void operator()(int i, int& place, bool const final) const {
    Coord const across = from_left_edge(cell, p.x(i), p.y(i)), up = p.y(i) - cell.y;
    int const sx = across < reach_sideways ? 1 : across >= cell.edges.xx - reach_sideways ? -1 : 0;
    int const sy = up < reach ? 1 : up >= cell.edges.yy - reach ? -1 : 0;
    if (sx != 0) add(i, sx, 0, place, final);
    if (sy != 0) add(i, 0, sy, place, final);
    if (sx != 0 && sy != 0) add(i, sx, sy, place, final);
  }
  KOKKOS_INLINE_FUNCTION void add(int i, int sx, int sy, int& place, bool final) const {
    if (final && place < static_cast<int>(source.extent(0))) {
      source(place) = i;
      shift_x(place) = sx;
      shift_y(place) = sy;
    }
    ++place;
  }
};

/// Copies what changes in each step, or all of the state.
struct CopyImages {
  ParticleSoA p;
  Box cell;
  Field<int> source, shift_x, shift_y;
  bool all;
  KOKKOS_FUNCTION void operator()(int g) const {
    int const from = source(g), to = p.owned + g;
    for_each_field(p, [&](DiscField const& about, auto const& field) {
      if (all || about.moves) set(field, static_cast<std::size_t>(to), field(from));
    });
    p.x(to) += shift_x(g) * cell.edges.xx + shift_y(g) * cell.edges.xy;
    p.y(to) += shift_y(g) * cell.edges.yy;
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

void PeriodicImages::rebuild(ParticleSoA& particles, Box const& cell, Real reach) {
  if (2 * reach > cell.narrowest()) throw std::invalid_argument("the periodic cell is smaller than four particle diameters");
  Real const sideways = reach * std::hypot(1, cell.edges.xy / cell.edges.yy);
  Kokkos::RangePolicy<ExecutionSpace> const each(0, particles.owned);
  particles.ghosts = 0;
  Kokkos::parallel_for("wrap", each, Wrap{particles, cell});
  int count = 0;
  auto const list = [&] {
    Kokkos::parallel_scan("list_images", each, ListImages{particles, cell, reach, sideways, source_, shift_x_, shift_y_}, count);
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

void PeriodicImages::copy(ParticleSoA const& particles, Box const& cell, bool all) const {
  Kokkos::parallel_for("copy_images", Kokkos::RangePolicy<ExecutionSpace>(0, particles.ghosts),
                       CopyImages{particles, cell, source_, shift_x_, shift_y_, all});
  update_mirror(particles, particles.owned, particles.ghosts);
}

void PeriodicImages::refresh(ParticleSoA const& particles, Box const& cell) const { copy(particles, cell, false); }

void PeriodicImages::refresh(ParticleSoA const& particles, AnyField const& field) const {
  auto const copy = [&]<class AField>(AField const& values) {
    Kokkos::parallel_for("refresh_images", Kokkos::RangePolicy<ExecutionSpace>(0, particles.ghosts),
                         CopyValues<AField>{values, source_, particles.owned});
  };
  std::visit(copy, field);
}

}  // namespace clathra
