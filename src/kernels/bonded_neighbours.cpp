/// What neighbour searches and the log of breaks need to know of the bonds in the rows.
#include "kernels/neighbours.hpp"

namespace clathra {

namespace {

/// Of the rows of one group of discs.
struct WidestBondedGap {
  ParticleSoA p;
  ContactRows rows;
  KOKKOS_FUNCTION void operator()(int group, Real& widest) const {
    auto const i = static_cast<std::size_t>(group) * lane_count;
    int const shift = rows.features.format.slice_shift();
    auto const slice = static_cast<int>(i >> shift);
    std::size_t const in_slice = i & ((std::size_t(1) << shift) - 1);
    Lanes const x = load(&p.x(i)), y = load(&p.y(i)), radius = load(&p.radius(i));
    Lanes widest_here(0);
    for (int k = rows.slice_start(slice); k < rows.slice_start(slice + 1); ++k) {
      std::size_t const e = (static_cast<std::size_t>(k) << shift) | in_slice;
      auto const bonded = is_bonded(load(rows.formation_overlap, e));
      if (!any(bonded)) continue;
      int const* const other = &rows.neighbour(e);
      Lanes const dx = gather(p.x.data(), other) - x, dy = gather(p.y.data(), other) - y;
      Lanes const gap = lane_sqrt(dx * dx + dy * dy) - (radius + gather(p.radius.data(), other));
      widest_here = lane_max(widest_here, select(bonded, gap, Lanes(0)));
    }
    widest = lane_max(widest, largest(widest_here));
  }
};

struct CountOwnBonds {
  ParticleSoA p;
  ContactRows rows;
  KOKKOS_FUNCTION void operator()(int i, int& bonds) const {
    for (int k = 0; k < rows.length(i); ++k) {
      std::size_t const e = rows.entry(i, k);
      if (is_bonded(rows.formation_overlap(e)) && p.id(i) < p.id(rows.neighbour(e))) ++bonds;
    }
  }
};

}  // namespace

int count_own_bonds(ParticleSoA const& particles, ContactRows const& rows) {
  int bonds = 0;
  if (rows.formation_overlap.extent(0) > 0)
    Kokkos::parallel_reduce("count_own_bonds", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                            CountOwnBonds{particles, rows}, bonds);
  return bonds;
}

Real widest_bonded_gap(ParticleSoA const& particles, ContactRows const& rows) {
  if (rows.formation_overlap.extent(0) == 0 || rows.length.extent(0) == 0) return 0;
  Real widest = 0;
  Kokkos::parallel_reduce("widest_bonded_gap", Kokkos::RangePolicy<ExecutionSpace>(0, group_count(particles.owned)),
                          WidestBondedGap{particles, rows}, Kokkos::Max<Real>(widest));
  return lane_max(widest, Real(0));
}

}  // namespace clathra
