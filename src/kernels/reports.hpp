#pragma once
/// What kernels report besides forces: broken bonds, faults and energy losses.
#include "kernels/bond_strength.hpp"

namespace clathra {

/// Bonds that broke, each once, in no particular order. Bonds never re-form, so the number of intact bonds is a firm capacity.
struct BreakLog {
  Field<int> count;          ///< [1] events in the log
  Field<std::int64_t> step;  ///< [bonds] step number
  Field<int> id_a, id_b;     ///< [bonds] id_a < id_b
  Field<std::int8_t> mode;   ///< [bonds] BreakMode
  Field<Coord> x, y;         ///< [bonds] midpoint of the branch [m]

  KOKKOS_INLINE_FUNCTION void record(std::int64_t at_step, int a, int b, BreakMode how, Coord at_x, Coord at_y) const {
    auto const slot = static_cast<std::size_t>(Kokkos::atomic_fetch_add(&count(0), 1));
    step(slot) = at_step;
    id_a(slot) = a;
    id_b(slot) = b;
    mode(slot) = static_cast<std::int8_t>(how);
    x(slot) = at_x;
    y(slot) = at_y;
  }
};

inline BreakLog make_break_log(std::size_t bonds) {
  BreakLog log;
  log.count = Field<int>("breaks.count", 1);
  log.step = uninitialised<std::int64_t>("breaks.step", bonds);  // pages that nothing is written to cost nothing on a host
  log.id_a = uninitialised<int>("breaks.id_a", bonds);
  log.id_b = uninitialised<int>("breaks.id_b", bonds);
  log.mode = uninitialised<std::int8_t>("breaks.mode", bonds);
  log.x = uninitialised<Coord>("breaks.x", bonds);
  log.y = uninitialised<Coord>("breaks.y", bonds);
  return log;
}

/// What can go wrong inside a kernel. Each holds the largest id of a disc that met it, or -1.
enum class Fault { not_finite = 0, deep_overlap = 1, row_overflow = 2 };
inline constexpr int fault_count = 3;

struct Faults {
  Field<int> disc;  ///< [fault_count]
  KOKKOS_INLINE_FUNCTION void report(Fault what, int id) const {
    Kokkos::atomic_fetch_max(&disc(static_cast<std::size_t>(what)), id);
  }
};

inline Faults make_faults() {
  Faults faults{Field<int>("faults", fault_count)};
  Kokkos::deep_copy(faults.disc, -1);
  return faults;
}

/// Energy lost since the ledger was opened [J/m], by disc (half of each contact's loss on either disc). Empty fields = no ledger.
struct EnergyLosses {
  Field<Accum> sliding;   ///< Coulomb slip
  Field<Accum> rolling;   ///< plastic rolling
  Field<Accum> dashpot;   ///< viscous contact damping
  Field<Accum> breakage;  ///< bond energy minus grain-contact energy at the instant of breakage; negative where breaking stiffens
  Field<Accum> damping;   ///< local (Cundall) damping
};

inline EnergyLosses make_energy_losses(std::size_t discs) {
  return {Field<Accum>("loss.sliding", discs), Field<Accum>("loss.rolling", discs), Field<Accum>("loss.dashpot", discs),
          Field<Accum>("loss.breakage", discs), Field<Accum>("loss.damping", discs)};
}

}  // namespace clathra
