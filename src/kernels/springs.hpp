#pragma once
/// The network of contacts, bonds and walls as springs: what the stability of the time step depends on.
#include "kernels/pair_state.hpp"
#include "kernels/wall_forces.hpp"

namespace clathra {

struct SpringNetwork {
  ParticleSoA particles;
  ContactRows rows;
  ContactLaws laws;
  Walls walls;
  WallLaw wall_law;
};

/// What holds a disc at one contact, bond or wall while nothing slips or breaks. Stiffness in N/m per m, N m/rad per m. L is a
/// lane type.
template <class L>
struct Spring {
  L nx, ny;          ///< from the disc outward
  L arm, other_arm;  ///< lever arms of the shear force [m]; other_arm is 0 at a wall
  L normal, shear, rolling;
  L dashpot;  ///< viscous normal coefficient [N s/m per m]
};

/// Which springs are meant: those that carry a force now, as stiff as they are, or all as stiff as they may become: with the
/// grain contact beside a bond whose gap may close (`parallel`), or behind a bond that may break (`replace`, `memory`: the
/// stiffer of the two), and with grain contacts in gaps that may close.
struct SpringSet {
  bool to_come = false;
  Real skin_fraction = 0;    ///< gaps below this share of both discs' Verlet skins may close, bonded or not
  bool bonds_close = false;  ///< all bonded gaps, however wide
};

/// Two discs as one of them sees the other.
template <class L>
struct Pair {
  L dx, dy;                            ///< from the disc to the other [m]
  L radius, other_radius;              ///< [m]
  L inverse_mass, other_inverse_mass;  ///< [m/kg]
  L formation_overlap, width;          ///< u_0 and B of the bond [m]
  L closing;                           ///< gaps below it may close [m]; -no_bond where only present springs are meant
};

/// The spring of a pair, zero where it has none.
template <class L>
KOKKOS_FORCEINLINE_FUNCTION Spring<L> pair_spring(SpringNetwork const& net, Pair<L> const& pair) {
  GrainLaw const& grain = net.laws.grain;
  bool const parallel = net.laws.bond_kind == BondKind::parallel;
  L const zero(0), distance = lane_max(lane_sqrt(pair.dx * pair.dx + pair.dy * pair.dy), L(1e-30)), inverse = L(1) / distance;
  L const overlap = pair.radius + pair.other_radius - distance, half_overlap = L(0.5) * overlap;
  auto const touching = overlap > zero, bonded = is_bonded(pair.formation_overlap), closed = overlap > -pair.closing;
  auto const grains = (parallel ? touching : touching && !bonded) || closed;
  Spring<L> spring{
      pair.dx * inverse, pair.dy * inverse, pair.radius - half_overlap, pair.other_radius - half_overlap, zero, zero, zero, zero};
  ContactStiffness<L> const k =
      kept_stiffness(net.rows, grain, lane_max(overlap, zero), common_radius(pair.radius, pair.other_radius));
  spring.normal = select(grains, k.normal, zero);
  spring.shear = select(grains, k.shear, zero);
  spring.rolling = select(grains, k.rolling, zero);
  if (any(bonded)) {
    ContactStiffness<L> const b = net.laws.bond.stiffness(pair.width, net.laws.bond.bond_thickness(pair.formation_overlap));
    auto const with_bond = [&](L const& of_grains, L const& of_bond) {
      return select(bonded, parallel ? of_grains + of_bond : lane_max(of_grains, of_bond), of_grains);
    };
    spring.normal = with_bond(spring.normal, b.normal);
    spring.shear = with_bond(spring.shear, b.shear);
    spring.rolling = with_bond(spring.rolling, b.rolling);
  }
  if (grain.damping_ratio > 0)
    spring.dashpot = select(grains, dashpot_coefficient(grain, pair.inverse_mass, pair.other_inverse_mass), zero);
  return spring;
}

/// The spring of a disc at a wall, zero where it has none.
template <class L>
KOKKOS_FORCEINLINE_FUNCTION Spring<L> wall_spring(SpringNetwork const& net, int wall, L const& x, L const& y, L const& radius,
                                                  L const& inverse_mass, L const& closing) {
  WallFace const face = wall_face(net.walls, wall, x, y);
  L const zero(0), distance = lane_abs(face.distance);
  auto const near = distance < radius + closing;
  GrainLaw const law = net.wall_law.as_grain();
  ContactStiffness<L> const k = grain_stiffness(law, lane_max(radius - distance, zero), L(2) * radius);
  Spring<L> spring{L(face.nx), L(face.ny), distance, zero, select(near, k.normal, zero), zero, zero, zero};
  if (law.friction > 0) spring.shear = select(near, k.shear, zero);
  if (law.damping_ratio > 0) spring.dashpot = select(near, dashpot_coefficient(law, inverse_mass, zero), zero);
  return spring;
}

/// Calls visit(Spring, the other disc) for each of a disc's contacts and bonds, and then visit(Spring, -1) for each wall that it
/// touches.
CLATHRA_OF_THE_CALLERS_SIDE
template <class Visit>
KOKKOS_INLINE_FUNCTION void for_each_spring(SpringNetwork const& net, int i, SpringSet const& set, Visit const& visit) {
  ParticleSoA const& p = net.particles;
  bool const bonds = net.laws.bond_kind != BondKind::none;
  for (int k = 0; k < net.rows.length(i); ++k) {
    std::size_t const e = net.rows.entry(i, k);
    int const j = net.rows.neighbour(e);
    Real const formation_overlap = bonds ? Real(net.rows.formation_overlap(e)) : no_bond;
    bool const closes = set.bonds_close && is_bonded(formation_overlap);
    Real const closing = closes ? no_bond : set.skin_fraction * (p.verlet_skin(i) + p.verlet_skin(j));
    Pair<Real> const pair{p.x(j) - p.x(i),
                          p.y(j) - p.y(i),
                          p.radius(i),
                          p.radius(j),
                          p.inverse_mass(i),
                          p.inverse_mass(j),
                          formation_overlap,
                          bonds ? Real(net.rows.width(e)) : 0,
                          set.to_come ? closing : -no_bond};
    if (Spring<Real> const spring = pair_spring(net, pair); spring.normal > 0) visit(spring, j);
  }
  for (int wall = 0; wall < wall_count; ++wall) {
    Spring<Real> const spring =
        wall_spring(net, wall, p.x(i), p.y(i), p.radius(i), p.inverse_mass(i), set.skin_fraction * p.verlet_skin(i));
    if (spring.normal > 0) visit(spring, -1);
  }
}

}  // namespace clathra
