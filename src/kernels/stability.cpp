#include "kernels/stability.hpp"

#include <algorithm>
#include <cmath>

namespace clathra {

namespace {

constexpr Real any_gap = 1e300;

/// min over (m/k) and (I/k_rot) of one disc.
struct LocalPeriod {
  SpringNetwork net;
  int least_contacts;

  KOKKOS_FUNCTION void operator()(int i, Real& least) const {
    ParticleSoA const& p = net.particles;
    Real const r = p.radius(i);
    Real kxx = 0, kyy = 0, rotation = 0, stiffest = 0, stiffest_rotational = 0;
    int contacts = 0;
    for_each_spring(net, i, {true, any_gap, 0}, [&](Spring const& s) {
      Real const rotational = s.shear * r * r + s.rolling;
      kxx += s.normal * s.nx * s.nx + s.shear * s.ny * s.ny;
      kyy += s.normal * s.ny * s.ny + s.shear * s.nx * s.nx;
      rotation += rotational;
      if (s.other < 0) return;  // a wall is no reason to count fewer contacts to come
      stiffest = lane_max(stiffest, 0.5 * (s.normal + s.shear));
      stiffest_rotational = lane_max(stiffest_rotational, rotational);
      ++contacts;
    });
    if (contacts == 0) {
      ContactStiffness<Real> const k = kept_stiffness(net.rows, net.laws.grain, 0, r);  // with a disc of its own size
      stiffest = 0.5 * (k.normal + k.shear);
      stiffest_rotational = k.shear * r * r + k.rolling;
    }
    int const missing = contacts < least_contacts ? least_contacts - contacts : 0;
    Real const translation = lane_max(kxx, kyy) + missing * stiffest;
    least = lane_min(least, 1 / (p.inverse_mass(i) * translation));
    least = lane_min(least, 1 / (p.inverse_inertia(i) * (rotation + missing * stiffest_rotational)));
  }
};

/// A motion of all discs, ghosts included: two displacements and a rotation each.
struct Motion {
  Field<Real> x, y, rotation;
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
    u.rotation(i) = draw(2) / p.radius(i);
  }
};

/// w = M^-1 K u; its terms are u.M.u and u.K.u (Rayleigh quotient).
struct StiffnessProduct {
  SpringNetwork net;
  Motion u, w;

  KOKKOS_FUNCTION void operator()(int i, Real* out) const {
    ParticleSoA const& p = net.particles;
    Real fx = 0, fy = 0, torque = 0;
    for_each_spring(net, i, {}, [&](Spring const& s) {
      Real const other_x = s.other < 0 ? 0 : u.x(s.other), other_y = s.other < 0 ? 0 : u.y(s.other);
      Real const other_rotation = s.other < 0 ? 0 : u.rotation(s.other);
      Real const dx = other_x - u.x(i), dy = other_y - u.y(i);
      Real const normal = -s.normal * (dx * s.nx + dy * s.ny);
      Real const shear = s.shear * ((dy * s.nx - dx * s.ny) - (u.rotation(i) * s.arm + other_rotation * s.other_arm));
      fx -= normal * s.nx + shear * s.ny;
      fy += shear * s.nx - normal * s.ny;
      torque += s.arm * shear + s.rolling * (other_rotation - u.rotation(i));
    });
    w.x(i) = -fx * p.inverse_mass(i);
    w.y(i) = -fy * p.inverse_mass(i);
    w.rotation(i) = -torque * p.inverse_inertia(i);
    Real const mass = 1 / p.inverse_mass(i), inertia = 1 / p.inverse_inertia(i);
    out[0] = mass * (u.x(i) * u.x(i) + u.y(i) * u.y(i)) + inertia * u.rotation(i) * u.rotation(i);
    out[1] = mass * (u.x(i) * w.x(i) + u.y(i) * w.y(i)) + inertia * u.rotation(i) * w.rotation(i);
  }
};

struct Rescale {
  Motion from, to;
  Real factor;
  KOKKOS_FUNCTION void operator()(int i) const {
    to.x(i) = from.x(i) * factor;
    to.y(i) = from.y(i) * factor;
    to.rotation(i) = from.rotation(i) * factor;
  }
};

/// u = M^-1/2.
struct UnitMotion {
  ParticleSoA p;
  Motion u;
  KOKKOS_FUNCTION void operator()(int i) const {
    u.x(i) = u.y(i) = lane_sqrt(p.inverse_mass(i));
    u.rotation(i) = lane_sqrt(p.inverse_inertia(i));
  }
};

/// w = |M^-1 (K + 2 C / dt)| u, entry by entry, for positive u; reduces to the largest w / u.
struct AbsoluteProduct {
  SpringNetwork net;
  Motion u, w;
  Real twice_rate;                       ///< 2 / dt [1/s]
  static constexpr Real closing = 0.06;  ///< of gaps, as a share of the mean radius

