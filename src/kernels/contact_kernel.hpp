#pragma once
/// The contact kernel, specialised by bond kind, rolling, dashpot and ledger; instantiated in forces.cpp only.
#include "kernels/forces.hpp"

namespace clathra {

/// One slice of `lane_count` discs per call: walks their rows side by side.
template <BondKind Bond, bool Rolling, bool Dashpot, bool Ledger>
struct ContactKernel {
  static constexpr bool bonded_code = Bond != BondKind::none;
  static constexpr bool moments = Rolling || bonded_code;

  ParticleSoA p;
  ContactRows rows;
  GrainLaw grain;
  BondLaw bond;
  Real dt;
  std::int64_t step;
  BreakLog breaks;
  EnergyLosses losses;
  Faults faults;

  /// State of the slice's own discs and what has been summed for them.
  struct Own {
    Lanes x, y, vx, vy, omega, radius, inverse_mass;
    Lanes force_x, force_y, torque;
    Lanes sliding, rolling, dashpot, breakage;
  };

  /// History of one block of entries.
  struct History {
    Lanes shear, moment, equilibrium, width, bond_shear, bond_moment;
  };

  KOKKOS_FUNCTION void operator()(int slice) const {
    auto const first = static_cast<std::size_t>(slice) * lane_count;
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
    // Entries out of touch stay so nearly always, and those that carry a history still do: a branch on what the last step found
    // is foreseen, one on the distances is not.
    int const begin = rows.slice_start(slice), end = rows.slice_start(slice + 1);
    std::uint64_t const active = rows.active(slice);
    std::uint64_t carrying = 0, bit = 1;
    for (int k = begin; k < end; ++k, bit <<= 1) {
      if (add_block(first, static_cast<std::size_t>(k) * lane_count, (active & bit) != 0, own)) carrying |= bit;
    }
    rows.active(slice) = carrying;
    store(&p.force_x(first), own.force_x);
    store(&p.force_y(first), own.force_y);
    store(&p.torque(first), own.torque);
    if constexpr (Ledger) {
      store(&losses.sliding(first), load(&losses.sliding(first)) + own.sliding);
      store(&losses.rolling(first), load(&losses.rolling(first)) + own.rolling);
      store(&losses.dashpot(first), load(&losses.dashpot(first)) + own.dashpot);
      store(&losses.breakage(first), load(&losses.breakage(first)) + own.breakage);
    }
  }

  /// Entry block `e .. e + lane_count`: the k-th neighbour of each disc of the slice.
  /// @param active  false if none of them holds a history;  @return whether one does afterwards
  KOKKOS_FORCEINLINE_FUNCTION bool add_block(std::size_t first, std::size_t e, bool active, Own& own) const {
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
    motion.approach = -(dvx * nx + dvy * ny);
    Lanes const half_overlap = Lanes(0.5) * motion.overlap;
    Lanes const arm = own.radius - half_overlap, other_arm = other_radius - half_overlap;  // arm + other_arm = distance
    motion.slip = ((dvy * nx - dvx * ny) - (own.omega * arm + other_omega * other_arm)) * dt;
    motion.turn = (other_omega - own.omega) * dt;
    motion.common_radius = common_radius(own.radius, other_radius);
    auto const deep = distance < lane_max(own.radius, other_radius);  // one disc's centre lies inside the other
    if (any(deep)) report_deep(first, deep);

    Lanes dashpot(0);
    if constexpr (Dashpot) dashpot = dashpot_coefficient(grain, own.inverse_mass, gather(p.inverse_mass.data(), j));
    ContactForce<Lanes> force = grain_force(motion, dashpot, h, own);
    if constexpr (bonded_code) {
      Site const site{first, e, j, &own, dx, dy};
      force = with_bond(force, motion, dashpot, site, h, own);
    }
    write(e, h);
    // Entries out of touch and without a bond got exact zeros from the laws; nothing needs masking here.
    own.force_x -= force.normal * nx + force.shear * ny;
    own.force_y += force.shear * nx - force.normal * ny;
    own.torque += arm * force.shear + force.moment;
    if constexpr (bonded_code) return any(touching || is_bonded(h.equilibrium));
    return any(touching);
  }

 private:
  /// Where a block of entries lies: needed only when something is reported.
  struct Site {
    std::size_t first, entry;
    int const* other;
    Own const* own;
    Lanes dx, dy;
  };

