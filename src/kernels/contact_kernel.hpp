#pragma once
/// The contact kernel, specialised by precision, bond kind, friction, rolling, dashpot and ledger; instantiated in
/// forces_full.cpp and forces_mixed.cpp only.
#include <type_traits>

#include "kernels/bond_quick_test.hpp"
#include "kernels/disc_reader.hpp"
#include "kernels/forces.hpp"
#include "kernels/history.hpp"

namespace clathra {

/// Numbers of the laws. The kernel works on a copy on its stack, which no store can change, so that what follows from them is
/// computed once a group.
template <class R>
struct ContactConstants {
  GrainLawOf<R> grain;
  BondLawOf<R> bond;
  LeastStrengthOf<R> least;
  R dt;
  HistoryScale<R> forces, moments;
  R tick;  ///< mixed precision: what differences of places count in [m]
};

/// One group of discs per call, as many as a vector holds: walks their rows side by side.
/// @tparam P  FullPrecision or MixedPrecision;  @tparam Friction  false where grain contacts carry no shear
template <class P, BondKind Bond, bool Friction, bool Rolling, bool Dashpot, bool Ledger>
struct ContactKernel {
  using R = typename P::Real;
  using V = LanesOf<R>;
  using VMask = MaskOf<V>;
  using Kept = HistoryOf<P>;
  using Stored = typename Kept::Value;
  using Constants = ContactConstants<R>;
  using Discs = DiscReader<P, Dashpot>;
  static constexpr bool mixed = P::precision == Precision::mixed;
  static constexpr int lanes = lane_count_of<R>, slice_width = slice_width_of<R>;
  static constexpr bool bonded_code = Bond != BondKind::none;
  static constexpr bool shears = Friction || Bond == BondKind::replace;  // has a history of `shear`
  static constexpr bool moments = Rolling || bonded_code;

  ParticleSoA p;
  ContactRows rows;
  Constants constants;
  BondLaw exact;      ///< for the strength test that decides, in double precision
  std::int64_t step;  ///< its number, where there are no `steps`
  Field<StepState> steps;
  BreakLog breaks;
  EnergyLosses losses;
  Faults faults;
  std::size_t discs_ahead;  ///< that are fetched before a neighbour needs them, discs_ahead()

  /// State of the group's own discs and what has been summed for them.
  struct Own {
    typename Discs::Own disc;
    V force_x, force_y, torque;
    V sliding, rolling, dashpot, breakage;
  };

  /// History of one block of entries.
  struct History {
    Stored shear, moment;
    V formation_overlap, width;
    Stored bond_shear, bond_moment;
  };

  KOKKOS_FUNCTION void operator()(int group) const {
    if (is_stopped(steps)) return;
    auto const first = static_cast<std::size_t>(group) * lanes;
    int const slice = group / (slice_width / lanes);
    Constants law = constants;
    if constexpr (mixed) law.forces.rounding = law.moments.rounding = rounding_of_step(number_of_step());
    Own own = load_own(first);
    Discs::fetch_ahead(p, first, discs_ahead);
    // Entries out of touch stay so nearly always, and those that carry a history still do: a branch on what the last step found
    // is foreseen, one on the distances is not.
    int const begin = rows.slice_start(slice), end = rows.slice_start(slice + 1);
    std::uint64_t const active = rows.active(group);
    std::uint64_t carrying = 0, bit = 1;
    for (int k = begin; k < end; ++k, bit <<= 1) {
      if (add_block(law, first, static_cast<std::size_t>(k) * slice_width + first % slice_width, (active & bit) != 0, own))
        carrying |= bit;
    }
    rows.active(group) = carrying;
    store(p.force_x.data<R>() + first, own.force_x);
    store(p.force_y.data<R>() + first, own.force_y);
    store(p.torque.data<R>() + first, own.torque);
    if constexpr (Ledger) {
      if constexpr (shears) Discs::book(losses.sliding, first, own.sliding);
      if constexpr (Rolling) Discs::book(losses.rolling, first, own.rolling);
      if constexpr (Dashpot) Discs::book(losses.dashpot, first, own.dashpot);
      if constexpr (bonded_code) Discs::book(losses.breakage, first, own.breakage);
    }
  }

