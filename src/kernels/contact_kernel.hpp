#pragma once
/// The contact kernel, specialised by precision, bond kind, friction, rolling, dashpot and ledger; instantiated in
/// forces_full.cpp and forces_mixed.cpp only.
#include <type_traits>

#include "kernels/bond_failures.hpp"
#include "kernels/contact_constants.hpp"
#include "kernels/disc_reader.hpp"

namespace clathra {

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
  using Failures = BondFailures<P>;
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
  bool caps_limits;         ///< whether limits may be larger than a history
  std::size_t discs_ahead;  ///< that are fetched before a neighbour needs them, discs_ahead()

  /// State of the group's own discs and what has been summed for them.
  struct Own {
    typename Discs::Own disc;
    V force_x, force_y, torque;
    V moment, most_overlap;  ///< mixed precision: the sum of moments, and the largest overlap of each disc
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
    if constexpr (mixed) {
      own.torque = times_plus(own.moment, V(law.moment_unit), own.torque);
      // Where a disc's centre lies inside another one. That one looks, too.
      if (auto const deep = own.most_overlap > own.disc.radius; any(deep)) report_deep(first, deep);
    }
    store(p.force_x.data<R>() + first, in_si(law, own.force_x));
    store(p.force_y.data<R>() + first, in_si(law, own.force_y));
    store(p.torque.data<R>() + first, in_si(law, own.torque));
    if constexpr (Ledger) {
      if constexpr (shears) Discs::book(losses.sliding, first, in_si(law, own.sliding));
      if constexpr (Rolling) Discs::book(losses.rolling, first, in_si(law, own.rolling));
      if constexpr (Dashpot) Discs::book(losses.dashpot, first, in_si(law, own.dashpot));
      if constexpr (bonded_code) Discs::book(losses.breakage, first, in_si(law, own.breakage));
    }
  }

  /// Entry block `e .. e + lanes`: the k-th neighbour of each disc of the group.
  /// @param active  false if none of them holds a history;  @return whether one does afterwards
  KOKKOS_FORCEINLINE_FUNCTION bool add_block(Constants const& law, std::size_t first, std::size_t e, bool active,
                                             Own& own) const {
    int const* const j = &rows.neighbour(e);
    typename Discs::Own const& disc = own.disc;
    typename Discs::OtherMotion moving;
    typename Discs::Other const other = Discs::other(p, j, disc, active, moving);
    V const &dx = other.dx, &dy = other.dy, &other_radius = other.radius;
    V const reach = disc.radius + other_radius, distance2 = Discs::squared(dx, dy),
            reach_of_branch = Discs::as_branch(reach, law.per_tick);
    auto const touching = distance2 < reach_of_branch * reach_of_branch;
    if (!active && !any(touching)) return false;
    History h = read(e);

    V const distance = Discs::distance_of(distance2), inverse = V(1) / distance;
    V const nx = dx * inverse, ny = dy * inverse;
    Discs::complete(p, j, active, moving);
    V const dvx = moving.vx - disc.vx, dvy = moving.vy - disc.vy, &other_omega = moving.omega;
    ContactMotion<V> motion;
    motion.overlap = Discs::overlap_at(distance, reach, law.tick);
    motion.closing_velocity = -(dvx * nx + dvy * ny);
    V const half = constant<V>(0.5), arm = minus_times(half, motion.overlap, disc.radius),
            other_arm = minus_times(half, motion.overlap, other_radius);  // arm + other_arm = distance
    // Both sides of a pair get the same bits: a fused product must not be that of one side.
    motion.shear_increment = during_step(law, minus_times(dvx, ny, dvy * nx) - (disc.omega * arm + other_omega * other_arm));
    motion.relative_rotation = during_step(law, other_omega - disc.omega);
    if constexpr (mixed) {
      motion.common_radius = V(2) * disc.radius * other_radius / reach;  // common_radius() of radii that are not zero
      own.most_overlap = lane_max(motion.overlap, own.most_overlap);
    } else {
      motion.common_radius = common_radius(disc.radius, other_radius);
      auto const deep = distance < lane_max(disc.radius, other_radius);
      if (any(deep)) report_deep(first, deep);
    }

    Viscosity dashpot;
    if constexpr (Dashpot) dashpot = dashpot_coefficient(law.grain, disc.inverse_mass, moving.inverse_mass);
    ContactForce<V> force = grain_force(law, motion, dashpot, h, own);
    auto carrying = touching;
    if constexpr (bonded_code) {
      auto const bonded = is_bonded(h.formation_overlap);
      BondTrial const trial = bond_trial(law, motion, h, bonded);
      auto intact = bonded;
      auto const doubt = bonded && !is_far_from_breaking(law.least, trial.bond);
      if (any(doubt)) {
        ContactForce<V> const& f = trial.bond.force;
        intact = bonded && !Failures{p, rows, constants, exact, breaks, number_of_step()}.break_bonds(
                               {first, e, doubt, trial.bond.width, trial.bond.thickness, f.normal, f.shear, f.moment, dx, dy});
      }
      force = with_bond(law, force, motion, dashpot, trial, bonded, intact, h, own);
      carrying = touching || intact;
    }
    write(e, h);
    // Entries out of touch and without a bond got exact zeros from the laws; nothing needs masking here.
    add_force(force, nx, ny, arm, own);
    return any(carrying);
  }

