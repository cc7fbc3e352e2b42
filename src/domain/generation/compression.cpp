#include "domain/generation/compression.hpp"

#include <cmath>
#include <utility>

#include "domain/scene/short_number.hpp"

namespace clathra {

namespace {

constexpr double void_reserve = 0.01;  // in void ratio: what is left to close with grains as stiff as the scene's
constexpr double far_off = 0.02;       // in void ratio: too loose to be held where it did not resist
constexpr double least_share = 1e-4;   // of the friction
constexpr double flowing_modulus = 0.4, resting_modulus = 0.3;  // stress for a strain of its area, over k_n
// Inertial numbers: while discs hardly touch, of the fall of the height alone, of the closing of soft grains, and of that of the
// scene's; and a cap on the walls' own speed. At five times the first some of 200,000 discs met nearly centre to centre. Half the
// second and third of these change nothing in coordination, fabric and void ratios of layers (40 specimens of 1,500 discs).
constexpr double loose_rate = 0.015, vertical_rate = 5e-3, soft_rate = 5e-4, last_rate = 6e-4, wall_rate = 1e-4;

std::string digits(double value) { return short_number(value, 4); }

double mean_inside(Simulation const& simulation) {
  WallStress const stress = stress_inside(simulation);
  return 0.5 * (stress.x + stress.y);
}

/// An assembly on its way.
struct PartlyClosed {
  Specimen specimen;
  GenerationFriction friction;
  double lowest_share = 1;  ///< of the friction, so far
  double strain = 0;        ///< linear, by which grains softer than the scene's are pressed into each other
  bool blocked = false;     ///< resists without friction
};

class Compression {
 public:
  Compression(Scene const& scene, SpecimenDesign const& design, ProgressCallback const& progress, Ranks const& ranks)
      : scene_(scene), design_(design), progress_(progress), ranks_(ranks) {}

  /// @throws VoidRatioMissed, Refused
  PackedSpecimen run(Specimen const& loose) {
    return slower_where_it_fails([&](int slowness) {
      slowness_ = slowness;
      return close_and_rest(loose);
    });
  }

 private:
  PackedSpecimen close_and_rest(Specimen const& loose) {
    PartlyClosed const near = stiffened(close_softly({loose, generation_friction(wanted_)}));
    constexpr int most_attempts = 4;
    double goal = wanted_;
    for (int attempt = 1;; ++attempt) {
      PartlyClosed closed = closed_to(goal, near);
      PackedSpecimen packed = at_rest(closed);
      double const error = packed.specimen.void_ratio - wanted_;
      if (std::abs(error) <= void_tolerance) return packed;
      bool const hopeless = closed.blocked || (closed.lowest_share == 1 && error < -far_off);
      if (attempt == most_attempts || hopeless) refuse(packed.specimen.void_ratio, closed.friction);
      goal -= error;
    }
  }

  [[noreturn]] void refuse(double reached, GenerationFriction const& friction) const {
    bool const denser = reached > wanted_;
    std::string const held =
        "with a friction of " + digits(friction.friction) + " and a rolling width factor of " + digits(friction.shape_factor);
    throw VoidRatioMissed("under " + digits(stress_ / 1e3) + " kPa these grains came to rest at a void ratio of " +
                              digits(reached) + (denser ? " without friction: looser" : " " + held + ": denser") + " than the " +
                              digits(wanted_) + " that was asked for",
                          reached, denser);
  }

  /// How a part of the closing goes on.
  struct Part {
    double goal;                    ///< void ratio, with what overlaps take away
    double inertial_number;         ///< of its rate near the goal
    double softness = 0;            ///< void ratio that overlaps take away, over the stress [1/Pa]
    bool vertical = false;          ///< by the height alone
    bool until_it_resists = false;  ///< beyond the goal where it does not there
  };

  /// Closes, ever slower towards the goal, so that the assembly arrives at rest: the force network of a flowing assembly would
  /// collapse once it stops. The friction is the servo of the stress here: too much stress, less friction.
  template <class Laws>
  void close(Simulation& simulation, PartlyClosed& a, Part const& part, Laws const& laws) {
    constexpr double loose_margin = 0.1;     // in void ratio: further above, far from touching all over, it may close much faster
    constexpr double slowing_range = 0.004;  // in void ratio
    constexpr double scarce_friction = 0.1;  // share below which discs find denser places if given time
    constexpr double least_resistance = 0.05;  // of the stress
    double const full_rate =
        strain_rate_of(part.inertial_number / slowness_, stress_, simulation.assembly().facts.moving_density(), d50_);
    simulation.evaluate_forces();
    double stress = mean_inside(simulation);
    auto const above = [&] {
      return simulation.assembly().void_ratio() + part.softness * std::min(stress, 1.5 * stress_) - part.goal;
    };
    auto const on_its_way = [&] { return above() > 1e-5 || (part.until_it_resists && stress < least_resistance * stress_); };
    while (on_its_way() && !a.blocked) {
      double const far = std::clamp(above() > 0 ? (above() - loose_margin) / 0.2 : (-above() - far_off) / 0.1, 0.0, 1.0),
                   hurry = 1 + far * (slowness_ * loose_rate / part.inertial_number - 1);
      double const rate = full_rate * hurry * std::clamp(std::abs(above()) / slowing_range, 0.1, 1.0) *
                          std::clamp(2 * stress_ / std::max(stress, stress_), 0.05, 1.0) *
                          std::clamp(a.friction.share / scarce_friction, 0.1, 1.0);
      double const strain = rate * steering * simulation.time_step;
      close_together(simulation, {part.vertical ? 0 : strain, strain}, {stress, stress});
      simulation.step(steering);
      stress = mean_inside(simulation);
      double const excess = std::clamp(stress / stress_ - 1, -1.0, 2.0);
      a.friction.share = std::clamp(a.friction.share * (1 - 0.02 * excess), least_share, 1.0);
      a.lowest_share = std::min(a.lowest_share, a.friction.share);
      simulation.set_laws(laws(a.friction));
      a.blocked = a.friction.share <= least_share && stress > 4 * stress_;
      if (simulation.assembly().steps() % 1000 == 0) tell(simulation);
    }
  }

