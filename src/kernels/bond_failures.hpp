#pragma once
/// What the contact kernel does where bonds may break.
#include "kernels/contact_constants.hpp"

namespace clathra {

/// @tparam P  FullPrecision or MixedPrecision
template <class P>
struct BondFailures {
  using R = typename P::Real;
  using V = LanesOf<R>;
  using VMask = MaskOf<V>;
  static constexpr bool mixed = P::precision == Precision::mixed;

  ParticleSoA const& p;
  ContactRows const& rows;
  ContactConstants<R> const& constants;
  BondLaw const& exact;  ///< for the strength test that decides, in double precision
  BreakLog const& breaks;
  std::int64_t step;

  /// A block with bonds that may break. It is put together where one is met: a block whose values had an address would spend its
  /// time storing and loading them.
  struct Candidates {
    std::size_t first, entry;
    VMask where;
    V width, thickness, normal, shear, moment;
    V dx, dy;  ///< branches
  };

  /// The closer strength test of the failure candidates and, one by one, the exact one of those that it leaves. @return those
  /// that broke
  CLATHRA_COLD_FUNCTION VMask break_bonds(Candidates const& block) const {
    VMask broken(false);
    for_each_set(doubtful(block), [&](int l) {
      std::size_t const e = block.entry + static_cast<std::size_t>(l), disc = block.first + static_cast<std::size_t>(l);
      Real share = 1;
      if (exact.scatter.is_on()) {
        Real const part = exact.scatter.part_below(p.id(disc), p.id(rows.neighbour(e)));
        if (is_surely_intact(exact, trial_of(block, l, 1 / exact.scatter.lower_bound(part)))) return;
        share = lane_max(exact.scatter.least, exact.scatter.quantile(part));
      }
      if (mixed && is_surely_intact(exact, trial_of(block, l, 1 / share))) return;
      Real const radius = common_radius(p.radius(disc), p.radius(rows.neighbour(e)));
      BondStrength strength = bond_strength(exact.strength, lane(block.width, l), lane(block.thickness, l), radius);
      strength.tension *= share;  // R_s and R_r are proportional to R_c + R_t
      strength.compression *= share;
      ContactForce<Real> const force = trial_of(block, l).force;
      BreakMode const mode = strength.test(force.normal, force.shear, force.moment);
      if (mode == BreakMode::none) return;
      rows.formation_overlap.data<R>()[e] = no_bond_of<R>;
      set_lane(broken, l, true);
      int const id = p.id(disc), other = p.id(rows.neighbour(e));
      if (id < other)  // the other side sees it too
        breaks.record(step, id, other, mode, p.x(disc) + half_a_unit() * lane(block.dx, l),
                      p.y(disc) + half_a_unit() * lane(block.dy, l), [&] { return details_of(block, l, strength, mode); });
    });
    return broken;
  }

  /// Half of what branches count in [m].
  KOKKOS_FORCEINLINE_FUNCTION Real half_a_unit() const { return mixed ? 0.5 * p.mirror.tick : 0.5; }

  /// One of them. @param factor  of its forces
  KOKKOS_FORCEINLINE_FUNCTION BondForce<Real> trial_of(Candidates const& block, int l, Real factor = 1) const {
    return {{factor * lane(block.normal, l), factor * lane(block.shear, l), factor * lane(block.moment, l)},
            {0, 0, 0},
            lane(block.width, l),
            lane(block.thickness, l)};
  }

  /// In full precision the closer test is made in lanes, in mixed precision one by one.
  KOKKOS_FORCEINLINE_FUNCTION VMask doubtful(Candidates const& block) const {
    if constexpr (mixed) return block.where;
    BondForce<V> const trial{{block.normal, block.shear, block.moment}, {0, 0, 0}, block.width, block.thickness};
    return block.where && !is_surely_intact(constants.bond, trial);
  }

  /// @param l  the lane of a bond that broke
  CLATHRA_COLD_FUNCTION BreakDetails details_of(Candidates const& block, int l, BondStrength const& strength,
                                                BreakMode mode) const {
    std::size_t const disc = block.first + static_cast<std::size_t>(l);
    auto const other = static_cast<std::size_t>(rows.neighbour(block.entry + static_cast<std::size_t>(l)));
    ContactForce<Real> const force = trial_of(block, l).force;
    BreakDetails details;
    details.eps1 = 0;  // the host's, from the height of the box
    details.orientation = angle_of_line(p.x(other) - p.x(disc), p.y(other) - p.y(disc));
    details.thickness = lane(block.thickness, l);
    details.width = lane(block.width, l);
    details.utilisation = strength.utilisation(mode, force.normal, force.shear, force.moment);
    ContactStiffness<Real> const stiffness = exact.stiffness(details.width, details.thickness);
    details.energy = spring_energy(force, stiffness);
    details.relative_rotation = force.moment / lane_max(stiffness.rolling, 1e-300);
    return details;
  }
};

}  // namespace clathra
