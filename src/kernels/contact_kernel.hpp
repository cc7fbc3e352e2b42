#pragma once
/// The contact kernel, specialised by precision, bond kind, friction, rolling and losses; instantiated in
/// forces_full.cpp and forces_mixed.cpp only.
#include <type_traits>

#include "kernels/bond_failures.hpp"
#include "kernels/path_sum_history.hpp"
#include "kernels/reference_history.hpp"

namespace clathra {

/// One group of discs per call, as many as a vector holds: walks their rows side by side.
/// @tparam Variant  KernelVariant
template <class Variant>
struct ContactKernel {
  using R = typename Variant::R;
  using V = typename Variant::V;
  using VMask = typename Variant::VMask;
  using Constants = typename Variant::Constants;
  using Discs = typename Variant::Discs;
  using History = typename Variant::History;
  using Force = typename Variant::Force;
  using Forces = typename Variant::Forces;
  using StepIncrement = typename Variant::StepIncrement;
  static constexpr BondKind Bond = Variant::Bond;
  static constexpr bool mixed = Variant::mixed, bonded_code = Variant::bonded_code, shears = Variant::shears,
                        moments = Variant::moments, separate = Variant::separate, Rolling = Variant::Rolling,
                        Losses = Variant::Losses;
  using Kept = std::conditional_t<mixed, ReferenceHistory<Variant>, PathSumHistory<Variant>>;
  using Failures = BondFailures<typename Variant::Numbers>;
  static constexpr int lanes = lane_count_of<R>, slice_width = slice_width_of<R>;

  ParticleSoA p;
  ContactRows rows;
  Constants constants;
  BondLaw exact;      ///< for the strength test that decides, in double precision
  std::int64_t step;  ///< its number, where there are no `steps`
  Field<StepState> steps;
  BreakLog breaks;
  Dissipation losses;
  Faults faults;
  std::size_t discs_ahead;  ///< that are fetched before a neighbour needs them, discs_ahead()

  /// State of the group's own discs and what has been summed for them.
  struct Own {
    typename Discs::Own disc;
    V force_x, force_y, torque;
    V most_overlap;    ///< mixed precision: of each disc
    bool rotated_far;  ///< ReferenceHistory: whether any of them has
    V sliding, rolling, dashpot, breakage;
  };

  KOKKOS_FUNCTION void operator()(int group) const {
    if (is_stopped(steps)) return;
    auto const first = static_cast<std::size_t>(group) * lanes;
    int const slice = group / (slice_width / lanes);
    Constants const law = constants;
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
    if constexpr (mixed) {  // where a disc's centre lies inside another one; that one looks, too
      if (auto const deep = own.most_overlap > own.disc.radius; any(deep)) report_deep(first, deep);
    }
    store(p.force_x.data<R>() + first, own.force_x);
    store(p.force_y.data<R>() + first, own.force_y);
    store(p.torque.data<R>() + first, own.torque);
    if constexpr (Losses) {
      if (!law.ledger) return;
      if constexpr (shears) Discs::add_dissipation(losses.sliding, first, own.sliding);
      if constexpr (Rolling) Discs::add_dissipation(losses.rolling, first, own.rolling);
      if (law.grain.damping_ratio > 0) Discs::add_dissipation(losses.dashpot, first, own.dashpot);
      if constexpr (bonded_code) Discs::add_dissipation(losses.breakage, first, own.breakage);
    }
  }

