#include "domain/snapshot.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/pair_list.hpp"

namespace clathra {

namespace {

template <class T>
auto on_host(Field<T> const& field) {
  return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, field);
}

/// The first `size` values of a field, converted.
template <class To, class From>
std::vector<To> listed(Field<From> const& field, std::size_t size) {
  auto const host = on_host(field);
  std::vector<To> values(size);
  for (std::size_t i = 0; i < size; ++i) values[i] = static_cast<To>(host(i));
  return values;
}

std::uint8_t broken_state(int mode) {
  switch (static_cast<BreakMode>(mode)) {
    case BreakMode::compression:
      return static_cast<std::uint8_t>(ContactState::broken_compression);
    case BreakMode::shear:
      return static_cast<std::uint8_t>(ContactState::broken_shear);
    case BreakMode::rolling:
      return static_cast<std::uint8_t>(ContactState::broken_rolling);
    case BreakMode::tension:
    case BreakMode::none:
      break;
  }
  return static_cast<std::uint8_t>(ContactState::broken_tension);
}

void copy_discs(Snapshot& s, Simulation const& simulation) {
  ParticleSoA const& p = simulation.particles();
  auto const n = static_cast<std::size_t>(p.owned);
  s.id = listed<std::int32_t>(p.id, n);
  s.x = listed<double>(p.x, n);
  s.y = listed<double>(p.y, n);
  s.radius = listed<float>(p.radius, n);
  s.angle = listed<float>(p.angle, n);
  s.vx = listed<float>(p.vx, n);
  s.vy = listed<float>(p.vy, n);
  s.omega = listed<float>(p.omega, n);
  bool const marked = simulation.start_x().extent(0) > 0;
  std::vector<double> const x = marked ? listed<double>(simulation.start_x(), n) : s.x;
  std::vector<double> const y = marked ? listed<double>(simulation.start_y(), n) : s.y;
  s.ux.resize(n);
  s.uy.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    s.ux[i] = static_cast<float>(s.x[i] - x[i]);
    s.uy[i] = static_cast<float>(s.y[i] - y[i]);
  }
  DiscLoads const loads = disc_loads(p, simulation.rows(), simulation.laws().contact, simulation.walls(), simulation.laws().wall);
  s.stress_xx = listed<float>(loads.stress_xx, n);
  s.stress_yy = listed<float>(loads.stress_yy, n);
  s.stress_xy = listed<float>(loads.stress_xy, n);
  s.coordination = listed<std::uint8_t>(loads.carriers, n);
  s.bonds_intact = listed<std::uint8_t>(loads.bonds, n);
  s.bonds_initial = s.bonds_intact;
}

void copy_pairs(Snapshot& s, Simulation const& simulation) {
  PairList const list = list_pairs(simulation.particles(), simulation.rows(), simulation.laws().contact);
  auto const n = static_cast<std::size_t>(list.size);
  s.a = listed<std::int32_t>(list.a, n);
  s.b = listed<std::int32_t>(list.b, n);
  s.state = listed<std::uint8_t>(list.bonded, n);  // 0 = contact, 1 = bonded
  s.normal_force = listed<float>(list.normal, n);
  s.shear_force = listed<float>(list.shear, n);
  s.moment = listed<float>(list.moment, n);
  s.gap = listed<float>(list.gap, n);
  s.width = listed<float>(list.width, n);
}

/// Marks the pairs whose bond broke, and appends those that no longer touch.
void add_broken_pairs(Snapshot& s, std::vector<BreakEvent> const& broken) {
  std::vector<std::int32_t> place(s.id.size());
  for (std::size_t i = 0; i < s.id.size(); ++i) place[static_cast<std::size_t>(s.id[i])] = static_cast<std::int32_t>(i);
  std::size_t const carriers = s.a.size();
  for (BreakEvent const& event : broken) {
    auto const p = static_cast<std::size_t>(event.id_a), q = static_cast<std::size_t>(event.id_b);
    std::int32_t const a = std::min(place[p], place[q]), b = std::max(place[p], place[q]);
    ++s.bonds_initial[static_cast<std::size_t>(a)];
    ++s.bonds_initial[static_cast<std::size_t>(b)];
    auto const end = s.a.begin() + static_cast<std::ptrdiff_t>(carriers);
    auto const [from, to] = std::equal_range(s.a.begin(), end, a);
    auto at = static_cast<std::size_t>(from - s.a.begin());
    while (at < static_cast<std::size_t>(to - s.a.begin()) && s.b[at] != b) ++at;
    if (at < static_cast<std::size_t>(to - s.a.begin())) {
      s.state[at] = broken_state(event.mode);
      continue;
    }
    auto const i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    double const dx = s.x[j] - s.x[i], dy = s.y[j] - s.y[i];
    s.a.push_back(a);
    s.b.push_back(b);
    s.state.push_back(broken_state(event.mode));
    for (auto* force : {&s.normal_force, &s.shear_force, &s.moment, &s.width}) force->push_back(0);
    s.gap.push_back(static_cast<float>(std::sqrt(dx * dx + dy * dy) - double(s.radius[i]) - double(s.radius[j])));
  }
}

}  // namespace

Snapshot take_snapshot(Simulation const& simulation) {
  Snapshot s;
  s.step = simulation.steps();
  s.time = simulation.time();
  Walls const& walls = simulation.walls();
  s.left = walls.position[left];
  s.right = walls.position[right];
  s.bottom = walls.position[bottom];
  s.top = walls.position[top];
  WallStress const stress = simulation.stress();
  s.sigma1 = stress.y;
  s.sigma3 = stress.x;
  s.density = simulation.density();
  s.critical_thickness = simulation.critical_thickness();
  copy_discs(s, simulation);
  copy_pairs(s, simulation);
  add_broken_pairs(s, simulation.break_events(0));
  return s;
}

}  // namespace clathra
