#include "domain/scene/hydrate_loss.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/bond_law.hpp"
#include "kernels/elementary.hpp"

namespace clathra {

namespace {

/// What is left, over the spread above 20 %, of that which is left at its upper end.
double share_of_rest(double saturation, double spread) { return std::clamp((saturation - least_cementing) / spread, 0.0, 1.0); }

/// Of the reference bond, without the spread [m].
double lost_width(Scene const& scene, double d50, double formed, double saturation) {
  double const spread = scene.hydrate.spread_of_loss,
               left = remaining_thickness(scene.hydrate.saturation, std::max(saturation, least_cementing + spread), spread);
  return bond_width(0.5 * d50, formed) - bond_width(0.5 * d50, formed * left);
}

void recede(BondLaw& law, Scene const& scene, double d50, double saturation) {
  law.width_lost = lost_width(scene, d50, law.critical_thickness, saturation);
  law.width_share = share_of_rest(saturation, scene.hydrate.spread_of_loss);
}

void weaken(BondLaw& law, double share) {
  law.strength = part_of(law.strength, share);
  law.modulus *= share;
}

}  // namespace

double remaining_thickness(double formed, double saturation, double spread) {
  double const edge = least_cementing + spread;
  if (saturation >= edge) return critical_thickness_ratio(saturation) / critical_thickness_ratio(formed);
  return critical_thickness_ratio(edge) / critical_thickness_ratio(formed) * std::max(0.0, saturation - least_cementing) / spread;
}

double reference_width(Scene const& scene, double d50, double formed, double saturation) {
  return share_of_rest(saturation, scene.hydrate.spread_of_loss) *
         (bond_width(0.5 * d50, formed) - lost_width(scene, d50, formed, saturation));
}

double saturation_of_width(Scene const& scene, double d50, double formed, double width) {
  double const spread = scene.hydrate.spread_of_loss, edge = reference_width(scene, d50, formed, least_cementing + spread);
  if (width <= edge) return least_cementing + spread * std::max(0.0, width) / edge;
  // Eq. 2, h_max = 2 r - sqrt(4 r^2 - B^2) without its cancellation, and Eq. 3 backwards: both are quadratic.
  double const h_max = width * width / (d50 + std::sqrt(d50 * d50 - width * width)),
               ratio = h_max / formed * critical_thickness_ratio(scene.hydrate.saturation);
  constexpr double a = 0.3268, b = 0.4879, c = 0.0815;
  double const root = b * b - 4 * a * (c + ratio);
  return std::min(0.7, root > 0 ? 2 * (c + ratio) / (b + std::sqrt(root)) : 0.7);
}

double remaining_cement(double formed, double saturation) {
  return std::max(0.0, saturation - least_cementing) / (formed - least_cementing);
}

BondLaw changed_bond_law(Scene const& scene, double d50, BondLaw const& formed, HydrateScene const& now) {
  BondLaw law = formed;
  HydrateScene const& then = scene.hydrate;
  if (scene.bond.strength_from != StrengthFrom::printed) {
    HydrateStrength const solid = hydrate_strength(now.temperature, now.pore_pressure, now.density);
    law.strength.tensile_stress = 3 * solid.tension;
    law.strength.compressive_stress = 3 * solid.compression;
  }
  switch (then.loss) {
    case HydrateLoss::critical_thickness:
      law.critical_thickness =
          formed.critical_thickness * remaining_thickness(then.saturation, now.saturation, then.spread_of_loss);
      break;
    case HydrateLoss::recession:
      recede(law, scene, d50, now.saturation);
      break;
    case HydrateLoss::uniform: {
      double const left = remaining_cement(then.saturation, now.saturation), n = then.loss_exponent;
      weaken(law, n == 1 || left == 0 ? left : power(left, n));
      break;
    }
  }
  return law;
}

}  // namespace clathra
