/// What the log of breaks needs to know of the bonds in the rows.
#include "kernels/neighbours.hpp"

namespace clathra {

namespace {

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

}  // namespace clathra
