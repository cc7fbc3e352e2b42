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

struct ReReferenceRows {
  ParticleSoA p;
  ContactRows rows;
  ContactLaws laws;

  KOKKOS_FUNCTION void operator()(int place) const {
    int const slice = place >> rows.features.format.slice_shift(), used = place < p.owned ? rows.length(place) : 0;
    for (int k = 0; k < rows.slice_start(slice + 1) - rows.slice_start(slice); ++k) {
      std::size_t const e = rows.entry(place, k);
      if (k < used)
        re_reference(place, e);
      else
        forget(e);
    }
  }

  KOKKOS_INLINE_FUNCTION void re_reference(int i, std::size_t e) const {
    ReferencedPair const pair = referenced_pair(p, rows, laws, i, e, /*from_now=*/true);
    if (!(pair.overlap > 0 || pair.bond.normal > 0)) {
      forget(e);
      return;
    }
    if (rows.reference_branch.extent(0) > 0) rows.reference_branch.data<std::int32_t>()[e] = pair.reference;
    auto const count = [e](RealField const& field, float stiffness, float way) {
      if (field.extent(0) == 0) return;
      float& force = field.data<float>()[e];
      force = negative_multiply_add(stiffness, way, force == no_bond_single ? 0 : force);
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

/// M = M_0 + k_m (phi_j - phi_i) stays when k_m changes. One group of discs a call.
struct KeepMomentsSinceReference {
  ParticleSoA p;
  ContactRows rows;
  float less;  ///< k_m / common_radius^2 before, less that of now
  bool not_of_bonds;

  KOKKOS_FUNCTION void operator()(int group) const {
    constexpr int lanes = lane_count_of<float>, slice_width = slice_width_of<float>;
    auto const first = static_cast<std::size_t>(group) * lanes;
    PlacesOfDiscs const own = p.mirror.load_places(first);
    int const slice = group / (slice_width / lanes);
    std::uint64_t active = rows.active(group);
    for (int k = rows.slice_start(slice); k < rows.slice_start(slice + 1); ++k, active >>= 1) {
      if ((active & 1) == 0) continue;
      std::size_t const e = static_cast<std::size_t>(k) * slice_width + first % slice_width;
      PlacesOfDiscs const other = p.mirror.gather_places(&rows.neighbour(e));
      float* const moments = rows.moment.data<float>() + e;
      FloatLanes const common = common_radius(own.radius, other.radius), at_reference = load(moments),
                       kept = multiply_add(
                           less * common * common,
                           rotation_from_now_on(other.rotation_increment) - rotation_from_now_on(own.rotation_increment),
                           at_reference);
      auto stays = at_reference == FloatLanes(no_bond_single);
      if (not_of_bonds) stays = stays || is_bonded(load(rows.formation_overlap.data<float>() + e));
      store(moments, select(stays, at_reference, kept));
    }
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

void re_reference_rows(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws) {
  if (particles.precision == Precision::full) return;
  HistoryFormat const& format = rows.features.format;
  int const places = format.slice_count(particles.owned) * format.slice_width();
  Kokkos::parallel_for("re_reference_rows", Kokkos::RangePolicy<ExecutionSpace>(0, places),
                       ReReferenceRows{particles, rows, laws});
}

void keep_moments(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& before, ContactLaws const& now) {
  if (particles.precision == Precision::full || !rows.features.rolling) return;
  float const less = cast<float>(before.grain).rolling_factor() - cast<float>(now.grain).rolling_factor();
  Kokkos::parallel_for("keep_moments", Kokkos::RangePolicy<ExecutionSpace>(0, group_count(particles.owned, lane_count_of<float>)),
                       KeepMomentsSinceReference{particles, rows, less, now.bond_kind == BondKind::replace});
}

}  // namespace clathra
