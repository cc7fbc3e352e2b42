#include "kernels/walls.hpp"

#include <algorithm>

#include "kernels/light_launch.hpp"

namespace clathra {

namespace {

constexpr int reaction_count = 3 * wall_count;

/// Adds the forces of up to four walls to one disc; its terms are the reactions.
struct WallForces {
  ParticleSoA p;
  WallContacts contacts;
  Field<StepState> steps;
  GrainLaw law;
  Real dt;
  EnergyLosses losses;
  Faults faults;

  /// The discs along a wall lie far apart in memory; each would be waited for.
  KOKKOS_FORCEINLINE_FUNCTION void fetch_ahead(int c) const {
    constexpr int discs_ahead = 16;
    int const i = contacts.disc(c + discs_ahead < contacts.size ? c + discs_ahead : contacts.size - 1);
    for (auto const& field : {&p.x, &p.y, &p.radius}) prefetch(&(*field)(i));
    if (p.precision == Precision::mixed) {
      prefetch(p.mirror.numbers() + static_cast<std::size_t>(i) * DiscMirror::row);
      for (auto const& field : {&p.force_x, &p.force_y}) prefetch(field->data<float>() + i);
    } else {
      for (auto const& field : {&p.vx, &p.vy, &p.omega, &p.force_x, &p.force_y}) prefetch(field->data<Real>() + i);
    }
  }

  KOKKOS_FUNCTION void operator()(int c, Real* reactions) const {
    if (is_stopped(steps)) return;
    Walls const walls = steps(0).box.walls;
    fetch_ahead(c);
    int const i = contacts.disc(c);
    bool const friction = contacts.shear.extent(0) > 0;
    for (int wall = 0; wall < wall_count; ++wall) {
      WallFace const face = wall_face(walls, wall, p.x(i), p.y(i));
      Real const overlap = p.radius(i) - face.distance, old_shear = friction ? contacts.shear(c, wall) : 0;
      if (overlap <= 0 && old_shear == 0) continue;
      Real const nx = face.nx, ny = face.ny, arm = p.radius(i) - overlap;
      Real const dvx = face.vx - p.vx(i), dvy = face.vy - p.vy(i);
      ContactMotion<Real> const motion{overlap, -(dvx * nx + dvy * ny), ((dvy * nx - dvx * ny) - p.omega(i) * arm) * dt, 0,
                                       2 * p.radius(i)};
      Real const dashpot = law.damping_ratio > 0 ? dashpot_coefficient(law, p.inverse_mass(i), Real(0)) : 0;
      ContactForce<Real> const force = grain_contact<false>(law, motion, old_shear, Real(0), dashpot);
      if (friction) contacts.shear(c, wall) = force.shear;
      add_losses(i, motion, old_shear, force);
      if (overlap > p.radius(i)) faults.report(Fault::deep_overlap, p.id(i));
      p.force_x.add(i, -(force.normal * nx + force.shear * ny));
      p.force_y.add(i, force.shear * nx - force.normal * ny);
      p.torque.add(i, arm * force.shear);
      reactions[wall] = force.normal;
      reactions[wall_count + wall] = force.shear * (nx != 0 ? -nx : ny);  // on the wall: opposite to the force on the disc
      reactions[2 * wall_count + wall] = overlap > 0 ? 1 : 0;
    }
  }

  /// As between grains, but all of it on the disc's account.
  KOKKOS_INLINE_FUNCTION void add_losses(int i, ContactMotion<Real> const& motion, Real old_shear,
                                         ContactForce<Real> const& now) const {
    if (law.friction > 0 && losses.sliding.extent(0) > 0) {
      Real const slid = motion.shear_increment + (old_shear - now.shear) / law.shear_stiffness;
      losses.sliding(i) += 0.5 * (old_shear + now.shear) * slid;
    }
    if (law.damping_ratio > 0 && losses.dashpot.extent(0) > 0) losses.dashpot(i) += dashpot_loss(law, motion, now.normal, dt);
  }
};

using ReactionSums = ExactSumKernel<reaction_count, WallForces>;

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

/// The forces of the walls, and with them the end of the step.
struct EndOfStep : ReactionSums {
  Real unit_of_force;
  EndOfStep(WallForces const& forces, SumUnits const& unit)
      : ReactionSums(forces, ReactionUnits(unit).of), unit_of_force(unit.force()) {}

  /// Called once, when all are done.
  KOKKOS_FUNCTION void final(SumWord* sums) const {
    StepState& now = terms.steps(0);
    if (now.stop != StepStop::none || now.orders.host_goes_along) return;
    now.out_of_range = out_of_range(sums);
    if (now.out_of_range > 0) {
      now.stop = StepStop::out_of_range;
    } else {
      now.end_step(reactions_of(sums, unit_of_force));
    }
  }
};

/// Lists the discs within twice their skin of a wall, and behind the last disc writes how many there are.
struct FindNearWalls {
  ParticleSoA p;
  Walls walls;
  Field<int> disc;
  Field<std::int64_t> number;
  KOKKOS_FUNCTION void operator()(int i, int& slot, bool const final) const {
    if (i == p.owned) {
      if (final) number(0) = slot;
      return;
    }
    Real nearest = -1e300;
    for (int wall = 0; wall < wall_count; ++wall)
      nearest = lane_max(nearest, p.radius(i) - wall_face(walls, wall, p.x(i), p.y(i)).distance);
    if (nearest < -2 * p.verlet_skin(i)) return;
    if (final) disc(slot) = i;
    ++slot;
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
                     EnergyLosses const& losses, Faults const& faults, SumUnits const& unit, DeviceSteps const& steps) {
  WallForces const forces{particles, contacts, steps.state, law.as_grain(), dt, losses, faults};
  static_assert(sizeof(EndOfStep) <= most_bytes_of_a_light_kernel);
  Kokkos::parallel_reduce("wall_forces", light_launch(contacts.size), EndOfStep(forces, unit), steps.reactions);
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
