#include "kernels/hydrate_change.hpp"

#include "kernels/pair_state.hpp"

namespace clathra {

namespace {

/// A bond before and after.
struct ChangedBond {
  bool leaves;
  Real width, thickness;  ///< before [m]
  ContactStiffness<Real> was, is;
};

KOKKOS_INLINE_FUNCTION ChangedBond changed_bond(ParticleSoA const& p, ContactRows const& rows, BondLaw const& before,
                                                BondLaw const& next, int i, std::size_t e) {
  Real const formed_at = rows.formation_overlap(e), common = common_radius(p.radius(i), p.radius(rows.neighbour(e)));
  ChangedBond bond;
  bond.thickness = before.bond_thickness(formed_at);
  bond.width = before.width_formed_at(common, formed_at);
  bond.was = before.stiffness(bond.width, bond.thickness);
  Real const thickness = next.bond_thickness(formed_at), width = next.width_formed_at(common, formed_at);
  bond.is = next.stiffness(width, thickness);
  BondStrength const strength = bond_strength(next.strength, width, thickness, common);
  bond.leaves = !(thickness < next.critical_thickness) || !(strength.tension > 0) || !(strength.compression > 0);
  return bond;
}

struct LeavingSums {
  ParticleSoA p;
  ContactRows rows;
  ContactLaws laws;
  BondLaw next;

  KOKKOS_FUNCTION void operator()(int i, Real* out) const {
    for (int k = 0; k < rows.length(i); ++k) {
      std::size_t const e = rows.entry(i, k);
      if (!is_bonded(rows.formation_overlap(e)) || !changed_bond(p, rows, laws.bond, next, i, e).leaves) continue;
      PairState const pair = pair_state(p, rows, laws, i, e);
      out[0] += 0.25 * lane_abs(pair.bond_normal) * pair.distance;
    }
  }
};

struct ChangeBonds {
  ParticleSoA p;
  ContactRows rows;
  ContactLaws laws;
  BondLaw next;
  BreakLog breaks;
  std::int64_t step;

  KOKKOS_FUNCTION void operator()(int i) const {
    for (int k = 0; k < rows.length(i); ++k)
      if (std::size_t const e = rows.entry(i, k); is_bonded(rows.formation_overlap(e))) change(i, e);
  }

  KOKKOS_INLINE_FUNCTION void change(int i, std::size_t e) const {
    ChangedBond const bond = changed_bond(p, rows, laws.bond, next, i, e);
    bool const separate = laws.bond_kind == BondKind::parallel;
    RealField const &shear = separate ? rows.bond_shear : rows.shear, &moment = separate ? rows.bond_moment : rows.moment;
    if (!bond.leaves) {
      scale(shear, e, bond.was.shear, bond.is.shear);
      scale(moment, e, bond.was.rolling, bond.is.rolling);
      return;
    }
    Real const dx = p.x(rows.neighbour(e)) - p.x(i), dy = p.y(rows.neighbour(e)) - p.y(i),
               distance = std::sqrt(dx * dx + dy * dy), overlap = p.radius(i) + p.radius(rows.neighbour(e)) - distance;
    record(i, e, bond, overlap, dx, dy, shear.extent(0) > 0 ? Real(shear(e)) : 0, moment.extent(0) > 0 ? Real(moment(e)) : 0);
    rows.formation_overlap.set(e, no_bond);
    // In the place of a bond the pair goes on as a grain contact, with what that can bear of its shear force and moment.
    Real const normal = !separate && overlap > 0 ? spring_force(laws.grain, overlap) : 0,
               common = common_radius(p.radius(i), p.radius(rows.neighbour(e)));
    limit(shear, e, shear_limit(laws.grain, normal));
    limit(moment, e, moment_limit(laws.grain, common, normal));
  }

  KOKKOS_INLINE_FUNCTION static void scale(RealField const& field, std::size_t e, Real was, Real is) {
    if (field.extent(0) > 0) field.set(e, was > 0 ? field(e) * (is / was) : Real(0));
  }
  KOKKOS_INLINE_FUNCTION static void limit(RealField const& field, std::size_t e, Real most) {
    if (field.extent(0) > 0) field.set(e, most > 0 ? clamp_to(Real(field(e)), most) : Real(0));
  }

  /// By the side with the smaller id.
  KOKKOS_INLINE_FUNCTION void record(int i, std::size_t e, ChangedBond const& bond, Real overlap, Real dx, Real dy, Real shear,
                                     Real moment) const {
    int const id = p.id(i), other = p.id(rows.neighbour(e));
    if (id > other) return;
    breaks.record(step, id, other, BreakMode::dissolved, p.x(i) + 0.5 * dx, p.y(i) + 0.5 * dy, [&] {
      BreakDetails details;
      details.eps1 = 0;  // the host's, from the height of the box
      details.orientation = angle_of_line(dx, dy);
      details.thickness = bond.thickness;
      details.width = bond.width;
      details.utilisation = BondStrength::no_strength;
      ContactMotion<Real> const still{overlap, 0, 0, 0, 0};
      BondForce<Real> force = bond_springs(laws.bond, still, Real(rows.formation_overlap(e)), bond.width);
      force.force.shear = shear, force.force.moment = moment;
      details.energy = spring_energy(force.force, bond.was);
      details.relative_rotation = moment / lane_max(bond.was.rolling, 1e-300);
      return details;
    });
  }
};

}  // namespace

Real force_of_leaving_bonds(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, BondLaw const& next,
                            Summation const& sums) {
  Real const unit[] = {sums.unit.energy()};
  Real out[1] = {0};
  exact_sums<1>("leaving_bonds", particles.owned, LeavingSums{particles, rows, laws, next}, unit, out, sums.over_ranks);
  return out[0];
}

void change_bonds(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, BondLaw const& next,
                  BreakLog const& breaks, std::int64_t step) {
  Kokkos::parallel_for("change_bonds", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                       ChangeBonds{particles, rows, laws, next, breaks, step});
}

}  // namespace clathra
