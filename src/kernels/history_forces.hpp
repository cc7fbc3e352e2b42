#pragma once
/// The forces and moments that pairs remember, off the hot path: whatever the precision, rows hold what gives them
/// (path_sum_history.hpp, reference_history.hpp).
#include "kernels/forces.hpp"
#include "kernels/reference_configuration.hpp"

namespace clathra {

struct HistoryForces {
  Real shear = 0, moment = 0;            ///< of the grain contact, or of the bond in its place [N/m, N m/m]
  Real bond_shear = 0, bond_moment = 0;  ///< of a separate bond
};

/// A pair in mixed precision as the contact kernel sees it.
struct ReferencedPair {
  MotionSinceReference<float> way;
  std::int32_t reference;             ///< that of now
  float overlap;                      ///< [m]
  ContactStiffness<float> of_grains;  ///< of the grain contact, or of the bond in its place
  ContactStiffness<float> bond;       ///< 0 without one
};

// These are no part of their callers, so that fused products show by the names of who asks for them (tests/no_fma_test.cmake).
/// @param from_now  whether the motion counts from the branch of now
CLATHRA_COLD_FUNCTION inline ReferencedPair referenced_pair(ParticleSoA const& p, ContactRows const& rows,
                                                            ContactLaws const& laws, int i, std::size_t e,
                                                            bool from_now = false) {
  auto const row_of = [&](int disc) {
    return DiscMirror::numbers(p.mirror.places) + DiscMirror::row * static_cast<std::size_t>(disc);
  };
  float const *const a = row_of(i), *const b = row_of(rows.neighbour(e));
  std::int32_t const dx = difference(bits_of(b[0]), bits_of(a[0])), dy = difference(bits_of(b[1]), bits_of(a[1]));
  auto const tick = static_cast<float>(p.mirror.tick);
  float const x = to_float(dx), y = to_float(dy), distance2 = multiply_add(x, x, multiply_add(y, y, 1e-12F));
  float const distance = lane_sqrt(distance2), overlap = negative_multiply_add(distance, tick, a[2] + b[2]);
  ReferencedPair pair;
  pair.reference = packed_branch(x, y);
  pair.overlap = overlap;
  bool const keeps = rows.reference_branch.extent(0) > 0;
  std::int32_t const reference = from_now || !keeps ? pair.reference : rows.reference_branch.data<std::int32_t>()[e];
  pair.way = motion_since(branch_since(reference, dx, dy, x, y, 1 / distance2), negative_multiply_add(0.5F, overlap, a[2]),
                          negative_multiply_add(0.5F, overlap, b[2]), rotation_from_now_on(a[3]), rotation_from_now_on(b[3]));
  pair.of_grains = grain_stiffness(cast<float>(laws.grain), overlap, common_radius(a[2], b[2]));
  pair.bond = {0, 0, 0};
  if (laws.bond_kind == BondKind::none || !is_bonded(rows.formation_overlap(e))) return pair;
  BondLawOf<float> const law = cast<float>(laws.bond);
  pair.bond = law.stiffness(rows.width.data<float>()[e], law.bond_thickness(rows.formation_overlap.data<float>()[e]));
  if (laws.bond_kind == BondKind::replace) pair.of_grains = pair.bond;
  return pair;
}

/// history_forces() in mixed precision.
/// @param held  what rows hold
CLATHRA_COLD_FUNCTION inline HistoryForces referenced_forces(ParticleSoA const& p, ContactRows const& rows,
                                                             ContactLaws const& laws, int i, std::size_t e,
                                                             HistoryForces const& held) {
  ReferencedPair const pair = referenced_pair(p, rows, laws, i, e);
  auto const force = [](Real at_reference, float stiffness, float way) {
    return at_reference == no_bond ? Real(0) : Real(multiply_add(stiffness, way, static_cast<float>(at_reference)));
  };
  ContactStiffness<float> const& k = pair.of_grains;
  return {force(held.shear, k.shear, pair.way.slip), force(held.moment, k.rolling, pair.way.rotation),
          force(held.bond_shear, pair.bond.shear, pair.way.slip), force(held.bond_moment, pair.bond.rolling, pair.way.rotation)};
}

/// What the histories of entry `e` of disc `i` come to where the discs are; 0 where there is none.
KOKKOS_INLINE_FUNCTION HistoryForces history_forces(ParticleSoA const& p, ContactRows const& rows, ContactLaws const& laws, int i,
                                                    std::size_t e) {
  auto const kept = [e](RealField const& field, Real none) { return field.extent(0) > 0 ? Real(field(e)) : none; };
  Real const none = no_force(rows.features.format);
  HistoryForces const held{kept(rows.shear, none), kept(rows.moment, none), kept(rows.bond_shear, none),
                           kept(rows.bond_moment, none)};
  return p.precision == Precision::full ? held : referenced_forces(p, rows, laws, i, e, held);
}

/// Rows whose fields hold the forces and moments themselves, for the host and until laws have changed. In double precision they
/// are the rows that were given.
ContactRows with_forces(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws);

/// The way back: from the forces and moments in the fields to what the contact kernel keeps, with all pairs re-referenced where
/// they are. To be called when the rows are prepared (prepare_rows()). In double precision nothing is to be done.
void re_reference_rows(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws);

/// The same where nothing but the rolling stiffness of grain contacts has changed: their moments stay as they are, and references
/// too. A generation does it every ten steps.
void keep_moments(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& before, ContactLaws const& now);

}  // namespace clathra
