#include "domain/simulation/time_step_control.hpp"

#include <algorithm>

namespace clathra {

namespace {

constexpr int most_steps_of_an_update = 1000;
constexpr int least_steps_of_a_calm_update = 150;
constexpr Real calm_skin_fraction = 0.3;
constexpr Real most_stiffening = 1.05;  // that a share of 0.95 of the limit bears without an update: it is then 0.973

}  // namespace

void TimeStepControl::follow(StepChoice const& choice, Real estimate) {
  constexpr Real most = 1.35;  // times the estimate, which counts contacts to come: no bound knows those of flying discs
  bool const by_limit = choice.rule == TimeStepRule::adaptive;
  follows_ = true;
  share_ = by_limit ? choice.safety : usual_share_of_limit;
  ceiling_ = (by_limit ? most : choice.safety) * estimate;
  age_ = least_steps_of_a_calm_update;
}

/// Where discs move so fast that the last update did not last, the next one counts every listed gap as closed: it lasts until the
/// next search.
Real TimeStepControl::update(SpringNetwork const& springs, SimulationLaws const& laws, AcrossRanks const& across) {
  skin_fraction_ = age_ < least_steps_of_a_calm_update ? 1 : calm_skin_fraction;
  Real const limit = stable_limit(springs, laws.motion.damping, skin_fraction_, across);
  laws_of_update_ = laws;
  age_ = 0;
  due_ = false;
  ++updates_;
  return std::min(share_ * limit, ceiling_);
}

bool TimeStepControl::remember_places(ParticleSoA const& particles) {
  bool moved = false;
  for (auto* field : {&places_.x, &places_.y}) {
    if (field->extent(0) == particles.x.extent(0)) continue;
    moved = true;
    *field = Field<Coord>("places_at_update", particles.x.extent(0));
  }
  Kokkos::deep_copy(places_.x, particles.x);
  Kokkos::deep_copy(places_.y, particles.y);
  return moved;
}

void TimeStepControl::after_laws(SimulationLaws const& laws) {
  due_ |= follows_ && stiffening(laws_of_update_, laws) > most_stiffening;
}

void TimeStepControl::after_steps(std::int64_t steps, Real time_step) {
  previous_ = time_step;
  if (!follows_) return;
  age_ += steps;
  due_ = age_ >= most_steps_of_an_update;
}

void TimeStepControl::after_step(bool outdated) {
  if (follows_) due_ = ++age_ >= most_steps_of_an_update || outdated;
}

std::int64_t TimeStepControl::steps_left() const { return follows_ ? most_steps_of_an_update - age_ : INT64_MAX; }

Real TimeStepControl::calm_limit(SpringNetwork const& springs, Real damping, AcrossRanks const& across) {
  return stable_limit(springs, damping, calm_skin_fraction, across);
}

}  // namespace clathra
