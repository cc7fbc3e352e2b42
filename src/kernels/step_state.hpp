#pragma once
/// What a step changes beside the discs, in the memory of the device: between steps nobody has to ask the host.
#include "kernels/exact_sum.hpp"
#include "kernels/loading.hpp"

namespace clathra {

/// The box when the discs were where somebody looked at them, and how far they have strayed since.
struct Mark {
  Box box;
  Real strayed = 1e300;  ///< at most, beside the homogeneous motion, as a share of a skin

  /// What the homogeneous motion since then brings two discs nearer, relatively.
  KOKKOS_INLINE_FUNCTION Real closing(Box const& now) const {
    AffineFrame const f = frame_since(now, box);
    return lane_max(lane_abs(1 - f.stretch_x), lane_abs(1 - f.stretch_y));
  }
  /// Whether two discs whose gap was wider than a share of both their skins could touch: by how far the discs have strayed, as a
  /// share of their skins, and what the homogeneous motion itself brings them nearer, as a share of the least skin.
  /// @param reach  of a pair, in skins;  @param leeway  that share
  KOKKOS_INLINE_FUNCTION bool has_strayed(Box const& now, Real reach, Real leeway) const {
    return strayed + closing(now) * reach >= leeway;
  }
  /// Adds the way of a step. @return whether ways could amount to a share of both their skins by which two discs were apart: then
  /// the discs' own ones tell whether they do
  /// @param way  in least skins;  @param reach  of a pair, in skins;  @param leeway  that share
  KOKKOS_INLINE_FUNCTION bool may_have_strayed(Box const& now, Real way, Real reach, Real leeway) {
    Real const nearer = closing(now);
    strayed += way;
    return !(strayed * (1 + nearer) + nearer * reach < leeway);
  }
};

/// Why steps that are under way stop: all kernels that follow do nothing until the host has looked.
enum class StepStop : int {
  none,
  after_move,   ///< the discs have moved and may have strayed too far, or the host asked for it: their forces are missing
  low_box,      ///< the box has become as low as the host waits for
  out_of_range  ///< a force on a wall is not finite or beyond all scale: the step has not ended
};

/// What the host says of the steps to come.
struct StepOrders {
  Real dt = 0;                  ///< [s]
  Real least_skin = 1;          ///< [m]
  Real reach = 0;               ///< of a pair, in skins
  Real leeway = 1;              ///< share of its skin that a disc may stray before dt is chosen anew
  Real height = 0;              ///< of the box, at which steps stop [m]
  bool follows_limit = false;   ///< whether dt is ever chosen anew
  bool host_goes_along = true;  ///< the host has a part in each step: other ranks, images of discs, a search
};

/// The largest sigma_y - sigma_x after any step since somebody asked [Pa], and the height of the box then [m].
struct LargestDeviator {
  Real q = -1e300, height = 0;
};

inline constexpr int numbers_of_survey = 15;

/// The longest of all discs.
struct Ways {
  Real of_step = 0;  ///< [m], at least
  Real search2 = 0;  ///< (d / skin)^2 since the last search (largest_nonaffine_displacement2()), where somebody looks at it
  Real choice2 = 0;  ///< since the last choice of dt
};

struct StepState {
  Box box;
  WallReactions reactions;
  Loading loading;
  Real time = 0, boundary_work = 0;  ///< [s], [J/m]
  LargestDeviator largest;
  std::int64_t step = 0;
  Mark search, choice;  ///< of the last neighbour search, of the last choice of dt
  StepOrders orders;
  AffineFrame frame;                                      ///< of the box as the next step moves it
  Real displacement = 0;                                  ///< at least the longest way of a disc in the last step [m]
  Real way = 0;                                           ///< of that step beside the homogeneous motion, at most, in least skins
  bool search_in_doubt = false, choice_in_doubt = false;  ///< which the discs' own ways have not settled
  bool search_is_due = false, choice_is_due = false;      ///< by the discs' own ways
  // On a GPU:
  AffineFrame frame_of_choice;                            ///< of the box as the next step moves it, since the last choice
  bool looks_at_search = false, looks_at_choice = false;  ///< the next step may leave a doubt: it measures the discs' own ways
  StepStop stop = StepStop::none;
  std::int64_t out_of_range = 0;                  ///< terms of the forces on the walls
  std::int64_t surveyed[numbers_of_survey] = {};  ///< where a search is due: what it has to know (survey.hpp)

