#include "domain/generation/bonding.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "domain/parallel/near_pairs.hpp"
#include "domain/scene/hydrate.hpp"
#include "kernels/bond_law.hpp"
#include "kernels/exact_sum.hpp"

namespace clathra {

namespace {

enum class Bondability { bondable, no_tension, out_of_fit };

/// Whether a pair may be bonded: the traps 4, 6 and 7 of the strength laws.
Bondability bondability(BondLaw const& law, double radius, double thickness) {
  double const width = law.width(radius, thickness);
  BondStrength const strength = bond_strength(law.strength, width, thickness);
  if (!(strength.tension > 0)) return Bondability::no_tension;
  bool const fits = strength.compression > 0 && strength.shear_slope > 0 && strength.moment_slope > 0;
  return fits ? Bondability::bondable : Bondability::out_of_fit;
}

double unit_of_area(Specimen const& s) { return SumUnits::near(s.d50 * s.d50); }

/// Sum of Eq. 5 over the pairs that a critical thickness would bond [m^2].
double area_at(Scene const& scene, Specimen const& s, std::vector<NearPair> const& pairs, double h_max, Ranks const& ranks) {
  BondLaw const law = make_bond_law(scene, s.d50, h_max);
  ExactSum area(unit_of_area(s));
  for (NearPair const& p : pairs) {
    if (!(p.gap < h_max)) continue;
    double const radius = common_radius(s.radius[p.a], s.radius[p.b]), thickness = law.bond_thickness(-p.gap);
    if (bondability(law, radius, thickness) == Bondability::bondable)
      area.add(bond_area(radius, law.width(radius, thickness), thickness, h_max));
  }
  return area.over(ranks.summation());
}

double area_of_equation_4(Scene const& scene, Specimen const& s) {
  double const e = s.void_ratio, area = s.width() * s.height();
  return std::max(0.0, scene.hydrate.saturation - 0.2) * e / (1 + e) * area;
}

}  // namespace

double critical_thickness(Scene const& scene, Specimen const& share, Ranks const& ranks) {
  switch (scene.bond.critical_thickness_from) {
    case CriticalThicknessFrom::saturation:
      return critical_thickness_ratio(scene.hydrate.saturation) * share.d50;
    case CriticalThicknessFrom::given:
      return scene.bond.critical_thickness;
    case CriticalThicknessFrom::bond_area:
      break;
  }
  double const target = area_of_equation_4(scene, share);
  if (target <= 0) return 0;
  double low = 0, high = share.d50;  // a bond as thick as a grain is no bond any more
  Specimen const s = with_halo(ranks, share, high);
  auto const pairs = near_pairs(s, share.size(), high);
  if (area_at(scene, s, pairs, high, ranks) < target) {
    throw Refused(
        "bond.critical_thickness_from = \"bond_area\": even bonds of thickness d50 hold less hydrate than the saturation " +
        std::to_string(scene.hydrate.saturation) + " demands");
  }
  for (int n = 0; n < 60; ++n) {
    double const middle = 0.5 * (low + high);
    (area_at(scene, s, pairs, middle, ranks) < target ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

namespace {

/// Bonds a pair, or counts why it may not be bonded.
void decide(Scene const& scene, BondLaw const& law, double radius, double distance, SpecimenContact& contact,
            BondingOutcome& outcome, ExactSum& area) {
  double const thickness = law.bond_thickness(-distance);
  switch (bondability(law, radius, thickness)) {
    case Bondability::no_tension:
      ++outcome.rejected_no_tension;
      break;
    case Bondability::out_of_fit:
      ++outcome.rejected_out_of_fit;
      break;
    case Bondability::bondable:
      ++outcome.bonds;
      contact.formation_overlap = -distance;
      if (scene.bond.contact_coupling == ContactCoupling::replaces)
        contact.shear = contact.moment = 0;  // Eq. 7 starts from F_n = F_s = M = 0
      area.add(bond_area(radius, law.width(radius, thickness), thickness, outcome.critical_thickness));
  }
}

}  // namespace

BondingOutcome install_bonds(Scene const& scene, Specimen& share, Ranks const& ranks) {
  BondingOutcome outcome;
  outcome.critical_thickness = critical_thickness(scene, share, ranks);
  outcome.target_area = area_of_equation_4(scene, share);
  if (!(outcome.critical_thickness > 0)) return outcome;
  Specimen const s = with_halo(ranks, share, outcome.critical_thickness);
  ExactSum area(unit_of_area(s));
  BondLaw const law = make_bond_law(scene, share.d50, outcome.critical_thickness);
  std::vector<SpecimenContact> contacts;
  std::sort(share.contacts.begin(), share.contacts.end(), by_ids);
  auto old = share.contacts.begin();
  // Both lists are sorted by ids: one walk merges the bonds into the contacts with history.
  auto const before = [](SpecimenContact const& c, int id_a, int id_b) { return c.id_a != id_a ? c.id_a < id_a : c.id_b < id_b; };
  auto const pairs = near_pairs(s, share.size(), outcome.critical_thickness);
  contacts.reserve(pairs.size() + share.contacts.size());
  for (NearPair const& p : pairs) {
    int const id_a = s.id[p.a], id_b = s.id[p.b];
    while (old != share.contacts.end() && before(*old, id_a, id_b)) contacts.push_back(*old++);
    SpecimenContact contact{id_a, id_b};
    if (old != share.contacts.end() && old->id_a == id_a && old->id_b == id_b) contact = *old++;
    decide(scene, law, common_radius(s.radius[p.a], s.radius[p.b]), p.gap, contact, outcome, area);
    contacts.push_back(contact);
  }
  contacts.insert(contacts.end(), old, share.contacts.end());
  share.contacts = std::move(contacts);
  share.critical_thickness = outcome.critical_thickness;
  share.separate_bonds = scene.bond.contact_coupling == ContactCoupling::parallel;
  for (std::int64_t* const count : {&outcome.bonds, &outcome.rejected_no_tension, &outcome.rejected_out_of_fit})
    *count = ranks.sum(*count);
  outcome.bond_area = area.over(ranks.summation());
  double const void_area = share.void_ratio / (1 + share.void_ratio) * share.width() * share.height();
  outcome.areal_saturation = outcome.bond_area / void_area;
  return outcome;
}

void bond_specimen(Scene const& scene, Specimen& specimen, StageRecord& record, Ranks const& ranks) {
  BondingOutcome const outcome = install_bonds(scene, specimen, ranks);
  record["h_max_m"] = outcome.critical_thickness;
  record["bonds"] = static_cast<double>(outcome.bonds);
  record["bonds_per_particle"] =
      static_cast<double>(outcome.bonds) / static_cast<double>(ranks.sum(static_cast<std::int64_t>(specimen.size())));
  record["pairs_without_tensile_strength"] = static_cast<double>(outcome.rejected_no_tension);
  record["pairs_beyond_fit"] = static_cast<double>(outcome.rejected_out_of_fit);
  record["bond_area_m2"] = outcome.bond_area;
  record["areal_saturation"] = outcome.areal_saturation;
  record["areal_saturation_demanded"] = std::max(0.0, scene.hydrate.saturation - 0.2);
}

}  // namespace clathra
