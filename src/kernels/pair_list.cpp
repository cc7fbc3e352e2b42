#include "kernels/pair_list.hpp"

#include "kernels/pair_state.hpp"

namespace clathra {

namespace {

/// Whether the pair is listed from disc i's side: once, whoever owns the other disc.
KOKKOS_INLINE_FUNCTION bool list_here(ParticleSoA const& p, int i, int other) {
  return other < p.owned ? other > i : p.id(other) > p.id(i);
}

/// How many pairs disc i is the first of.
struct CountPairs {
  ParticleSoA p;
  ContactRows rows;
  ContactLaws laws;
  Field<int> first;  ///< [owned + 1] on return: where the pairs of a disc begin

  KOKKOS_FUNCTION void operator()(int i, int& sum, bool final) const {
    if (final) first(i) = sum;
    if (i == p.owned) return;
    for (int k = 0; k < rows.length(i); ++k) {
      PairState const s = pair_state(p, rows, laws, i, rows.entry(i, k));
      if (list_here(p, i, s.other) && s.carries()) ++sum;
    }
  }
};

struct FillPairs {
  ParticleSoA p;
  ContactRows rows;
  ContactLaws laws;
  Field<int> first;
  PairList list;

  KOKKOS_FUNCTION void operator()(int i) const {
    int at = first(i);
    for (int k = 0; k < rows.length(i); ++k) {
      PairState const s = pair_state(p, rows, laws, i, rows.entry(i, k));
      if (!list_here(p, i, s.other) || !s.carries()) continue;
      list.a(at) = i;
      list.b(at) = s.other;
      list.bonded(at) = s.bonded ? 1 : 0;
      list.normal(at) = s.normal;
      list.shear(at) = s.shear;
      list.moment(at) = s.moment;
      list.gap(at) = -s.overlap;
      list.width(at) = s.width;
      ++at;
    }
  }
};

struct SumLoads {
  ParticleSoA p;
  ContactRows rows;
  ContactLaws laws;
  Walls walls;
  WallLaw wall_law;
  DiscLoads loads;

  KOKKOS_FUNCTION void operator()(int i) const {
    Real xx = 0, yy = 0, xy = 0;
    int active_contacts = 0, bonds = 0;
    for (int k = 0; k < rows.length(i); ++k) {
      PairState const s = pair_state(p, rows, laws, i, rows.entry(i, k));
      if (!s.carries()) continue;
      Real const fx = s.normal * s.nx + s.shear * s.ny, fy = s.normal * s.ny - s.shear * s.nx;  // against the force on disc i
      xx += s.arm * s.nx * fx;
      yy += s.arm * s.ny * fy;
      xy += 0.5 * s.arm * (s.nx * fy + s.ny * fx);
      ++active_contacts;
      bonds += s.bonded ? 1 : 0;
    }
    for (int wall = 0; wall < wall_count; ++wall) {
      WallFace const face = wall_face(walls, wall, p.x(i), p.y(i));
      Real const overlap = p.radius(i) - face.distance;
      if (overlap <= 0) continue;
      (face.nx != 0 ? xx : yy) += spring_force(wall_law.as_grain(), overlap) * face.distance;
      ++active_contacts;
    }
    Real const area = pi * p.radius(i) * p.radius(i);
    loads.stress_xx(i) = static_cast<float>(xx / area);
    loads.stress_yy(i) = static_cast<float>(yy / area);
    loads.stress_xy(i) = static_cast<float>(xy / area);
    loads.active_contacts(i) = active_contacts;
    loads.bonds(i) = bonds;
  }
};

/// The shear of rough walls, which stands with their contacts.
struct AddWallShear {
  ParticleSoA p;
  WallContacts contacts;
  Walls walls;
  Field<float> stress_xy;

  KOKKOS_FUNCTION void operator()(int c) const {
    int const i = contacts.disc(c);
    Real xy = 0;
    for (int wall = 0; wall < wall_count; ++wall) {
      WallFace const face = wall_face(walls, wall, p.x(i), p.y(i));
      if (p.radius(i) > face.distance) xy += 0.5 * (face.nx != 0 ? -1 : 1) * contacts.shear(c, wall) * face.distance;
    }
    stress_xy(i) += static_cast<float>(xy / (pi * p.radius(i) * p.radius(i)));
  }
};

}  // namespace

PairList list_pairs(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws) {
  PairList list;
  Field<int> const first("pair_list.first", static_cast<std::size_t>(particles.owned) + 1);
  Kokkos::parallel_scan("count_pairs", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned + 1),
                        CountPairs{particles, rows, laws, first}, list.size);
  auto const size = static_cast<std::size_t>(list.size);
  for (auto* field : {&list.a, &list.b, &list.bonded}) *field = Field<int>("pair_list", size);
  for (auto* field : {&list.normal, &list.shear, &list.moment, &list.gap, &list.width}) *field = Field<Real>("pair_list", size);
  Kokkos::parallel_for("fill_pairs", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                       FillPairs{particles, rows, laws, first, list});
  return list;
}

DiscLoads disc_loads(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, Walls const& walls,
                     WallContacts const& wall_contacts, WallLaw const& wall_law) {
  auto const size = static_cast<std::size_t>(particles.owned);
  DiscLoads loads;
  for (auto* field : {&loads.stress_xx, &loads.stress_yy, &loads.stress_xy}) *field = Field<float>("disc_loads", size);
  for (auto* field : {&loads.active_contacts, &loads.bonds}) *field = Field<int>("disc_loads", size);
  Kokkos::parallel_for("disc_loads", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                       SumLoads{particles, rows, laws, walls, wall_law, loads});
  if (wall_contacts.shear.extent(0) > 0)
    Kokkos::parallel_for("add_wall_shear", Kokkos::RangePolicy<ExecutionSpace>(0, wall_contacts.size),
                         AddWallShear{particles, wall_contacts, walls, loads.stress_xy});
  return loads;
}

}  // namespace clathra