  /// To be called before steps, and done by a step for the next one.
  KOKKOS_INLINE_FUNCTION void begin_step() {
    Box moved = box;
    moved.walls.move(orders.dt);
    frame = frame_since(moved, search.box);
    if constexpr (for_gpu) {
      frame_of_choice = frame_since(moved, choice.box);
      looks_at_search = may_be_in_doubt(search, moved, 1);
      looks_at_choice = orders.follows_limit && may_be_in_doubt(choice, moved, orders.leeway);
    }
  }
  /// Whether a step whose way is no more than twice that of the last one may leave a doubt.
  KOKKOS_INLINE_FUNCTION bool may_be_in_doubt(Mark mark, Box const& moved, Real leeway) const {
    return !orders.host_goes_along && mark.may_have_strayed(moved, 2 * way, orders.reach, leeway);
  }

  /// After kick and drift: the box has moved too.
  KOKKOS_INLINE_FUNCTION void end_move(Ways const& ways) {
    displacement = ways.of_step;
    box.walls.move(orders.dt);
    if (orders.host_goes_along) {
      stop = StepStop::after_move;
      return;
    }
    look_for_doubts();
    if (search_in_doubt && looks_at_search) search_in_doubt = search_is_due = settle(search, ways.search2, 1);
    if (!search_is_due && choice_in_doubt && looks_at_choice)
      choice_in_doubt = choice_is_due = settle(choice, ways.choice2, orders.leeway);
    if (search_in_doubt || choice_in_doubt) stop = StepStop::after_move;
  }
  /// Settles a doubt by the discs' own ways. @param share2  (d / skin)^2 of the disc that strayed most;  @return whether there
  /// was reason for it
  KOKKOS_INLINE_FUNCTION bool settle(Mark& mark, Real share2, Real leeway) const {
    mark.strayed = lane_sqrt(share2);
    return mark.has_strayed(box, orders.reach, leeway);
  }
  /// Whether the discs' ways since the last search, and since the last choice of dt, call for a closer look.
  KOKKOS_INLINE_FUNCTION void look_for_doubts() {
    Walls const& walls = box.walls;
    Real const of_frame = box.periodic() ? 0 : (walls.largest_speed(left, right) + walls.largest_speed(bottom, top)) * orders.dt;
    way = (displacement + of_frame) / orders.least_skin;
    search_in_doubt = search.may_have_strayed(box, way, orders.reach, 1);
    choice_in_doubt = orders.follows_limit && choice.may_have_strayed(box, way, orders.reach, orders.leeway);
    search_is_due = choice_is_due = false;
  }

  /// After the forces of the walls: books their work, keeps the largest deviator stress and steers them.
  KOKKOS_INLINE_FUNCTION void end_step(WallReactions const& now) {
    // The mean force over the step times the way: what leapfrog's kinetic energy sees to the digit.
    for (int wall = 0; wall < wall_count; ++wall) {
      Real const outward = wall == right || wall == top ? 1 : -1;
      boundary_work -= 0.5 * (reactions.normal[wall] + now.normal[wall]) * outward * box.walls.velocity[wall] * orders.dt;
    }
    reactions = now;
    WallStress const stress = wall_stress(box.walls, reactions);
    if (stress.y - stress.x > largest.q) largest = {stress.y - stress.x, box.height()};
    loading.steer(box.walls, stress, reactions, orders.dt);
    end_step();
  }
  /// The same in a periodic cell.
  KOKKOS_INLINE_FUNCTION void end_step() {
    time += orders.dt;
    ++step;
    begin_step();
    if (box.height() <= orders.height) stop = StepStop::low_box;
  }
};

/// Memory of the device for steps that nobody waits for.
struct DeviceSteps {
  Field<StepState> state = Field<StepState>("step_state", 1);
  decltype(Kokkos::create_mirror_view(Kokkos::HostSpace(), state)) on_host =
      Kokkos::create_mirror_view(Kokkos::HostSpace(), state);
  Kokkos::View<Ways, MemorySpace> ways = Kokkos::View<Ways, MemorySpace>("longest_ways");
  static constexpr std::size_t words_of_reactions = sum_words(3 * wall_count);
  Field<SumWord> reactions = Field<SumWord>("wall_reactions", words_of_reactions);
  /// Where a GPU sums them up, and the number of threads that have done so; zero between launches.
  Field<SumWord> sums_of_reactions = Field<SumWord>("sums_of_wall_reactions", words_of_reactions + 1);

  void set(StepState const& now) const {
    on_host(0) = now;
    Kokkos::deep_copy(state, on_host);
  }
  /// StepState::surveyed on the device.
  using Numbers = Kokkos::View<std::int64_t*, MemorySpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;
  Numbers surveyed() const { return Numbers(state.data()->surveyed, numbers_of_survey); }
  /// Waits for all that was asked for.
  StepState const& get() const {
    Kokkos::deep_copy(on_host, state);
    return on_host(0);
  }
};

/// In kernels of a step: whether they have nothing to do. @param state  of the steps, or empty for a kernel beside them
KOKKOS_INLINE_FUNCTION bool is_stopped(Field<StepState> const& state) {
  return state.extent(0) > 0 && state(0).stop != StepStop::none;
}

}  // namespace clathra
