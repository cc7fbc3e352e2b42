/// Images across the edges of a periodic cell, upright or leaning, against the lattice that the cell stands for.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "domain/generation/random.hpp"
#include "domain/simulation/periodic_images.hpp"
#include "on_host.hpp"

namespace clathra {
namespace {

/// Discs of radius 0.1 in and around a cell.
ParticleSoA scattered(Box const& cell, int discs) {
  ParticleSoA p = allocate_particles(discs, Precision::full, 0.1);
  auto const fill = [&](Field<Coord> const& field, Real from, Real size, int of) {
    auto host = Kokkos::create_mirror_view(Kokkos::HostSpace(), field);
    Kokkos::deep_copy(host, field);
    for (int i = 0; i < discs; ++i)
      host(static_cast<std::size_t>(i)) =
          from + size * (1.4 * uniform_random(7, 0, static_cast<std::uint64_t>(2 * i + of)) - 0.2);
    Kokkos::deep_copy(field, host);
  };
  fill(p.x, cell.x, cell.width(), 0);
  fill(p.y, cell.y, cell.height(), 1);
  auto id = Kokkos::create_mirror_view(Kokkos::HostSpace(), p.id);
  Kokkos::deep_copy(id, p.id);
  for (int i = 0; i < discs; ++i) id(static_cast<std::size_t>(i)) = i;
  Kokkos::deep_copy(p.id, id);
  return p;
}

/// Whether a ghost of a disc stands at a place.
bool has_image(HostField<double> const& x, HostField<double> const& y, HostField<int> const& id, ParticleSoA const& p, int of,
               double at_x, double at_y) {
  for (int g = p.owned; g < p.owned + p.ghosts; ++g)
    if (id(g) == of && std::hypot(x(g) - at_x, y(g) - at_y) < 1e-12) return true;
  return false;
}

TEST(PeriodicImages, OfAnyCellAreThoseOfItsLattice) {
  constexpr double reach = 1.1;
  for (double const tilt : {0.0, 2.0, -3.5}) {
    Box cell = Box::cell(0.5, -2, 9, 7);
    cell.edges.xy = tilt;
    ParticleSoA p = scattered(cell, 150);
    PeriodicImages images;
    images.rebuild(p, cell, reach);
    HostField<double> const x(p.x), y(p.y);
    HostField<int> const id(p.id);
    int across = 0;
    for (int i = 0; i < p.owned; ++i) {
      double const up = (y(i) - cell.y) / cell.edges.yy, along = (x(i) - cell.x - up * tilt) / cell.edges.xx;
      EXPECT_TRUE(up >= 0 && up < 1 && along >= -1e-15 && along < 1) << i << ": the cell holds all particles";
      for (int j = 0; j < p.owned; ++j)
        for (int a = -2; a <= 2; ++a)
          for (int b = -2; b <= 2; ++b) {
            double const at_x = x(j) + a * cell.edges.xx + b * tilt, at_y = y(j) + b * cell.edges.yy;
            if ((a == 0 && b == 0) || std::hypot(at_x - x(i), at_y - y(i)) > reach) continue;
            ++across;
            EXPECT_TRUE(has_image(x, y, id, p, j, at_x, at_y)) << "tilt " << tilt << ": of " << j << " beside " << i;
          }
    }
    EXPECT_GT(across, 50);
    EXPECT_LT(p.ghosts, 3 * p.owned);
  }
}

/// A strain of a leaning cell is the same in the frame: F = H H_then^-1 takes each lattice point to its new place.
TEST(Box, ItsFrameTakesTheEdgesAlong) {
  Box then = Box::cell(1, 2, 4, 3), now = Box::cell(1.5, 1, 4.4, 2.7);
  then.edges.xy = 0.5;
  now.edges.xy = -0.8;
  AffineFrame const f = frame_since(now, then);
  for (auto const& [a, b] : {std::tuple{0, 0}, {1, 0}, {0, 1}, {2, -3}}) {
    double const x = then.x + a * then.edges.xx + b * then.edges.xy, y = then.y + b * then.edges.yy;
    EXPECT_NEAR(f.mapped_x(x, y), now.x + a * now.edges.xx + b * now.edges.xy, 1e-14);
    EXPECT_NEAR(f.mapped_y(y), now.y + b * now.edges.yy, 1e-14);
  }
  // Two points approach each other by no more than it says.
  for (int n = 0; n < 16; ++n) {
    double const angle = 0.4 * n, x = std::cos(angle), y = std::sin(angle);
    double const dx = f.mapped_x(x, y) - f.mapped_x(0.0, 0.0), dy = f.mapped_y(y) - f.mapped_y(0.0);
    EXPECT_LE(1 - std::hypot(dx, dy), f.closing());
  }
}

}  // namespace
}  // namespace clathra
