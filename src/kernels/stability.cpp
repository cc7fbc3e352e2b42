#include "kernels/stability.hpp"

#include <cmath>

#include "kernels/exact_sum.hpp"

namespace clathra {

namespace {

/// min over (m/k) and (I/k_rot) of one disc.
struct LocalPeriod {
  ParticleSoA p;
  ContactRows rows;
  ContactLaws laws;
  int least_contacts;

  KOKKOS_FUNCTION void operator()(int i, Real& least) const {
    Real kxx = 0, kyy = 0, rotation = 0, stiffest = 0, stiffest_turn = 0;
    int contacts = 0;
    for (int k = 0; k < rows.length(i); ++k) {
      PairState const s = pair_state(p, rows, laws, i, rows.entry(i, k));
      if (!s.carries()) continue;
      // A bonded gap may close: with `parallel` its grain contact then adds to the bond.
      Real const common = common_radius(p.radius(i), p.radius(s.other));
      Real const k_m = rows.features.rolling ? rolling_stiffness(laws.grain, common) : 0;
      bool const add_grain = !s.touching && laws.bond_kind == BondKind::parallel;
      Real const kn = s.normal_stiffness + (add_grain ? laws.grain.normal_stiffness : 0);
      Real const ks = s.shear_stiffness + (add_grain ? laws.grain.shear_stiffness : 0);
      Real const turn = ks * p.radius(i) * p.radius(i) + s.rolling_stiffness + (add_grain ? k_m : 0);
      kxx += kn * s.nx * s.nx + ks * s.ny * s.ny;
      kyy += kn * s.ny * s.ny + ks * s.nx * s.nx;
      rotation += turn;
      stiffest = lane_max(stiffest, 0.5 * (kn + ks));
      stiffest_turn = lane_max(stiffest_turn, turn);
      ++contacts;
    }
    Real const r = p.radius(i);
    if (stiffest == 0) {
      stiffest = 0.5 * (laws.grain.normal_stiffness + laws.grain.shear_stiffness);
      stiffest_turn = laws.grain.shear_stiffness * r * r + (rows.features.rolling ? rolling_stiffness(laws.grain, r) : 0);
    }
    int const missing = contacts < least_contacts ? least_contacts - contacts : 0;
    Real const translation = lane_max(kxx, kyy) + missing * stiffest;
    least = lane_min(least, 1 / (p.inverse_mass(i) * translation));
    least = lane_min(least, 1 / (p.inverse_inertia(i) * (rotation + missing * stiffest_turn)));
  }
};

/// A motion of all discs, ghosts included: two displacements and a rotation each.
struct Motion {
  Field<Real> x, y, turn;
};

struct RandomMotion {
  ParticleSoA p;
  Motion u;
  KOKKOS_FUNCTION void operator()(int i) const {
    auto const draw = [&](std::uint64_t salt) {
      std::uint64_t z = (static_cast<std::uint64_t>(p.id(i)) * 3 + salt) * 0x9e3779b97f4a7c15ULL;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
      return static_cast<Real>(z >> 11) / 9007199254740992.0 - 0.5;
    };
    u.x(i) = draw(0);
    u.y(i) = draw(1);
    u.turn(i) = draw(2) / p.radius(i);
  }
};

/// w = M^-1 K u; its terms are u.M.u and u.K.u (Rayleigh quotient).
struct StiffnessProduct {
  ParticleSoA p;
  ContactRows rows;
  ContactLaws laws;
  Walls walls;
  WallLaw wall_law;
  Motion u, w;

  KOKKOS_FUNCTION void operator()(int i, Real* out) const {
    Real fx = 0, fy = 0, torque = 0;
    for (int k = 0; k < rows.length(i); ++k) {
      PairState const s = pair_state(p, rows, laws, i, rows.entry(i, k));
      if (!(s.touching || s.bonded)) continue;
      int const j = s.other;
      Real const dx = u.x(j) - u.x(i), dy = u.y(j) - u.y(i);
      Real const normal = -s.normal_stiffness * (dx * s.nx + dy * s.ny);
      Real const shear = s.shear_stiffness * ((dy * s.nx - dx * s.ny) - (u.turn(i) * s.arm + u.turn(j) * s.other_arm));
      fx -= normal * s.nx + shear * s.ny;
      fy += shear * s.nx - normal * s.ny;
      torque += s.arm * shear + s.rolling_stiffness * (u.turn(j) - u.turn(i));
    }
    for (int wall = 0; wall < wall_count; ++wall) {
      bool const upright = wall == left || wall == right;
      Real const distance = std::fabs((upright ? p.x(i) : p.y(i)) - walls.position[wall]);
      if (distance >= p.radius(i)) continue;
      (upright ? fx : fy) -= wall_law.normal_stiffness * (upright ? u.x(i) : u.y(i));
    }
    w.x(i) = -fx * p.inverse_mass(i);
    w.y(i) = -fy * p.inverse_mass(i);
    w.turn(i) = -torque * p.inverse_inertia(i);
    // Scaled by the mass of a grain so that the fixed-point sums keep their digits.
    Real const mass = reference_mass / p.inverse_mass(i), inertia = reference_mass / p.inverse_inertia(i);
    out[0] = mass * (u.x(i) * u.x(i) + u.y(i) * u.y(i)) + inertia * u.turn(i) * u.turn(i);
    out[1] = (mass * (u.x(i) * w.x(i) + u.y(i) * w.y(i)) + inertia * u.turn(i) * w.turn(i)) * reference_time2;
  }
  Real reference_mass, reference_time2;
};

struct Rescale {
  Motion from, to;
  Real factor;
  KOKKOS_FUNCTION void operator()(int i) const {
    to.x(i) = from.x(i) * factor;
    to.y(i) = from.y(i) * factor;
    to.turn(i) = from.turn(i) * factor;
  }
};

Motion make_motion(int discs) {
  auto const n = static_cast<std::size_t>(discs);
  return {Field<Real>("motion.x", n), Field<Real>("motion.y", n), Field<Real>("motion.turn", n)};
}

}  // namespace

Real local_time_step(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, int least_contacts) {
  Real least = 0;
  Kokkos::parallel_reduce("local_time_step", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                          LocalPeriod{particles, rows, laws, least_contacts}, Kokkos::Min<Real>(least));
  return std::sqrt(2 * least);
}

Real largest_frequency(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, Walls const& walls,
                       WallLaw const& wall_law, AcrossRanks const& across, int iterations) {
  Kokkos::RangePolicy<ExecutionSpace> const each(0, particles.owned);
  Motion u = make_motion(particles.all()), w = make_motion(particles.owned);
  Kokkos::parallel_for("random_motion", Kokkos::RangePolicy<ExecutionSpace>(0, particles.all()), RandomMotion{particles, u});
  StiffnessProduct product{particles, rows, laws, walls, wall_law, u, w, 1e4, across.period * across.period};
  Real frequency2 = 0;
  for (int n = 0; n < iterations; ++n) {
    Real sums[2];
    exact_sums<2>("stiffness_product", particles.owned, product, sums, across.sum);
    if (!(sums[0] > 0)) return 0;
    frequency2 = sums[1] / sums[0] / product.reference_time2;
    if (!(frequency2 > 0)) return 0;
    Kokkos::parallel_for("rescale_motion", each, Rescale{w, u, 1 / frequency2});
    for (auto const& field : {u.x, u.y, u.turn}) across.refresh_ghosts(field);
  }
  return std::sqrt(frequency2);
}

}  // namespace clathra