 private:
  /// A force, torque or energy in SI units.
  KOKKOS_FORCEINLINE_FUNCTION static V in_si(Constants const& law, V const& of_unit) {
    if constexpr (mixed)
      return of_unit * law.force_unit;
    else
      return of_unit;
  }
  KOKKOS_FORCEINLINE_FUNCTION std::int64_t number_of_step() const { return steps.extent(0) > 0 ? steps(0).step + 1 : step; }

  KOKKOS_FORCEINLINE_FUNCTION static void add_force(ContactForce<V> const& force, V const& nx, V const& ny, V const& arm,
                                                    Own& own) {
    constexpr bool sheared = shears || bonded_code;
    if constexpr (mixed) {
      own.force_x = minus_times(force.normal, nx, own.force_x);
      own.force_y = minus_times(force.normal, ny, own.force_y);
      if constexpr (sheared) {
        own.force_x = minus_times(force.shear, ny, own.force_x);
        own.force_y = times_plus(force.shear, nx, own.force_y);
        own.torque = times_plus(arm, force.shear, own.torque);
      }
      own.moment += force.moment;
    } else if constexpr (sheared) {
      own.force_x -= force.normal * nx + force.shear * ny;
      own.force_y += force.shear * nx - force.normal * ny;
      own.torque += arm * force.shear + force.moment;
    } else {
      own.force_x -= force.normal * nx;
      own.force_y -= force.normal * ny;
      own.torque += force.moment;
    }
  }

  /// A motion as the history takes it: in mixed precision the rate itself (HistoryScale::per_rate).
  KOKKOS_FORCEINLINE_FUNCTION static V during_step(Constants const& law, V const& rate) {
    if constexpr (mixed)
      return rate;
    else
      return rate * law.dt;
  }

  KOKKOS_FORCEINLINE_FUNCTION Own load_own(std::size_t first) const {
    Own own;  // each number of which is set here: as a whole it would be set to zero by a function
    own.disc = Discs::own(p, first);
    own.most_overlap = constant<V>(-1e30);
    own.force_x = own.force_y = own.torque = own.moment = own.sliding = own.rolling = own.dashpot = own.breakage = V(0);
    return own;
  }

  using Viscosity = std::conditional_t<Dashpot, V, Undamped>;

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

  /// k_m of a grain contact, as its history takes it.
  KOKKOS_FORCEINLINE_FUNCTION static V rolling_of_step(Constants const& law, ContactMotion<V> const& motion) {
    return law.rolling_of_step * motion.common_radius * motion.common_radius;
  }
  /// Shear force and moment of a grain contact before the limits.
  struct GrainTrial {
    Stored shear, moment;
  };
  KOKKOS_FORCEINLINE_FUNCTION static GrainTrial grain_trial(Constants const& law, ContactMotion<V> const& motion,
                                                            History const& h) {
    GrainTrial trial{Kept::none(), Kept::none()};
    if constexpr (shears) trial.shear = Kept::advanced(h.shear, law.shear_of_step, motion.shear_increment, law.forces);
    if constexpr (Rolling)
      trial.moment = Kept::advanced(h.moment, rolling_of_step(law, motion), motion.relative_rotation, law.moments);
    return trial;
  }

  /// Eq. 8: puts a trial within its limits. @return the forces that it then is
  /// @param free  the mask of lanes without limits, where there are such
  template <class... Free>
  KOKKOS_FORCEINLINE_FUNCTION ContactForce<V> limit(Constants const& law, ContactMotion<V> const& motion,
                                                    Viscosity const& dashpot, GrainTrial& trial, Free const&... free) const {
    ContactForce<V> force;
    force.normal = normal_force(law.grain, motion, dashpot);
    force.shear = force.moment = V(0);
    if constexpr (shears) {
      trial.shear = Kept::limited(trial.shear, as_kept(shear_limit(law.grain, force.normal)), free...);
      force.shear = Kept::number(trial.shear);
    }
    if constexpr (Rolling) {
      trial.moment = Kept::limited(trial.moment, as_kept(law.limit_of_moment * motion.common_radius * force.normal), free...);
      force.moment = Kept::number(trial.moment);
    }
    return force;
  }

