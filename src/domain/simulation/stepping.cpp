/// The time step: what is asked of the device, and what part the host has in it.
#include <algorithm>

#include "domain/simulation/simulation.hpp"

namespace clathra {

namespace {

constexpr int check_every = 64;  // steps between checks of the fault flags
constexpr int most_steps_of_a_choice = 1000;

}  // namespace

void Simulation::step(std::int64_t count, Real until_height) {
  std::int64_t const last = now_.step + count;
  now_.orders.height = until_height;
  now_.stop = StepStop::none;
  while (now_.step < last && now_.stop == StepStop::none) {
    if (following_.on && (following_.due || rebuild_pending_)) renew_time_step();
    advance(steps_at_once(last - now_.step));
    if (now_.step % check_every == 0) throw_if_unstable();
  }
}

/// Steps that the host need not look at, by what is known of them: when faults are looked for and when the step is chosen anew.
/// A GPU sees for itself how far the discs have strayed, and what it was asked for after the step that has to search does
/// nothing; for a processor it is said when their ways will have added up, if they go on as in the last step.
Simulation::StepsAtOnce Simulation::steps_at_once(std::int64_t most) const {
  if (host_goes_along()) return {1, rebuild_pending_};
  most = std::min(most, check_every - now_.step % check_every);
  if (following_.on) most = std::min(most, most_steps_of_a_choice - following_.age);
  Real until = 0;
  if constexpr (for_gpu) {
    constexpr Real beyond = 8;  // steps, that would not do to fall short of a search by a few
    Real const strayed = now_.search.strayed + now_.search.closing(now_.box) * reach_in_skins();
    until = static_cast<Real>(now_.step - searched_at_) * (1 - strayed) / std::max(strayed, Real(1e-9)) + beyond;
  } else {
    Real ways = 1 - now_.search.strayed;
    if (following_.on) ways = std::min(ways, following_.leeway - now_.choice.strayed);
    until = 1 + ways / now_.way;
  }
  bool const may_search = until < static_cast<Real>(most);
  if (may_search) most = static_cast<std::int64_t>(until);
  return {static_cast<int>(std::max<std::int64_t>(most, 1)), may_search};
}

/// Asks for steps and waits for them. The host has no part in them unless it goes along, which it does one step at a time, or the
/// discs may have strayed too far: then the steps stop, the host sees to it and ends that step as its last.
void Simulation::advance(StepsAtOnce const& steps) {
  bool const along = host_goes_along();
  std::int64_t const first = now_.step;
  hand_over(along);
  Kokkos::Timer const moving;
  if (along)
    move_discs(0, {});
  else
    ask_for(steps.count);
  bool const surveys = for_gpu && steps.may_search && ranks_.alone() && !periodic();
  if (surveys)
    ask_for_survey(particles_, rows_, faults_, sums_.unit, steps_,
                   along ? StepLaunches() : graph_.behind());  // one wait for both
  now_ = steps_.get();
  busy_seconds_ += moving.seconds();
  following_.last = time_step;
  if (following_.on) {
    following_.age += now_.step - first;
    following_.due = following_.age >= most_steps_of_a_choice;
  }
  if (now_.stop == StepStop::after_move) {
    end_move(surveys);
    end_step();
  }
  in_range([&] { require_reactions_in_range(now_.out_of_range); });
}

/// Asks for whole steps, many at once where there are graphs.
void Simulation::ask_for(int steps) {
  graph_.follow(time_step);
  graph_.ask_for(steps, [this](StepLaunches const& launches, int ahead) {
    move_discs(ahead, launches);
    push_discs(launches);
  });
}

/// The state of the steps to the device, with what has been set since it came from there.
void Simulation::hand_over(bool host_goes_along) {
  now_.orders.dt = time_step;
  now_.orders.least_skin = skin_range(false).least;
  now_.orders.reach = reach_in_skins();
  now_.orders.leeway = following_.leeway;
  now_.orders.follows_limit = following_.on;
  now_.orders.host_goes_along = host_goes_along;
  now_.stop = StepStop::none;
  now_.out_of_range = 0;
  now_.begin_step();
  steps_.set(now_);
}

/// Kick and drift. @param ahead  steps that were asked for since the last wait
void Simulation::move_discs(int ahead, StepLaunches const& launches) {
  bool const changed = ahead == 0 && following_.last > 0;
  StepLengths const lengths{changed ? 0.5 * (following_.last + time_step) : time_step, time_step};
  integrate(particles_, laws_.motion, lengths, losses_, faults_, steps_, {step_x_, step_y_}, launches);
}

/// The forces at the places that the discs have come to, and the end of the step.
void Simulation::push_discs(StepLaunches const& launches) {
  compute_forces(particles_, rows_, laws_.contact, time_step, now_.step + 1, broken_bonds_.log_of(steps_.state), losses_, faults_,
                 steps_.state, launches);
  if (!periodic())
    add_wall_forces(particles_, wall_contacts_, laws_.wall, time_step, losses_, faults_, sums_.unit, steps_, launches);
}

/// The host's part between the move and the forces: a search, or the ghosts follow their discs.
/// @param surveyed  whether the device was asked for a survey
void Simulation::end_move(bool surveyed) {
  if (now_.orders.host_goes_along) {
    now_.displacement = ranks_.max(now_.displacement);
    now_.look_for_doubts();
  }
  bool const known = rebuild_pending_ || now_.search_is_due;
  if (!known && now_.search_in_doubt)
    now_.search_is_due = have_strayed(now_.search, particles_.reference_x, particles_.reference_y, 1);
  if (rebuild_pending_ || now_.search_is_due) {
    rebuild(surveyed && known ? checked(survey_of(now_)) : survey_discs());
    return;
  }
  refresh_ghosts();
  if (following_.on)
    following_.due = ++following_.age >= most_steps_of_a_choice || now_.choice_is_due ||
                     (now_.choice_in_doubt && have_strayed(now_.choice, step_x_, step_y_, following_.leeway));
}

/// The rest of a step after end_move(). Where the host goes along it waits for the forces of all ranks on the walls.
void Simulation::end_step() {
  bool const along = host_goes_along();
  hand_over(along);
  Kokkos::Timer const pushing;
  push_discs({});
  Kokkos::fence();
  busy_seconds_ += pushing.seconds();
  if (!along) {
    now_ = steps_.get();
  } else if (periodic()) {
    now_.end_step();
  } else {
    now_.end_step(in_range([&] { return wall_reactions(steps_, sums_); }));
  }
}

/// StepState::settle() by the largest non-affine displacement of a disc since then.
/// @param x,y  where the discs were then
bool Simulation::have_strayed(Mark& mark, Field<Coord> const& x, Field<Coord> const& y, Real leeway) const {
  AffineFrame const f = frame_since(now_.box, mark.box);
  return now_.settle(mark, ranks_.max(largest_nonaffine_displacement2(particles_, x, y, f)), leeway);
}

void Simulation::evaluate_forces() {
  if (rebuild_pending_) rebuild(survey_discs());
  hand_over(true);
  count_turns_on(particles_);
  compute_forces(particles_, rows_, laws_.contact, 0, now_.step, broken_bonds_.log_of(steps_.state), losses_, faults_);
  if (periodic()) return;
  add_wall_forces(particles_, wall_contacts_, laws_.wall, 0, losses_, faults_, sums_.unit, steps_);
  now_.reactions = in_range([&] { return wall_reactions(steps_, sums_); });
}

}  // namespace clathra
