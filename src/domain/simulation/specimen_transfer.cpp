#include "domain/simulation/specimen_transfer.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>

#include "domain/parallel/directory.hpp"
#include "domain/parallel/id_index.hpp"
#include "domain/scene/stage.hpp"
#include "domain/simulation/neighbour_search.hpp"
#include "kernels/history_forces.hpp"

namespace clathra {

namespace {

/// Copies host values into the first `values.size()` places of a field.
template <class T, class Number>
void upload(Field<T> const& field, std::vector<Number> const& values) {
  auto host = Kokkos::create_mirror_view(Kokkos::HostSpace(), field);
  Kokkos::deep_copy(host, field);
  std::copy(values.begin(), values.end(), host.data());
  Kokkos::deep_copy(field, host);
}

void upload(RealField const& field, std::vector<double> const& values) { set_from_host(field, values); }

/// Visits the fields of the discs that a specimen keeps, each with its column.
template <class Visit>
void for_each_column_of_specimen(ParticleSoA const& particles, Visit&& visit) {
  for_each_field(particles, [&](DiscField const& about, auto const& field) {
    for (ParticleColumn const& column : particle_columns)
      if (std::string_view(column.name) == about.name) visit(field, column);
  });
}

/// The history of all entries on the host, with the forces themselves, as double whatever it is in the rows.
class HistoryOnHost {
 public:
  /// @param rows  with_forces(), or new ones
  explicit HistoryOnHost(ContactRows const& rows) {
    for_each_history(rows, [&](HistoryField const& about, RealField const& field) {
      if (about.quantity == HistoryField::Quantity::branch) return;
      columns_.push_back({about, number_of(about.name), on_host(field, field.extent(0))});
      if (about.quantity == HistoryField::Quantity::length) return;
      columns_.back().about.empty = 0;
      std::vector<double>& forces = columns_.back().values;
      std::replace(forces.begin(), forces.end(), no_bond, 0.0);
    });
  }

  void upload_to(ContactRows const& rows) const {
    auto column = columns_.begin();
    for_each_history(rows, [&](HistoryField const& about, RealField const& field) {
      if (about.quantity != HistoryField::Quantity::branch) upload(field, (column++)->values);
    });
  }

  bool empty(std::size_t entry) const {
    return std::all_of(columns_.begin(), columns_.end(), [&](Column const& c) { return c.values[entry] == c.about.empty; });
  }

  SpecimenContact contact(std::size_t entry, int id_a, int id_b) const {
    SpecimenContact contact;
    contact.id_a = id_a;
    contact.id_b = id_b;
    for (Column const& c : columns_) contact.*c.number = c.values[entry];
    return contact;
  }

  /// @param is_first  whether the entry is in the row of the contact's first disc
  void set(std::size_t entry, SpecimenContact const& contact, bool is_first) {
    for (Column& c : columns_) c.values[entry] = c.about.odd && !is_first ? -(contact.*c.number) : contact.*c.number;
  }

 private:
  struct Column {
    HistoryField about;
    double SpecimenContact::*number;
    std::vector<double> values;
  };

  static double SpecimenContact::*number_of(std::string_view name) {
    for (ContactNumber const& number : contact_numbers)
      if (name == number.name) return number.of;
    throw std::logic_error("a specimen does not keep the history '" + std::string(name) + "'");
  }

