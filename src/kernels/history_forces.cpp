#include "kernels/history_forces.hpp"

namespace clathra {

namespace {

struct WriteForces {
  ParticleSoA p;
  ContactRows rows, to;
  ContactLaws laws;
  KOKKOS_FUNCTION void operator()(int i) const {
    for (int k = 0; k < rows.length(i); ++k) {
      std::size_t const e = rows.entry(i, k);
      HistoryForces const forces = history_forces(p, rows, laws, i, e);
      auto const write = [e](RealField const& field, Real force) {
        if (field.extent(0) > 0) field.set(e, force);
      };
      write(to.shear, forces.shear);
      write(to.moment, forces.moment);
      write(to.bond_shear, forces.bond_shear);
      write(to.bond_moment, forces.bond_moment);
    }
  }
};

struct AnchorRows {
  ParticleSoA p;
  ContactRows rows;
  ContactLaws laws;

  KOKKOS_FUNCTION void operator()(int slot) const {
    int const slice = slot >> rows.features.format.slice_shift(), used = slot < p.owned ? rows.length(slot) : 0;
    for (int k = 0; k < rows.slice_start(slice + 1) - rows.slice_start(slice); ++k) {
      std::size_t const e = rows.entry(slot, k);
      if (k < used)
        anchor(slot, e);
      else
        forget(e);
    }
  }

  KOKKOS_INLINE_FUNCTION void anchor(int i, std::size_t e) const {
    AnchoredPair const pair = anchored_pair(p, rows, laws, i, e, /*anew=*/true);
    if (!(pair.overlap > 0 || pair.bond.normal > 0)) {
      forget(e);
      return;
    }
    if (rows.anchor.extent(0) > 0) rows.anchor.data<std::int32_t>()[e] = pair.anchor;
    auto const count = [e](RealField const& field, float stiffness, float way) {
      if (field.extent(0) == 0) return;
      float& force = field.data<float>()[e];
      force = minus_times(stiffness, way, force == no_bond_single ? 0 : force);
    };
    count(rows.shear, pair.of_grains.shear, pair.way.slip);
    count(rows.moment, pair.of_grains.rolling, pair.way.rotation);
    count(rows.bond_shear, pair.bond.shear, pair.way.slip);
    count(rows.bond_moment, pair.bond.rolling, pair.way.rotation);
  }
  KOKKOS_INLINE_FUNCTION void forget(std::size_t e) const {
    for (RealField const* field : {&rows.shear, &rows.moment, &rows.bond_shear, &rows.bond_moment})
      if (field->extent(0) > 0) field->data<float>()[e] = no_bond_single;
  }
};

}  // namespace

ContactRows with_forces(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws) {
  if (particles.precision == Precision::full) return rows;
  ContactRows with = rows;
  for (RealField* field : {&with.shear, &with.moment, &with.bond_shear, &with.bond_moment}) {
    if (field->extent(0) == 0) continue;
    *field = like(*field, field->label(), field->extent(0), false);
    fill(*field, no_bond);
  }
  Kokkos::parallel_for("write_forces", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                       WriteForces{particles, rows, with, laws});
  return with;
}

void anchor_rows(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws) {
  if (particles.precision == Precision::full) return;
  HistoryFormat const& format = rows.features.format;
  int const slots = format.slice_count(particles.owned) * format.slice_width();
  Kokkos::parallel_for("anchor_rows", Kokkos::RangePolicy<ExecutionSpace>(0, slots), AnchorRows{particles, rows, laws});
}

}  // namespace clathra