  /// A limit that a history can hold.
  KOKKOS_FORCEINLINE_FUNCTION V as_kept(V const& limit) const {
    if (mixed && caps_limits) return lane_min(limit, constant<V>(most_units));
    return limit;
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

  /// With `replace` an entry that is not bonded gets the trial of its grain contact.
  KOKKOS_FORCEINLINE_FUNCTION static BondTrial bond_trial(Constants const& law, ContactMotion<V> const& motion, History const& h,
                                                          VMask const& bonded) {
    constexpr bool parallel = Bond == BondKind::parallel;
    BondTrial trial{bond_springs(law.bond, motion, h.formation_overlap, h.width), Kept::none(), Kept::none()};
    ContactForce<V>& force = trial.bond.force;
    ContactStiffness<V> const& k = trial.bond.stiffness;
    V shear = Kept::of_step(k.shear, law.forces), rolling = Kept::of_step(k.rolling, law.moments);
    if constexpr (!parallel) shear = select(bonded, shear, V(law.shear_of_step));
    if constexpr (!parallel && Rolling) rolling = select(bonded, rolling, rolling_of_step(law, motion));
    trial.shear = Kept::advanced(parallel ? h.bond_shear : h.shear, shear, motion.shear_increment, law.forces);
    trial.moment = Kept::advanced(parallel ? h.bond_moment : h.moment, rolling, motion.relative_rotation, law.moments);
    force.shear = Kept::number(trial.shear);
    force.moment = Kept::number(trial.moment);
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
        own.breakage +=
            select(bonded && !intact, constant<V>(0.5) * spring_energy(in_one_unit(law, bond.force), bond.stiffness), zero);
      h.bond_shear = Kept::choose(intact, trial.shear, Kept::none());
      h.bond_moment = Kept::choose(intact, trial.moment, Kept::none());
      return {grain_part.normal + select(intact, bond.force.normal, zero),
              grain_part.shear + select(intact, bond.force.shear, zero),
              grain_part.moment + select(intact, bond.force.moment, zero)};
    } else {
      GrainTrial const before{trial.shear, trial.moment};
      GrainTrial kept = before;
      ContactForce<V> force = limit(law, motion, dashpot, kept, intact);
      if constexpr (!Rolling) {
        kept.moment = Kept::choose(intact, trial.moment, Kept::none());
        force.moment = Kept::number(kept.moment);
      }
      if constexpr (Ledger) add_replace_losses(law, motion, bond, before, bonded, intact, force, h, own);
      h.shear = kept.shear;
      h.moment = kept.moment;
      force.normal = select(intact, bond.force.normal, force.normal);
      return force;
    }
  }

  /// Forces with the moment in the unit of force times metres, for energies.
  KOKKOS_FORCEINLINE_FUNCTION static ContactForce<V> in_one_unit(Constants const& law, ContactForce<V> force) {
    force.moment = in_metres(law, force.moment);
    return force;
  }
  /// A moment in the unit of force times metres.
  KOKKOS_FORCEINLINE_FUNCTION static V in_metres(Constants const& law, V const& moment) {
    if constexpr (mixed)
      return moment * law.moment_unit;
    else
      return moment;
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
      V const slid = (Kept::number(trial.shear) - now.shear) * V(1 / law.grain.shear_stiffness);
      own.sliding += select(where, quarter * (Kept::number(old.shear) + now.shear) * slid, zero);
    }
    if constexpr (Rolling) {
      V const stiffness = lane_max(rolling_stiffness(law.grain, motion.common_radius), V(least_divisor<R>));
      V const turned = in_metres(law, Kept::number(trial.moment) - now.moment) / stiffness;
      own.rolling += select(where, quarter * (in_metres(law, Kept::number(old.moment) + now.moment)) * turned, zero);
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
    ContactForce<V> const elastic{normal_force(law.grain, motion, Undamped()), unbonded.shear, Rolling ? unbonded.moment : V(0)};
    V const before = spring_energy(in_one_unit(law, trial.force), trial.stiffness),
            after = grain_energy(law.grain, in_one_unit(law, elastic),
                                 grain_stiffness(law.grain, motion.overlap, motion.common_radius));
    own.breakage += select(bonded && !intact, constant<V>(0.5) * (before - after), V(0));
  }
};

}  // namespace clathra
