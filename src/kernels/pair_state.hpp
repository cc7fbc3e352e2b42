#pragma once
/// One pair of discs as it stands after a step: what measurements, files and the stability analysis read.
#include "kernels/history_forces.hpp"

namespace clathra {

struct PairState {
  int other = -1;         ///< index of the other disc
  bool touching = false;  ///< u_n > 0
  bool bonded = false;
  Real nx = 0, ny = 0;                                    ///< from the row's disc to the other
  Real distance = 0, overlap = 0;                         ///< [m]
  Real arm = 0, other_arm = 0;                            ///< lever arms of the shear force [m], arm + other_arm = distance
  Real normal = 0, shear = 0, moment = 0;                 ///< total force and moment of grain contact and bond
  Real bond_normal = 0, bond_shear = 0, bond_moment = 0;  ///< the bond's part
  ContactStiffness<Real> stiffness{0, 0, 0};              ///< of both together
  Real grain_energy = 0, bond_energy = 0;                 ///< elastic [J/m]
  Real width = 0, thickness = 0;                          ///< B and h_cr of the bond [m]
  KOKKOS_INLINE_FUNCTION bool carries() const { return touching || bonded; }
};

/// The tangent of a grain contact with what these rows keep: no shear and no rolling where the scene has none.
template <class L>
KOKKOS_FORCEINLINE_FUNCTION ContactStiffness<L> kept_stiffness(ContactRows const& rows, GrainLaw const& grain, L const& overlap,
                                                               L const& common_radius) {
  ContactStiffness<L> k = grain_stiffness(grain, overlap, common_radius);
  if (rows.shear.extent(0) == 0) k.shear = L(0);
  if (!rows.features.rolling) k.rolling = L(0);
  return k;
}

/// The pair behind entry `e` of disc `i`. No dashpot part.
KOKKOS_INLINE_FUNCTION PairState pair_state(ParticleSoA const& p, ContactRows const& rows, ContactLaws const& laws, int i,
                                            std::size_t e) {
  PairState s;
  s.other = rows.neighbour(e);
  Real const dx = p.x(s.other) - p.x(i), dy = p.y(s.other) - p.y(i);
  s.distance = lane_max(std::sqrt(dx * dx + dy * dy), 1e-30);
  s.nx = dx / s.distance;
  s.ny = dy / s.distance;
  s.overlap = p.radius(i) + p.radius(s.other) - s.distance;
  s.touching = s.overlap > 0;
  s.arm = p.radius(i) - 0.5 * s.overlap;
  s.other_arm = p.radius(s.other) - 0.5 * s.overlap;
  bool const separate = laws.bond_kind == BondKind::parallel;
  s.bonded = laws.bond_kind != BondKind::none && is_bonded(rows.formation_overlap(e));
  Real const common = common_radius(p.radius(i), p.radius(s.other));
  HistoryForces const kept = history_forces(p, rows, laws, i, e);
  if (s.touching && (!s.bonded || separate)) {
    ContactForce<Real> const grain{spring_force(laws.grain, s.overlap), kept.shear, kept.moment};
    s.normal = grain.normal;
    s.shear = grain.shear;
    s.moment = grain.moment;
    s.stiffness = kept_stiffness(rows, laws.grain, s.overlap, common);
    s.grain_energy = grain_energy(laws.grain, grain, s.stiffness);
  }
  if (s.bonded) {
    ContactMotion<Real> const still{s.overlap, 0, 0, 0, common};
    BondForce<Real> const bond = bond_contact(laws.bond, still, Real(rows.formation_overlap(e)), Real(rows.width(e)),
                                              separate ? kept.bond_shear : kept.shear, separate ? kept.bond_moment : kept.moment);
    s.width = bond.width;
    s.thickness = bond.thickness;
    s.bond_normal = bond.force.normal, s.bond_shear = bond.force.shear, s.bond_moment = bond.force.moment;
    s.normal += s.bond_normal;
    s.shear += s.bond_shear;
    s.moment += s.bond_moment;
    s.stiffness = {s.stiffness.normal + bond.stiffness.normal, s.stiffness.shear + bond.stiffness.shear,
                   s.stiffness.rolling + bond.stiffness.rolling};
    s.bond_energy = spring_energy(bond.force, bond.stiffness);
  }
  return s;
}

}  // namespace clathra
