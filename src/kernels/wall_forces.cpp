#include "kernels/wall_forces.hpp"

#include <algorithm>

namespace clathra {

namespace {

constexpr int reaction_count = 3 * wall_count;

using ReactionSums = ExactSums<reaction_count>;

struct ReactionUnits {
  Real of[reaction_count];
  explicit ReactionUnits(SumUnits const& unit) {
    for (int k = 0; k < reaction_count; ++k) of[k] = k < 2 * wall_count ? unit.force() : 1;
  }
};

KOKKOS_INLINE_FUNCTION WallReactions reactions_of(SumWord const* sums, Real unit_of_force) {
  WallReactions reactions;
  for (int wall = 0; wall < wall_count; ++wall) {
    reactions.normal[wall] = ReactionSums::total(sums, wall, unit_of_force);
    reactions.shear[wall] = ReactionSums::total(sums, wall_count + wall, unit_of_force);
    reactions.contacts[wall] = static_cast<int>(ReactionSums::total(sums, 2 * wall_count + wall, 1));
  }
  return reactions;
}

/// The discs of a group, side by side.
struct WallDiscs {
  int index[lane_count];
  Mask present;
  Lanes x, y, radius, vx, vy, omega;
};

/// The forces of up to four walls on the discs near them.
struct WallForces : ReactionSums {
  ParticleSoA p;
  WallContacts contacts;
  Field<StepState> steps;
  GrainLaw law;
  Real dt;
  Dissipation losses;
  Faults faults;
  Real unit_of_force;
  bool ends_step;

  /// Whether anybody asks how the discs move.
  KOKKOS_FORCEINLINE_FUNCTION bool needs_motion() const { return law.friction > 0 || law.damping_ratio > 0; }

  /// The discs along a wall lie far apart in memory; each would be waited for.
  KOKKOS_FORCEINLINE_FUNCTION void fetch_ahead(int c) const {
    constexpr int discs_ahead = 16;
    int const i = contacts.disc(c + discs_ahead < contacts.size ? c + discs_ahead : contacts.size - 1);
    for (auto const& field : {&p.x, &p.y, &p.radius}) prefetch(&(*field)(i));
    if (p.precision == Precision::mixed) {
      if (needs_motion()) prefetch(DiscMirror::numbers(p.mirror.motion) + static_cast<std::size_t>(i) * DiscMirror::row);
      for (auto const& field : {&p.force_x, &p.force_y}) prefetch(field->data<float>() + i);
    } else {
      for (auto const& field : {&p.vx, &p.vy, &p.omega, &p.force_x, &p.force_y}) prefetch(field->data<Real>() + i);
    }
  }

  /// The group from `first` on; in place of discs beyond the last one stands the last.
  KOKKOS_FORCEINLINE_FUNCTION WallDiscs discs(int first) const {
    WallDiscs d;
    for (int l = 0; l < lane_count; ++l) {
      fetch_ahead(first + l);
      d.index[l] = contacts.disc(first + l < contacts.size ? first + l : contacts.size - 1);
    }
    d.present = first_lanes<Real>(contacts.size - first);
    d.x = gather(p.x.data(), d.index);
    d.y = gather(p.y.data(), d.index);
    d.radius = gather(p.radius.data(), d.index);
    d.vx = d.vy = d.omega = Lanes(0);
    if (needs_motion()) {
      d.vx = gather(p.vx, d.index);
      d.vy = gather(p.vy, d.index);
      d.omega = gather(p.omega, d.index);
    }
    return d;
  }

