#pragma once
/// Broken bonds: kernels log them, here they are collected on the host.
///
/// Bonds break in the middle of the hot kernel, a few in a million steps of a disc. It appends to a log of fixed size instead of
/// asking the host, and the host empties the log when somebody asks or rows are made anew. A log as long as the number of intact
/// bonds cannot overflow, so there is no check and no loss.
#include <vector>

#include "domain/parallel/ranks.hpp"
#include "domain/simulation/simulation_state.hpp"
#include "kernels/reports.hpp"

namespace clathra {

/// What is kept of each break.
enum class BreakRecord {
  counts,  ///< how many by mode
  events,  ///< when, where, how
  details  ///< and the forces and strains of each, which count from now
};

/// Those of one rank; each break is seen by one rank.
class BrokenBonds {
 public:
  /// What kernels write into in steps with this state. Bonds break once: a log as long as the number of intact bonds cannot
  /// overflow.
  BreakLog const& log_of(Field<StepState> const& steps);
  bool has_log() const { return log_.count.extent(0) > 0; }
  void drop_log() { log_ = BreakLog(); }
  /// Has a log with room for so many bonds from now on, if their events are kept. What it holds must have been collected.
  void make_room(std::size_t bonds);
  /// From the next log on; without, only their numbers by mode are known.
  bool keeps_events = true;
  /// Details of events are kept from the next log on, and their strains count from the box of this height [m]; 0: none are kept.
  Real details_from_height = 0;

  /// Moves what kernels logged to the host.
  void collect();
  // As of the last collect():
  BreakCounts const& counts() const { return counts_; }
  /// Those from the first-th on, sorted by (step, id_a, id_b).
  BreakEvents sorted_events(int first) const { return sorted(events_, static_cast<std::size_t>(first)); }

  /// Events of this rank and counts of all, into a checkpoint.
  void write(SimulationState& state, Ranks const& ranks) const;
  /// @param state  loses its events
  void read(SimulationState& state, Ranks const& ranks);
  std::size_t bytes() const { return clathra::bytes(log_); }

 private:
  bool detailed() const { return details_from_height > 0; }

  BreakLog log_;  // since the last collect()
  BreakEvents events_;
  BreakCounts counts_;
};

/// The events of all ranks on rank 0, sorted by (step, id_a, id_b); nothing elsewhere.
BreakEvents gathered(Ranks const& ranks, BreakEvents events);

}  // namespace clathra
