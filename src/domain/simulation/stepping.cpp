/// The time step: what the device is asked for, and what part the host has in it.
#include <algorithm>

#include "domain/simulation/simulation.hpp"

namespace clathra {

namespace {

constexpr int check_every = 64;  // steps between checks of the fault flags

}  // namespace

void Simulation::step(std::int64_t count, Real until_height) {
  std::int64_t const last = now_.step + count;
  now_.orders.height = until_height;
  now_.stop = StepStop::none;
  while (now_.step < last && now_.stop == StepStop::none) {
    if (time_steps_.follows() && (time_steps_.is_due() || upkeep_.is_asked())) update_time_step();
    advance(steps_at_once(last - now_.step));
    if (now_.step % check_every == 0) throw_if_unstable();
  }
}

/// Steps that the host need not look at, by what is known of them: when faults are looked for and when the time step is updated.
/// A GPU sees for itself how far the discs are displaced, and what was enqueued behind the step that has to search does nothing;
/// for a processor it is said when their displacements will have added up, if they go on as in the last step.
Simulation::StepsAtOnce Simulation::steps_at_once(std::int64_t most) const {
  if (host_synchronous()) return {1, upkeep_.is_asked()};
  most = std::min({most, check_every - now_.step % check_every, time_steps_.steps_left()});
  Real until = 0;
  if constexpr (for_gpu) {
    constexpr Real beyond = 8;  // steps, that would not do to fall short of a search by a few
    Real const reach = upkeep_.reach_in_skins(facts_.largest_radius),
               displaced = now_.at_search.displacement + now_.at_search.closing(now_.box) * reach;
    until = static_cast<Real>(now_.step - upkeep_.last_search()) * (1 - displaced) / std::max(displaced, Real(1e-9)) + beyond;
  } else {
    Real left = 1 - now_.at_search.displacement;
    if (time_steps_.follows()) left = std::min(left, time_steps_.skin_fraction() - now_.at_update.displacement);
    until = 1 + left / now_.relative_displacement;
  }
  bool const may_search = until < static_cast<Real>(most);
  if (may_search) most = static_cast<std::int64_t>(until);
  return {static_cast<int>(std::max<std::int64_t>(most, 1)), may_search};
}

/// Enqueues steps and waits for them. The host has no part in them unless steps are host-synchronous, which go one by one, or the
/// discs may be displaced too far: then the steps stop, the host sees to it and ends that step as its last.
void Simulation::advance(StepsAtOnce const& steps) {
  bool const synchronous = host_synchronous();
  std::int64_t const first = now_.step;
  upload_state(synchronous);
  Kokkos::Timer const moving;
  if (synchronous)
    enqueue_motion(0, {});
  else
    enqueue_steps(steps.count);
  bool const has_rebuild_inputs = for_gpu && steps.may_search && ranks().alone() && !periodic();
  if (has_rebuild_inputs)
    enqueue_rebuild_inputs(particles_, rows_, faults_, sums_.unit, steps_,
                           synchronous ? StepLaunches() : graph_.behind());  // one wait for both
  now_ = steps_.get();
  ghosts_.add_busy_seconds(moving.seconds());
  time_steps_.after_steps(now_.step - first, time_step);
  if (now_.stop == StepStop::after_move) {
    end_move(has_rebuild_inputs);
    end_step();
  }
  in_range([&] { require_reactions_in_range(now_.out_of_range); });
}

/// Whole steps, many at once where there are graphs.
void Simulation::enqueue_steps(int steps) {
  graph_.follow(time_step);
  graph_.enqueue(steps, [this](StepLaunches const& launches, int ahead) {
    enqueue_motion(ahead, launches);
    enqueue_forces(launches);
  });
}

/// The state of the steps to the device, with what has been set since it came from there.
void Simulation::upload_state(bool synchronous) {
  now_.orders.dt = time_step;
  now_.orders.least_skin = skins(false).least;
  now_.orders.reach = upkeep_.reach_in_skins(facts_.largest_radius);
  now_.orders.skin_fraction = time_steps_.skin_fraction();
  now_.orders.follows_limit = time_steps_.follows();
  now_.orders.host_synchronous = synchronous;
  now_.stop = StepStop::none;
  now_.out_of_range = 0;
  now_.begin_step();
  steps_.set(now_);
}

/// Kick and drift. @param ahead  steps that were enqueued since the last wait
void Simulation::enqueue_motion(int ahead, StepLaunches const& launches) {
  StepLengths const lengths = ahead == 0 ? time_steps_.lengths(time_step) : StepLengths{time_step, time_step};
  integrate(particles_, laws_.motion, lengths, losses_, faults_, steps_, time_steps_.places(), launches);
}

/// The forces at the places that the discs have come to, and the end of the step.
void Simulation::enqueue_forces(StepLaunches const& launches) {
  compute_forces(particles_, rows_, laws_.contact, time_step, now_.step + 1, broken_bonds_.log_of(steps_.state), losses_, faults_,
                 steps_.state, launches);
  if (!periodic())
    add_wall_forces(particles_, wall_contacts_, laws_.wall, time_step, losses_, faults_, sums_.unit, steps_, launches);
}

/// The host's part between the move and the forces: a search, or the ghosts follow their discs.
/// @param has_rebuild_inputs  whether they were enqueued
void Simulation::end_move(bool has_rebuild_inputs) {
  if (now_.orders.host_synchronous) {
    now_.step_displacement = ranks().max(now_.step_displacement);
    now_.add_displacements();
  }
  bool const known = upkeep_.is_asked() || now_.search_is_due;
  if (!known && now_.search_may_be_due)
    now_.search_is_due = are_displaced(now_.at_search, particles_.reference_x, particles_.reference_y, 1);
  if (upkeep_.is_asked() || now_.search_is_due) {
    rebuild(has_rebuild_inputs && known ? checked(enqueued_rebuild_inputs(now_)) : rebuild_inputs_of_all());
    return;
  }
  refresh_ghosts();
  UpdatePlaces const& places = time_steps_.places();
  time_steps_.after_step(now_.update_is_due || (now_.update_may_be_due &&
                                                are_displaced(now_.at_update, places.x, places.y, time_steps_.skin_fraction())));
}

/// The rest of a step after end_move(). Where steps are host-synchronous it waits for the forces of all ranks on the walls.
void Simulation::end_step() {
  bool const synchronous = host_synchronous();
  upload_state(synchronous);
  Kokkos::Timer const computing;
  enqueue_forces({});
  Kokkos::fence();
  ghosts_.add_busy_seconds(computing.seconds());
  if (!synchronous) {
    now_ = steps_.get();
  } else if (periodic()) {
    now_.end_step();
  } else {
    now_.end_step(in_range([&] { return wall_reactions(steps_, sums_); }));
  }
}

/// StepState::is_outdated() by the largest non-affine displacement of a disc since then.
/// @param x,y  where the discs were then
bool Simulation::are_displaced(ReferenceState& reference, Field<Coord> const& x, Field<Coord> const& y,
                               Real skin_fraction) const {
  AffineFrame const f = frame_since(now_.box, reference.box);
  return now_.is_outdated(reference, ranks().max(largest_nonaffine_displacement2(particles_, x, y, f)), skin_fraction);
}

void Simulation::evaluate_forces() {
  if (upkeep_.is_asked()) rebuild(rebuild_inputs_of_all());
  upload_state(true);
  count_turns_on(particles_);
  compute_forces(particles_, rows_, laws_.contact, 0, now_.step, broken_bonds_.log_of(steps_.state), losses_, faults_);
  if (periodic()) return;
  add_wall_forces(particles_, wall_contacts_, laws_.wall, 0, losses_, faults_, sums_.unit, steps_);
  now_.reactions = in_range([&] { return wall_reactions(steps_, sums_); });
}

}  // namespace clathra