  std::vector<Column> columns_;
};

std::vector<double> or_zero(std::vector<double> const& values, std::size_t size) {
  return values.empty() ? std::vector<double>(size, 0.0) : values;
}

/// The widest gap among the bonded contacts of a specimen [m].
Real widest_gap(Ranks const& ranks, Specimen const& s, std::int64_t discs) {
  std::vector<int> first, second;
  for (SpecimenContact const& c : s.contacts) {
    if (!c.bonded()) continue;
    first.push_back(c.id_a);
    second.push_back(c.id_b);
  }
  if (!ranks.any(!first.empty())) return 0;
  Directory const places(ranks, discs, s.id, {s.x, s.y, s.radius});
  std::vector<double> const a = places.find(first), b = places.find(second);
  Real widest = 0;
  for (std::size_t k = 0; k < a.size(); k += 3) {
    double dx = b[k] - a[k], dy = b[k + 1] - a[k + 1];
    if (s.periodic) {  // the nearest images
      dx -= s.width() * std::round(dx / s.width());
      dy -= s.height() * std::round(dy / s.height());
    }
    widest = std::max(widest, std::hypot(dx, dy) - a[k + 2] - b[k + 2]);
  }
  return ranks.max(widest);
}

/// @throws Diverged where a number of a disc is not finite: a neighbour search would have no place for it
void require_finite(Ranks const& ranks, Specimen const& s) {
  double worst = -1;
  for (ParticleColumn const& column : particle_columns) {
    std::vector<double> const& numbers = s.*column.of;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (!std::isfinite(numbers[i])) worst = std::max(worst, static_cast<double>(s.id[i]));
    }
  }
  worst = ranks.max(worst);
  if (worst < 0) return;
  throw Diverged("step 0: particle " + std::to_string(static_cast<int>(worst)) +
                 " has a position, velocity or radius that is not finite");
}

/// The contacts with a disc of this rank that stand in another rank's share of the specimen.
std::vector<SpecimenContact> contacts_from_others(Ranks const& ranks, Specimen const& s, std::int64_t discs, IdIndex const& here,
                                                  std::vector<int> const& ids) {
  if (ranks.alone()) return {};
  std::vector<int> elsewhere;
  std::vector<std::size_t> of_contact;
  for (std::size_t k = 0; k < s.contacts.size(); ++k) {
    for (int const id : {s.contacts[k].id_a, s.contacts[k].id_b}) {
      if (here.find(id) >= 0) continue;
      elsewhere.push_back(id);
      of_contact.push_back(k);
    }
  }
  std::vector<double> const owner = Directory(ranks, discs, ids, {std::vector<double>(ids.size(), ranks.rank())}).find(elsewhere);
  std::vector<std::vector<double>> to(static_cast<std::size_t>(ranks.count()));
  for (std::size_t n = 0; n < elsewhere.size(); ++n) {
    bool const sent = n > 0 && of_contact[n - 1] == of_contact[n] && owner[n - 1] == owner[n];
    if (!sent) append_numbers(to[static_cast<std::size_t>(owner[n])], s.contacts[of_contact[n]]);
  }
  std::vector<SpecimenContact> contacts;
  for (auto const& part : ranks.exchange(std::move(to))) append_contacts(contacts, part);
  return contacts;
}

void upload_discs(Assembly& a, Specimen const& s) {
  AssemblyFacts& facts = a.facts;
  Ranks const& ranks = a.ranks();
  std::size_t const n = s.size();
  std::vector<double> inverse_mass(n), inverse_inertia(n);
  MassScaling const& scaling = a.laws.scaling;
  auto const moving_area = [least = scaling.least_radius](double r) { return pi * std::max(r, least) * std::max(r, least); };
  for (std::size_t i = 0; i < n; ++i) {
    inverse_mass[i] = 1 / (moving_area(s.radius[i]) * s.density);
    inverse_inertia[i] = 2 * inverse_mass[i] / (scaling.inertia * (s.radius[i] * s.radius[i]));
    facts.largest_radius = std::max(facts.largest_radius, s.radius[i]);
  }
  facts.largest_radius = ranks.max(facts.largest_radius);
  facts.smallest_radius = ranks.min(s.radius.empty() ? HUGE_VAL : *std::min_element(s.radius.begin(), s.radius.end()));
  a.particles = allocate_particles(static_cast<int>(n), a.laws.precision, facts.largest_radius);
  // Summed by id, so that the order of the input does not show.
  Directory const radii(ranks, facts.discs, s.id, {s.radius});
  facts.solid_area = radii.sum_by_id([](double const* r) { return pi * *r * *r; });
  facts.added_mass = radii.sum_by_id([&](double const* r) { return moving_area(*r); }) / facts.solid_area - 1;
  upload(a.particles.id, s.id);
  upload(a.particles.inverse_mass, inverse_mass);
  upload(a.particles.inverse_inertia, inverse_inertia);
  for_each_column_of_specimen(a.particles,
                              [&](auto const& field, ParticleColumn const& column) { upload(field, or_zero(s.*column.of, n)); });
  facts.density = s.density;
  facts.d50 = s.d50;
  facts.critical_thickness = s.critical_thickness;
  if (s.periodic)
    a.now.cell = Box::cell(s.left, s.bottom, s.width(), s.height());
  else
    a.now.walls.place = {{s.left, s.right, s.bottom, s.top}, {0, 0, 0, 0}};
  a.now.at_search.box = a.now.box();
}

/// Writes the history of the specimen's contacts into the rows, on both sides.
void restore_history(Assembly& a, Specimen const& s) {
  ContactRows const& rows = a.rows;
  auto const id = host_copy(a.particles.id), slice_start = host_copy(rows.slice_start), neighbour = host_copy(rows.neighbour);
  auto const length = host_copy(rows.length);
  IdIndex const at(id, a.particles.owned);
  HistoryOnHost history(rows);
  auto const write = [&](SpecimenContact const& c) {
    for (auto const& [mine, other, is_first] : {std::tuple{c.id_a, c.id_b, true}, std::tuple{c.id_b, c.id_a, false}}) {
      int const i = at.find(mine);
      if (i < 0) continue;
      for (int k = 0; k < length(i); ++k) {
        std::size_t const e = entry_in(slice_start, rows.features.format, i, k);
        if (id(neighbour(e)) == other) history.set(e, c, is_first);
      }
    }
  };
  std::for_each(s.contacts.begin(), s.contacts.end(), write);
  auto const others =
      contacts_from_others(a.ranks(), s, a.discs(), at, {id.data(), id.data() + static_cast<std::size_t>(a.particles.owned)});
  std::for_each(others.begin(), others.end(), write);
  history.upload_to(rows);
  prepare_rows(a.particles, a.rows, a.laws.contact.bond);
  re_reference_rows(a.particles, rows, a.laws.contact);
  a.broken.drop_log();  // that of the search before it has room for no bond
  a.make_room_for_breaks();
}

/// The rows, with the history of the specimen's contacts. @param also  what goes with the discs (search_neighbours())
void restore_pairs(Assembly& a, Specimen const& s, bool skin_by_speed, AuxiliaryFields const& also) {
  // The search must reach the widest bond; the skin is its own again afterwards.
  Real const skin = a.upkeep.skin();
  a.upkeep.set_skin(std::max(skin, widest_gap(a.ranks(), s, a.discs()) * (1 + 1e-9)));
  search_neighbours(a, rebuild_inputs_of_all(a), skin_by_speed, also);
  a.upkeep.set_skin(skin);
  a.upkeep.ask();
  restore_history(a, s);
}

/// The pairs with history, sorted by (id_a, id_b).
std::vector<SpecimenContact> contacts_by_id(Assembly const& a) {
  ContactRows const& rows = a.rows;
  auto const id = host_copy(a.particles.id), slice_start = host_copy(rows.slice_start), neighbour = host_copy(rows.neighbour);
  auto const length = host_copy(rows.length);
  HistoryOnHost const history(with_forces(a.particles, rows, a.laws.contact));
  std::vector<SpecimenContact> contacts;
  for (int i = 0; i < a.particles.owned; ++i) {
    for (int k = 0; k < length(i); ++k) {
      std::size_t const e = entry_in(slice_start, rows.features.format, i, k);
      int const other = id(neighbour(e));
      if (other > id(i) && !history.empty(e)) contacts.push_back(history.contact(e, id(i), other));
    }
  }
  std::sort(contacts.begin(), contacts.end(), by_ids);
  return contacts;
}

}  // namespace

