/// The time step: what the device is asked for, and what part the host has in it.
#include <algorithm>

#include "domain/simulation/neighbour_search.hpp"
#include "domain/simulation/simulation.hpp"

namespace clathra {

namespace {

constexpr int check_every = 64;  // steps between checks of the fault flags

/// Whether the host has a part in each step: for other ranks, images of discs, a search that somebody asked for.
bool host_synchronous(Assembly const& a) { return !a.ranks().alone() || a.periodic() || a.upkeep.is_asked(); }

/// Steps that the host need not look at, by what is known of them: when faults are looked for and when the time step is updated.
/// A GPU sees for itself how far the discs are displaced, and what was enqueued behind the step that has to search does nothing;
/// for a processor it is said when their displacements will have added up, if they go on as in the last step.
StepsAtOnce steps_at_once(Assembly const& a, TimeStepControl const& time_steps, std::int64_t most) {
  if (host_synchronous(a)) return {1, a.upkeep.is_asked()};
  StepState const& now = a.now;
  most = std::min({most, check_every - now.step % check_every, time_steps.steps_left()});
  Real until = 0;
  if constexpr (for_gpu) {
    constexpr Real beyond = 8;  // steps, that would not do to fall short of a search by a few
    Real const reach = a.upkeep.reach_in_skins(a.facts.largest_radius),
               displaced = now.at_search.displacement + now.at_search.closing(now.box()) * reach;
    until = static_cast<Real>(now.step - a.upkeep.last_search()) * (1 - displaced) / std::max(displaced, Real(1e-9)) + beyond;
  } else {
    Real left = 1 - now.at_search.displacement;
    if (time_steps.follows()) left = std::min(left, time_steps.skin_fraction() - now.at_update.displacement);
    until = 1 + left / now.relative_displacement;
  }
  bool const may_search = until < static_cast<Real>(most);
  if (may_search) most = static_cast<std::int64_t>(until);
  return {static_cast<int>(std::max<std::int64_t>(most, 1)), may_search};
}

/// StepState::is_outdated() by the largest non-affine displacement of a disc since then.
/// @param x,y  where the discs were then
bool are_displaced(Assembly const& a, ReferenceState& reference, Field<Coord> const& x, Field<Coord> const& y,
                   Real skin_fraction) {
  AffineFrame const f = frame_since(a.now.box(), reference.box);
  Real const share2 = a.ranks().max(largest_nonaffine_displacement2(a.particles, x, y, f));
  return a.now.is_outdated(reference, share2, skin_fraction);
}

}  // namespace

void Simulation::step(std::int64_t count, StepLimits const& limits) {
  StepState& now = assembly_.now;
  std::int64_t const last = now.step + count;
  now.orders.limits = limits;
  now.stop = StepStop::none;
  while (now.step < last && now.stop == StepStop::none) {
    if (time_steps_.follows() && (time_steps_.is_due() || assembly_.upkeep.is_asked())) update_time_step();
    advance(steps_at_once(assembly_, time_steps_, last - now.step));
    if (now.step % check_every == 0) assembly_.throw_if_unstable();
  }
}

/// Enqueues steps and waits for them. The host has no part in them unless steps are host-synchronous, which go one by one, or the
/// discs may be displaced too far: then the steps stop, the host sees to it and ends that step as its last.
void Simulation::advance(StepsAtOnce const& steps) {
  StepState& now = assembly_.now;
  bool const synchronous = host_synchronous(assembly_);
  std::int64_t const first = now.step;
  upload_state(synchronous);
  Kokkos::Timer const moving;
  if (synchronous)
    enqueue_motion(0, {});
  else
    enqueue_steps(steps.count);
  bool const has_rebuild_inputs = for_gpu && steps.may_search && assembly_.ranks().alone() && !assembly_.periodic();
  if (has_rebuild_inputs)
    enqueue_rebuild_inputs(assembly_.particles, assembly_.rows, assembly_.faults, assembly_.sums.unit, steps_,
                           synchronous ? StepLaunches() : graph_.behind());  // one wait for both
  now = steps_.get();
  assembly_.ghosts.add_busy_seconds(moving.seconds());
  time_steps_.after_steps(now.step - first, time_step);
  if (now.stop == StepStop::after_move) {
    end_move(has_rebuild_inputs);
    end_step();
  }
  assembly_.in_range([&] { require_reactions_in_range(now.out_of_range); });
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
  StepState& now = assembly_.now;
  now.orders.dt = time_step;
  now.orders.least_skin = assembly_.skins(false).least;
  now.orders.reach = assembly_.upkeep.reach_in_skins(assembly_.facts.largest_radius);
  now.orders.skin_fraction = time_steps_.skin_fraction();
  now.orders.follows_limit = time_steps_.follows();
  now.orders.host_synchronous = synchronous;
  now.stop = StepStop::none;
  now.out_of_range = 0;
  now.begin_step();
  steps_.set(now);
}

/// Kick and drift. @param ahead  steps that were enqueued since the last wait
void Simulation::enqueue_motion(int ahead, StepLaunches const& launches) {
  StepLengths const lengths = ahead == 0 ? time_steps_.lengths(time_step) : StepLengths{time_step, time_step};
  integrate(assembly_.particles, assembly_.laws.motion, lengths, assembly_.dissipation, assembly_.faults, steps_,
            time_steps_.places(), launches);
}

/// The forces at the places that the discs have come to: of their neighbours, then of the boundaries, the last of which ends the
/// step.
void Simulation::enqueue_forces(StepLaunches const& launches) {
  Assembly& a = assembly_;
  compute_forces(a.particles, a.rows, a.laws.contact, time_step, a.now.step + 1, a.broken.log_of(steps_.state), a.dissipation,
                 a.faults, steps_.state, launches);
  for (auto const& boundary : a.boundaries)
    boundary->enqueue_forces({a.particles, a.laws, time_step, a.dissipation, a.faults, a.sums.unit, steps_,
                              /*ends_step=*/boundary == a.boundaries.back(), launches});
}

/// The host's part between the move and the forces: a search, or the ghosts follow their discs.
/// @param has_rebuild_inputs  whether they were enqueued
void Simulation::end_move(bool has_rebuild_inputs) {
  Assembly& a = assembly_;
  StepState& now = a.now;
  if (now.orders.host_synchronous) {
    now.step_displacement = a.ranks().max(now.step_displacement);
    now.add_displacements();
  }
  bool const known = a.upkeep.is_asked() || now.search_is_due;
  if (!known && now.search_may_be_due)
    now.search_is_due = are_displaced(a, now.at_search, a.particles.reference_x, a.particles.reference_y, 1);
  if (a.upkeep.is_asked() || now.search_is_due) {
    rebuild(has_rebuild_inputs && known ? rebuild_inputs_of_all(a, enqueued_rebuild_inputs(now)) : rebuild_inputs_of_all(a));
    return;
  }
  a.refresh_ghosts();
  UpdatePlaces const& places = time_steps_.places();
  time_steps_.after_step(now.update_is_due || (now.update_may_be_due &&
                                               are_displaced(a, now.at_update, places.x, places.y, time_steps_.skin_fraction())));
}

/// The rest of a step after end_move(). Where steps are host-synchronous it waits for the forces of all ranks on the boundaries.
void Simulation::end_step() {
  Assembly& a = assembly_;
  bool const synchronous = host_synchronous(a);
  upload_state(synchronous);
  Kokkos::Timer const computing;
  enqueue_forces({});
  Kokkos::fence();
  a.ghosts.add_busy_seconds(computing.seconds());
  if (!synchronous) {
    a.now = steps_.get();
    return;
  }
  for (auto const& boundary : a.boundaries) a.in_range([&] { boundary->end_step(a.now, steps_, a.sums); });
  a.now.end_step();
}

void Simulation::evaluate_forces() {
  Assembly& a = assembly_;
  if (a.upkeep.is_asked()) rebuild(rebuild_inputs_of_all(a));
  upload_state(/*host_synchronous=*/true);
  count_turns_on(a.particles);
  compute_forces(a.particles, a.rows, a.laws.contact, 0, a.now.step, a.broken.log_of(steps_.state), a.dissipation, a.faults);
  for (auto const& boundary : a.boundaries) {
    boundary->enqueue_forces({a.particles, a.laws, 0, a.dissipation, a.faults, a.sums.unit, steps_, /*ends_step=*/false, {}});
    a.in_range([&] { boundary->read_reactions(a.now, steps_, a.sums); });
  }
}

}  // namespace clathra