  /// @param group  of discs near walls
  template <class Sums>
  KOKKOS_FUNCTION void operator()(int group, Sums reactions) const {
    if (!is_stopped(steps)) add_group(group, reactions);
  }
  template <class Sums>
  KOKKOS_FORCEINLINE_FUNCTION void add_group(int group, Sums reactions) const {
    Walls const walls = steps(0).walls.place;
    int const first = group * lane_count;
    WallDiscs const d = discs(first);
    for (int wall = 0; wall < wall_count; ++wall) {
      WallFace const face = wall_face(walls, wall, d.x, d.y);
      Lanes const overlap = d.radius - face.distance, old_shear = shear_before(first, wall);
      // A place that is no number is active too; integrate() finds it.
      Mask const active = d.present && !(overlap <= Lanes(0) && old_shear == Lanes(0));
      if (any(active)) add(first, d, wall, face, overlap, old_shear, active, reactions);
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION Lanes shear_before(int first, int wall) const {
    Lanes shear(0);
    if (contacts.shear.extent(0) == 0) return shear;
    for (int l = 0; l < lane_count && first + l < contacts.size; ++l) set_lane(shear, l, contacts.shear(first + l, wall));
    return shear;
  }

  /// Adds the forces of one wall.
  template <class Sums>
  KOKKOS_FORCEINLINE_FUNCTION void add(int first, WallDiscs const& d, int wall, WallFace<Lanes> const& face, Lanes const& overlap,
                                       Lanes const& old_shear, Mask const& active, Sums reactions) const {
    Real const nx = face.nx, ny = face.ny;
    Lanes const arm = d.radius - overlap, dvx = face.vx - d.vx, dvy = face.vy - d.vy;
    ContactMotion<Lanes> const motion{overlap, -(dvx * nx + dvy * ny), ((dvy * nx - dvx * ny) - d.omega * arm) * dt, Lanes(0),
                                      2 * d.radius};
    Lanes const dashpot = law.damping_ratio > 0 ? dashpot_coefficient(law, gather(p.inverse_mass, d.index), Lanes(0)) : Lanes(0);
    ContactForce<Lanes> const force = grain_contact<false>(law, motion, old_shear, Lanes(0), dashpot);
    Lanes const fx = -(force.normal * nx + force.shear * ny), fy = force.shear * nx - force.normal * ny,
                torque = arm * force.shear;
    for_each_set(active, [&](int l) {
      int const i = d.index[l];
      p.force_x.add(i, lane(fx, l));
      p.force_y.add(i, lane(fy, l));
      p.torque.add(i, lane(torque, l));
      if (contacts.shear.extent(0) > 0) contacts.shear(first + l, wall) = lane(force.shear, l);
    });
    for_each_set(active && overlap > d.radius, [&](int l) { faults.report(Fault::deep_overlap, p.id(d.index[l])); });
    add_dissipation(d, motion, old_shear, force, active);
    Lanes const on_wall = force.shear * Lanes(nx != 0 ? -nx : ny);  // opposite to the force on the disc
    ReactionSums::add(wall, select(active, force.normal, Lanes(0)), reactions);
    if (contacts.shear.extent(0) > 0) ReactionSums::add(wall_count + wall, select(active, on_wall, Lanes(0)), reactions);
    reactions[2 * wall_count + wall] += count_set(active && overlap > Lanes(0));
  }

  /// As between grains, but all of it on the disc's account.
  KOKKOS_FORCEINLINE_FUNCTION void add_dissipation(WallDiscs const& d, ContactMotion<Lanes> const& motion, Lanes const& old_shear,
                                                   ContactForce<Lanes> const& now, Mask const& active) const {
    if (law.friction > 0 && losses.sliding.extent(0) > 0) {
      Lanes const slid = motion.shear_increment + (old_shear - now.shear) / law.shear_stiffness;
      Lanes const lost = 0.5 * (old_shear + now.shear) * slid;
      for_each_set(active, [&](int l) { losses.sliding(d.index[l]) += lane(lost, l); });
    }
    if (law.damping_ratio > 0 && losses.dashpot.extent(0) > 0) {
      Lanes const lost = dashpot_loss(law, motion, now.normal, dt);
      for_each_set(active, [&](int l) { losses.dashpot(d.index[l]) += lane(lost, l); });
    }
  }

  /// Called once, when all are done.
  KOKKOS_FUNCTION void final(SumWord* sums) const {
    StepState& now = steps(0);
    if (now.stop != StepStop::none || now.orders.host_synchronous) return;
    now.out_of_range = out_of_range(sums);
    if (now.out_of_range > 0) {
      now.stop = StepStop::out_of_range;
      return;
    }
    now.walls.after_forces(reactions_of(sums, unit_of_force), now.orders.dt);
    if (ends_step) now.end_step();
  }
};

/// The same for a GPU, whose tree of sums would take longer than all the rest of a small specimen's step: the few discs near
/// walls add to shared words, and the thread that is the last to have done so ends the step.
struct WallForcesToShared {
  WallForces forces;
  Field<SumWord> sums, reactions;
  int threads;

  KOKKOS_FUNCTION void operator()(int group) const {
    if (is_stopped(forces.steps)) return;
    if (group * lane_count < forces.contacts.size) forces.add_group(group, SharedSums{sums.data()});
    Kokkos::memory_fence();
    SumWord& done = sums(DeviceSteps::words_of_reactions);
    if (Kokkos::atomic_fetch_add(&done, SumWord(1)) + 1 < threads) return;
    Kokkos::memory_fence();
    done = 0;
    for (std::size_t k = 0; k < DeviceSteps::words_of_reactions; ++k)
      reactions(k) = Kokkos::atomic_exchange(&sums(k), SumWord(0));
    forces.final(reactions.data());
  }
};

/// Lists the discs within twice their skin of a wall, and behind the last disc writes how many there are.
struct FindNearWalls {
  ParticleSoA p;
  Walls walls;
  Field<int> disc;
  Field<std::int64_t> number;
  KOKKOS_FUNCTION void operator()(int i, int& place, bool const final) const {
    if (i == p.owned) {
      if (final) number(0) = place;
      return;
    }
    Real nearest = -1e300;
    for (int wall = 0; wall < wall_count; ++wall)
      nearest = lane_max(nearest, p.radius(i) - wall_face(walls, wall, p.x(i), p.y(i)).distance);
    if (nearest < -2 * p.verlet_skin(i)) return;
    if (final) disc(place) = i;
    ++place;
  }
};

struct ClearShear {
  WallShear shear;
  KOKKOS_FUNCTION void operator()(int i) const {
    for (auto const& field : shear.of) field(i) = 0;
  }
};

struct SpreadShear {
  WallContacts contacts;
  WallShear shear;
  KOKKOS_FUNCTION void operator()(int c) const {
    for (int wall = 0; wall < wall_count; ++wall) shear.of[wall](contacts.disc(c)) = contacts.shear(c, wall);
  }
};

struct CollectShear {
  WallContacts contacts;
  WallShear shear;
  KOKKOS_FUNCTION void operator()(int c) const {
    for (int wall = 0; wall < wall_count; ++wall) contacts.shear(c, wall) = shear.of[wall](contacts.disc(c));
  }
};

}  // namespace

WallShear wall_shear_of_discs(ParticleSoA const& particles, WallContacts const& contacts, Scratch& scratch) {
  WallShear shear;
  if (contacts.shear.extent(0) == 0 && !contacts.rough) return shear;
  for (auto& field : shear.of) field = scratch.take<Real>("wall_shear_of_discs", particles.x.extent(0));
  Kokkos::parallel_for("clear_wall_shear", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(particles.x.extent(0))),
                       ClearShear{shear});
  Kokkos::parallel_for("spread_wall_shear", Kokkos::RangePolicy<ExecutionSpace>(0, contacts.size), SpreadShear{contacts, shear});
  return shear;
}

Field<int> list_near_walls(ParticleSoA const& particles, Walls const& walls, Field<std::int64_t> const& number,
                           Scratch& scratch) {
  Field<int> const near = scratch.take<int>("near_walls", static_cast<std::size_t>(particles.owned));
  Kokkos::parallel_scan("find_near_walls", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned + 1),
                        FindNearWalls{particles, walls, near, number});
  return near;
}

WallContacts make_wall_contacts(Field<int> const& near, int size, bool friction, WallShear const& shear, Scratch& scratch) {
  WallContacts found;
  found.size = size;
  found.disc = near;
  found.rough = friction;
  if (!friction) return found;
  auto const contacts = static_cast<std::size_t>(size);
  found.history = scratch.take<Real>("wall_shear", wall_count * contacts);
  found.shear = decltype(found.shear)(found.history.data(), contacts);
  if (shear.of[0].extent(0) > 0)
    Kokkos::parallel_for("collect_wall_shear", Kokkos::RangePolicy<ExecutionSpace>(0, size), CollectShear{found, shear});
  else
    Kokkos::deep_copy(found.history, 0);
  return found;
}

void add_wall_forces(ParticleSoA const& particles, WallContacts const& contacts, WallLaw const& law, Real dt,
                     Dissipation const& losses, Faults const& faults, SumUnits const& unit, DeviceSteps const& steps,
                     bool ends_step, StepLaunches const& launches) {
  WallForces const forces = uncounted([&] {
    return WallForces{ReactionSums(ReactionUnits(unit).of),
                      particles,
                      contacts,
                      steps.state,
                      law.as_grain(),
                      dt,
                      losses,
                      faults,
                      unit.force(),
                      ends_step};
  });
  int const groups = group_count(contacts.size);
  if constexpr (for_gpu) {
    int const threads = std::max(groups, 1);  // the step ends without discs near walls, too
    launches.parallel_for("wall_forces", threads, WallForcesToShared{forces, steps.sums_of_reactions, steps.reactions, threads});
  } else {
    launches.parallel_reduce("wall_forces", groups, forces, steps.reactions);
  }
}

WallReactions wall_reactions(DeviceSteps const& steps, Summation const& summation) {
  auto const here = host_copy(steps.reactions);
  SumWord words[ReactionSums::words];
  std::copy(here.data(), here.data() + ReactionSums::words, words);
  ReactionSums::add_other_ranks(words, summation.over_ranks);
  require_reactions_in_range(ReactionSums::out_of_range(words));
  return reactions_of(words, summation.unit.force());
}

void require_reactions_in_range(std::int64_t out_of_range) { require_in_range("wall_forces", out_of_range); }

}  // namespace clathra
