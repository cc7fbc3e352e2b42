#pragma once
/// How the time step of a simulation follows the limit of stability.
#include <cstdint>

#include "domain/scene/step_choice.hpp"
#include "domain/simulation/simulation_laws.hpp"
#include "kernels/stability.hpp"

namespace clathra {

/// Without it the time step stays as it is set. With it dt = min(share * limit, ceiling), where the limit is a bound that holds
/// until discs are displaced by a fraction of their skins: it is updated then, after each neighbour search, where laws become
/// stiffer, and every 1000 steps.
class TimeStepControl {
 public:
  /// From now on the step follows the limit. @param estimate  of it, by each disc's own springs [s]
  void follow(StepChoice const& choice, Real estimate);
  bool follows() const { return follows_; }
  bool is_due() const { return due_; }

  /// dt of the steps to come [s]. @param springs  as they are now;  @param laws  they follow from these
  Real update(SpringNetwork const& springs, SimulationLaws const& laws, AcrossRanks const& across);
  /// Keeps where the discs are as places(). @return whether these are in other memory than before
  bool remember_places(ParticleSoA const& particles);

  /// Pairs that were not listed may touch from now on.
  void after_search() { due_ = follows_; }
  void after_laws(SimulationLaws const& laws);
  void ask() { due_ = follows_; }  ///< after springs have changed
  /// @param steps  that were made of this length
  void after_steps(std::int64_t steps, Real time_step);
  /// The same of one step. @param outdated  whether discs were displaced too far for the bound
  void after_step(bool outdated);

  /// The share of its skin that a disc may be displaced by before an update is due.
  Real skin_fraction() const { return skin_fraction_; }
  /// Until an update is due at the latest.
  std::int64_t steps_left() const;
  /// The parts of the next step [s]: velocities lie half a step behind, so that where its length changes the kick is the mean of
  /// both.
  StepLengths lengths(Real time_step) const { return {previous_ > 0 ? 0.5 * (previous_ + time_step) : time_step, time_step}; }
  /// Where the last update found the discs.
  UpdatePlaces& places() { return places_; }
  UpdatePlaces const& places() const { return places_; }
  std::int64_t updates() const { return updates_; }

  /// clathra::stable_limit() of calm discs [s].
  static Real calm_limit(SpringNetwork const& springs, Real damping, AcrossRanks const& across);

  /// Visits the numbers that a checkpoint keeps: (name, number).
  template <class Visit>
  void for_each_number(Visit&& visit) {
    visit("follows_limit", follows_);
    visit("share_of_limit", share_);
    visit("time_step_ceiling", ceiling_);
    visit("time_step_skin_fraction", skin_fraction_);
    visit("time_step_before", previous_);
    visit("time_step_age", age_);
    visit("time_step_due", due_);
    visit("time_step_updates", updates_);
  }
  /// The laws under which a simulation goes on are those of its last update.
  void go_on_with(SimulationLaws const& laws) { laws_of_update_ = laws; }

 private:
  bool follows_ = false, due_ = false;
  Real share_ = 0, ceiling_ = 0;
  Real skin_fraction_ = 1;
  Real previous_ = 0;     // dt of the step before, 0 before the first [s]
  std::int64_t age_ = 0;  // steps since the last update
  std::int64_t updates_ = 0;
  SimulationLaws laws_of_update_;
  UpdatePlaces places_;
};

}  // namespace clathra
