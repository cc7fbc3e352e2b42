#pragma once
/// The network of contacts, bonds and walls as springs: what the stability of the time step depends on.
#include "kernels/pair_state.hpp"
#include "kernels/walls.hpp"

namespace clathra {

struct SpringNetwork {
  ParticleSoA particles;
  ContactRows rows;
  ContactLaws laws;
  Walls walls;
  WallLaw wall_law;
};

/// What holds a disc at one contact, bond or wall while nothing slips or breaks. Stiffness in N/m per m, N m/rad per m.
struct Spring {
  int other;            ///< index of the other disc, -1 for a wall
  Real nx, ny;          ///< from the disc outward
  Real arm, other_arm;  ///< lever arms of the shear force [m]
  Real normal, shear, rolling;
  Real dashpot;  ///< viscous normal coefficient [N s/m per m]
};

/// Which springs are meant: those that carry a force now, as stiff as they are, or all as stiff as they may become: with the
/// grain contact beside a bond whose gap may close (`parallel`), or behind a bond that may break (`replace`, `memory`: the
/// stiffer of the two), and with grain contacts in gaps that may close.
struct SpringSet {
  bool to_come = false;
  Real closing_bonds = 0, closing_gaps = 0;  ///< gaps below this share of the mean radius may close, bonded or not
};

namespace detail {

/// A pair that carries a force or may soon.
/// @param closed  whether its grains may be in contact
KOKKOS_INLINE_FUNCTION Spring pair_spring(SpringNetwork const& net, int i, PairState const& s, bool closed) {
  GrainLaw const& grain = net.laws.grain;
  ParticleSoA const& p = net.particles;
  Spring spring{s.other, s.nx, s.ny, s.arm, s.other_arm, s.stiffness.normal, s.stiffness.shear, s.stiffness.rolling, 0};
  bool const parallel = net.laws.bond_kind == BondKind::parallel;
  bool const grains_carry = s.touching && (!s.bonded || parallel);
  if (closed && !grains_carry) {
    ContactStiffness<Real> const k =
        kept_stiffness(net.rows, grain, lane_max(s.overlap, Real(0)), common_radius(p.radius(i), p.radius(s.other)));
    bool const beside = !s.bonded || parallel;
    spring.normal = beside ? spring.normal + k.normal : lane_max(spring.normal, k.normal);
    spring.shear = beside ? spring.shear + k.shear : lane_max(spring.shear, k.shear);
    spring.rolling = beside ? spring.rolling + k.rolling : lane_max(spring.rolling, k.rolling);
  }
  if (grain.damping_ratio > 0 && (grains_carry || closed))
    spring.dashpot = dashpot_coefficient(grain, p.inverse_mass(i), p.inverse_mass(s.other));
  return spring;
}

}  // namespace detail

/// Calls visit(Spring) for each of a disc's contacts and bonds, and then for each wall that it touches.
template <class Visit>
KOKKOS_INLINE_FUNCTION void for_each_spring(SpringNetwork const& net, int i, SpringSet const& set, Visit const& visit) {
  ParticleSoA const& p = net.particles;
  for (int k = 0; k < net.rows.length(i); ++k) {
    PairState const s = pair_state(p, net.rows, net.laws, i, net.rows.entry(i, k));
    Real const closing = s.bonded ? set.closing_bonds : set.closing_gaps;
    bool const closed = set.to_come && s.overlap > -0.5 * closing * (p.radius(i) + p.radius(s.other));
    if (s.carries() || closed) visit(detail::pair_spring(net, i, s, closed));
  }
  for (int wall = 0; wall < wall_count; ++wall) {
    WallFace const face = wall_face(net.walls, wall, p.x(i), p.y(i));
    Real const distance = std::fabs(face.distance), radius = p.radius(i);
    if (distance >= radius * (1 + set.closing_gaps)) continue;
    GrainLaw const law = net.wall_law.as_grain();
    ContactStiffness<Real> const k = grain_stiffness(law, lane_max(radius - distance, Real(0)), 2 * radius);
    Real const dashpot = law.damping_ratio > 0 ? dashpot_coefficient(law, p.inverse_mass(i), Real(0)) : 0;
    visit(Spring{-1, face.nx, face.ny, distance, 0, k.normal, law.friction > 0 ? k.shear : 0, 0, dashpot});
  }
}

}  // namespace clathra
