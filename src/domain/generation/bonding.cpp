#include "domain/generation/bonding.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "domain/scene/hydrate.hpp"
#include "kernels/bond_law.hpp"
#include "kernels/exact_sum.hpp"

namespace clathra {

namespace {

double gap_between(Specimen const& s, std::size_t a, std::size_t b) {
  double const dx = s.x[b] - s.x[a], dy = s.y[b] - s.y[a];
  return std::sqrt(dx * dx + dy * dy) - (s.radius[a] + s.radius[b]);
}

/// Discs by square cell.
struct HostCells {
  double left, bottom, size;
  std::int64_t columns;
  std::vector<std::pair<std::int64_t, std::size_t>> sorted;  // (cell, disc)
  std::int64_t cell_of(double x, double y) const {
    return static_cast<std::int64_t>((y - bottom) / size) * columns + static_cast<std::int64_t>((x - left) / size);
  }
};

HostCells host_cells(Specimen const& s, double size) {
  auto const [x0, x1] = std::minmax_element(s.x.begin(), s.x.end());
  double const bottom = *std::min_element(s.y.begin(), s.y.end()) - size, left_edge = *x0 - size;
  HostCells cells{left_edge, bottom, size, static_cast<std::int64_t>((*x1 - left_edge) / size) + 2, {}};
  cells.sorted.reserve(s.size());
  for (std::size_t i = 0; i < s.size(); ++i) cells.sorted.emplace_back(cells.cell_of(s.x[i], s.y[i]), i);
  std::sort(cells.sorted.begin(), cells.sorted.end());
  return cells;
}

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

std::vector<NearPair> near_pairs(Specimen const& s, double reach, std::size_t own) {
  if (s.size() == 0) return {};
  double const widest = 2 * *std::max_element(s.radius.begin(), s.radius.end());
  HostCells const cells = host_cells(s, widest + std::max(reach, 0.0));
  auto const first_of = [&](std::int64_t cell) {
    return static_cast<std::size_t>(
        std::lower_bound(cells.sorted.begin(), cells.sorted.end(), std::pair<std::int64_t, std::size_t>{cell, 0}) -
        cells.sorted.begin());
  };
  std::vector<NearPair> pairs;
  std::size_t row_begin[3] = {0, 0, 0};
  std::int64_t current = -1;
  for (auto const& [cell, i] : cells.sorted) {
    if (cell != current) {
      for (int r = 0; r < 3; ++r) row_begin[r] = first_of(cell + (r - 1) * cells.columns - 1);
      current = cell;
    }
    for (int r = 0; r < 3; ++r) {
      std::int64_t const last = cell + (r - 1) * cells.columns + 1;
      for (std::size_t k = row_begin[r]; k < cells.sorted.size() && cells.sorted[k].first <= last; ++k) {
        std::size_t const j = cells.sorted[k].second;
        if (s.id[i] >= s.id[j] || i >= own) continue;
        double const gap = gap_between(s, i, j);
        if (gap < reach) pairs.push_back({i, j, gap});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end(), [&](NearPair const& p, NearPair const& q) {
    return s.id[p.a] != s.id[q.a] ? s.id[p.a] < s.id[q.a] : s.id[p.b] < s.id[q.b];
  });
  return pairs;
}

double critical_thickness(Scene const& scene, Specimen const& share, Ranks const& ranks) {
  switch (scene.bond.mode) {
    case BondingMode::eq3:
      return critical_thickness_ratio(scene.hydrate.saturation) * share.d50;
    case BondingMode::given_thickness:
      return scene.bond.critical_thickness;
    case BondingMode::areal_target:
      break;
  }
  double const target = area_of_equation_4(scene, share);
  if (target <= 0) return 0;
  double low = 0, high = share.d50;  // a bond as thick as a grain is no bond any more
  Specimen const s = with_halo(ranks, share, high);
  auto const pairs = near_pairs(s, high, share.size());
  if (area_at(scene, s, pairs, high, ranks) < target) {
    throw Refused("bond.mode = 'areal_target': even bonds of thickness d50 hold less hydrate than the saturation " +
                  std::to_string(scene.hydrate.saturation) + " demands");
  }
  for (int n = 0; n < 60; ++n) {
    double const middle = 0.5 * (low + high);
    (area_at(scene, s, pairs, middle, ranks) < target ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Specimen with_halo(Ranks const& ranks, Specimen const& share, double reach) {
  Specimen s;
  s.id = share.id;
  s.x = share.x;
  s.y = share.y;
  s.radius = share.radius;
  s.d50 = share.d50;
  if (ranks.alone()) return s;
  double box[4] = {1e300, -1e300, 1e300, -1e300}, widest = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    box[0] = std::min(box[0], s.x[i]);
    box[1] = std::max(box[1], s.x[i]);
    box[2] = std::min(box[2], s.y[i]);
    box[3] = std::max(box[3], s.y[i]);
    widest = std::max(widest, 2 * s.radius[i]);
  }
  double const far = ranks.max(widest) + std::max(reach, 0.0);
  std::vector<double> boxes(4 * static_cast<std::size_t>(ranks.count()), -1e300);
  for (std::size_t k = 0; k < 4; ++k) boxes[4 * static_cast<std::size_t>(ranks.rank()) + k] = k % 2 == 0 ? -box[k] : box[k];
  ranks.max(boxes.data(), static_cast<int>(boxes.size()));
  std::vector<std::vector<double>> to(static_cast<std::size_t>(ranks.count()));
  for (std::size_t r = 0; r < to.size(); ++r) {
    if (static_cast<int>(r) == ranks.rank()) continue;
    double const* const b = &boxes[4 * r];
    for (std::size_t i = 0; i < share.size(); ++i) {
      bool const near = s.x[i] > -b[0] - far && s.x[i] < b[1] + far && s.y[i] > -b[2] - far && s.y[i] < b[3] + far;
      if (near) to[r].insert(to[r].end(), {double(s.id[i]), s.x[i], s.y[i], s.radius[i]});
    }
  }
  for (auto const& part : ranks.exchange(std::move(to))) {
    for (std::size_t k = 0; k < part.size(); k += 4) {
      s.id.push_back(static_cast<int>(part[k]));
      s.x.push_back(part[k + 1]);
      s.y.push_back(part[k + 2]);
      s.radius.push_back(part[k + 3]);
    }
  }
  return s;
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
      if (scene.bond.composite == Composite::replace) contact.shear = contact.moment = 0;  // Eq. 7 starts from F_n = F_s = M = 0
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
  auto const pairs = near_pairs(s, outcome.critical_thickness, share.size());
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
  share.separate_bonds = scene.bond.composite == Composite::parallel;
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
  record["bonds_per_disc"] =
      static_cast<double>(outcome.bonds) / static_cast<double>(ranks.sum(static_cast<std::int64_t>(specimen.size())));
  record["rejected_no_tension"] = static_cast<double>(outcome.rejected_no_tension);
  record["rejected_out_of_fit"] = static_cast<double>(outcome.rejected_out_of_fit);
  record["bond_area_m2"] = outcome.bond_area;
  record["areal_saturation"] = outcome.areal_saturation;
  record["areal_saturation_demanded"] = std::max(0.0, scene.hydrate.saturation - 0.2);
}

}  // namespace clathra