  KOKKOS_FORCEINLINE_FUNCTION History read(std::size_t e) const {
    History h{load(&rows.shear(e)), 0, no_bond, 0, 0, 0};
    if constexpr (moments) h.moment = load(&rows.moment(e));
    if constexpr (bonded_code) {
      h.equilibrium = load(&rows.equilibrium(e));
      h.width = load(&rows.width(e));
    }
    if constexpr (Bond == BondKind::parallel) {
      h.bond_shear = load(&rows.bond_shear(e));
      h.bond_moment = load(&rows.bond_moment(e));
    }
    return h;
  }

  KOKKOS_FORCEINLINE_FUNCTION void write(std::size_t e, History const& h) const {
    store(&rows.shear(e), h.shear);
    if constexpr (moments) store(&rows.moment(e), h.moment);
    if constexpr (Bond == BondKind::parallel) {
      store(&rows.bond_shear(e), h.bond_shear);
      store(&rows.bond_moment(e), h.bond_moment);
    }
  }

  /// The unbonded law on every entry; with `replace` the entries that are bonded are overruled by with_bond().
  KOKKOS_FORCEINLINE_FUNCTION ContactForce<Lanes> grain_force(ContactMotion<Lanes> const& motion, Lanes const& dashpot,
                                                              History& h, Own& own) const {
    if constexpr (Bond == BondKind::replace) return {};
    ContactForce<Lanes> const force = grain_contact<Rolling>(grain, motion, h.shear, h.moment, dashpot);
    if constexpr (Ledger) {
      add_grain_losses(motion, h.shear + grain.shear_stiffness * motion.slip, h.moment + rolling_trial(motion), h, force, own);
    }
    h.shear = force.shear;
    h.moment = force.moment;
    return force;
  }

  KOKKOS_FORCEINLINE_FUNCTION Lanes rolling_trial(ContactMotion<Lanes> const& motion) const {
    return rolling_stiffness(grain, motion.common_radius) * motion.turn;
  }

  /// Adds the bond (`parallel`) or puts it in the grain contact's place (`replace`), and breaks it where its strength is reached;
  /// a broken bond's pair follows the unbonded law from this very step on.
  KOKKOS_FORCEINLINE_FUNCTION ContactForce<Lanes> with_bond(ContactForce<Lanes> const& grain_part,
                                                            ContactMotion<Lanes> const& motion, Lanes const& dashpot,
                                                            Site const& site, History& h, Own& own) const {
    constexpr bool parallel = Bond == BondKind::parallel;
    auto const bonded = is_bonded(h.equilibrium);
    BondForce<Lanes> const trial = bond_contact(bond, motion, h.equilibrium, h.width, parallel ? h.bond_shear : h.shear,
                                                parallel ? h.bond_moment : h.moment);
    auto const doubt = bonded && !is_surely_intact(bond, trial);
    if (any(doubt) && break_bonds(trial, doubt, site, h)) store(&rows.equilibrium(site.entry), h.equilibrium);
    auto const intact = is_bonded(h.equilibrium);
    Lanes const zero(0);
    if constexpr (parallel) {
      if constexpr (Ledger) own.breakage += select(bonded && !intact, Lanes(0.5) * bond_energy(trial), zero);
      h.bond_shear = select(intact, trial.force.shear, zero);
      h.bond_moment = select(intact, trial.force.moment, zero);
      return {grain_part.normal + select(intact, trial.force.normal, zero), h.shear + h.bond_shear, h.moment + h.bond_moment};
    } else {
      Lanes const trial_shear = select(bonded, trial.force.shear, h.shear + grain.shear_stiffness * motion.slip);
      Lanes const trial_moment = select(bonded, trial.force.moment, Rolling ? h.moment + rolling_trial(motion) : zero);
      ContactForce<Lanes> const unbonded = limit_grain_contact<Rolling>(grain, motion, trial_shear, trial_moment, dashpot);
      if constexpr (Ledger) add_replace_losses(motion, trial, trial_shear, trial_moment, bonded, intact, unbonded, h, own);
      h.shear = select(intact, trial.force.shear, unbonded.shear);
      h.moment = select(intact, trial.force.moment, unbonded.moment);
      return {select(intact, trial.force.normal, unbonded.normal), h.shear, h.moment};
    }
  }

