/// The largest eigenvalue of a network by Lanczos' method.
#include "kernels/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kernels/mix64.hpp"

namespace clathra {

namespace {

struct RandomMotion {
  ParticleSoA p;
  Motion u;
  KOKKOS_FUNCTION void operator()(int i) const {
    auto const draw = [&](std::uint64_t salt) {
      return unit_interval(mix64((static_cast<std::uint64_t>(p.id(i)) * 3 + salt) * golden_gamma)) - 0.5;
    };
    u.x(i) = draw(0);
    u.y(i) = draw(1);
    u.rotation(i) = draw(2) / p.radius(i);
  }
};

/// u.M.v of one disc.
KOKKOS_INLINE_FUNCTION Real mass_product(ParticleSoA const& p, Motion const& u, Motion const& v, int i) {
  return (u.x(i) * v.x(i) + u.y(i) * v.y(i)) / p.inverse_mass(i) + u.rotation(i) * v.rotation(i) / p.inverse_inertia(i);
}

/// w = M^-1 K u; its term is u.K.u.
struct StiffnessProduct {
  SpringNetwork net;
  Motion u, w;
  SpringSet springs;

  KOKKOS_FUNCTION void operator()(int i, Real* out) const {
    ParticleSoA const& p = net.particles;
    Real fx = 0, fy = 0, torque = 0;
    for_each_spring(net, i, springs, [&](Spring<Real> const& s, int other) {
      Real const other_x = other < 0 ? 0 : u.x(other), other_y = other < 0 ? 0 : u.y(other);
      Real const other_rotation = other < 0 ? 0 : u.rotation(other);
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
    out[0] = mass_product(p, u, w, i);
  }
};

/// w -= a u + b before; its term is w.M.w.
struct Orthogonalise {
  ParticleSoA p;
  Motion w, u, before;
  Real a, b;
  KOKKOS_FUNCTION void operator()(int i, Real* out) const {
    w.x(i) -= a * u.x(i) + b * before.x(i);
    w.y(i) -= a * u.y(i) + b * before.y(i);
    w.rotation(i) -= a * u.rotation(i) + b * before.rotation(i);
    out[0] = mass_product(p, w, w, i);
  }
};

struct MassNorm {
  ParticleSoA p;
  Motion u;
  KOKKOS_FUNCTION void operator()(int i, Real* out) const { out[0] = mass_product(p, u, u, i); }
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

/// A sum over all discs of all ranks.
template <class Terms>
Real sum_of(char const* label, int discs, Terms const& terms, Real unit, AcrossRanks const& across) {
  Real sum[1];
  exact_sums<1>(label, discs, terms, {unit}, sum, across.sums.over_ranks);
  return sum[0];
}

}  // namespace

void scale_motion(int owned, Motion const& from, Real factor, Motion const& to) {
  Kokkos::parallel_for("scale_motion", Kokkos::RangePolicy<ExecutionSpace>(0, owned), Rescale{from, to, factor});
}

void refresh(Motion const& motion, AcrossRanks const& across) {
  for (auto const& field : {motion.x, motion.y, motion.rotation}) across.refresh_ghosts(field);
}

Real largest_eigenvalue(std::vector<Real> const& diagonal, std::vector<Real> const& beside) {
  // Sturm: the eigenvalues above x are as many as the negative pivots of x - T.
  Real low = diagonal.front(), high = low;
  for (std::size_t k = 0; k < diagonal.size(); ++k) {
    Real const reach = (k > 0 ? std::abs(beside[k - 1]) : 0) + (k + 1 < diagonal.size() ? std::abs(beside[k]) : 0);
    low = std::max(low, diagonal[k]);
    high = std::max(high, diagonal[k] + reach);
  }
  auto const any_above = [&](Real x) {
    Real pivot = x - diagonal[0];
    for (std::size_t k = 1; k < diagonal.size() && pivot > 0; ++k)
      pivot = x - diagonal[k] - beside[k - 1] * beside[k - 1] / pivot;
    return !(pivot > 0);
  };
  for (int n = 0; n < 100; ++n) {
    Real const middle = 0.5 * (low + high);
    (any_above(middle) ? low : high) = middle;
  }
  return low;
}

Real largest_frequency(SpringNetwork const& network, AcrossRanks const& across, int iterations, SpringSet const& springs) {
  ParticleSoA const& particles = network.particles;
  int const discs = particles.owned;
  Motion u = make_motion(particles), w = make_motion(particles), before = make_motion(particles);
  Kokkos::parallel_for("random_motion", Kokkos::RangePolicy<ExecutionSpace>(0, particles.all()), RandomMotion{particles, u});
  Real const norm2 = sum_of("mass_norm", discs, MassNorm{particles, u}, across.sums.unit.mass(), across);
  if (!(norm2 > 0)) return 0;
  scale_motion(discs, u, 1 / std::sqrt(norm2), u);
  Real const unit = across.sums.unit.stress / across.sums.unit.mass();  // of eigenvalues [1/s^2]
  std::vector<Real> diagonal, beside;
  for (int n = 0; n < iterations; ++n) {
    refresh(u, across);
    Real const a = sum_of("stiffness_product", discs, StiffnessProduct{network, u, w, springs}, unit, across);
    diagonal.push_back(a);
    Real const length2 =
        sum_of("orthogonalise", discs, Orthogonalise{particles, w, u, before, a, n > 0 ? beside.back() : 0}, unit * unit, across);
    Real const length = std::sqrt(std::max(length2, Real(0)));
    if (!(length > 1e-12 * std::abs(a))) break;  // all of the space that the start reaches
    beside.push_back(length);
    std::swap(before, u);
    scale_motion(discs, w, 1 / length, u);
  }
  return std::sqrt(std::max(largest_eigenvalue(diagonal, beside), Real(0)));
}

}  // namespace clathra
