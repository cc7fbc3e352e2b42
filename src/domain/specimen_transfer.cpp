/// Moving a specimen between the host's form (Specimen) and the running one (Simulation).
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "domain/simulation.hpp"

namespace clathra {

namespace {

/// Copies host values into the first `values.size()` places of a field.
template <class T>
void upload(Field<T> const& field, std::vector<T> const& values) {
  auto host = Kokkos::create_mirror_view(field);
  Kokkos::deep_copy(host, field);
  std::copy(values.begin(), values.end(), host.data());
  Kokkos::deep_copy(field, host);
}

template <class T>
auto download(Field<T> const& field) {
  return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), field);
}

std::vector<double> or_zero(std::vector<double> const& values, std::size_t size) {
  return values.empty() ? std::vector<double>(size, 0.0) : values;
}

/// The widest gap among the bonded contacts of a specimen [m].
Real widest_gap(Specimen const& s, std::vector<std::size_t> const& place) {
  Real widest = 0;
  for (SpecimenContact const& c : s.contacts) {
    if (!is_bonded(c.equilibrium)) continue;
    std::size_t const a = place[static_cast<std::size_t>(c.id_a)], b = place[static_cast<std::size_t>(c.id_b)];
    double dx = s.x[b] - s.x[a], dy = s.y[b] - s.y[a];
    if (s.periodic) {  // the nearest images
      dx -= s.width() * std::round(dx / s.width());
      dy -= s.height() * std::round(dy / s.height());
    }
    widest = std::max(widest, std::hypot(dx, dy) - s.radius[a] - s.radius[b]);
  }
  return widest;
}

/// @throws Diverged where a number of a disc is not finite: a neighbour search would have no place for it
void require_finite(Specimen const& s) {
  for (auto const* field : {&s.x, &s.y, &s.angle, &s.vx, &s.vy, &s.omega, &s.radius}) {
    for (std::size_t i = 0; i < field->size(); ++i) {
      if (!std::isfinite((*field)[i]))
        throw Diverged("step 0: disc " + std::to_string(s.id[i]) + " has a position, velocity or radius that is not finite");
    }
  }
}

std::vector<std::size_t> places_by_id(std::vector<int> const& id) {
  std::vector<std::size_t> place(id.size());
  for (std::size_t i = 0; i < id.size(); ++i) place.at(static_cast<std::size_t>(id[i])) = i;
  return place;
}

}  // namespace

Simulation::Simulation(Specimen const& s, SimulationLaws const& laws, Real skin)
    : laws_(laws), faults_(make_faults()), skin_(skin) {
  std::size_t const n = s.size();
  if (n == 0) throw std::invalid_argument("a specimen needs at least one disc");
  require_finite(s);
  particles_ = allocate_particles(static_cast<int>(n));
  std::vector<double> inverse_mass(n), inverse_inertia(n);
  for (std::size_t i = 0; i < n; ++i) {
    inverse_mass[i] = 1 / (pi * s.radius[i] * s.radius[i] * s.density);
    inverse_inertia[i] = 2 * inverse_mass[i] / (s.radius[i] * s.radius[i]);
    largest_radius_ = std::max(largest_radius_, s.radius[i]);
  }
  // Summed by id, so that the order of the input does not show.
  std::vector<std::size_t> const place = places_by_id(s.id);
  for (std::size_t at : place) solid_area_ += pi * s.radius[at] * s.radius[at];
  upload(particles_.id, s.id);
  upload(particles_.x, s.x);
  upload(particles_.y, s.y);
  upload(particles_.angle, or_zero(s.angle, n));
  upload(particles_.vx, or_zero(s.vx, n));
  upload(particles_.vy, or_zero(s.vy, n));
  upload(particles_.omega, or_zero(s.omega, n));
  upload(particles_.radius, s.radius);
  upload(particles_.inverse_mass, inverse_mass);
  upload(particles_.inverse_inertia, inverse_inertia);
  density_ = s.density;
  d50_ = s.d50;
  critical_thickness_ = s.critical_thickness;
  if (s.periodic) {
    cell_ = {s.left, s.bottom, s.width(), s.height()};
  } else {
    walls_ = {{s.left, s.right, s.bottom, s.top}, {0, 0, 0, 0}};
  }
  rows_.features = laws_.features();
  // The first search must reach the widest bond; the skin is its own again afterwards.
  Real const own_skin = skin_;
  skin_ = std::max(skin_, widest_gap(s, place) * (1 + 1e-9));
  rebuild();
  skin_ = own_skin;
  rebuild_pending_ = true;
  inject(s);
  evaluate_forces();
}

/// Writes the history of the specimen's contacts into the rows, on both sides, and makes room to log the break of every bond.
void Simulation::inject(Specimen const& s) {
  auto const id = download(particles_.id), length = download(rows_.length), slice_start = download(rows_.slice_start),
             neighbour = download(rows_.neighbour);
  std::vector<int> at(s.size());
  for (int i = 0; i < particles_.owned; ++i) at[static_cast<std::size_t>(id(i))] = i;
  auto shear = download(rows_.shear), moment = download(rows_.moment), equilibrium = download(rows_.equilibrium),
       bond_shear = download(rows_.bond_shear), bond_moment = download(rows_.bond_moment);
  auto const set = [](auto& field, std::size_t e, Real value) {
    if (field.extent(0) > 0) field(e) = value;
  };
  std::size_t bonds = 0;
  for (SpecimenContact const& c : s.contacts) {
    if (is_bonded(c.equilibrium)) ++bonds;
    for (auto const& [mine, other, sign] : {std::tuple{c.id_a, c.id_b, 1.0}, std::tuple{c.id_b, c.id_a, -1.0}}) {
      int const i = at[static_cast<std::size_t>(mine)];
      for (int k = 0; k < length(i); ++k) {
        std::size_t const e =
            static_cast<std::size_t>(slice_start(i / lane_count) + k) * lane_count + static_cast<std::size_t>(i % lane_count);
        if (id(neighbour(e)) != other) continue;
        set(shear, e, c.shear);
        set(moment, e, sign * c.moment);
        set(equilibrium, e, c.equilibrium);
        set(bond_shear, e, c.bond_shear);
        set(bond_moment, e, sign * c.bond_moment);
      }
    }
  }
  for (auto const& [field, host] :
       {std::pair{&rows_.shear, &shear}, std::pair{&rows_.moment, &moment}, std::pair{&rows_.equilibrium, &equilibrium},
        std::pair{&rows_.bond_shear, &bond_shear}, std::pair{&rows_.bond_moment, &bond_moment}}) {
    if (field->extent(0) > 0) Kokkos::deep_copy(*field, *host);
  }
  prepare_rows(particles_, rows_, laws_.contact.bond);
  if (laws_.contact.bond_kind != BondKind::none) breaks_ = make_break_log(bonds);
}