  /// The exact strength test of the doubtful bonds, one by one: they are few. @return whether one broke
  KOKKOS_FUNCTION bool break_bonds(BondForce<Lanes> const& trial, Mask const& doubt, Site const& site, History& h) const {
    bool broken = false;
    for (int l = 0; l < lane_count; ++l) {
      if (!lane(doubt, l)) continue;
      BondStrength const strength = bond_strength(bond.strength, lane(trial.width, l), lane(trial.gap, l));
      BreakMode const mode = strength.test(lane(trial.force.normal, l), lane(trial.force.shear, l), lane(trial.force.moment, l));
      if (mode == BreakMode::none) continue;
      set_lane(h.equilibrium, l, no_bond);
      broken = true;
      int const id = p.id(site.first + static_cast<std::size_t>(l)), other = p.id(site.other[l]);
      if (id >= other) continue;  // both discs of the pair see the same break; one of them reports it
      breaks.record(step, id, other, mode, lane(site.own->x, l) + 0.5 * lane(site.dx, l),
                    lane(site.own->y, l) + 0.5 * lane(site.dy, l));
    }
    return broken;
  }

  KOKKOS_FUNCTION void report_deep(std::size_t first, Mask const& deep) const {
    for (int l = 0; l < lane_count; ++l) {
      if (lane(deep, l)) faults.report(Fault::deep_overlap, p.id(first + static_cast<std::size_t>(l)));
    }
  }

  /// Elastic energy of a bond, F_n^2/2k_bn + F_s^2/2k_bs + M^2/2k_bm [J/m].
  KOKKOS_FORCEINLINE_FUNCTION static Lanes bond_energy(BondForce<Lanes> const& b) {
    Lanes const floor(1e-300);
    return Lanes(0.5) * (b.force.normal * b.force.normal / lane_max(b.stiffness.normal, floor) +
                         b.force.shear * b.force.shear / lane_max(b.stiffness.shear, floor) +
                         b.force.moment * b.force.moment / lane_max(b.stiffness.rolling, floor));
  }

  /// Work of slip and plastic rolling of a grain contact in this step, by the mean force over the step: exactly what leapfrog
  /// takes out.
  KOKKOS_FORCEINLINE_FUNCTION void add_grain_losses(ContactMotion<Lanes> const& motion, Lanes const& trial_shear,
                                                    Lanes const& trial_moment, History const& old, ContactForce<Lanes> const& now,
                                                    Own& own, Mask const& where = Mask(true)) const {
    Lanes const zero(0), quarter(0.25);
    Lanes const slid = (trial_shear - now.shear) * Lanes(1 / grain.shear_stiffness);
    own.sliding += select(where, quarter * (old.shear + now.shear) * slid, zero);
    if constexpr (Rolling) {
      Lanes const stiffness = lane_max(rolling_stiffness(grain, motion.common_radius), Lanes(1e-300));
      own.rolling += select(where, quarter * (old.moment + now.moment) * ((trial_moment - now.moment) / stiffness), zero);
    }
    if constexpr (Dashpot) {
      Lanes const spring = lane_max(grain.normal_stiffness * motion.overlap, zero);
      own.dashpot += select(where, Lanes(0.5) * (now.normal - spring) * (motion.approach * dt), zero);
    }
  }

  /// The same for `replace`: unbonded pairs slide and roll; a bond that breaks swaps its energy for that of the grain contact.
  KOKKOS_FORCEINLINE_FUNCTION void add_replace_losses(ContactMotion<Lanes> const& motion, BondForce<Lanes> const& trial,
                                                      Lanes const& trial_shear, Lanes const& trial_moment, Mask const& bonded,
                                                      Mask const& intact, ContactForce<Lanes> const& unbonded, History const& old,
                                                      Own& own) const {
    add_grain_losses(motion, trial_shear, trial_moment, old, unbonded, own, !bonded);
    Lanes const spring = lane_max(grain.normal_stiffness * motion.overlap, Lanes(0));
    Lanes after = spring * spring * Lanes(0.5 / grain.normal_stiffness) +
                  unbonded.shear * unbonded.shear * Lanes(0.5 / grain.shear_stiffness);
    if constexpr (Rolling) {
      after += Lanes(0.5) * unbonded.moment * unbonded.moment /
               lane_max(rolling_stiffness(grain, motion.common_radius), Lanes(1e-300));
    }
    own.breakage += select(bonded && !intact, Lanes(0.5) * (bond_energy(trial) - after), Lanes(0));
  }
};

}  // namespace clathra