  /// Entry block `e .. e + lanes`: the k-th neighbour of each disc of the group.
  /// @param active  false if none of them holds a history;  @return whether one does afterwards
  KOKKOS_FORCEINLINE_FUNCTION bool add_block(Constants const& law, std::size_t first, std::size_t e, bool active,
                                             Own& own) const {
    int const* const j = &rows.neighbour(e);
    typename Discs::Own const& disc = own.disc;
    typename Discs::OtherMotion moving;
    typename Discs::Other const other = Discs::other(p, j, disc, law.tick, active, moving);
    V const &dx = other.dx, &dy = other.dy, &other_radius = other.radius;
    V const reach = disc.radius + other_radius, distance2 = dx * dx + dy * dy;
    auto const touching = distance2 < reach * reach;
    if (!active && !any(touching)) return false;
    History h = read(e);

    V const distance = lane_max(lane_sqrt(distance2), constant<V>(1e-30)), inverse = V(1) / distance;
    V const nx = dx * inverse, ny = dy * inverse;
    Discs::complete(p, j, active, moving);
    V const dvx = moving.vx - disc.vx, dvy = moving.vy - disc.vy, &other_omega = moving.omega;
    ContactMotion<V> motion;
    motion.overlap = reach - distance;
    motion.closing_velocity = -(dvx * nx + dvy * ny);
    V const half_overlap = constant<V>(0.5) * motion.overlap;
    V const arm = disc.radius - half_overlap, other_arm = other_radius - half_overlap;  // arm + other_arm = distance
    motion.shear_increment = during_step(law, (dvy * nx - dvx * ny) - (disc.omega * arm + other_omega * other_arm));
    motion.relative_rotation = during_step(law, other_omega - disc.omega);
    motion.common_radius = common_radius(disc.radius, other_radius);
    auto const deep = Discs::is_deep(motion.overlap, distance, disc.radius, other_radius);
    if (any(deep)) report_deep(first, deep);

    Viscosity dashpot;
    if constexpr (Dashpot) dashpot = dashpot_coefficient(law.grain, disc.inverse_mass, moving.inverse_mass);
    ContactForce<V> force = grain_force(law, motion, dashpot, h, own);
    auto carrying = touching;
    if constexpr (bonded_code) {
      auto const bonded = is_bonded(h.formation_overlap);
      BondTrial const trial = bond_trial(law, motion, h);
      auto intact = bonded;
      auto const doubt = bonded && !is_far_from_breaking(law.least, trial.bond);
      if (any(doubt)) {
        ContactForce<V> const& f = trial.bond.force;
        intact = bonded &&
                 !break_bonds({first, e, doubt, trial.bond.width, trial.bond.thickness, f.normal, f.shear, f.moment, dx, dy});
      }
      force = with_bond(law, force, motion, dashpot, trial, bonded, intact, h, own);
      carrying = touching || intact;
    }
    write(e, h);
    // Entries out of touch and without a bond got exact zeros from the laws; nothing needs masking here.
    if constexpr (shears || bonded_code) {
      own.force_x -= force.normal * nx + force.shear * ny;
      own.force_y += force.shear * nx - force.normal * ny;
      own.torque += arm * force.shear + force.moment;
    } else {
      own.force_x -= force.normal * nx;
      own.force_y -= force.normal * ny;
      own.torque += force.moment;
    }
    return any(carrying);
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION std::int64_t number_of_step() const { return steps.extent(0) > 0 ? steps(0).step + 1 : step; }

  /// A motion as the history takes it: in mixed precision the rate itself (HistoryScale::per_rate).
  KOKKOS_FORCEINLINE_FUNCTION static V during_step(Constants const& law, V const& rate) {
    if constexpr (mixed)
      return rate;
    else
      return rate * law.dt;
  }

  KOKKOS_FORCEINLINE_FUNCTION Own load_own(std::size_t first) const {
    Own own{};
    own.disc = Discs::own(p, first);
    own.force_x = own.force_y = own.torque = own.sliding = own.rolling = own.dashpot = own.breakage = V(0);
    return own;
  }

  using Viscosity = std::conditional_t<Dashpot, V, Undamped>;

  /// A block with bonds that may break. It is put together where one is met: a block whose values had an address would spend its
  /// time storing and loading them.
  struct FailureCandidates {
    std::size_t first, entry;
    VMask where;
    V width, thickness, normal, shear, moment;
    V dx, dy;  ///< branches
  };

  /// Bonds as they would be if none broke, and what would then be kept of them.
  struct BondTrial {
    BondForce<V> bond;
    Stored shear, moment;
  };

  KOKKOS_FORCEINLINE_FUNCTION History read(std::size_t e) const {
    History h{Kept::none(), Kept::none(), V(no_bond_of<R>), V(0), Kept::none(), Kept::none()};
    if constexpr (shears) h.shear = Kept::read(rows.shear, e);
    if constexpr (moments) h.moment = Kept::read(rows.moment, e);
    if constexpr (bonded_code) {
      h.formation_overlap = load(rows.formation_overlap.data<R>() + e);
      h.width = load(rows.width.data<R>() + e);
    }
    if constexpr (Bond == BondKind::parallel) {
      h.bond_shear = Kept::read(rows.bond_shear, e);
      h.bond_moment = Kept::read(rows.bond_moment, e);
    }
    return h;
  }

  KOKKOS_FORCEINLINE_FUNCTION void write(std::size_t e, History const& h) const {
    if constexpr (shears) Kept::write(rows.shear, e, h.shear);
    if constexpr (moments) Kept::write(rows.moment, e, h.moment);
    if constexpr (Bond == BondKind::parallel) {
      Kept::write(rows.bond_shear, e, h.bond_shear);
      Kept::write(rows.bond_moment, e, h.bond_moment);
    }
  }

  /// Shear force and moment of a grain contact before the limits.
  struct GrainTrial {
    Stored shear, moment;
  };
  KOKKOS_FORCEINLINE_FUNCTION static GrainTrial grain_trial(Constants const& law, ContactMotion<V> const& motion,
                                                            History const& h) {
    GrainTrial trial{Kept::none(), Kept::none()};
    if constexpr (shears) trial.shear = Kept::advanced(h.shear, law.grain.shear_stiffness, motion.shear_increment, law.forces);
    if constexpr (Rolling)
      trial.moment =
          Kept::advanced(h.moment, rolling_stiffness(law.grain, motion.common_radius), motion.relative_rotation, law.moments);
    return trial;
  }

  /// Eq. 8: puts a trial within its limits. @return the forces that it then is
  KOKKOS_FORCEINLINE_FUNCTION static ContactForce<V> limit(Constants const& law, ContactMotion<V> const& motion,
                                                           Viscosity const& dashpot, GrainTrial& trial) {
    ContactForce<V> force;
    force.normal = normal_force(law.grain, motion, dashpot);
    force.shear = force.moment = V(0);
    if constexpr (shears) {
      trial.shear = Kept::limited(trial.shear, shear_limit(law.grain, force.normal), law.forces);
      force.shear = Kept::number(trial.shear, law.forces);
    }
    if constexpr (Rolling) {
      trial.moment = Kept::limited(trial.moment, moment_limit(law.grain, motion.common_radius, force.normal), law.moments);
      force.moment = Kept::number(trial.moment, law.moments);
    }
    return force;
  }

  /// The unbonded law on every entry; with `replace` the entries that are bonded are overruled by with_bond().
  KOKKOS_FORCEINLINE_FUNCTION ContactForce<V> grain_force(Constants const& law, ContactMotion<V> const& motion,
                                                          Viscosity const& dashpot, History& h, Own& own) const {
    if constexpr (Bond == BondKind::replace) return {};
    GrainTrial const trial = grain_trial(law, motion, h);
    GrainTrial kept = trial;
    ContactForce<V> const force = limit(law, motion, dashpot, kept);
    if constexpr (Ledger) add_grain_losses(law, motion, trial, h, force, own);
    if constexpr (shears) h.shear = kept.shear;
    if constexpr (Rolling) h.moment = kept.moment;
    return force;
  }

  KOKKOS_FORCEINLINE_FUNCTION static BondTrial bond_trial(Constants const& law, ContactMotion<V> const& motion,
                                                          History const& h) {
    constexpr bool parallel = Bond == BondKind::parallel;
    BondTrial trial{bond_springs(law.bond, motion, h.formation_overlap, h.width), Kept::none(), Kept::none()};
    ContactForce<V>& force = trial.bond.force;
    ContactStiffness<V> const& k = trial.bond.stiffness;
    trial.shear = Kept::advanced(parallel ? h.bond_shear : h.shear, k.shear, motion.shear_increment, law.forces);
    trial.moment = Kept::advanced(parallel ? h.bond_moment : h.moment, k.rolling, motion.relative_rotation, law.moments);
    force.shear = Kept::number(trial.shear, law.forces);
    force.moment = Kept::number(trial.moment, law.moments);
    return trial;
  }

  /// Adds the bond (`parallel`) or puts it in the grain contact's place (`replace`). The pair of a bond that broke, `bonded` but
  /// not `intact`, follows the unbonded law from this very step on.
  KOKKOS_FORCEINLINE_FUNCTION ContactForce<V> with_bond(Constants const& law, ContactForce<V> const& grain_part,
                                                        ContactMotion<V> const& motion, Viscosity const& dashpot,
                                                        BondTrial const& trial, VMask const& bonded, VMask const& intact,
                                                        History& h, Own& own) const {
    V const zero(0);
    BondForce<V> const& bond = trial.bond;
    if constexpr (Bond == BondKind::parallel) {
      if constexpr (Ledger)
        own.breakage += select(bonded && !intact, constant<V>(0.5) * spring_energy(bond.force, bond.stiffness), zero);
      h.bond_shear = Kept::choose(intact, trial.shear, Kept::none());
      h.bond_moment = Kept::choose(intact, trial.moment, Kept::none());
      return {grain_part.normal + select(intact, bond.force.normal, zero),
              grain_part.shear + select(intact, bond.force.shear, zero),
              grain_part.moment + select(intact, bond.force.moment, zero)};
    } else {
      GrainTrial const grains = grain_trial(law, motion, h);
      GrainTrial const before{Kept::choose(bonded, trial.shear, grains.shear), Kept::choose(bonded, trial.moment, grains.moment)};
      GrainTrial kept{before.shear, Rolling ? before.moment : Kept::none()};
      ContactForce<V> const unbonded = limit(law, motion, dashpot, kept);
      if constexpr (Ledger) add_replace_losses(law, motion, bond, before, bonded, intact, unbonded, h, own);
      h.shear = Kept::choose(intact, trial.shear, kept.shear);
      h.moment = Kept::choose(intact, trial.moment, kept.moment);
      return {select(intact, bond.force.normal, unbonded.normal), select(intact, bond.force.shear, unbonded.shear),
              select(intact, bond.force.moment, unbonded.moment)};
    }
  }

  /// The closer strength test of the failure candidates and, one by one, the exact one of those that it leaves. @return those
  /// that broke
  CLATHRA_COLD_FUNCTION VMask break_bonds(FailureCandidates const& block) const {
    VMask broken(false);
    for_each_set(doubtful(block), [&](int l) {
      if (mixed && is_surely_intact(exact, trial_of(block, l))) return;
      std::size_t const e = block.entry + static_cast<std::size_t>(l), disc = block.first + static_cast<std::size_t>(l);
      Real const radius = common_radius(p.radius(disc), p.radius(rows.neighbour(e)));
      BondStrength const strength = bond_strength(exact.strength, lane(block.width, l), lane(block.thickness, l), radius);
      BreakMode const mode = strength.test(lane(block.normal, l), lane(block.shear, l), lane(block.moment, l));
      if (mode == BreakMode::none) return;
      rows.formation_overlap.data<R>()[e] = no_bond_of<R>;
      set_lane(broken, l, true);
      int const id = p.id(disc), other = p.id(rows.neighbour(e));
      if (id < other)  // the other side sees it too
        breaks.record(number_of_step(), id, other, mode, p.x(disc) + 0.5 * lane(block.dx, l), p.y(disc) + 0.5 * lane(block.dy, l),
                      [&] { return details_of(block, l, strength, mode); });
    });
    return broken;
  }

  KOKKOS_FORCEINLINE_FUNCTION static BondForce<Real> trial_of(FailureCandidates const& block, int l) {
    return {{lane(block.normal, l), lane(block.shear, l), lane(block.moment, l)},
            {0, 0, 0},
            lane(block.width, l),
            lane(block.thickness, l)};
  }

  /// In full precision the closer test is made in lanes, in mixed precision one by one.
  KOKKOS_FORCEINLINE_FUNCTION VMask doubtful(FailureCandidates const& block) const {
    if constexpr (mixed) return block.where;
    BondForce<V> const trial{{block.normal, block.shear, block.moment}, {0, 0, 0}, block.width, block.thickness};
    return block.where && !is_surely_intact(constants.bond, trial);
  }

  /// @param l  the lane of a bond that broke
  CLATHRA_COLD_FUNCTION BreakDetails details_of(FailureCandidates const& block, int l, BondStrength const& strength,
                                                BreakMode mode) const {
    std::size_t const disc = block.first + static_cast<std::size_t>(l);
    auto const other = static_cast<std::size_t>(rows.neighbour(block.entry + static_cast<std::size_t>(l)));
    ContactForce<Real> const force = trial_of(block, l).force;
    BreakDetails details;
    details.eps1 = 0;  // the host's, from the height of the box
    details.orientation = angle_of_line(p.x(other) - p.x(disc), p.y(other) - p.y(disc));
    details.thickness = lane(block.thickness, l);
    details.width = lane(block.width, l);
    details.utilisation = strength.utilisation(mode, force.normal, force.shear, force.moment);
    ContactStiffness<Real> const stiffness = exact.stiffness(details.width, details.thickness);
    details.energy = spring_energy(force, stiffness);
    details.relative_rotation = force.moment / lane_max(stiffness.rolling, 1e-300);
    return details;
  }

  CLATHRA_COLD_FUNCTION void report_deep(std::size_t first, VMask const& deep) const {
    for (int l = 0; l < lanes; ++l) {
      if (lane(deep, l)) faults.report(Fault::deep_overlap, p.id(first + static_cast<std::size_t>(l)));
    }
  }

  /// Work of slip and plastic rolling of a grain contact in this step, by the mean force over the step: exactly what leapfrog
  /// takes out.
  KOKKOS_FORCEINLINE_FUNCTION void add_grain_losses(Constants const& law, ContactMotion<V> const& motion, GrainTrial const& trial,
                                                    History const& old, ContactForce<V> const& now, Own& own,
                                                    VMask const& where = VMask(true)) const {
    V const zero(0), quarter = constant<V>(0.25);
    if constexpr (shears) {
      V const slid = (Kept::number(trial.shear, law.forces) - now.shear) * V(1 / law.grain.shear_stiffness);
      own.sliding += select(where, quarter * (Kept::number(old.shear, law.forces) + now.shear) * slid, zero);
    }
    if constexpr (Rolling) {
      V const stiffness = lane_max(rolling_stiffness(law.grain, motion.common_radius), V(least_divisor<R>));
      V const turned = (Kept::number(trial.moment, law.moments) - now.moment) / stiffness;
      own.rolling += select(where, quarter * (Kept::number(old.moment, law.moments) + now.moment) * turned, zero);
    }
    if constexpr (Dashpot) {
      own.dashpot += select(where, constant<V>(0.5) * dashpot_loss(law.grain, motion, now.normal, law.dt), zero);
    }
  }

  /// The same for `replace`: unbonded pairs slide and roll; a bond that breaks swaps its energy for that of the grain contact.
  KOKKOS_FORCEINLINE_FUNCTION void add_replace_losses(Constants const& law, ContactMotion<V> const& motion,
                                                      BondForce<V> const& trial, GrainTrial const& grains, VMask const& bonded,
                                                      VMask const& intact, ContactForce<V> const& unbonded, History const& old,
                                                      Own& own) const {
    add_grain_losses(law, motion, grains, old, unbonded, own, !bonded);
    ContactForce<V> elastic{normal_force(law.grain, motion, Undamped()), unbonded.shear, Rolling ? unbonded.moment : V(0)};
    V const after = grain_energy(law.grain, elastic, grain_stiffness(law.grain, motion.overlap, motion.common_radius));
    own.breakage += select(bonded && !intact, constant<V>(0.5) * (spring_energy(trial.force, trial.stiffness) - after), V(0));
  }
};

}  // namespace clathra
