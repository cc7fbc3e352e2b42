#include "domain/scene/hydrate.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "domain/scene/phase_boundary.hpp"
#include "domain/scene/short_number.hpp"
#include "domain/scene/units.hpp"
#include "kernels/bond_law.hpp"

namespace clathra {
namespace {

constexpr double printed_tensile_stress = 1.421e7;      // 3 q_max,t of Eq. 14a [Pa]
constexpr double printed_compressive_stress = 2.571e7;  // 3 q_max,c of Eq. 14b [Pa]

std::string state_text(HydrateScene const& hydrate) {
  return format_number(hydrate.temperature) + " degC, " + format_quantity(hydrate.pore_pressure, Dimension::pressure) + ", " +
         format_quantity(hydrate.density, Dimension::density);
}

/// How a bond is read off those between rods that were tested, and whether it may be weaker than a grain contact.
void set_rod(BondStrengthLaw& strength, Scene const& scene, double d50) {
  constexpr double rod_diameter = 12e-3, thinnest = 0.6e-3, area = 3e-3 * 50e-3;  // [m, m, m^2] of the bonds between rods
  if (scene.bond.thickness_mapping == ThicknessMapping::clamped) strength.least_rod_thickness = thinnest;
  if (scene.bond.thickness_mapping == ThicknessMapping::scaled) {
    strength.rod_scale = rod_diameter / d50;
    strength.rod_share = 0;
    strength.rod_share_per_width = 1 / area;  // of a bond 1 m long
  }
  if (scene.bond.friction_floor) {
    strength.floor_friction = scene.grains.friction;
    strength.floor_shape_factor = scene.grains.rolling_width_factor;
  }
}

StrengthScatter scatter_of(BondScene const& bond) {
  StrengthScatter scatter;
  if (bond.strength_modulus == 0) return scatter;
  scatter.inverse_modulus = 1 / bond.strength_modulus;
  scatter.scale = 1 / std::tgamma(1 + scatter.inverse_modulus);
  scatter.least = scatter.quantile(StrengthScatter::weakest);
  for (int k = 0; k < StrengthScatter::mark_count; ++k) scatter.at_mark[k] = scatter.quantile(scatter.mark[k]);
  scatter.seed = bond.strength_seed;
  return scatter;
}

}  // namespace

HydrateStrength hydrate_strength(double temperature, double pore_pressure, double density) {
  double const p = pore_pressure / atmospheric_pressure;
  double const t = temperature;  // T / T_0 with T_0 = 1 deg C
  double const r = density / water_density;
  HydrateStrength strength;
  strength.compression = atmospheric_pressure * (0.81 * p - 2.08 * t + 184.16 * r - 134.65);
  strength.tension = atmospheric_pressure * (0.45 * p - 1.15 * t + 101.75 * r - 74.39);
  strength.modulus = atmospheric_pressure * (3.0 * p - 1.98 * t + 4950.50 * r - 1821.78);
  return strength;
}

double critical_thickness_ratio(double saturation) {
  if (!(saturation >= 0 && saturation <= 1)) {
    std::string const hint = saturation > 1 && saturation <= 100 ? " (looks like percent: 26 % is 0.26)" : "";
    throw std::invalid_argument("hydrate saturation must lie between 0 and 1, got " + format_number(saturation) + hint);
  }
  if (saturation <= 0.2) return 0;
  if (saturation <= 0.7) return (-0.3268 * saturation + 0.4879) * saturation - 0.0815;
  return 0.1;
}

std::string saturation_warning(double saturation) {
  std::string const stated = "a saturation of " + format_number(std::round(saturation * 1e8) / 1e6) + " %";
  if (saturation > 0 && saturation <= 0.2) return stated + " makes no bonds: Eq. 3 has none up to 20 %";
  if (saturation > 0.7 && saturation <= 1)
    return stated + " is above the range of Eq. 3, which ends at 70 %: the critical thickness stays at 0.1 d50";
  return {};
}

std::string stability_problem(HydrateScene const& hydrate) {
  double const limit = equilibrium_temperature(hydrate.pore_pressure, hydrate.salinity);
  if (hydrate.temperature <= limit) return {};
  double const shown = std::floor(limit * 100) / 100, least = equilibrium_pressure(hydrate.temperature, hydrate.salinity);
  return "hydrate is not stable at " + format_number(hydrate.temperature) + " degC and a pore pressure of " +
         format_quantity(hydrate.pore_pressure, Dimension::pressure) + " in water of " + format_number(hydrate.salinity) +
         " ppt of salt: it dissociates above " + format_number(shown) + " degC, or below " +
         short_number(std::ceil(least * 1e-4) * 1e-2) + " MPa";
}

std::string hydrate_problem(HydrateScene const& hydrate) {
  HydrateStrength const strength = hydrate_strength(hydrate.temperature, hydrate.pore_pressure, hydrate.density);
  if (!(strength.tension > 0) || !(strength.compression > 0))
    return "hydrate has no strength left at " + state_text(hydrate) + " (Eq. 13)";
  if (!(strength.modulus > 0)) return "hydrate has no stiffness left at " + state_text(hydrate) + " (Eq. 18)";
  return {};
}

std::string fit_warning(HydrateScene const& hydrate) {
  constexpr double slack = 1e-9;
  auto const is_outside = [](double value, double least, double most) {
    double const margin = slack * (most - least);
    return !(value >= least - margin && value <= most + margin);
  };
  std::string outside;
  auto const look = [&](bool is_out, std::string const& value, char const* range) {
    if (is_out) outside.append(outside.empty() ? "" : ", ").append(value).append(range);
  };
  look(is_outside(hydrate.temperature, -30, 1e3), format_number(hydrate.temperature), " degC (-30 degC and warmer)");
  look(is_outside(hydrate.pore_pressure, 1.5e6, 8e6), format_quantity(hydrate.pore_pressure, Dimension::pressure),
       " of pore pressure (1.5 to 8 MPa)");
  look(is_outside(hydrate.density, 720, 900), format_quantity(hydrate.density, Dimension::density), " (720 to 900 kg/m^3)");
  if (outside.empty()) return outside;
  return outside.insert(0, "strength and stiffness of hydrate are extrapolated: Eqs. 13 and 18 were not fitted to ");
}

bool has_bonds(Scene const& scene) { return scene.hydrate.saturation > 0 && scene.bond.law != BondLawKind::none; }

BondLaw make_bond_law(Scene const& scene, double d50, double critical_thickness) {
  HydrateScene const& hydrate = scene.hydrate;
  HydrateStrength const solid = hydrate_strength(hydrate.temperature, hydrate.pore_pressure, hydrate.density);
  bool const printed = scene.bond.strength_from == StrengthFrom::printed;
  BondLaw law;
  law.strength.tensile_stress = printed ? printed_tensile_stress : 3 * solid.tension;
  law.strength.compressive_stress = printed ? printed_compressive_stress : 3 * solid.compression;
  law.strength.moment_length = scene.bond.rolling_lever.length;
  law.strength.moment_width_ratio = scene.bond.rolling_lever.width_fraction;
  set_rod(law.strength, scene, d50);
  law.scatter = scatter_of(scene.bond);
  law.modulus = solid.modulus;
  law.particle_stiffness = scene.bond.grain_stiffness_factor * scene.grains.normal_stiffness;
  law.critical_thickness = critical_thickness;
  law.thickness_partner = critical_thickness;
  if (scene.bond.law == BondLawKind::constant_thickness) {
    double const plate = scene.bond.constant_thickness > 0 ? scene.bond.constant_thickness : critical_thickness / 2;
    law.thickness_weight = 0;
    law.plate_thickness = plate;
    law.thickness_partner = plate;
  }
  if (scene.bond.contact_coupling == ContactCoupling::replaces_keeping_force)
    law.preload_stiffness = scene.grains.normal_stiffness;
  // f_s and f_r fall from gap 0 to 1.15 mm and rise from there; the last digits are left to the rounding of exponential().
  double const thickest = law.thickness_weight * critical_thickness + law.plate_thickness;
  double const flattest = std::min(rod_thickness(law.strength, thickest), 1.15e-3);
  law.least_shape_of_shear = shape_of_shear(flattest) * (1 - 1e-12);
  law.least_shape_of_rolling = shape_of_rolling(flattest) * (1 - 1e-12);
  return law;
}

BondCard evaluate_bond(Scene const& scene, double d50, double r1, double r2, double gap, double normal_force) {
  bool const given = scene.bond.critical_thickness_from == CriticalThicknessFrom::given;
  double const h_max = given ? scene.bond.critical_thickness : critical_thickness_ratio(scene.hydrate.saturation) * d50;
  BondLaw const law = make_bond_law(scene, d50, h_max);
  HydrateStrength const solid = hydrate_strength(scene.hydrate.temperature, scene.hydrate.pore_pressure, scene.hydrate.density);

  BondCard card;
  card.h_max = h_max;
  card.common_radius = common_radius(r1, r2);
  card.thickness = law.bond_thickness(-gap);
  card.B = law.width(card.common_radius, card.thickness);
  card.h0 = effective_thickness(card.thickness, law.thickness_partner);
  card.area = bond_area(card.common_radius, card.B, card.thickness, h_max);
  card.q_c = solid.compression;
  card.q_t = solid.tension;
  card.E_m = solid.modulus;
  double const rod = rod_thickness(law.strength, card.thickness);
  card.R_t = tensile_strength(law.strength, card.B, rod);
  card.R_c = compressive_strength(law.strength, card.B, rod);
  card.k_mh = card.h0 > 0 ? card.B * law.modulus / card.h0 : 0;
  ContactStiffness<double> const stiffness = law.stiffness(card.B, card.thickness);
  card.k_bn = stiffness.normal;
  card.k_bs = stiffness.shear;
  card.k_bm = stiffness.rolling;
  card.f_s = shape_of_shear(rod);
  card.K_s = shear_slope(rod);
  card.f_r = shape_of_rolling(rod);
  card.K_r = rolling_slope(rod);
  card.moment_length = moment_length(law.strength, card.B);
  card.bonded = scene.bond.law != BondLawKind::none && h_max > 0 && gap < h_max && card.R_t > 0 && card.R_c > 0;

  BondStrength strength = bond_strength(law.strength, card.B, card.thickness);
  card.R_s = strength.shear(normal_force);
  strength.moment_slope = card.f_r * card.K_r;  // without L_r, which may be 0 for a bond of no width
  card.R_r_per_length = strength.rolling(normal_force);
  return card;
}

}  // namespace clathra
