#pragma once
/// What a neighbour search has to know of all discs before it begins, from one pass over them that the host waits for once.
#include "kernels/exact_sum.hpp"
#include "kernels/neighbours.hpp"
#include "kernels/verlet_skin.hpp"

namespace clathra {

/// Of one rank. Where there are several, sums and maxima are to be replaced by those over all of them. None depends on the order
/// of the discs.
struct RebuildInputs {
  /// Of the speeds beside the homogeneous motion, digit by digit; of those out of range; of the discs.
  enum Sum : int { speed_digits, speeds_out_of_range = speed_digits + FixedPoint::words, discs, sum_count };
  /// Bounds of the discs [m], those on the left and at the bottom with the other sign; the speed beside the homogeneous motion
  /// [m/s]; the gap of an intact bond, 0 without one [m]; the id of a disc that met each fault, or -1.
  enum Largest : int {
    leftwards,
    rightwards,
    downwards,
    upwards,
    speed,
    bonded_gap,
    faults,
    largest_count = faults + fault_count
  };

  std::int64_t sums[sum_count] = {};
  double largest[largest_count] = {};

  Real mean_speed = 0;  ///< mean_of_speeds() once the sums are those of all ranks [m/s]

  /// @throws SumOutOfRange
  Real mean_of_speeds(SumUnits const& unit) const;
  /// All zero without discs.
  Bounds bounds() const;
};

/// The host waits for it. @param rows  with ghosts in their present places
RebuildInputs rebuild_inputs(ParticleSoA const& particles, ContactRows const& rows, AffineFrame const& frame,
                             Faults const& faults, SumUnits const& unit);

/// Enqueues the same behind a move after which a search is due or the host has a part: it will be in the state of
/// the steps, in which enqueued_rebuild_inputs() finds it.
void enqueue_rebuild_inputs(ParticleSoA const& particles, ContactRows const& rows, Faults const& faults, SumUnits const& unit,
                            DeviceSteps const& steps, StepLaunches const& launches);
RebuildInputs enqueued_rebuild_inputs(StepState const& steps);

}  // namespace clathra
