#include "kernels/measures.hpp"

#include "kernels/exact_sum.hpp"
#include "kernels/mix64.hpp"

namespace clathra {

namespace {

enum Sum : int {
  stress_xx,
  stress_xy,
  stress_yx,
  stress_yy,
  shear_xx,
  shear_yy,
  touching,
  interacting,
  non_rattlers,
  contacts_of_non_rattlers,
  bonded,
  contact_force,
  active_contacts,
  unbalanced,
  kinetic,
  elastic,
  elastic_of_bonds,
  deep,
  pair_sums
};

/// The share of one disc: half of each of its pairs.
struct DiscSums {
  ParticleSoA p;
  ContactRows rows;
  ContactLaws laws;

  KOKKOS_FUNCTION void operator()(int i, Real* out) const {
    out[unbalanced] = std::sqrt(p.force_x(i) * p.force_x(i) + p.force_y(i) * p.force_y(i));
    Real const speed2 = p.vx(i) * p.vx(i) + p.vy(i) * p.vy(i), spin2 = p.omega(i) * p.omega(i);
    // A disc that is driven from outside has no inverse mass, and no share in the energy of the specimen.
    if (p.inverse_mass(i) > 0) out[kinetic] = 0.5 * (speed2 / p.inverse_mass(i) + spin2 / p.inverse_inertia(i));
    int contacts = 0;
    for (int k = 0; k < rows.length(i); ++k) {
      PairState const s = pair_state(p, rows, laws, i, rows.entry(i, k));
      if (!s.touching && !s.bonded) continue;
      ++contacts;
      Real const fx = s.normal * s.nx + s.shear * s.ny, fy = s.normal * s.ny - s.shear * s.nx;  // against the force on disc i
      Real const lx = 0.5 * s.distance * s.nx, ly = 0.5 * s.distance * s.ny;
      out[stress_xx] += fx * lx;
      out[stress_xy] += fx * ly;
      out[stress_yx] += fy * lx;
      out[stress_yy] += fy * ly;
      out[touching] += s.touching ? 0.5 : 0;
      out[interacting] += 0.5;
      out[bonded] += s.bonded ? 0.5 : 0;
      out[contact_force] += 0.5 * std::sqrt(fx * fx + fy * fy);
      out[active_contacts] += 0.5;
      out[elastic] += 0.5 * s.grain_energy;
      out[elastic_of_bonds] += 0.5 * s.bond_energy;
      out[deep] += s.overlap > 0.1 * lane_min(p.radius(i), p.radius(s.other)) ? 0.5 : 0;
    }
    if (contacts < 2) return;
    out[non_rattlers] = 1;
    out[contacts_of_non_rattlers] = contacts;
  }
};

/// Smooth and rough wall contacts: the branch reaches from the centre to the wall.
struct WallSums {
  ParticleSoA p;
  WallContacts contacts;
  Walls walls;
  WallLaw law;

