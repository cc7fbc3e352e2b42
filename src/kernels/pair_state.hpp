#pragma once
/// One pair of discs as it stands after a step: what measurements, files and the stability analysis read.
#include "kernels/forces.hpp"

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
  Real normal_stiffness = 0, shear_stiffness = 0, rolling_stiffness = 0;  ///< tangent stiffness while nothing slips or breaks
  Real grain_energy = 0, bond_energy = 0;                                 ///< elastic [J/m]
  Real width = 0, gap = 0;                                                ///< B and h_cr of the bond [m]
  KOKKOS_INLINE_FUNCTION bool carries() const { return touching || bonded; }
};

/// Half of F^2 / k, 0 for a spring that is not there.
KOKKOS_INLINE_FUNCTION Real spring_energy(Real force, Real stiffness) {
  return stiffness > 0 ? 0.5 * force * force / stiffness : 0;
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
  s.bonded = laws.bond_kind != BondKind::none && is_bonded(rows.equilibrium(e));
  Real const common = common_radius(p.radius(i), p.radius(s.other));
  Real const moment = rows.moment.extent(0) > 0 ? rows.moment(e) : 0;
  if (s.touching && (!s.bonded || separate)) {
    Real const k_m = rows.features.rolling ? rolling_stiffness(laws.grain, common) : 0;
    s.normal = laws.grain.normal_stiffness * s.overlap;
    s.shear = rows.shear(e);
    s.moment = moment;
    s.normal_stiffness = laws.grain.normal_stiffness;
    s.shear_stiffness = laws.grain.shear_stiffness;
    s.rolling_stiffness = k_m;
    s.grain_energy = spring_energy(s.normal, laws.grain.normal_stiffness) + spring_energy(s.shear, laws.grain.shear_stiffness) +
                     spring_energy(s.moment, k_m);
  }
  if (s.bonded) {
    ContactMotion<Real> const still{s.overlap, 0, 0, 0, common};
    BondForce<Real> const bond =
        bond_contact(laws.bond, still, Real(rows.equilibrium(e)), Real(rows.width(e)),
                     Real(separate ? rows.bond_shear(e) : rows.shear(e)), separate ? Real(rows.bond_moment(e)) : moment);
    s.width = bond.width;
    s.gap = bond.gap;
    s.bond_normal = bond.force.normal;
    s.bond_shear = bond.force.shear;
    s.bond_moment = bond.force.moment;
    s.normal += s.bond_normal;
    s.shear += s.bond_shear;
    s.moment += s.bond_moment;
    s.normal_stiffness += bond.stiffness.normal;
    s.shear_stiffness += bond.stiffness.shear;
    s.rolling_stiffness += bond.stiffness.rolling;
    s.bond_energy = spring_energy(s.bond_normal, bond.stiffness.normal) + spring_energy(s.bond_shear, bond.stiffness.shear) +
                    spring_energy(s.bond_moment, bond.stiffness.rolling);
  }
  return s;
}

}  // namespace clathra