  /// With soft grains to the reserve above the target, what their overlaps take away counted in.
  PartlyClosed close_softly(PartlyClosed a) {
    auto const laws = [&](GenerationFriction const& friction) {
      return flowing_laws(generation_laws(scene_, friction), stress_, design_.grading);
    };
    Simulation simulation(a.specimen, laws(a.friction), skin_, ranks_);
    prepare_servo(simulation, stress_, wall_rate, d50_, StepChoice{});
    auto const modulus = [](double normal_stiffness) { return flowing_modulus * normal_stiffness; };
    // Area strain that the soft grains' overlaps take away beyond those of the scene's, over the stress.
    double const give =
        1 / modulus(simulation.assembly().laws.contact.grain.normal_stiffness) - 1 / modulus(scene_.grains.normal_stiffness);
    close(simulation, a, {wanted_ + unjammed, vertical_rate, 0, true}, laws);
    a.blocked = false;
    close(simulation, a, {wanted_ + void_reserve, soft_rate, (1 + wanted_) * give}, laws);
    a.blocked = false;  // soft grains may have been
    a.strain = 0.5 * give * mean_inside(simulation);
    simulation.stop_discs();
    a.specimen = simulation.specimen();
    disc_steps_ += simulation.assembly().steps() * simulation.assembly().discs();
    return a;
  }

  /// The same discs, just no longer pressed into each other, so that grains as stiff as the scene's can take over.
  static PartlyClosed stiffened(PartlyClosed a) {
    Specimen& s = a.specimen;
    auto const stretched = [&](double at, double from) { return from + (1 + a.strain) * (at - from); };
    for (double& x : s.x) x = stretched(x, s.left);
    for (double& y : s.y) y = stretched(y, s.bottom);
    s.right = stretched(s.right, s.left);
    s.top = stretched(s.top, s.bottom);
    s.contacts = {};
    return a;
  }

  PartlyClosed closed_to(double goal, PartlyClosed a) {
    auto const laws = [&](GenerationFriction const& friction) { return closing_laws(scene_, friction, design_.grading); };
    Simulation simulation(a.specimen, laws(a.friction), skin_, ranks_);
    prepare_servo(simulation, stress_, wall_rate, d50_, StepChoice{});
    // The void ratio is that at the stress of the design, whatever is left of it or too much where the closing ends.
    double const softness = (1 + wanted_) / (resting_modulus * scene_.grains.normal_stiffness);
    close(simulation, a, {goal + softness * stress_, last_rate, softness, false, true}, laws);
    a.specimen = simulation.specimen();
    disc_steps_ += simulation.assembly().steps() * simulation.assembly().discs();
    return a;
  }

  /// With the full friction back the assembly creeps no further. Most of the way to rest its small discs are heavier. One
  /// simulation at a time is in memory. @param closed  loses its discs
  PackedSpecimen at_rest(PartlyClosed& closed) {
    GenerationFriction full = closed.friction;
    full.share = 1;
    auto const calm = [&] {
      Simulation calming(std::exchange(closed.specimen, {}), closing_laws(scene_, full, design_.grading), skin_, ranks_);
      bring_to_rest(calming, full);
      return calming.specimen();
    };
    Simulation resting(calm(), generation_laws(scene_, full), skin_, ranks_);
    bring_to_rest(resting, full);
    PackedSpecimen packed = packed_at_rest(resting, stress_, closed.friction, closed.lowest_share);
    packed.disc_steps = disc_steps_;
    return packed;
  }

  void bring_to_rest(Simulation& simulation, GenerationFriction const& friction) {
    ProgressCallback const counted = [&](Progress p) {
      p.disc_steps += disc_steps_;
      return !progress_ || progress_(p);
    };
    prepare_servo(simulation, stress_, wall_rate, d50_, StepChoice{});
    if (!settle(simulation, stress_, rest_of_specimens, most_steps_to_rest, counted)) {
      if (std::abs(simulation.assembly().void_ratio() - wanted_) > void_tolerance)
        refuse(simulation.assembly().void_ratio(), friction);
      throw Refused(text_of_unrest(simulation, stress_));
    }
    disc_steps_ += simulation.assembly().steps() * simulation.assembly().discs();
  }

  void tell(Simulation const& simulation) const {
    report(progress_, {"generate", 0.7, "void ratio " + digits(simulation.assembly().void_ratio()) + " -> " + digits(wanted_),
                       disc_steps_ + simulation.assembly().steps() * simulation.assembly().discs()});
  }

  Scene const& scene_;
  SpecimenDesign const& design_;
  double const stress_ = scene_.specimen.preparation_stress, wanted_ = design_.void_ratio, d50_ = design_.grading.d50(),
               skin_ = usual_skin(d50_, design_.grading.smallest());
  ProgressCallback const& progress_;
  Ranks const& ranks_;
  std::int64_t disc_steps_ = 0;
  double slowness_ = 1;  // divides the inertial numbers
};

}  // namespace

PackedSpecimen compress(Specimen const& loose, Scene const& scene, SpecimenDesign const& design, ProgressCallback const& progress,
                        Ranks const& ranks) {
  return Compression(scene, design, progress, ranks).run(loose);
}

}  // namespace clathra
