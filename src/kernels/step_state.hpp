#pragma once
/// What a step changes beside the discs, in the memory of the device: between steps nobody has to ask the host.
#include "kernels/exact_sum.hpp"
#include "kernels/moving_walls.hpp"
#include "kernels/step_limits.hpp"

namespace clathra {

/// The box when somebody looked at where the discs were, and how far they have been displaced since.
struct ReferenceState {
  Box box;
  Real displacement = 1e300;  ///< the largest since then, at most, beside the homogeneous motion, as a share of a skin

  /// What the homogeneous motion since then brings two discs nearer, relatively.
  KOKKOS_INLINE_FUNCTION Real closing(Box const& now) const { return frame_since(now, box).closing(); }
  /// Whether two discs whose gap was wider than a share of both their skins could touch: by their displacements, as a share of
  /// their skins, and what the homogeneous motion itself brings them nearer, as a share of the least skin.
  /// @param reach  of a pair, in skins;  @param skin_fraction  that share
  KOKKOS_INLINE_FUNCTION bool is_outdated(Box const& now, Real reach, Real skin_fraction) const {
    return displacement + closing(now) * reach >= skin_fraction;
  }
  /// Adds the displacement of a step. @return whether the sum could be a share of both their skins by which two discs were apart:
  /// then each disc's own displacement tells whether it is
  /// @param of_step  in least skins;  @param reach  of a pair, in skins;  @param skin_fraction  that share
  KOKKOS_INLINE_FUNCTION bool add_displacement(Box const& now, Real of_step, Real reach, Real skin_fraction) {
    Real const nearer = closing(now);
    displacement += of_step;
    return !(displacement * (1 + nearer) + nearer * reach < skin_fraction);
  }
};

/// Why steps that are under way stop: all kernels that follow do nothing until the host has looked.
enum class StepStop : int {
  none,
  after_move,   ///< the discs have moved and may be displaced too far, or the host asked for it: their forces are missing
  at_limit,     ///< box or stresses have come to where the host waits for them
  out_of_range  ///< a force on a wall is not finite or beyond all scale: the step has not ended
};

/// What the host says of the steps to come.
struct StepOrders {
  Real dt = 0;                   ///< [s]
  Real least_skin = 1;           ///< [m]
  Real reach = 0;                ///< of a pair, in skins
  Real skin_fraction = 1;        ///< that discs may be displaced by before the time step is updated
  StepLimits limits;             ///< beyond which steps stop
  bool follows_limit = false;    ///< whether the time step is ever updated
  bool host_synchronous = true;  ///< the host has a part in each step: other ranks, images of discs, a search
};

inline constexpr int numbers_of_rebuild_inputs = 15;

/// The largest of all discs.
struct LargestDisplacements {
  Real of_step = 0;        ///< [m], at least
  Real since_search2 = 0;  ///< (d / skin)^2 (largest_nonaffine_displacement2()), where somebody looks at it
  Real since_update2 = 0;  ///< likewise, since the last update of the time step
};

struct StepState {
  // The boundaries:
  MovingWalls walls;
  Box cell;       ///< a periodic one, in place of the walls
  Real time = 0;  ///< [s]
  std::int64_t step = 0;
  ReferenceState at_search, at_update;  ///< the last neighbour search, the last update of the time step
  StepOrders orders;
  AffineFrame frame;                                          ///< of the box as the next step moves it
  Real step_displacement = 0;                                 ///< at least the largest of a disc in the last step [m]
  Real relative_displacement = 0;                             ///< the same beside the homogeneous motion, at most, in least skins
  bool search_may_be_due = false, update_may_be_due = false;  ///< by sums of displacements, each disc's own are yet to be seen
  bool search_is_due = false, update_is_due = false;          ///< by each disc's own
  // On a GPU:
  AffineFrame frame_since_update;                                     ///< of the box as the next step moves it
  bool measures_since_search = false, measures_since_update = false;  ///< whether the next step looks at each disc's own
  StepStop stop = StepStop::none;
  std::int64_t out_of_range = 0;                                ///< terms of the forces on the walls
  std::int64_t rebuild_inputs[numbers_of_rebuild_inputs] = {};  ///< where a search is due (rebuild_inputs.hpp)

