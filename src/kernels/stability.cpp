#include "kernels/stability.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clathra {

namespace {

constexpr Real of_single_precision = 1e-6;  // relative, more than its rounding can do to a sum

/// min over (m/k) and (I/k_rot) of one disc.
struct LocalPeriod {
  SpringNetwork net;
  int least_contacts;

  KOKKOS_FUNCTION void operator()(int i, Real& least) const {
    ParticleSoA const& p = net.particles;
    Real const r = p.radius(i);
    Real kxx = 0, kyy = 0, rotation = 0, stiffest = 0, stiffest_rotational = 0;
    int contacts = 0;
    for_each_spring(net, i, {true, 0, true}, [&](Spring<Real> const& s, int other) {
      Real const rotational = s.shear * r * r + s.rolling;
      kxx += s.normal * s.nx * s.nx + s.shear * s.ny * s.ny;
      kyy += s.normal * s.ny * s.ny + s.shear * s.nx * s.nx;
      rotation += rotational;
      if (other < 0) return;  // a wall is no reason to count fewer contacts to come
      stiffest = lane_max(stiffest, 0.5 * (s.normal + s.shear));
      stiffest_rotational = lane_max(stiffest_rotational, rotational);
      ++contacts;
    });
    if (contacts == 0) {
      ContactStiffness<Real> const k = kept_stiffness(net.rows, net.laws.grain, Real(0), r);  // with a disc of its own size
      stiffest = 0.5 * (k.normal + k.shear);
      stiffest_rotational = k.shear * r * r + k.rolling;
    }
    int const missing = contacts < least_contacts ? least_contacts - contacts : 0;
    Real const translation = lane_max(kxx, kyy) + missing * stiffest;
    least = lane_min(least, 1 / (p.inverse_mass(i) * translation));
    least = lane_min(least, 1 / (p.inverse_inertia(i) * (rotation + missing * stiffest_rotational)));
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

/// |K + 2 C / dt| as it stands in memory, in single precision, which no limit sees: blocks between discs by row entry, and of
/// each disc with itself.
struct AbsoluteStiffness {
  Field<float> between[9];  ///< [entries] xx, xy, xt, yx, yy, yt, tx, ty, tt: force or torque of the disc, motion of the other
  Field<float> own[6];      ///< [discs] xx, xy, yy, xt, yt, tt
  Field<std::uint64_t> blocks;  ///< [groups of lanes] bit k: one of the entries k of the group is a spring
};

AbsoluteStiffness make_absolute_stiffness(SpringNetwork const& net) {
  AbsoluteStiffness k;
  for (auto& field : k.between) field = uninitialised<float>("stiffness.between", net.rows.neighbour.extent(0));
  for (auto& field : k.own) field = uninitialised<float>("stiffness.own", net.particles.x.extent(0));
  k.blocks = uninitialised<std::uint64_t>("stiffness.blocks", static_cast<std::size_t>(group_count(net.particles.owned)));
  return k;
}

/// Writes |K + 2 C / dt| of one group of discs a call.
struct FillAbsoluteStiffness {
  SpringNetwork net;
  AbsoluteStiffness to;
  Real twice_rate;     ///< 2 / dt [1/s], 0 without dashpots
  Real skin_fraction;  ///< SpringSet
  Real slip;           ///< mu where sliding contacts may vibrate faster than sticking ones, else 0
  std::size_t ahead = discs_ahead(net.particles.owned);

  struct Own {
    Lanes xx, xy, yy, xt, yt, tt;
  };

  KOKKOS_FUNCTION void operator()(int group) const {
    ParticleSoA const& p = net.particles;
    auto const first = static_cast<std::size_t>(group) * lane_count;
    fetch_discs(first + ahead, p.x, p.y, p.radius, p.verlet_skin);
    Lanes const x = load(&p.x(first)), y = load(&p.y(first)), radius = load(&p.radius(first)),
                inverse_mass = load(p.inverse_mass, first), may_close = skin_fraction * load(&p.verlet_skin(first));
    bool const bonds = net.laws.bond_kind != BondKind::none, viscous = net.laws.grain.damping_ratio > 0;
    Own own{0, 0, 0, 0, 0, 0};
    HistoryFormat const& format = net.rows.features.format;
    int const shift = format.slice_shift();
    bool const narrow = format.lanes() > lane_count;
    auto const slice = static_cast<int>(first >> shift);
    std::uint64_t const active = net.rows.active(static_cast<int>(first) / format.lanes());
    std::uint64_t blocks = 0, bit = 1;
    for (int k = net.rows.slice_start(slice); k < net.rows.slice_start(slice + 1); ++k, bit <<= 1) {
      std::size_t const e = (static_cast<std::size_t>(k) << shift) | (first & ((std::size_t(1) << shift) - 1));
      int const* const j = &net.rows.neighbour(e);
      Lanes const dx = gather(p.x.data(), j) - x, dy = gather(p.y.data(), j) - y, other_radius = gather(p.radius.data(), j),
                  closing = may_close + skin_fraction * gather(p.verlet_skin.data(), j), reach = radius + other_radius + closing;
      auto const formed = [&] { return bonds ? load(net.rows.formation_overlap, e) : Lanes(no_bond); };
      // Whether an entry of a wider group carries something need not hold for one of this group.
      if ((narrow || (active & bit) == 0) && !any(dx * dx + dy * dy < reach * reach) &&
          ((active & bit) == 0 || !any(is_bonded(formed()))))
        continue;
      blocks |= bit;
      Pair<Lanes> const pair{dx,           dy,
                             radius,       other_radius,
                             inverse_mass, viscous ? gather(p.inverse_mass, j) : Lanes(1),
                             formed(),     bonds ? load(net.rows.width, e) : Lanes(0),
                             closing};
      add(pair_spring(net, pair), own,
          [&](int entry, Lanes const& value) { store_float(&to.between[entry](e), lane_abs(value)); });
    }
    to.blocks(group) = blocks;
    for (int wall = 0; wall < wall_count; ++wall) {
      if (!any(lane_abs(wall_face(net.walls, wall, x, y).distance) < radius + may_close)) continue;
      add(wall_spring(net, wall, x, y, radius, inverse_mass, may_close), own, [](int, Lanes const&) {});
    }
    Lanes const sums[] = {own.xx, own.xy, own.yy, own.xt, own.yt, own.tt};
    for (int n = 0; n < 6; ++n) store_float(&to.own[n](first), lane_abs(sums[n]));
  }

  /// Adds one spring of each disc of a group to its own block and writes that between the discs.
  template <class Write>
  KOKKOS_FORCEINLINE_FUNCTION void add(Spring<Lanes> const& s, Own& own, Write const& write) const {
    Lanes const normal = s.normal + s.dashpot * twice_rate, tx = -s.ny, ty = s.nx;
    Lanes const xx = normal * s.nx * s.nx + s.shear * tx * tx, xy = normal * s.nx * s.ny + s.shear * tx * ty,
                yy = normal * s.ny * s.ny + s.shear * ty * ty, xt = s.shear * s.arm * tx, yt = s.shear * s.arm * ty;
    own.tt += s.shear * s.arm * s.arm + s.rolling;
    write(2, s.shear * s.other_arm * tx);
    write(5, s.shear * s.other_arm * ty);
    write(8, s.shear * s.arm * s.other_arm - s.rolling);
    if (slip > 0) {
      add_sliding(s, slip * normal, {xx, xy, yy, xt, yt, 0}, own, write);
      return;
    }
    own.xx += xx;
    own.xy += xy;
    own.yy += yy;
    own.xt += xt;
    own.yt += yt;
    write(0, xx);
    write(1, xy);
    write(3, xy);
    write(4, yy);
    write(6, xt);
    write(7, yt);
  }

  /// Entry by entry the larger of a sticking contact and one that slides, whose shear force is mu times its normal force.
  /// @param drag  mu (k_n + 2 c / dt)
  template <class Write>
  KOKKOS_FORCEINLINE_FUNCTION void add_sliding(Spring<Lanes> const& s, Lanes const& drag, Own const& stick, Own& own,
                                               Write const& write) const {
    auto const larger = [](Lanes const& a, Lanes const& b) { return lane_max(lane_abs(a), b); };
    Lanes const nx = lane_abs(s.nx), ny = lane_abs(s.ny), normal = drag * (1 / slip);
    Lanes const xx = larger(stick.xx, normal * nx * nx + drag * nx * ny),
                yy = larger(stick.yy, normal * ny * ny + drag * nx * ny);
    Lanes const xy = larger(stick.xy, normal * nx * ny + drag * ny * ny),
                yx = larger(stick.xy, normal * nx * ny + drag * nx * nx);
    Lanes const tx = larger(stick.xt, drag * s.arm * nx), ty = larger(stick.yt, drag * s.arm * ny);
    own.xx += xx;
    own.xy += lane_max(xy, yx);
    own.yy += yy;
    own.xt += tx;
    own.yt += ty;
    write(0, xx);
    write(1, xy);
    write(3, yx);
    write(4, yy);
    write(6, tx);
    write(7, ty);
  }
};

/// v = factor M^-1 |K + 2 C / dt| u of one group of discs a call; reduces to the largest v / u. Any positive u bounds, so the
/// next one goes half as far again as v does, w = v sqrt(v / u): a bound as good from five products as v alone has from seven.
struct AbsoluteProduct {
  SpringNetwork net;
  AbsoluteStiffness k;
  Motion u, w;
  Real factor;
  static constexpr int entries_ahead = 256;  ///< that are fetched before they are read
  bool further;                              ///< w = v sqrt(v / u), else w = v: the first product is not normalised yet
  std::size_t ahead = discs_ahead(net.particles.owned);

  KOKKOS_FUNCTION void operator()(int group, Real& greatest) const {
    auto const first = static_cast<std::size_t>(group) * lane_count;
    fetch_discs(first + ahead, u.x, u.y, u.rotation);
    Lanes const ux = load(&u.x(first)), uy = load(&u.y(first)), ut = load(&u.rotation(first));
    Lanes own[6];
    for (int n = 0; n < 6; ++n) own[n] = load_float(&k.own[n](first));
    Lanes x = own[0] * ux + own[1] * uy + own[3] * ut, y = own[1] * ux + own[2] * uy + own[4] * ut,
          t = own[3] * ux + own[4] * uy + own[5] * ut;
    int const shift = net.rows.features.format.slice_shift();
    auto const slice = static_cast<int>(first >> shift);
    std::uint64_t blocks = k.blocks(group);
    for (int block = net.rows.slice_start(slice); blocks != 0; ++block, blocks >>= 1) {
      if ((blocks & 1) == 0) continue;
      std::size_t const e = (static_cast<std::size_t>(block) << shift) | (first & ((std::size_t(1) << shift) - 1));
      int const* const j = &net.rows.neighbour(e);
      prefetch(j + entries_ahead);
      for (int n = 0; n < 9; ++n) prefetch(k.between[n].data() + e + entries_ahead);
      Lanes const vx = gather(u.x.data(), j), vy = gather(u.y.data(), j), vt = gather(u.rotation.data(), j);
      x += load_float(&k.between[0](e)) * vx + load_float(&k.between[1](e)) * vy + load_float(&k.between[2](e)) * vt;
      y += load_float(&k.between[3](e)) * vx + load_float(&k.between[4](e)) * vy + load_float(&k.between[5](e)) * vt;
      t += load_float(&k.between[6](e)) * vx + load_float(&k.between[7](e)) * vy + load_float(&k.between[8](e)) * vt;
    }
    Lanes const inverse_mass = factor * load(net.particles.inverse_mass, first),
                inverse_inertia = factor * load(net.particles.inverse_inertia, first);
    Lanes largest_ratio = lane_max(lane_max(next(x * inverse_mass, ux, &w.x(first)), next(y * inverse_mass, uy, &w.y(first))),
                                   next(t * inverse_inertia, ut, &w.rotation(first)));
    for (auto l = net.particles.owned - static_cast<int>(first); l < lane_count; ++l) set_lane(largest_ratio, l, 0);
    greatest = lane_max(greatest, largest(largest_ratio));
  }

  /// Stores one component of w, returns v / u.
  KOKKOS_FORCEINLINE_FUNCTION Lanes next(Lanes const& v, Lanes const& from, Real* to) const {
    Lanes const ratio = select(from > Lanes(0), v / from, Lanes(0));  // u = 0 meets no spring
    store(to, further ? v * lane_sqrt(ratio) : v);
    return ratio;
  }
};

/// The friction of sliding contacts that may vibrate faster than sticking ones, else 0.
Real slip_of(Real friction) {
  constexpr Real fast = 2, never = 1000;
  return friction > fast && friction < never ? friction : 0;
}

}  // namespace

Motion make_motion(ParticleSoA const& particles) {
  std::size_t const places = particles.x.extent(0);
  return {Field<Real>("motion.x", places), Field<Real>("motion.y", places), Field<Real>("motion.rotation", places)};
}

Real local_time_step(SpringNetwork const& network, int least_contacts) {
  Real least = 0;
  Kokkos::parallel_reduce("local_time_step", Kokkos::RangePolicy<ExecutionSpace>(0, network.particles.owned),
                          LocalPeriod{network, least_contacts}, Kokkos::Min<Real>(least));
  return std::sqrt(2 * least);
}

Real stable_limit(SpringNetwork const& network, Real alpha, Real skin_fraction, AcrossRanks const& across) {
  ParticleSoA const& particles = network.particles;
  across.refresh_ghosts(particles.verlet_skin);
  Motion u = make_motion(particles), w = make_motion(particles);
  Kokkos::parallel_for("unit_motion", Kokkos::RangePolicy<ExecutionSpace>(0, particles.all()), UnitMotion{particles, u});
  // A bound for a shorter dt holds for a longer one too. With dashpots each product halves what the logarithm of dt lacks.
  bool const dashpots = network.laws.grain.damping_ratio > 0 || network.wall_law.damping_ratio > 0;
  Real const slip = lane_max(slip_of(network.laws.grain.friction), slip_of(network.wall_law.friction));
  // Without them it is enough when a product wins little: where the stiffest place is small that is soon.
  constexpr int least_products = 4;
  constexpr Real little = 1.006;  // five products for most states, for 0.5 % of the step
  int const products = dashpots ? 16 : 12;
  Real step = dashpots ? -1e-3 * across.max(-local_time_step(network)) : 0, factor = 1;
  Kokkos::RangePolicy<ExecutionSpace> const groups(0, group_count(particles.owned));
  AbsoluteStiffness const stiffness = make_absolute_stiffness(network);
  for (int n = 0; n < products; ++n) {
    if (n == 0 || dashpots)
      Kokkos::parallel_for("fill_absolute_stiffness", groups,
                           FillAbsoluteStiffness{network, stiffness, dashpots ? 2 / step : 0, skin_fraction, slip});
    Real greatest = 0;
    Kokkos::parallel_reduce("absolute_product", groups, AbsoluteProduct{network, stiffness, u, w, factor, n > 0},
                            Kokkos::Max<Real>(greatest));
    greatest = across.max(std::max(greatest, Real(0))) / factor;
    if (!(greatest > 0)) return 1e300;
    Real const before = step;
    step = std::max(step, 2 / std::sqrt((1 + alpha) * greatest * (1 + of_single_precision)));
    if (!dashpots && n >= least_products && step < little * before) break;
    if (n == 0) factor = 1 / greatest;  // keeps u from growing out of all bounds
    std::swap(u, w);
    refresh(u, across);
  }
  return step;
}

}  // namespace clathra
