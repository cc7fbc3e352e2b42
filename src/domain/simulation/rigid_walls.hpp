#pragma once
/// Four rigid walls as a boundary.
#include "domain/simulation/boundary.hpp"

namespace clathra {

class RigidWalls : public Boundary {
 public:
  /// @param rough  whether there is a shear history to come
  explicit RigidWalls(bool rough) { contacts_.rough = rough; }

  WallContacts const& contacts() const { return contacts_; }

  BoundaryHistory history_of_discs(ParticleSoA const& particles, Scratch& scratch) const override;
  void drop_contacts() override { contacts_ = WallContacts(); }
  void list_near(ParticleSoA const& particles, StepState const& now, Field<std::int64_t> const& number,
                 Scratch& scratch) override;
  void make_contacts(int size, SimulationLaws const& laws, BoundaryHistory const& history, Scratch& scratch) override;
  void enqueue_forces(StepForces const& by) const override;
  void read_reactions(StepState& now, DeviceSteps const& steps, Summation const& sums) const override;
  void end_step(StepState& now, DeviceSteps const& steps, Summation const& sums) const override;

 private:
  WallContacts contacts_;
  Field<int> near_;  // of the search under way
};

}  // namespace clathra