void take_over(Assembly& a, Specimen const& s) {
  Ranks const& ranks = a.ranks();
  std::int64_t const total = ranks.sum(static_cast<std::int64_t>(s.size()));
  if (total == 0) throw std::invalid_argument("a specimen needs at least one particle");
  if (s.periodic && !ranks.alone()) throw std::invalid_argument("a periodic cell is too small to be cut among ranks");
  require_finite(ranks, s);
  a.facts.discs = static_cast<int>(total);
  upload_discs(a, s);
  a.set_sums();
  a.rows.features = a.laws.features_of_rows();
  a.ghosts.set_decomposition(Decomposition::bisect(ranks, a.particles, 1));
  restore_pairs(a, s, /*skin_by_speed=*/false, {});
}

void take_bonds(Assembly& a, Specimen const& s) {
  a.facts.critical_thickness = s.critical_thickness;
  restore_pairs(a, s, /*skin_by_speed=*/true, force_fields(a));
}

Specimen specimen_of(Assembly const& a) {
  Specimen s;
  Box const box = a.now.box();
  Walls const& walls = a.walls();
  s.periodic = a.periodic();
  s.left = s.periodic ? box.x : walls.position[left];
  s.right = s.periodic ? box.x + box.width() : walls.position[right];
  s.bottom = s.periodic ? box.y : walls.position[bottom];
  s.top = s.periodic ? box.y + box.height() : walls.position[top];
  s.density = a.facts.density;
  s.d50 = a.facts.d50;
  s.void_ratio = a.void_ratio();
  s.separate_bonds = a.laws.contact.bond_kind == BondKind::parallel;
  s.critical_thickness = a.laws.contact.bond_kind == BondKind::none ? 0 : a.facts.critical_thickness;
  auto const n = static_cast<std::size_t>(a.particles.owned);
  IdIndex const places(host_copy(a.particles.id), a.particles.owned);
  for (auto const& [id, index] : places.sorted()) s.id.push_back(id);
  for_each_column_of_specimen(a.particles, [&](auto const& field, ParticleColumn const& column) {
    bool const turned = std::string_view(column.name) == "angle";
    std::vector<double> const host = turned ? rotations(a.particles) : numbers_on_host(field, n);
    std::vector<double>& values = s.*column.of;
    values.reserve(n);
    for (auto const& [id, index] : places.sorted()) values.push_back(host[static_cast<std::size_t>(index)]);
  });
  s.contacts = contacts_by_id(a);
  return s;
}

}  // namespace clathra
