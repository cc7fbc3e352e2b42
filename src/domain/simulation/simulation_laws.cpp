#include "domain/simulation/simulation_laws.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace clathra {

bool same_stiffness(ContactLaws const& a, ContactLaws const& b) {
  auto const of_grains = [](GrainLaw const& law) { return std::tuple(law.normal_stiffness, law.shear_stiffness); };
  auto const of_bonds = [](BondLaw const& law) {
    return std::tuple(law.modulus, law.particle_stiffness, law.critical_thickness, law.thickness_partner, law.thickness_weight,
                      law.plate_thickness, law.width_lost, law.width_share);
  };
  return a.bond_kind == b.bond_kind && of_grains(a.grain) == of_grains(b.grain) && of_bonds(a.bond) == of_bonds(b.bond);
}

Real stiffening(SimulationLaws const& before, SimulationLaws const& after) {
  constexpr Real calm_friction = 2;  // sliding vibrates faster above it (stability.hpp)
  Real most = 1;
  auto const compare = [&most](Real was, Real is) {
    if (is > was) most = std::max(most, was > 0 ? is / was : HUGE_VAL);
  };
  GrainLaw const &old_grain = before.contact.grain, &grain = after.contact.grain;
  compare(old_grain.normal_stiffness * old_grain.shape_factor * old_grain.shape_factor,
          grain.normal_stiffness * grain.shape_factor * grain.shape_factor);
  compare(std::max(old_grain.friction, calm_friction), std::max(grain.friction, calm_friction));
  compare(old_grain.damping_ratio, grain.damping_ratio);
  compare(before.wall.normal_stiffness, after.wall.normal_stiffness);
  compare(before.wall.shear_stiffness, after.wall.shear_stiffness);
  if (!same_stiffness(before.contact, after.contact)) return HUGE_VAL;
  return most * std::max<Real>(1, (1 + after.motion.damping) / (1 + before.motion.damping));
}

}  // namespace clathra
