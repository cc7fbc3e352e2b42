#include "kernels/forces.hpp"

namespace clathra {

namespace {

struct ExpectAll {
  Field<std::uint64_t> active;
  KOKKOS_FUNCTION void operator()(int group) const { active(group) = ~std::uint64_t(0); }
};

struct SetBondWidths {
  ParticleSoA p;
  ContactRows rows;
  BondLaw law;
  KOKKOS_FUNCTION void operator()(int place) const {
    int const slice = place >> rows.features.format.slice_shift(), used = place < p.owned ? rows.length(place) : 0;
    for (int k = 0; k < rows.slice_start(slice + 1) - rows.slice_start(slice); ++k) {
      std::size_t const e = rows.entry(place, k);
      bool const bonded = k < used && is_bonded(rows.formation_overlap(e));
      Real const formed_at = bonded ? rows.formation_overlap(e) : no_bond;
      rows.width.set(e, bonded ? law.width_formed_at(common_radius(p.radius(place), p.radius(rows.neighbour(e))), formed_at) : 0);
    }
  }
};

}  // namespace

void prepare_rows(ParticleSoA const& particles, ContactRows& rows, BondLaw const& law) {
  HistoryFormat const& format = rows.features.format;
  auto const groups = static_cast<std::size_t>(group_count(particles.owned, format.lanes()));
  if (rows.active.extent(0) != groups) rows.active = uninitialised<std::uint64_t>("active", groups);
  Kokkos::parallel_for("expect_all", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(groups)), ExpectAll{rows.active});
  if (!rows.features.bonds) {
    rows.width = RealField();
    return;
  }
  if (rows.width.extent(0) != rows.formation_overlap.extent(0) || !(rows.width.format() == rows.formation_overlap.format())) {
    rows.width = RealField();
    rows.width = like(rows.formation_overlap, "width", rows.formation_overlap.extent(0), false);
  }
  int const places = format.slice_count(particles.owned) * format.slice_width();
  Kokkos::parallel_for("set_bond_widths", Kokkos::RangePolicy<ExecutionSpace>(0, places), SetBondWidths{particles, rows, law});
}

void compute_forces(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, Real dt, std::int64_t step,
                    BreakLog const& breaks, Dissipation const& losses, Faults const& faults, Field<StepState> const& steps,
                    StepLaunches const& launches) {
  auto const compute =
      particles.precision == Precision::full ? compute_forces_in<FullPrecision> : compute_forces_in<MixedPrecision>;
  compute(particles, rows, laws, dt, step, breaks, losses, faults, steps, launches);
}

}  // namespace clathra