Specimen Simulation::specimen() const {
  Specimen s;
  s.periodic = periodic();
  s.left = periodic() ? cell_.left : walls_.position[left];
  s.right = periodic() ? cell_.left + cell_.width : walls_.position[right];
  s.bottom = periodic() ? cell_.bottom : walls_.position[bottom];
  s.top = periodic() ? cell_.bottom + cell_.height : walls_.position[top];
  s.density = density_;
  s.d50 = d50_;
  s.void_ratio = void_ratio();
  s.separate_bonds = laws_.contact.bond_kind == BondKind::parallel;
  s.critical_thickness = laws_.contact.bond_kind == BondKind::none ? 0 : critical_thickness_;
  auto const n = static_cast<std::size_t>(particles_.owned);
  auto const id = download(particles_.id);
  std::vector<int> at(n);
  for (int i = 0; i < particles_.owned; ++i) at[static_cast<std::size_t>(id(i))] = i;
  s.id.resize(n);
  for (std::size_t i = 0; i < n; ++i) s.id[i] = static_cast<int>(i);
  auto const fetch = [&](Field<Real> const& field, std::vector<double>& values) {
    auto const host = download(field);
    values.resize(n);
    for (std::size_t i = 0; i < n; ++i) values[i] = host(at[i]);
  };
  fetch(particles_.x, s.x);
  fetch(particles_.y, s.y);
  fetch(particles_.angle, s.angle);
  fetch(particles_.vx, s.vx);
  fetch(particles_.vy, s.vy);
  fetch(particles_.omega, s.omega);
  fetch(particles_.radius, s.radius);
  s.contacts = contacts_by_id();
  return s;
}

/// The pairs with history, sorted by (id_a, id_b).
std::vector<SpecimenContact> Simulation::contacts_by_id() const {
  auto const id = download(particles_.id), length = download(rows_.length), slice_start = download(rows_.slice_start),
             neighbour = download(rows_.neighbour);
  auto const shear = download(rows_.shear), moment = download(rows_.moment), equilibrium = download(rows_.equilibrium),
             bond_shear = download(rows_.bond_shear), bond_moment = download(rows_.bond_moment);
  auto const get = [](auto const& field, std::size_t e, Real absent) { return field.extent(0) > 0 ? Real(field(e)) : absent; };
  std::vector<SpecimenContact> contacts;
  for (int i = 0; i < particles_.owned; ++i) {
    for (int k = 0; k < length(i); ++k) {
      std::size_t const e =
          static_cast<std::size_t>(slice_start(i / lane_count) + k) * lane_count + static_cast<std::size_t>(i % lane_count);
      int const other = id(neighbour(e));
      if (other <= id(i)) continue;
      SpecimenContact const c{
          id(i), other, shear(e), get(moment, e, 0), get(equilibrium, e, no_bond), get(bond_shear, e, 0), get(bond_moment, e, 0)};
      if (c.shear != 0 || c.moment != 0 || is_bonded(c.equilibrium) || c.bond_shear != 0 || c.bond_moment != 0)
        contacts.push_back(c);
    }
  }
  std::sort(contacts.begin(), contacts.end(),
            [](auto const& a, auto const& b) { return a.id_a != b.id_a ? a.id_a < b.id_a : a.id_b < b.id_b; });
  return contacts;
}

int Simulation::broken_bonds() const { return breaks_.count.extent(0) > 0 ? download(breaks_.count)(0) : 0; }

BreakCounts Simulation::break_counts() const {
  if (breaks_.by_mode.extent(0) == 0) return {};
  auto const by_mode = download(breaks_.by_mode);
  auto const of = [&](BreakMode mode) { return static_cast<std::int64_t>(by_mode(static_cast<std::size_t>(mode))); };
  return {of(BreakMode::tension), of(BreakMode::compression), of(BreakMode::shear), of(BreakMode::rolling)};
}

std::vector<BreakEvent> Simulation::break_events(int first) const {
  int const count = broken_bonds();
  if (count <= first) return {};
  auto const step = download(breaks_.step);
  auto const id_a = download(breaks_.id_a), id_b = download(breaks_.id_b);
  auto const mode = download(breaks_.mode);
  auto const x = download(breaks_.x), y = download(breaks_.y);
  std::vector<BreakEvent> events;
  for (int k = first; k < count; ++k) events.push_back({step(k), id_a(k), id_b(k), mode(k), x(k), y(k)});
  std::sort(events.begin(), events.end(), [](BreakEvent const& p, BreakEvent const& q) {
    return p.step != q.step ? p.step < q.step : p.id_a != q.id_a ? p.id_a < q.id_a : p.id_b < q.id_b;
  });
  return events;
}

}  // namespace clathra
