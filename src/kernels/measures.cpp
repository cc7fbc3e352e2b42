#include "kernels/measures.hpp"

#include "kernels/exact_sum.hpp"

namespace clathra {

namespace {

enum Sum : int {
  stress_xx,
  stress_xy,
  stress_yx,
  stress_yy,
  touching,
  mechanical,
  bonded,
  contact_force,
  force_carriers,
  unbalanced,
  kinetic,
  grain_energy,
  bond_energy_sum,
  deep,
  area,
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
    for (int k = 0; k < rows.length(i); ++k) {
      PairState const s = pair_state(p, rows, laws, i, rows.entry(i, k));
      if (!s.touching && !s.bonded) continue;
      Real const fx = s.normal * s.nx + s.shear * s.ny, fy = s.normal * s.ny - s.shear * s.nx;  // against the force on disc i
      Real const lx = 0.5 * s.distance * s.nx, ly = 0.5 * s.distance * s.ny;
      out[stress_xx] += fx * lx;
      out[stress_xy] += fx * ly;
      out[stress_yx] += fy * lx;
      out[stress_yy] += fy * ly;
      out[touching] += s.touching ? 0.5 : 0;
      out[mechanical] += 0.5;
      out[bonded] += s.bonded ? 0.5 : 0;
      out[contact_force] += 0.5 * std::sqrt(fx * fx + fy * fy);
      out[force_carriers] += 0.5;
      out[grain_energy] += 0.5 * s.grain_energy;
      out[bond_energy_sum] += 0.5 * s.bond_energy;
      out[deep] += s.overlap > 0.1 * lane_min(p.radius(i), p.radius(s.other)) ? 0.5 : 0;
      if (s.bonded) {
        Real const common = common_radius(p.radius(i), p.radius(s.other));
        out[area] += 0.5 * bond_area(common, s.width, s.gap, laws.bond.critical_thickness);
      }
    }
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
    Real const gap[wall_count] = {p.x(i) - walls.position[left], walls.position[right] - p.x(i), p.y(i) - walls.position[bottom],
                                  walls.position[top] - p.y(i)};
    for (int wall = 0; wall < wall_count; ++wall) {
      Real const overlap = p.radius(i) - gap[wall];
      if (overlap <= 0) continue;
      Real const normal = law.normal_stiffness * overlap, shear = contacts.shear.extent(0) > 0 ? contacts.shear(c, wall) : 0;
      bool const upright = wall == left || wall == right;
      out[upright ? stress_xx : stress_yy] += normal * gap[wall];
      // f . t against the disc times the branch: t = (-n_y, n_x), the branch is gap * n.
      out[upright ? stress_yx : stress_xy] += (upright ? -shear : shear) * gap[wall];
      out[contact_force] += std::sqrt(normal * normal + shear * shear);
      out[force_carriers] += 1;
      out[grain_energy] += spring_energy(normal, law.normal_stiffness) + spring_energy(shear, law.shear_stiffness);
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
  for (int const sum : {stress_xx, stress_xy, stress_yx, stress_yy, kinetic, grain_energy, bond_energy_sum})
    unit[sum] = scale.energy();
  for (int const sum : {contact_force, unbalanced}) unit[sum] = scale.force();
  unit[area] = scale.area();
}

struct LossSums {
  EnergyLosses losses;
  KOKKOS_FUNCTION void operator()(int i, Real* out) const {
    auto const of = [i](Field<Accum> const& account) { return account.extent(0) > 0 ? account(i) : 0; };
    out[0] = of(losses.sliding);
    out[1] = of(losses.rolling);
    out[2] = of(losses.dashpot);
    out[3] = of(losses.breakage);
    out[4] = of(losses.damping);
  }
};

KOKKOS_INLINE_FUNCTION std::uint64_t mix(std::uint64_t z) {  // the finaliser of SplitMix64
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}
KOKKOS_INLINE_FUNCTION std::uint64_t chain(std::uint64_t hash, std::uint64_t word) {
  return mix(hash * 0x9e3779b97f4a7c15ULL + word);
}
KOKKOS_INLINE_FUNCTION std::uint64_t chain(std::uint64_t hash, Real value) { return chain(hash, detail::bits_of(value + 0.0)); }

struct HashDisc {
  ParticleSoA p;
  ContactRows rows;
  KOKKOS_FUNCTION void operator()(int i, std::uint64_t& sum) const {
    std::uint64_t hash = chain(1, static_cast<std::uint64_t>(p.id(i)));
    for (Real value : {p.x(i), p.y(i), p.angle(i), p.vx(i), p.vy(i), p.omega(i), p.radius(i), p.inverse_mass(i)})
      hash = chain(hash, value);
    sum += hash;
    for (int k = 0; k < rows.length(i); ++k) {
      std::size_t const e = rows.entry(i, k);
      Real const history[] = {rows.shear.extent(0) ? rows.shear(e) : 0, rows.moment.extent(0) ? rows.moment(e) : 0,
                              rows.equilibrium.extent(0) ? rows.equilibrium(e) : no_bond,
                              rows.bond_shear.extent(0) ? rows.bond_shear(e) : 0,
                              rows.bond_moment.extent(0) ? rows.bond_moment(e) : 0};
      bool empty = !is_bonded(history[2]);
      for (int f : {0, 1, 3, 4}) empty = empty && history[f] == 0;
      if (empty) continue;  // which far neighbours are listed is no part of the state
      std::uint64_t pair =
          chain(chain(2, static_cast<std::uint64_t>(p.id(i))), static_cast<std::uint64_t>(p.id(rows.neighbour(e))));
      for (Real value : history) pair = chain(pair, value);
      sum += pair;
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
  m.touching = pairs[touching];
  m.mechanical = pairs[mechanical];
  m.bonded = pairs[bonded];
  m.contact_force = pairs[contact_force] + at_walls[contact_force];
  m.force_carriers = pairs[force_carriers] + at_walls[force_carriers];
  m.unbalanced = pairs[unbalanced];
  m.kinetic = pairs[kinetic];
  m.grain_energy = pairs[grain_energy];
  m.bond_energy = pairs[bond_energy_sum];
  m.wall_energy = at_walls[grain_energy];
  m.deep = pairs[deep];
  m.bond_area = pairs[area];
  return m;
}

Real deepest_overlap(ParticleSoA const& particles, ContactRows const& rows) {
  Real deepest = 0;
  Kokkos::parallel_reduce("deepest_overlap", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                          DeepestOverlap{particles, rows}, Kokkos::Max<Real>(deepest));
  return lane_max(deepest, Real(0));
}

LossTotals total_losses(EnergyLosses const& losses, int discs, Summation const& summation) {
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