  KOKKOS_INLINE_FUNCTION bool periodic() const { return cell.periodic; }
  KOKKOS_INLINE_FUNCTION Box box() const { return periodic() ? cell : box_within(walls.place); }

  /// To be called before steps, and done by a step for the next one.
  KOKKOS_INLINE_FUNCTION void begin_step() {
    Walls next = walls.place;
    next.move(orders.dt);
    Box const moved = periodic() ? cell : box_within(next);
    frame = frame_since(moved, at_search.box);
    if constexpr (for_gpu) {
      frame_since_update = frame_since(moved, at_update.box);
      measures_since_search = may_be_due_after(at_search, moved, 1);
      measures_since_update = orders.follows_limit && may_be_due_after(at_update, moved, orders.skin_fraction);
    }
  }
  /// Whether after a step whose displacement is no more than twice that of the last one each disc's own may have to be seen.
  KOKKOS_INLINE_FUNCTION bool may_be_due_after(ReferenceState reference, Box const& moved, Real skin_fraction) const {
    return !orders.host_synchronous && reference.add_displacement(moved, 2 * relative_displacement, orders.reach, skin_fraction);
  }

  /// After kick and drift: the box has moved too.
  KOKKOS_INLINE_FUNCTION void end_move(LargestDisplacements const& largest_of) {
    step_displacement = largest_of.of_step;
    walls.place.move(orders.dt);
    if (orders.host_synchronous) {
      stop = StepStop::after_move;
      return;
    }
    add_displacements();
    if (search_may_be_due && measures_since_search)
      search_may_be_due = search_is_due = is_outdated(at_search, largest_of.since_search2, 1);
    if (!search_is_due && update_may_be_due && measures_since_update)
      update_may_be_due = update_is_due = is_outdated(at_update, largest_of.since_update2, orders.skin_fraction);
    if (search_may_be_due || update_may_be_due) stop = StepStop::after_move;
  }
  /// By each disc's own displacement. @param share2  (d / skin)^2 of the disc with the largest
  KOKKOS_INLINE_FUNCTION bool is_outdated(ReferenceState& reference, Real share2, Real skin_fraction) const {
    reference.displacement = lane_sqrt(share2);
    return reference.is_outdated(box(), orders.reach, skin_fraction);
  }
  /// Whether the displacements since the last search, and since the last update of the time step, may have become too large.
  KOKKOS_INLINE_FUNCTION void add_displacements() {
    Box const now = box();
    relative_displacement = (step_displacement + now.largest_speed * orders.dt) / orders.least_skin;
    search_may_be_due = at_search.add_displacement(now, relative_displacement, orders.reach, 1);
    update_may_be_due =
        orders.follows_limit && at_update.add_displacement(now, relative_displacement, orders.reach, orders.skin_fraction);
    search_is_due = update_is_due = false;
  }

  /// After the forces of all boundaries.
  KOKKOS_INLINE_FUNCTION void end_step() {
    time += orders.dt;
    ++step;
    begin_step();
    if (!orders.limits.hold(box(), walls.place, walls.reactions)) stop = StepStop::at_limit;
  }
};

/// Memory of the device for steps that nobody waits for.
struct DeviceSteps {
  Field<StepState> state = Field<StepState>("step_state", 1);
  decltype(Kokkos::create_mirror_view(Kokkos::HostSpace(), state)) on_host =
      Kokkos::create_mirror_view(Kokkos::HostSpace(), state);
  Kokkos::View<LargestDisplacements, MemorySpace> displacements =
      Kokkos::View<LargestDisplacements, MemorySpace>("largest_displacements");
  static constexpr std::size_t words_of_reactions = sum_words(3 * wall_count);
  Field<SumWord> reactions = Field<SumWord>("wall_reactions", words_of_reactions);
  /// Where a GPU sums them up, and the number of threads that have done so; zero between launches.
  Field<SumWord> sums_of_reactions = Field<SumWord>("sums_of_wall_reactions", words_of_reactions + 1);

  void set(StepState const& now) const {
    on_host(0) = now;
    Kokkos::deep_copy(state, on_host);
  }
  /// StepState::rebuild_inputs on the device.
  using Numbers = Kokkos::View<std::int64_t*, MemorySpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;
  Numbers rebuild_inputs() const { return Numbers(state.data()->rebuild_inputs, numbers_of_rebuild_inputs); }
  /// Waits for all that was enqueued.
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