  KOKKOS_FUNCTION void operator()(int i, Real& greatest) const {
    ParticleSoA const& p = net.particles;
    Real kxx = 0, kxy = 0, kyy = 0, kxt = 0, kyt = 0, ktt = 0;  // of the disc with itself
    Real x = 0, y = 0, rotation = 0;                            // from the others
    for_each_spring(net, i, {true, closing, closing}, [&](Spring const& s) {
      Real const normal = s.normal + s.dashpot * twice_rate, tx = -s.ny, ty = s.nx;
      Real const axx = normal * s.nx * s.nx + s.shear * tx * tx, axy = normal * s.nx * s.ny + s.shear * tx * ty,
                 ayy = normal * s.ny * s.ny + s.shear * ty * ty;
      kxx += axx;
      kxy += axy;
      kyy += ayy;
      kxt += s.shear * s.arm * tx;
      kyt += s.shear * s.arm * ty;
      ktt += s.shear * s.arm * s.arm + s.rolling;
      if (s.other < 0) return;
      Real const ux = u.x(s.other), uy = u.y(s.other), ut = u.rotation(s.other);
      x += axx * ux + std::fabs(axy) * uy + std::fabs(s.shear * s.other_arm * tx) * ut;
      y += std::fabs(axy) * ux + ayy * uy + std::fabs(s.shear * s.other_arm * ty) * ut;
      rotation += std::fabs(s.shear * s.arm * tx) * ux + std::fabs(s.shear * s.arm * ty) * uy +
                  std::fabs(s.shear * s.arm * s.other_arm - s.rolling) * ut;
    });
    Real const ux = u.x(i), uy = u.y(i), ut = u.rotation(i);
    w.x(i) = (kxx * ux + std::fabs(kxy) * uy + std::fabs(kxt) * ut + x) * p.inverse_mass(i);
    w.y(i) = (std::fabs(kxy) * ux + kyy * uy + std::fabs(kyt) * ut + y) * p.inverse_mass(i);
    w.rotation(i) = (std::fabs(kxt) * ux + std::fabs(kyt) * uy + ktt * ut + rotation) * p.inverse_inertia(i);
    for (Real const ratio : {w.x(i) / ux, w.y(i) / uy, w.rotation(i) / ut})
      if (ratio > greatest) greatest = ratio;  // not where both are 0: such a motion meets no spring
  }
};

Motion make_motion(int discs) {
  auto const n = static_cast<std::size_t>(discs);
  return {Field<Real>("motion.x", n), Field<Real>("motion.y", n), Field<Real>("motion.relative_rotation", n)};
}

/// u = factor w, on all ranks.
void rescale(ParticleSoA const& particles, Motion const& w, Motion const& u, Real factor, AcrossRanks const& across) {
  Kokkos::parallel_for("rescale_motion", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned), Rescale{w, u, factor});
  for (auto const& field : {u.x, u.y, u.rotation}) across.refresh_ghosts(field);
}

}  // namespace

Real local_time_step(SpringNetwork const& network, int least_contacts) {
  Real least = 0;
  Kokkos::parallel_reduce("local_time_step", Kokkos::RangePolicy<ExecutionSpace>(0, network.particles.owned),
                          LocalPeriod{network, least_contacts}, Kokkos::Min<Real>(least));
  return std::sqrt(2 * least);
}

Real largest_frequency(SpringNetwork const& network, AcrossRanks const& across, int iterations) {
  ParticleSoA const& particles = network.particles;
  Motion const u = make_motion(particles.all()), w = make_motion(particles.owned);
  Kokkos::parallel_for("random_motion", Kokkos::RangePolicy<ExecutionSpace>(0, particles.all()), RandomMotion{particles, u});
  StiffnessProduct const product{network, u, w};
  Real frequency2 = 0;
  for (int n = 0; n < iterations; ++n) {
    Real sums[2];
    exact_sums<2>("stiffness_product", particles.owned, product, {across.sums.unit.mass(), across.sums.unit.stress}, sums,
                  across.sums.over_ranks);
    if (!(sums[0] > 0)) return 0;
    frequency2 = sums[1] / sums[0];
    if (!(frequency2 > 0)) return 0;
    rescale(particles, w, u, 1 / frequency2, across);
  }
  return std::sqrt(frequency2);
}

Real stable_limit(SpringNetwork const& network, Real alpha, AcrossRanks const& across) {
  ParticleSoA const& particles = network.particles;
  Motion const u = make_motion(particles.all()), w = make_motion(particles.owned);
  Kokkos::parallel_for("unit_motion", Kokkos::RangePolicy<ExecutionSpace>(0, particles.all()), UnitMotion{particles, u});
  // A bound for a shorter dt holds for a longer one too. With dashpots each product halves what the logarithm of dt lacks.
  bool const dashpots = network.laws.grain.damping_ratio > 0 || network.wall_law.damping_ratio > 0;
  int const products = dashpots ? 16 : 10;
  Real step = dashpots ? -1e-3 * across.max(-local_time_step(network)) : 0;
  for (int n = 0; n < products; ++n) {
    Real greatest = 0;
    Kokkos::parallel_reduce("absolute_product", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                            AbsoluteProduct{network, u, w, dashpots ? 2 / step : 0}, Kokkos::Max<Real>(greatest));
    greatest = across.max(std::max(greatest, Real(0)));
    if (!(greatest > 0)) return 1e300;
    step = std::max(step, 2 / std::sqrt((1 + alpha) * greatest));
    rescale(particles, w, u, 1 / greatest, across);
  }
  return step;
}

}  // namespace clathra
