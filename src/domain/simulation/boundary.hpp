#pragma once
/// What bounds an assembly and pushes its particles.
#include <utility>
#include <vector>

#include "domain/simulation/simulation_laws.hpp"
#include "kernels/scratch.hpp"

namespace clathra {

/// What a boundary keeps of discs, disc by disc with names, while these change their places. [owned] each
using BoundaryHistory = std::vector<std::pair<char const*, Field<Real>>>;

/// What the forces of a step need.
struct StepForces {
  ParticleSoA const& particles;
  SimulationLaws const& laws;
  Real dt;  ///< [s]
  Dissipation const& losses;
  Faults const& faults;
  SumUnits const& unit;
  DeviceSteps const& steps;
  bool ends_step;  ///< whether these are the last ones, whose kernel ends the step
  StepLaunches const& launches;
};

/// The host's part of a boundary with forces. What a step changes of it is in StepState, which the device moves. A periodic cell
/// has no forces: its images are ghosts (Ghosts).
class Boundary {
 public:
  virtual ~Boundary() = default;

  // In a neighbour search, in this order:
  virtual BoundaryHistory history_of_discs(ParticleSoA const& particles, Scratch& scratch) const = 0;
  virtual void drop_contacts() = 0;
  /// Enqueues a list of the discs near it. @param number  [1] on the device: how many
  virtual void list_near(ParticleSoA const& particles, StepState const& now, Field<std::int64_t> const& number,
                         Scratch& scratch) = 0;
  /// @param size  of that list
  virtual void make_contacts(int size, SimulationLaws const& laws, BoundaryHistory const& history, Scratch& scratch) = 0;

  // In a step:
  virtual void enqueue_forces(StepForces const& by) const = 0;
  /// What it feels of the discs of all ranks after such forces, where the host has a part in steps; collective.
  virtual void read_reactions(StepState& now, DeviceSteps const& steps, Summation const& sums) const = 0;
  /// The same, and how it moves on.
  virtual void end_step(StepState& now, DeviceSteps const& steps, Summation const& sums) const = 0;
};

}  // namespace clathra
