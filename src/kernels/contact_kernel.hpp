#pragma once
/// The contact kernel, specialised by bond kind, friction, rolling, dashpot and ledger; instantiated in forces.cpp only.
#include <type_traits>

#include "kernels/bond_quick_test.hpp"
#include "kernels/forces.hpp"

namespace clathra {

/// One group of `lane_count` discs per call: walks their rows side by side.
/// @tparam Friction  false where grain contacts carry no shear
template <BondKind Bond, bool Friction, bool Rolling, bool Dashpot, bool Ledger>
struct ContactKernel {
  static constexpr bool bonded_code = Bond != BondKind::none;
  static constexpr bool shears = Friction || Bond == BondKind::replace;  // has a history of `shear`
  static constexpr bool moments = Rolling || bonded_code;

  /// Numbers of the laws. The kernel works on a copy on its stack, which no store can change, so that what follows from them is
  /// computed once a group.
  struct Constants {
    GrainLaw grain;
    BondLaw bond;
    LeastStrength least;
    Real dt;
  };

  ParticleSoA p;
  ContactRows rows;
  Constants constants;
  std::int64_t step;
  BreakLog breaks;
  EnergyLosses losses;
  Faults faults;

  /// State of the group's own discs and what has been summed for them.
  struct Own {
    Lanes x, y, vx, vy, omega, radius, inverse_mass;
    Lanes force_x, force_y, torque;
    Lanes sliding, rolling, dashpot, breakage;
  };

  /// History of one block of entries.
  struct History {
    Lanes shear, moment, formation_overlap, width, bond_shear, bond_moment;
  };

  KOKKOS_FUNCTION void operator()(int group) const {
    auto const first = static_cast<std::size_t>(group) * lane_count;
    int const slice = group / (slice_width / lane_count);
    Constants const law = constants;
    Own own{load(&p.x(first)),
            load(&p.y(first)),
            load(&p.vx(first)),
            load(&p.vy(first)),
            load(&p.omega(first)),
            load(&p.radius(first)),
            Dashpot ? load(&p.inverse_mass(first)) : Lanes(0),
            0,
            0,
            0,
            0,
            0,
            0,
            0};
    fetch_ahead(first);
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
    store(&p.force_x(first), own.force_x);
    store(&p.force_y(first), own.force_y);
    store(&p.torque(first), own.torque);
    if constexpr (Ledger) {
      auto const book = [first](Field<Accum> const& account, Lanes const& loss) {
        store(&account(first), load(&account(first)) + loss);
      };
      if constexpr (shears) book(losses.sliding, own.sliding);
      if constexpr (Rolling) book(losses.rolling, own.rolling);
      if constexpr (Dashpot) book(losses.dashpot, own.dashpot);
      if constexpr (bonded_code) book(losses.breakage, own.breakage);
    }
  }

