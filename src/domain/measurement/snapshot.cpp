#include "domain/measurement/snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "domain/parallel/directory.hpp"
#include "domain/simulation/simulation.hpp"
#include "kernels/pair_list.hpp"

namespace clathra {

namespace {

/// The first `size` values of a field, converted.
template <class To, class From>
std::vector<To> listed(Field<From> const& field, std::size_t size) {
  auto const host = host_copy(field);
  std::vector<To> values(size);
  for (std::size_t i = 0; i < size; ++i) values[i] = static_cast<To>(host(i));
  return values;
}

template <class To>
std::vector<To> listed(RealField const& field, std::size_t size) {
  std::vector<double> const host = on_host(field, size);
  std::vector<To> values(size);
  for (std::size_t i = 0; i < size; ++i) values[i] = static_cast<To>(host[i]);
  return values;
}

std::uint8_t broken_state(int mode) { return static_cast<std::uint8_t>(broken_in(static_cast<BreakMode>(mode))); }

void copy_discs(Snapshot& s, Simulation const& simulation) {
  ParticleSoA const& p = simulation.assembly().particles;
  auto const n = static_cast<std::size_t>(p.owned);
  s.id = listed<std::int32_t>(p.id, n);
  s.x = listed<double>(p.x, n);
  s.y = listed<double>(p.y, n);
  s.radius = listed<float>(p.radius, n);
  std::vector<double> const rotation = rotations(p);
  s.angle.assign(rotation.begin(), rotation.end());
  s.vx = listed<float>(p.vx, n);
  s.vy = listed<float>(p.vy, n);
  s.omega = listed<float>(p.omega, n);
  bool const marked = simulation.assembly().start_x.extent(0) > 0;
  std::vector<double> const x = marked ? listed<double>(simulation.assembly().start_x, n) : s.x;
  std::vector<double> const y = marked ? listed<double>(simulation.assembly().start_y, n) : s.y;
  s.ux.resize(n);
  s.uy.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    s.ux[i] = static_cast<float>(s.x[i] - x[i]);
    s.uy[i] = static_cast<float>(s.y[i] - y[i]);
  }
  DiscLoads const loads =
      disc_loads(p, simulation.assembly().rows, simulation.assembly().laws.contact, simulation.assembly().walls(),
                 simulation.assembly().wall_contacts(), simulation.assembly().laws.wall);
  s.stress_xx = listed<float>(loads.stress_xx, n);
  s.stress_yy = listed<float>(loads.stress_yy, n);
  s.stress_xy = listed<float>(loads.stress_xy, n);
  s.coordination = listed<std::uint8_t>(loads.active_contacts, n);
  s.bonds_intact = listed<std::uint8_t>(loads.bonds, n);
  s.bonds_initial = s.bonds_intact;
}

void copy_pairs(Snapshot& s, Simulation const& simulation) {
  PairList const list =
      list_pairs(simulation.assembly().particles, simulation.assembly().rows, simulation.assembly().laws.contact);
  auto const n = static_cast<std::size_t>(list.size);
  ParticleSoA const& p = simulation.assembly().particles;
  std::vector<double> number(static_cast<std::size_t>(p.all()));
  for (std::size_t i = 0; i < number.size(); ++i) number[i] = static_cast<double>(s.first_disc) + static_cast<double>(i);
  if (!simulation.assembly().ranks().alone()) {  // ghosts have the numbers that their owners gave them
    Field<double> const numbers("numbers", p.x.extent(0));
    auto host = Kokkos::create_mirror_view(Kokkos::HostSpace(), numbers);
    std::copy_n(number.begin(), p.owned, host.data());
    Kokkos::deep_copy(numbers, host);
    simulation.assembly().refresh_ghosts(numbers);
    number = listed<double>(numbers, number.size());
  }
  auto const numbered = [&](Field<int> const& field) {
    std::vector<std::int32_t> of_all = listed<std::int32_t>(field, n);
    for (std::int32_t& i : of_all) i = static_cast<std::int32_t>(number[static_cast<std::size_t>(i)]);
    return of_all;
  };
  s.a = numbered(list.a);
  s.b = numbered(list.b);
  s.state = listed<std::uint8_t>(list.bonded, n);  // 0 = contact, 1 = bonded
  s.normal_force = listed<double>(list.normal, n);
  s.shear_force = listed<double>(list.shear, n);
  s.moment = listed<double>(list.moment, n);
  s.gap = listed<double>(list.gap, n);
  s.width = listed<double>(list.width, n);
}

/// A broken bond as the rank that owns its first disc needs to know it; positions and radii are those of now.
struct BrokenPair {
  double a, b;  // numbers of the discs in the snapshot
  double mode;
  double x, y, r;  // of disc b
};

/// The breaks of all ranks that concern discs of this one: `first` those whose first disc is here, `second` the numbers of the
/// discs here that are the second one.
struct BrokenHere {
  std::vector<BrokenPair> first;
  std::vector<std::size_t> second;
};

BrokenHere broken_here(Ranks const& ranks, Snapshot const& s, int discs, std::vector<BreakEvent> const& broken) {
  std::vector<double> number(s.id.size()), radius(s.radius.begin(), s.radius.end());
  for (std::size_t i = 0; i < number.size(); ++i) number[i] = static_cast<double>(s.first_disc) + static_cast<double>(i);
  Directory const directory(ranks, discs, {s.id.begin(), s.id.end()},
                            {std::vector<double>(s.id.size(), ranks.rank()), number, s.x, s.y, radius});
  std::vector<int> first, second;
  for (BreakEvent const& e : broken) {
    first.push_back(e.id_a);
    second.push_back(e.id_b);
  }
  std::vector<double> const of_a = directory.find(first), of_b = directory.find(second);
  constexpr std::size_t width = 6;
  std::vector<std::vector<double>> to_first(static_cast<std::size_t>(ranks.count())), to_second = to_first;
  for (std::size_t k = 0; k < broken.size(); ++k) {
    double const *a = &of_a[5 * k], *b = &of_b[5 * k];
    if (a[0] == b[0] && a[1] > b[1]) std::swap(a, b);  // of two discs of a rank the one with the smaller number is the first
    auto& part = to_first[static_cast<std::size_t>(a[0])];
    part.insert(part.end(), {a[1], b[1], double(broken[k].mode), b[2], b[3], b[4]});
    to_second[static_cast<std::size_t>(b[0])].push_back(b[1]);
  }
  BrokenHere here;
  for (auto const& part : ranks.exchange(std::move(to_first))) {
    for (std::size_t k = 0; k < part.size(); k += width)
      here.first.push_back({part[k], part[k + 1], part[k + 2], part[k + 3], part[k + 4], part[k + 5]});
  }
  for (auto const& part : ranks.exchange(std::move(to_second))) {
    for (double const n : part) here.second.push_back(static_cast<std::size_t>(n));
  }
  return here;
}

/// Marks the pairs whose bond broke, and appends those that no longer touch.
void add_broken_pairs(Snapshot& s, BrokenHere const& broken) {
  std::size_t const active_contacts = s.a.size();
  auto const place = [&](auto number) { return static_cast<std::size_t>(number) - static_cast<std::size_t>(s.first_disc); };
  for (std::size_t const number : broken.second) ++s.bonds_initial[place(number)];
  for (BrokenPair const& pair : broken.first) {
    auto const a = static_cast<std::int32_t>(pair.a), b = static_cast<std::int32_t>(pair.b);
    std::size_t const i = place(pair.a);
    ++s.bonds_initial[i];
    auto const end = s.a.begin() + static_cast<std::ptrdiff_t>(active_contacts);
    auto const [from, to] = std::equal_range(s.a.begin(), end, a);
    auto at = static_cast<std::size_t>(from - s.a.begin());
    while (at < static_cast<std::size_t>(to - s.a.begin()) && s.b[at] != b) ++at;
    if (at < static_cast<std::size_t>(to - s.a.begin())) {
      s.state[at] = broken_state(static_cast<int>(pair.mode));
      continue;
    }
    double const dx = pair.x - s.x[i], dy = pair.y - s.y[i];
    s.a.push_back(a);
    s.b.push_back(b);
    s.state.push_back(broken_state(static_cast<int>(pair.mode)));
    for (auto* force : {&s.normal_force, &s.shear_force, &s.moment, &s.width}) force->push_back(0);
    s.gap.push_back(std::sqrt(dx * dx + dy * dy) - (double(s.radius[i]) + pair.r));  // the same from both sides
  }
}

}  // namespace

Snapshot take_snapshot(Simulation const& simulation) {
  Snapshot s;
  s.step = simulation.assembly().steps();
  s.time = simulation.assembly().time();
  Walls const& walls = simulation.assembly().walls();
  s.left = walls.position[left];
  s.right = walls.position[right];
  s.bottom = walls.position[bottom];
  s.top = walls.position[top];
  WallStress const stress = simulation.assembly().stress();
  s.sigma1 = stress.y;
  s.sigma3 = stress.x;
  s.density = simulation.assembly().facts.density;
  s.critical_thickness = simulation.assembly().facts.critical_thickness;
  s.first_disc = simulation.assembly().ranks().sum_before(simulation.assembly().particles.owned);
  copy_discs(s, simulation);
  copy_pairs(s, simulation);
  add_broken_pairs(
      s, broken_here(simulation.assembly().ranks(), s, simulation.assembly().discs(), simulation.assembly().break_events(0)));
  return s;
}

}  // namespace clathra