  KOKKOS_FUNCTION void operator()(int c, Real* out) const {
    int const i = contacts.disc(c);
    GrainLaw const grain = law.as_grain();
    for (int wall = 0; wall < wall_count; ++wall) {
      WallFace const face = wall_face(walls, wall, p.x(i), p.y(i));
      Real const overlap = p.radius(i) - face.distance;
      if (overlap <= 0) continue;
      Real const normal = spring_force(grain, overlap), shear = contacts.shear.extent(0) > 0 ? contacts.shear(c, wall) : 0;
      bool const upright = face.nx != 0;
      out[upright ? stress_xx : stress_yy] += normal * face.distance;
      // f . t against the disc times the branch: t = (-n_y, n_x), the branch is distance * n.
      out[upright ? stress_yx : stress_xy] += (upright ? -shear : shear) * face.distance;
      if (upright)
        out[shear_yy] -= shear * face.nx * (p.y(i) - 0.5 * (walls.position[bottom] + walls.position[top]));
      else
        out[shear_xx] += shear * face.ny * (p.x(i) - 0.5 * (walls.position[left] + walls.position[right]));
      out[contact_force] += std::sqrt(normal * normal + shear * shear);
      out[active_contacts] += 1;
      out[elastic] += grain_energy(grain, {normal, shear, 0}, grain_stiffness(grain, overlap, 2 * p.radius(i)));
    }
  }
};

struct DeepestOverlap {
  ParticleSoA p;
  ContactRows rows;
  KOKKOS_FUNCTION void operator()(int i, Real& deepest) const {
    for (int k = 0; k < rows.length(i); ++k) {
      int const j = rows.neighbour(rows.entry(i, k));
      Real const dx = p.x(j) - p.x(i), dy = p.y(j) - p.y(i);
      Real const overlap = p.radius(i) + p.radius(j) - std::sqrt(dx * dx + dy * dy);
      deepest = lane_max(deepest, overlap / lane_min(p.radius(i), p.radius(j)));
    }
  }
};

void set_units(SumUnits const& scale, Real (&unit)[pair_sums]) {
  for (Real& u : unit) u = 1;  // of numbers of contacts
  for (int const sum : {stress_xx, stress_xy, stress_yx, stress_yy, shear_xx, shear_yy, kinetic, elastic, elastic_of_bonds})
    unit[sum] = scale.energy();
  for (int const sum : {contact_force, unbalanced}) unit[sum] = scale.force();
}

struct LossSums {
  Dissipation losses;
  KOKKOS_FUNCTION void operator()(int i, Real* out) const {
    auto const of = [i](Field<Accum> const& account) { return account.extent(0) > 0 ? account(i) : 0; };
    out[0] = of(losses.sliding);
    out[1] = of(losses.rolling);
    out[2] = of(losses.dashpot);
    out[3] = of(losses.breakage);
    out[4] = of(losses.damping);
  }
};

KOKKOS_INLINE_FUNCTION std::uint64_t chain(std::uint64_t hash, std::uint64_t word) { return mix64(hash * golden_gamma + word); }
KOKKOS_INLINE_FUNCTION std::uint64_t chain(std::uint64_t hash, double value) { return chain(hash, detail::bits_of(value + 0.0)); }
KOKKOS_INLINE_FUNCTION std::uint64_t chain(std::uint64_t hash, int value) {
  return chain(hash, static_cast<std::uint64_t>(value));
}

/// Chains all fields of a disc, and for each entry that has a history both ids and all of it: as if none of it was left out where
/// the features need it not. Which far neighbours are listed is no part of the state.
struct HashDisc {
  ParticleSoA p;
  ContactRows rows;
  KOKKOS_FUNCTION void operator()(int i, std::uint64_t& sum) const {
    std::uint64_t hash = 1;
    for_each_field(p, [&](DiscField const&, auto const& field) { hash = chain(hash, field(i)); });
    sum += hash;
    for (int k = 0; k < rows.length(i); ++k) {
      std::size_t const e = rows.entry(i, k);
      std::uint64_t pair = chain(chain(2, p.id(i)), p.id(rows.neighbour(e)));
      bool empty = true;
      auto const add = [&](HistoryField const& about, bool needed, auto const& field) {
        bool const is_reference = about.quantity == HistoryField::Quantity::branch;
        if (is_reference && !needed) return;
        Real const value = field.extent(0) > 0 ? Real(field(e)) : about.empty;
        empty = empty && (is_reference || value == about.empty);
        pair = chain(pair, value);
      };
      for_each_possible_history(rows.features, add, rows);
      if (!empty) sum += pair;
    }
  }
};

}  // namespace

Measures measure(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws,
                 WallContacts const& wall_contacts, Walls const& walls, WallLaw const& wall_law, Summation const& summation) {
  Real pairs[pair_sums], at_walls[pair_sums];
  Real unit[pair_sums];
  set_units(summation.unit, unit);
  exact_sums<pair_sums>("measure_discs", particles.owned, DiscSums{particles, rows, laws}, unit, pairs, summation.over_ranks);
  exact_sums<pair_sums>("measure_walls", wall_contacts.size, WallSums{particles, wall_contacts, walls, wall_law}, unit, at_walls,
                        summation.over_ranks);
  Measures m;
  m.stress_area_xx = pairs[stress_xx] + at_walls[stress_xx];
  m.stress_area_xy = pairs[stress_xy] + at_walls[stress_xy];
  m.stress_area_yx = pairs[stress_yx] + at_walls[stress_yx];
  m.stress_area_yy = pairs[stress_yy] + at_walls[stress_yy];
  m.wall_shear_xx = at_walls[shear_xx];
  m.wall_shear_yy = at_walls[shear_yy];
  m.touching = pairs[touching];
  m.interacting = pairs[interacting];
  m.non_rattlers = pairs[non_rattlers];
  m.contacts_of_non_rattlers = pairs[contacts_of_non_rattlers];
  m.bonded = pairs[bonded];
  m.contact_force = pairs[contact_force] + at_walls[contact_force];
  m.active_contacts = pairs[active_contacts] + at_walls[active_contacts];
  m.unbalanced = pairs[unbalanced];
  m.kinetic = pairs[kinetic];
  m.grain_energy = pairs[elastic];
  m.bond_energy = pairs[elastic_of_bonds];
  m.wall_energy = at_walls[elastic];
  m.deep = pairs[deep];
  return m;
}

Real deepest_overlap(ParticleSoA const& particles, ContactRows const& rows) {
  Real deepest = 0;
  Kokkos::parallel_reduce("deepest_overlap", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                          DeepestOverlap{particles, rows}, Kokkos::Max<Real>(deepest));
  return lane_max(deepest, Real(0));
}

DissipationTotals total_losses(Dissipation const& losses, int discs, Summation const& summation) {
  Real sums[5] = {};
  Real const unit = summation.unit.energy();
  exact_sums<5>("total_losses", discs, LossSums{losses}, {unit, unit, unit, unit, unit}, sums, summation.over_ranks);
  return {sums[0], sums[1], sums[2], sums[3], sums[4]};
}

std::uint64_t state_hash(ParticleSoA const& particles, ContactRows const& rows) {
  std::uint64_t hash = 0;
  Kokkos::parallel_reduce("state_hash", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned), HashDisc{particles, rows}, hash);
  return hash;
}

}  // namespace clathra