  /// Entry block `e .. e + lane_count`: the k-th neighbour of each disc of the group.
  /// @param active  false if none of them holds a history;  @return whether one does afterwards
  KOKKOS_FORCEINLINE_FUNCTION bool add_block(Constants const& law, std::size_t first, std::size_t e, bool active,
                                             Own& own) const {
    int const* const j = &rows.neighbour(e);
    Lanes const dx = gather(p.x.data(), j) - own.x, dy = gather(p.y.data(), j) - own.y;
    Lanes const other_radius = gather(p.radius.data(), j);
    Lanes const reach = own.radius + other_radius, distance2 = dx * dx + dy * dy;
    auto const touching = distance2 < reach * reach;
    if (!active && !any(touching)) return false;
    History h = read(e);

    Lanes const distance = lane_max(lane_sqrt(distance2), Lanes(1e-30)), inverse = Lanes(1) / distance;
    Lanes const nx = dx * inverse, ny = dy * inverse;
    Lanes const dvx = gather(p.vx.data(), j) - own.vx, dvy = gather(p.vy.data(), j) - own.vy;
    Lanes const other_omega = gather(p.omega.data(), j);
    ContactMotion<Lanes> motion;
    motion.overlap = reach - distance;
    motion.closing_velocity = -(dvx * nx + dvy * ny);
    Lanes const half_overlap = Lanes(0.5) * motion.overlap;
    Lanes const arm = own.radius - half_overlap, other_arm = other_radius - half_overlap;  // arm + other_arm = distance
    motion.shear_increment = ((dvy * nx - dvx * ny) - (own.omega * arm + other_omega * other_arm)) * law.dt;
    motion.relative_rotation = (other_omega - own.omega) * law.dt;
    motion.common_radius = common_radius(own.radius, other_radius);
    auto const deep = distance < lane_max(own.radius, other_radius);  // one disc's centre lies inside the other
    if (any(deep)) report_deep(first, deep);

    Viscosity dashpot;
    if constexpr (Dashpot) dashpot = dashpot_coefficient(law.grain, own.inverse_mass, gather(p.inverse_mass.data(), j));
    ContactForce<Lanes> force = grain_force(law, motion, dashpot, h, own);
    auto carrying = touching;
    if constexpr (bonded_code) {
      auto const bonded = is_bonded(h.formation_overlap);
      BondForce<Lanes> const trial = bond_trial(law, motion, h);
      auto intact = bonded;
      auto const doubt = bonded && !is_far_from_breaking(law.least, trial);
      if (any(doubt)) {
        intact = bonded && !break_bonds({first, e, doubt, trial.width, trial.thickness, trial.force.normal, trial.force.shear,
                                         trial.force.moment, own.x + Lanes(0.5) * dx, own.y + Lanes(0.5) * dy});
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
  /// Neighbours lie scattered, and a load that waits for the outer caches holds up everything behind it. So the discs some groups
  /// ahead are fetched in their order, before a neighbour needs them.
  KOKKOS_FORCEINLINE_FUNCTION void fetch_ahead(std::size_t first) const {
    constexpr std::size_t groups_ahead = 64;
    std::size_t const wanted = first + groups_ahead * lane_count, last = p.x.extent(0) - 1;
    std::size_t const i = wanted < last ? wanted : last;
    prefetch(&p.x(i));
    prefetch(&p.y(i));
    prefetch(&p.radius(i));
    prefetch(&p.vx(i));
    prefetch(&p.vy(i));
    prefetch(&p.omega(i));
  }

  using Viscosity = std::conditional_t<Dashpot, Lanes, Undamped>;

  /// A block with bonds that may break. It is put together where one is met: a block whose values had an address would spend its
  /// time storing and loading them.
  struct FailureCandidates {
    std::size_t first, entry;
    Mask where;
    Lanes width, thickness, normal, shear, moment;
    Lanes x, y;  ///< midpoints of the branches
  };

  KOKKOS_FORCEINLINE_FUNCTION History read(std::size_t e) const {
    History h{0, 0, no_bond, 0, 0, 0};
    if constexpr (shears) h.shear = load(&rows.shear(e));
    if constexpr (moments) h.moment = load(&rows.moment(e));
    if constexpr (bonded_code) {
      h.formation_overlap = load(&rows.formation_overlap(e));
      h.width = load(&rows.width(e));
    }
    if constexpr (Bond == BondKind::parallel) {
      h.bond_shear = load(&rows.bond_shear(e));
      h.bond_moment = load(&rows.bond_moment(e));
    }
    return h;
  }

  KOKKOS_FORCEINLINE_FUNCTION void write(std::size_t e, History const& h) const {
    if constexpr (shears) store(&rows.shear(e), h.shear);
    if constexpr (moments) store(&rows.moment(e), h.moment);
    if constexpr (Bond == BondKind::parallel) {
      store(&rows.bond_shear(e), h.bond_shear);
      store(&rows.bond_moment(e), h.bond_moment);
    }
  }

  /// The unbonded law on every entry; with `replace` the entries that are bonded are overruled by with_bond().
  KOKKOS_FORCEINLINE_FUNCTION ContactForce<Lanes> grain_force(Constants const& law, ContactMotion<Lanes> const& motion,
                                                              Viscosity const& dashpot, History& h, Own& own) const {
    if constexpr (Bond == BondKind::replace) return {};
    ContactForce<Lanes> const force = grain_contact<Rolling, Friction>(law.grain, motion, h.shear, h.moment, dashpot);
    if constexpr (Ledger) {
      add_grain_losses(law, motion, h.shear + law.grain.shear_stiffness * motion.shear_increment,
                       h.moment + rolling_trial(law, motion), h, force, own);
    }
    h.shear = force.shear;
    h.moment = force.moment;
    return force;
  }

  KOKKOS_FORCEINLINE_FUNCTION static Lanes rolling_trial(Constants const& law, ContactMotion<Lanes> const& motion) {
    return rolling_stiffness(law.grain, motion.common_radius) * motion.relative_rotation;
  }

  /// What the bonds would carry if none broke.
  KOKKOS_FORCEINLINE_FUNCTION static BondForce<Lanes> bond_trial(Constants const& law, ContactMotion<Lanes> const& motion,
                                                                 History const& h) {
    constexpr bool parallel = Bond == BondKind::parallel;
    return bond_contact(law.bond, motion, h.formation_overlap, h.width, parallel ? h.bond_shear : h.shear,
                        parallel ? h.bond_moment : h.moment);
  }

  /// Adds the bond (`parallel`) or puts it in the grain contact's place (`replace`). The pair of a bond that broke, `bonded` but
  /// not `intact`, follows the unbonded law from this very step on.
  KOKKOS_FORCEINLINE_FUNCTION ContactForce<Lanes> with_bond(Constants const& law, ContactForce<Lanes> const& grain_part,
                                                            ContactMotion<Lanes> const& motion, Viscosity const& dashpot,
                                                            BondForce<Lanes> const& trial, Mask const& bonded, Mask const& intact,
                                                            History& h, Own& own) const {
    Lanes const zero(0);
    if constexpr (Bond == BondKind::parallel) {
      if constexpr (Ledger)
        own.breakage += select(bonded && !intact, Lanes(0.5) * spring_energy(trial.force, trial.stiffness), zero);
      h.bond_shear = select(intact, trial.force.shear, zero);
      h.bond_moment = select(intact, trial.force.moment, zero);
      return {grain_part.normal + select(intact, trial.force.normal, zero), h.shear + h.bond_shear, h.moment + h.bond_moment};
    } else {
      Lanes const trial_shear = select(bonded, trial.force.shear, h.shear + law.grain.shear_stiffness * motion.shear_increment);
      Lanes const trial_moment = select(bonded, trial.force.moment, Rolling ? h.moment + rolling_trial(law, motion) : zero);
      ContactForce<Lanes> const unbonded =
          limit_grain_contact<Rolling, shears>(law.grain, motion, trial_shear, trial_moment, dashpot);
      if constexpr (Ledger) add_replace_losses(law, motion, trial, trial_shear, trial_moment, bonded, intact, unbonded, h, own);
      h.shear = select(intact, trial.force.shear, unbonded.shear);
      h.moment = select(intact, trial.force.moment, unbonded.moment);
      return {select(intact, trial.force.normal, unbonded.normal), h.shear, h.moment};
    }
  }

  /// The closer strength test of the failure candidates and, one by one, the exact one of those that it leaves. @return those
  /// that broke
  CLATHRA_COLD_FUNCTION Mask break_bonds(FailureCandidates const& block) const {
    Mask broken(false);
    BondForce<Lanes> const trial{{block.normal, block.shear, block.moment}, {0, 0, 0}, block.width, block.thickness};
    for_each_set(block.where && !is_surely_intact(constants.bond, trial), [&](int l) {
      std::size_t const e = block.entry + static_cast<std::size_t>(l), disc = block.first + static_cast<std::size_t>(l);
      Real const radius = common_radius(p.radius(disc), p.radius(rows.neighbour(e)));
      BondStrength const strength =
          bond_strength(constants.bond.strength, lane(block.width, l), lane(block.thickness, l), radius);
      BreakMode const mode = strength.test(lane(block.normal, l), lane(block.shear, l), lane(block.moment, l));
      if (mode == BreakMode::none) return;
      rows.formation_overlap(e) = no_bond;
      set_lane(broken, l, true);
      int const id = p.id(disc), other = p.id(rows.neighbour(e));
      if (id < other)  // the other side sees it too
        breaks.record(step, id, other, mode, lane(block.x, l), lane(block.y, l),
                      [&] { return details_of(block, l, strength, mode); });
    });
    return broken;
  }

  /// @param l  the lane of a bond that broke
  CLATHRA_COLD_FUNCTION BreakDetails details_of(FailureCandidates const& block, int l, BondStrength const& strength,
                                                BreakMode mode) const {
    std::size_t const disc = block.first + static_cast<std::size_t>(l);
    auto const other = static_cast<std::size_t>(rows.neighbour(block.entry + static_cast<std::size_t>(l)));
    ContactForce<Real> const force{lane(block.normal, l), lane(block.shear, l), lane(block.moment, l)};
    BreakDetails details;
    details.eps1 = breaks.eps1;
    details.orientation = angle_of_line(p.x(other) - p.x(disc), p.y(other) - p.y(disc));
    details.thickness = lane(block.thickness, l);
    details.width = lane(block.width, l);
    details.utilisation = strength.utilisation(mode, force.normal, force.shear, force.moment);
    ContactStiffness<Real> const stiffness = constants.bond.stiffness(details.width, details.thickness);
    details.energy = spring_energy(force, stiffness);
    details.relative_rotation = force.moment / lane_max(stiffness.rolling, 1e-300);
    return details;
  }

  CLATHRA_COLD_FUNCTION void report_deep(std::size_t first, Mask const& deep) const {
    for (int l = 0; l < lane_count; ++l) {
      if (lane(deep, l)) faults.report(Fault::deep_overlap, p.id(first + static_cast<std::size_t>(l)));
    }
  }

  /// Work of slip and plastic rolling of a grain contact in this step, by the mean force over the step: exactly what leapfrog
  /// takes out.
  KOKKOS_FORCEINLINE_FUNCTION void add_grain_losses(Constants const& law, ContactMotion<Lanes> const& motion,
                                                    Lanes const& trial_shear, Lanes const& trial_moment, History const& old,
                                                    ContactForce<Lanes> const& now, Own& own,
                                                    Mask const& where = Mask(true)) const {
    Lanes const zero(0), quarter(0.25);
    if constexpr (shears) {
      Lanes const slid = (trial_shear - now.shear) * Lanes(1 / law.grain.shear_stiffness);
      own.sliding += select(where, quarter * (old.shear + now.shear) * slid, zero);
    }
    if constexpr (Rolling) {
      Lanes const stiffness = lane_max(rolling_stiffness(law.grain, motion.common_radius), Lanes(1e-300));
      own.rolling += select(where, quarter * (old.moment + now.moment) * ((trial_moment - now.moment) / stiffness), zero);
    }
    if constexpr (Dashpot) {
      own.dashpot += select(where, Lanes(0.5) * dashpot_loss(law.grain, motion, now.normal, law.dt), zero);
    }
  }

  /// The same for `replace`: unbonded pairs slide and roll; a bond that breaks swaps its energy for that of the grain contact.
  KOKKOS_FORCEINLINE_FUNCTION void add_replace_losses(Constants const& law, ContactMotion<Lanes> const& motion,
                                                      BondForce<Lanes> const& trial, Lanes const& trial_shear,
                                                      Lanes const& trial_moment, Mask const& bonded, Mask const& intact,
                                                      ContactForce<Lanes> const& unbonded, History const& old, Own& own) const {
    add_grain_losses(law, motion, trial_shear, trial_moment, old, unbonded, own, !bonded);
    ContactForce<Lanes> elastic{normal_force(law.grain, motion, Undamped()), unbonded.shear,
                                Rolling ? unbonded.moment : Lanes(0)};
    Lanes const after = grain_energy(law.grain, elastic, grain_stiffness(law.grain, motion.overlap, motion.common_radius));
    own.breakage += select(bonded && !intact, Lanes(0.5) * (spring_energy(trial.force, trial.stiffness) - after), Lanes(0));
  }
};

}  // namespace clathra
