#pragma once
/// What kernels report besides forces: broken bonds, faults and energy losses.
#include "kernels/bond_strength.hpp"
#include "kernels/break_details.hpp"
#include "kernels/step_state.hpp"

namespace clathra {

/// Bonds that broke, each once, in no particular order. Bonds never re-form, so the number of intact bonds is a firm capacity.
/// Where nobody reads the events only their numbers by mode are kept.
struct BreakLog {
  Field<std::int64_t> by_mode;  ///< [break_mode_count] bonds that broke
  Field<int> count;             ///< [1] events in the log
  Field<std::int64_t> step;     ///< [bonds] step number; as the following, empty where events are not kept
  Field<int> id_a, id_b;        ///< [bonds] id_a < id_b
  Field<std::int8_t> mode;      ///< [bonds] BreakMode
  Field<Coord> x, y;            ///< [bonds] midpoint of the branch [m]
  Field<BreakDetails> details;  ///< [bonds] empty where nobody asked for them
  Field<Coord> height;          ///< [bonds] of the box at the end of the step [m], likewise
  Field<StepState> steps;       ///< that has this box

  /// @param details_of_it  computes them; not called where nobody asked for them
  template <class DetailsOfIt>
  KOKKOS_INLINE_FUNCTION void record(std::int64_t at_step, int a, int b, BreakMode how, Coord at_x, Coord at_y,
                                     DetailsOfIt const& details_of_it) const {
    Kokkos::atomic_fetch_add(&by_mode(static_cast<std::size_t>(how)), std::int64_t(1));
    if (step.extent(0) == 0) return;
    auto const place = static_cast<std::size_t>(Kokkos::atomic_fetch_add(&count(0), 1));
    step(place) = at_step;
    id_a(place) = a;
    id_b(place) = b;
    mode(place) = static_cast<std::int8_t>(how);
    x(place) = at_x;
    y(place) = at_y;
    if (details.extent(0) == 0) return;
    details(place) = details_of_it();
    height(place) = steps(0).box().height();
  }
};

/// @param bonds  events that there is room for; 0 keeps none;  @param detailed  whether there is room for details too
inline BreakLog make_break_log(std::size_t bonds, bool detailed) {
  BreakLog log;
  log.by_mode = Field<std::int64_t>("breaks.by_mode", break_mode_count);
  log.count = Field<int>("breaks.count", 1);
  log.step = uninitialised<std::int64_t>("breaks.step", bonds);  // pages that nothing is written to cost nothing on a host
  log.id_a = uninitialised<int>("breaks.id_a", bonds);
  log.id_b = uninitialised<int>("breaks.id_b", bonds);
  log.mode = uninitialised<std::int8_t>("breaks.mode", bonds);
  log.x = uninitialised<Coord>("breaks.x", bonds);
  log.y = uninitialised<Coord>("breaks.y", bonds);
  if (detailed) {
    log.details = uninitialised<BreakDetails>("breaks.details", bonds);
    log.height = uninitialised<Coord>("breaks.height", bonds);
  }
  return log;
}

inline std::size_t bytes(BreakLog const& log) {
  return log.by_mode.span() * sizeof(std::int64_t) + log.count.span() * sizeof(int) +
         log.step.span() * (sizeof(std::int64_t) + 2 * sizeof(int) + sizeof(std::int8_t) + 2 * sizeof(Coord)) +
         log.details.span() * (sizeof(BreakDetails) + sizeof(Coord));
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

/// Energy lost since the ledger was opened [J/m], by disc (half of each contact's loss on either disc). An empty field is an
/// account that the laws have no use for; all are empty where there is no ledger.
struct Dissipation {
  Field<Accum> sliding;   ///< Coulomb slip
  Field<Accum> rolling;   ///< plastic rolling
  Field<Accum> dashpot;   ///< viscous contact damping
  Field<Accum> breakage;  ///< bond energy minus grain-contact energy at the instant of breakage; negative where breaking stiffens
  Field<Accum> damping;   ///< local (Cundall) damping
};

/// Which ways there are to lose energy.
struct DissipationKinds {
  bool sliding = true, rolling = true, dashpot = true, breakage = true, damping = true;
};

/// Visits (name, account, whether it is needed).
template <class Visit>
void for_each_dissipation(Dissipation& losses, DissipationKinds const& needed, Visit&& visit) {
  visit("lost_sliding", losses.sliding, needed.sliding);
  visit("lost_rolling", losses.rolling, needed.rolling);
  visit("lost_dashpot", losses.dashpot, needed.dashpot);
  visit("lost_breakage", losses.breakage, needed.breakage);
  visit("lost_damping", losses.damping, needed.damping);
}

/// Opens the accounts that are needed and not open yet; what stands in the others stays.
inline void allocate_dissipation(Dissipation& losses, DissipationKinds const& needed, std::size_t discs) {
  for_each_dissipation(losses, needed, [&](char const* name, Field<Accum>& account, bool wanted) {
    if (wanted && account.extent(0) == 0) account = Field<Accum>(std::string(name), discs);
  });
}

inline std::size_t bytes(Dissipation losses) {
  std::size_t total = 0;
  for_each_dissipation(losses, {},
                       [&](char const*, Field<Accum> const& account, bool) { total += account.span() * sizeof(Accum); });
  return total;
}

}  // namespace clathra