  /// Entry block `e .. e + lanes`: the k-th neighbour of each disc of the group. Which lanes do what, by masks:
  ///
  ///     touching                                by the distance; decides over the grain contact alone
  ///     none                                    had no history of the grain contact (of the bond in its place) before the step
  ///     bonded                                  had an intact bond before the step
  ///     begins   = none && touching             starts with the slip of this step
  ///     broken   = bonded && beyond its strength;  intact = bonded && !broken
  ///     carrying = touching || intact           has a history after the step; all others' forces are exact zeros
  ///     changes  = broken || none == carrying   its history begins or ends or gets another stiffness: a new reference
  ///                (separate bonds: none == touching, of the grain contact)
  ///     far      = carrying && rotated too far since its reference: the same
  ///
  /// In double precision a history that has ended is zero instead of none, and begins, changes and far are false.
  /// @param active  false if none of them holds a history;  @return whether one does afterwards
  KOKKOS_FORCEINLINE_FUNCTION bool add_block(Constants const& law, std::size_t first, std::size_t e, bool active,
                                             Own& own) const {
    int const* const j = History::neighbours(rows, e);
    typename Discs::Own const& disc = own.disc;
    typename Discs::Other const other = Discs::other(p, j, disc);
    V const &dx = other.dx, &dy = other.dy, &other_radius = other.radius;
    V const reach = disc.radius + other_radius, distance2 = Discs::squared(dx, dy),
            reach2 = Discs::squared_reach(reach, law.per_tick);
    auto const touching = distance2 < reach2;
    if (!active && !any(touching)) return false;
    History::fetch_ahead(rows, e);
    History h = History::read(rows, e);
    auto const none = Kept::is_none(h), begins = none && touching;

    V const distance = Discs::distance_of(distance2);
    Inverses<V> const inverse = inverses<mixed, moments>(distance, distance2, reach);
    V const nx = dx * inverse.of_distance, ny = dy * inverse.of_distance;
    typename Discs::MotionOf moving;
    if constexpr (Discs::moves) moving = Discs::other_motion(p, j);
    V const overlap = Discs::overlap_at(distance, reach, law.tick), half = constant<V>(0.5);
    V const arm = negative_multiply_add(half, overlap, disc.radius),
            other_arm = negative_multiply_add(half, overlap, other_radius);  // arm + other_arm = distance
    StepIncrement in_step{V(0), V(0)};
    V closing_velocity(0);
    if constexpr (Discs::moves) {
      closing_velocity = -((moving.vx - disc.motion.vx) * nx + (moving.vy - disc.motion.vy) * ny);
      in_step = increment_of_step(law.dt, disc.motion, moving, nx, ny, arm, other_arm);
    }
    typename Variant::Pairs at;  // number by number, as in load_own()
    at.dx = dx, at.dy = dy, at.distance = distance, at.reach = reach, at.nx = nx, at.ny = ny;
    at.arm = arm, at.other_arm = other_arm, at.inverse_distance2 = inverse.of_distance2, at.inverse_reach = inverse.of_reach;
    typename Kept::Motion moved;
    moved.of_pair.overlap = overlap, moved.of_pair.closing_velocity = closing_velocity;
    Kept::measure(rows, e, law, disc, other, at, in_step, none, h, moved);
    if constexpr (mixed) {
      own.most_overlap = lane_max(overlap, own.most_overlap);
    } else {
      auto const deep = distance < lane_max(disc.radius, other_radius);
      if (any(deep)) report_deep(first, deep);
    }
    ContactMotion<V> const& motion = moved.of_pair;

    Viscosity dashpot;
    if constexpr (Losses) dashpot = viscosity(law, disc.motion.inverse_mass, moving.inverse_mass);
    Forces now;
    ContactMotion<V> const& of_grains = Kept::of_grains(p, law, first, j, at, moved, begins, h);
    ContactForce<V> force = grain_force(law, of_grains, dashpot, h, none && !begins, now);
    if constexpr (Losses && Bond != BondKind::replace) {
      if (law.ledger) add_grain_losses(law, motion, now, Kept::before(h, now, in_step), force, own);
    }
    [[maybe_unused]] auto intact = VMask(false), broken = VMask(false);
    if constexpr (bonded_code) {
      auto const bonded = is_bonded(h.formation_overlap);
      BondForce<V> const trial = bond_trial(law, separate ? motion : of_grains, h, none && !begins, bonded, now);
      intact = bonded;
      auto const doubt = bonded && !is_far_from_breaking(law.least, trial);
      if (any(doubt)) {
        ContactForce<V> const& f = trial.force;
        intact = bonded && !Failures{p, rows, constants, exact, breaks, number_of_step()}.break_bonds(
                               {first, e, doubt, trial.width, trial.thickness, f.normal, f.shear, f.moment, dx, dy});
        broken = bonded && !intact;
      }
      force = with_bond(law, force, motion, dashpot, trial, bonded, intact, broken, in_step, h, now, own);
    }
    auto carrying = touching;
    if constexpr (bonded_code) carrying = touching || intact;
    Kept::write(rows, e, h, now);
    typename Variant::Outcome masks;
    masks.none = none, masks.touching = touching, masks.intact = intact, masks.broken = broken, masks.carrying = carrying;
    Kept::end_step(rows, e, law, own.rotated_far, disc, other, at, moved, masks, now);
    // Entries out of touch and without a bond got exact zeros from the laws; nothing needs masking here.
    add_force(force, nx, ny, arm, own);
    return any(carrying);
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION std::int64_t number_of_step() const { return steps.extent(0) > 0 ? steps(0).step + 1 : step; }

  KOKKOS_FORCEINLINE_FUNCTION static void add_force(ContactForce<V> const& force, V const& nx, V const& ny, V const& arm,
                                                    Own& own) {
    constexpr bool sheared = shears || bonded_code;
    if constexpr (mixed) {
      own.force_x = negative_multiply_add(force.normal, nx, own.force_x);
      own.force_y = negative_multiply_add(force.normal, ny, own.force_y);
      if constexpr (sheared) {
        own.force_x = negative_multiply_add(force.shear, ny, own.force_x);
        own.force_y = multiply_add(force.shear, nx, own.force_y);
        own.torque = multiply_add(arm, force.shear, own.torque);
      }
      own.torque += force.moment;
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

  KOKKOS_FORCEINLINE_FUNCTION Own load_own(std::size_t first) const {
    Own own;  // each number of which is set here: as a whole it would be set to zero by a function
    own.disc = Discs::own(p, first);
    own.most_overlap = constant<V>(-1e30);
    own.rotated_far = Kept::rotated_far(own.disc);
    own.force_x = own.force_y = own.torque = own.sliding = own.rolling = own.dashpot = own.breakage = V(0);
    return own;
  }

  using Viscosity = std::conditional_t<Losses, V, Undamped>;
  KOKKOS_FORCEINLINE_FUNCTION static V viscosity(Constants const& law, V const& inverse_mass, V const& other_inverse_mass) {
    return law.grain.damping_ratio > 0 ? dashpot_coefficient(law.grain, inverse_mass, other_inverse_mass) : V(0);
  }

  /// Eq. 8: the forces of unbonded pairs, their trials put within their limits.
  /// @param free  the mask of lanes without limits, where there are such
  template <class... Free>
  KOKKOS_FORCEINLINE_FUNCTION static ContactForce<V> limit(Constants const& law, ContactMotion<V> const& motion,
                                                           Viscosity const& dashpot, Forces& now, Free const&... free) {
    ContactForce<V> force;
    force.normal = normal_force(law.grain, motion, dashpot);
    force.shear = force.moment = V(0);
    auto const limited = [&](V const& trial, V const& most) {
      if constexpr (sizeof...(Free) > 0)
        return select((free, ...), trial, clamp_to(trial, most));
      else
        return clamp_to(trial, most);
    };
    if constexpr (shears) force.shear = now.shear.now = limited(now.shear.trial, shear_limit(law.grain, force.normal));
    if constexpr (Rolling)
      force.moment = now.moment.now = limited(now.moment.trial, moment_limit(law.grain, motion.common_radius, force.normal));
    return force;
  }

  /// The unbonded law on every entry; with `replace` with_bond() does it.
  KOKKOS_FORCEINLINE_FUNCTION static ContactForce<V> grain_force(Constants const& law, ContactMotion<V> const& motion,
                                                                 Viscosity const& dashpot, History const& h, VMask const& none,
                                                                 Forces& now) {
    if constexpr (Bond == BondKind::replace) return {};
    if constexpr (shears) {
      now.shear.stiffness = V(law.grain.shear_stiffness);
      now.shear.trial = Kept::trial(h.shear, law.grain.shear_stiffness, motion.shear_increment, none);
    }
    if constexpr (Rolling) {
      now.moment.stiffness = rolling_stiffness(law.grain, motion.common_radius);
      now.moment.trial = Kept::trial(h.moment, now.moment.stiffness, motion.relative_rotation, none);
    }
    return limit(law, motion, dashpot, now);
  }

  /// Bonds as they would be if none broke. With `replace` an entry that is not bonded gets the trial of its grain contact.
  KOKKOS_FORCEINLINE_FUNCTION static BondForce<V> bond_trial(Constants const& law, ContactMotion<V> const& motion,
                                                             History const& h, [[maybe_unused]] VMask const& none,
                                                             VMask const& bonded, Forces& now) {
    constexpr bool parallel = Bond == BondKind::parallel;
    BondForce<V> bond = bond_springs(law.bond, motion, h.formation_overlap, h.width);
    Force& shear = parallel ? now.bond_shear : now.shear;
    Force& moment = parallel ? now.bond_moment : now.moment;
    shear.stiffness = bond.stiffness.shear, moment.stiffness = bond.stiffness.rolling;
    if constexpr (!parallel) shear.stiffness = select(bonded, shear.stiffness, V(law.grain.shear_stiffness));
    if constexpr (!parallel && Rolling)
      moment.stiffness = select(bonded, moment.stiffness, rolling_stiffness(law.grain, motion.common_radius));
    bond.force.shear = shear.trial = parallel ? Kept::trial(h.bond_shear, shear.stiffness, motion.shear_increment)
                                              : Kept::trial(h.shear, shear.stiffness, motion.shear_increment, none);
    bond.force.moment = moment.trial = parallel ? Kept::trial(h.bond_moment, moment.stiffness, motion.relative_rotation)
                                                : Kept::trial(h.moment, moment.stiffness, motion.relative_rotation, none);
    return bond;
  }

  /// Adds the bond (`parallel`) or puts it in the grain contact's place (`replace`). The pair of a bond that broke follows the
  /// unbonded law from this very step on.
  KOKKOS_FORCEINLINE_FUNCTION ContactForce<V> with_bond(Constants const& law, ContactForce<V> const& grain_part,
                                                        ContactMotion<V> const& motion, Viscosity const& dashpot,
                                                        BondForce<V> const& bond, VMask const& bonded, VMask const& intact,
                                                        VMask const& broken, StepIncrement const& in_step, History const& h,
                                                        Forces& now, Own& own) const {
    V const zero(0);
    if constexpr (Bond == BondKind::parallel) {
      if constexpr (Losses) own.breakage += select(broken, constant<V>(0.5) * spring_energy(bond.force, bond.stiffness), zero);
      now.bond_shear.now = select(intact, bond.force.shear, zero);
      now.bond_moment.now = select(intact, bond.force.moment, zero);
      return {grain_part.normal + select(intact, bond.force.normal, zero), grain_part.shear + now.bond_shear.now,
              grain_part.moment + now.bond_moment.now};
    } else {
      ContactForce<V> force = limit(law, motion, dashpot, now, intact);
      if constexpr (!Rolling) force.moment = now.moment.now = select(intact, now.moment.trial, zero);
      if constexpr (Losses) {
        if (law.ledger) add_replace_losses(law, motion, bond, now, bonded, broken, Kept::before(h, now, in_step), force, own);
      }
      force.normal = select(intact, bond.force.normal, force.normal);
      return force;
    }
  }

  CLATHRA_COLD_FUNCTION void report_deep(std::size_t first, VMask const& deep) const {
    for (int l = 0; l < lanes; ++l) {
      if (lane(deep, l)) faults.report(Fault::deep_overlap, p.id(first + static_cast<std::size_t>(l)));
    }
  }

  /// Work of slip and plastic rolling of a grain contact in this step, by the mean force over the step: exactly what leapfrog
  /// takes out.
  KOKKOS_FORCEINLINE_FUNCTION void add_grain_losses(Constants const& law, ContactMotion<V> const& motion, Forces const& grains,
                                                    ContactForce<V> const& old, ContactForce<V> const& now, Own& own,
                                                    VMask const& where = VMask(true)) const {
    V const zero(0), quarter = constant<V>(0.25);
    if constexpr (shears) {
      V const slid = (grains.shear.trial - now.shear) * V(1 / law.grain.shear_stiffness);
      own.sliding += select(where, quarter * (old.shear + now.shear) * slid, zero);
    }
    if constexpr (Rolling) {
      V const stiffness = lane_max(rolling_stiffness(law.grain, motion.common_radius), V(least_divisor<R>));
      V const turned = (grains.moment.trial - now.moment) / stiffness;
      own.rolling += select(where, quarter * (old.moment + now.moment) * turned, zero);
    }
    if (law.grain.damping_ratio > 0)
      own.dashpot += select(where, constant<V>(0.5) * dashpot_loss(law.grain, motion, now.normal, law.dt), zero);
  }

  /// The same for `replace`: unbonded pairs slide and roll; a bond that breaks swaps its energy for that of the grain contact.
  KOKKOS_FORCEINLINE_FUNCTION void add_replace_losses(Constants const& law, ContactMotion<V> const& motion,
                                                      BondForce<V> const& trial, Forces const& grains, VMask const& bonded,
                                                      VMask const& broken, ContactForce<V> const& old,
                                                      ContactForce<V> const& unbonded, Own& own) const {
    add_grain_losses(law, motion, grains, old, unbonded, own, !bonded);
    ContactForce<V> const elastic{normal_force(law.grain, motion, Undamped()), unbonded.shear, Rolling ? unbonded.moment : V(0)};
    V const before_it = spring_energy(trial.force, trial.stiffness),
            after = grain_energy(law.grain, elastic, grain_stiffness(law.grain, motion.overlap, motion.common_radius));
    own.breakage += select(broken, constant<V>(0.5) * (before_it - after), V(0));
  }
};

}  // namespace clathra
