#include "domain/generation/compression.hpp"

#include <cmath>

#include "domain/scene/short_number.hpp"

namespace clathra {

namespace {

constexpr double void_tolerance = 0.001;  // of what is asked for
constexpr double reserve = 0.01;          // in void ratio: what is left to close with grains as stiff as the scene's
constexpr double flowing_modulus = 0.4;   // of the soft assembly, over its k_n
// Inertial numbers: while discs hardly touch, of the fall of the height alone, of the closing of soft grains, and of that of the
// scene's. At five times the first some of 200,000 discs met nearly centre to centre.
constexpr double loose_rate = 0.015, vertical_rate = 2.5e-3, soft_rate = 5e-4, last_rate = 3e-4;

std::string digits(double value) { return short_number(value, 4); }

/// Friction alone packs to about 0.25, with impacts to 0.24.
GenerationFriction generation_friction(double void_ratio) {
  GenerationFriction friction;
  friction.shape_factor = void_ratio > 0.28 ? 2 : 1;
  return friction;
}

/// An assembly on its way.
struct Assembly {
  Specimen specimen;
  GenerationFriction friction;
  double lowest_share = 1;  ///< of the friction, so far
  double strain = 0;        ///< linear, by which soft grains are pressed into each other
  bool blocked = false;     ///< resists without friction
};

class Compression {
 public:
  Compression(Scene const& scene, SampleDesign const& design, ProgressCallback const& progress, Ranks const& ranks)
      : scene_(scene), design_(design), progress_(progress), ranks_(ranks) {}

  /// @throws VoidRatioMissed, Refused
  PackedSpecimen run(Specimen const& loose) {
    Assembly const near = stiffened(close_softly({loose, generation_friction(wanted_)}));
    constexpr int most_attempts = 6;
    double goal = wanted_;
    for (int attempt = 1;; ++attempt) {
      Assembly const closed = closed_to(goal, near);
      PackedSpecimen packed = at_rest(closed);
      double const error = packed.specimen.void_ratio - wanted_;
      if (std::abs(error) <= void_tolerance) return packed;
      bool const never_resisted = error < 0 && closed.lowest_share == 1;
      if (attempt == most_attempts || closed.blocked || never_resisted) refuse(packed.specimen.void_ratio, closed.friction);
      goal -= error;
    }
  }

 private:
  [[noreturn]] void refuse(double reached, GenerationFriction const& friction) const {
    bool const denser = reached > wanted_;
    std::string const held =
        "with a friction of " + digits(friction.friction) + " and a shape factor of " + digits(friction.shape_factor);
    throw VoidRatioMissed("under " + digits(stress_ / 1e3) + " kPa these grains came to rest at a void ratio of " +
                              digits(reached) + (denser ? ", without friction" : ", " + held) + ": " + digits(wanted_) +
                              (denser ? " is denser than they pack" : " is looser than they hold"),
                          reached, denser);
  }

  /// How a part of the closing goes on.
  struct Part {
    double goal;             ///< void ratio
    double inertial_number;  ///< of its rate near the goal
    double softness = 0;     ///< void ratio that overlaps take away, over the stress [1/Pa]
    bool vertical = false;   ///< by the height alone
  };

  /// Closes, ever slower towards the goal, so that the assembly arrives at rest: the force network of a flowing assembly would
  /// collapse once it stops. The friction is the servo of the stress here: too much stress, less friction.
  template <class Laws>
  void close(Simulation& simulation, Assembly& a, Part const& part, Laws const& laws) {
    constexpr int interval = 10;             // steps between checks of the stress
    constexpr double loose_margin = 0.1;     // in void ratio: further above, far from touching all over, it may close much faster
    constexpr double slowing_range = 0.004;  // in void ratio
    double const full_rate = strain_rate_of(part.inertial_number, stress_, simulation.moving_density(), d50_);
    double stress = contact_stress(simulation);
    BoxRates present;
    auto const above = [&] { return simulation.void_ratio() + part.softness * stress - part.goal; };
    while (above() > 1e-5 && !a.blocked) {
      double const far = std::clamp((above() - loose_margin) / 0.2, 0.0, 1.0),
                   hurry = 1 + far * (loose_rate / part.inertial_number - 1);
      double const rate =
          full_rate * hurry * std::clamp(above() / slowing_range, 0.1, 1.0) * std::clamp(2 * stress_ / stress, 0.05, 1.0);
      stretch(simulation, {part.vertical ? 0 : rate, rate}, present);
      double const before = simulation.time();
      simulation.step(interval);
      // Discs keep their speed while the box gets smaller.
      double const faster = std::exp(rate * (simulation.time() - before));
      present = {present.x * faster, present.y * faster};
      stress = contact_stress(simulation);
      double const excess = std::clamp(stress / stress_ - 1, -1.0, 1.0);
      a.friction.share = std::clamp(a.friction.share * (1 - 0.02 * excess), 1e-4, 1.0);
      a.lowest_share = std::min(a.lowest_share, a.friction.share);
      simulation.set_laws(laws(a.friction));
      a.blocked = (a.friction.share < 1e-3 && stress > 4 * stress_) || stress > 20 * stress_;
      if (simulation.steps() % 1000 == 0) tell(simulation);
    }
    stretch(simulation, {}, present);
  }

  /// With soft grains to the reserve above the target, what their overlaps take away counted in.
  Assembly close_softly(Assembly a) {
    auto const laws = [&](GenerationFriction const& friction) {
      return flowing_laws(generation_laws(scene_, friction), stress_, design_.grading);
    };
    Simulation simulation(a.specimen, laws(a.friction), skin_, ranks_);
    simulation.choose_time_step(StepChoice{});
    double const modulus = flowing_modulus * simulation.laws().contact.grain.normal_stiffness;
    double const softness = (1 + wanted_) / modulus;
    close(simulation, a, {wanted_ + unjammed, vertical_rate, softness, true}, laws);
    a.blocked = false;
    close(simulation, a, {wanted_ + reserve, soft_rate, softness}, laws);
    a.blocked = false;  // soft grains may have been
    a.strain = 0.5 * contact_stress(simulation) / modulus;
    simulation.stop_discs();
    a.specimen = simulation.specimen();
    disc_steps_ += simulation.steps() * simulation.discs();
    return a;
  }

  /// The same discs, just no longer pressed into each other, so that grains as stiff as the scene's can take over.
  static Assembly stiffened(Assembly a) {
    Specimen& s = a.specimen;
    auto const stretched = [&](double at, double from) { return from + (1 + a.strain) * (at - from); };
    for (double& x : s.x) x = stretched(x, s.left);
    for (double& y : s.y) y = stretched(y, s.bottom);
    s.right = stretched(s.right, s.left);
    s.top = stretched(s.top, s.bottom);
    s.contacts.clear();
    return a;
  }

  Assembly closed_to(double goal, Assembly a) {
    auto const laws = [&](GenerationFriction const& friction) { return closing_laws(scene_, friction); };
    Simulation simulation(a.specimen, laws(a.friction), skin_, ranks_);
    simulation.choose_time_step(StepChoice{});
    close(simulation, a, {goal, last_rate}, laws);
    a.specimen = simulation.specimen();
    disc_steps_ += simulation.steps() * simulation.discs();
    return a;
  }

  /// With the full friction back the assembly creeps no further.
  PackedSpecimen at_rest(Assembly const& closed) {
    GenerationFriction full = closed.friction;
    full.share = 1;
    Simulation resting(closed.specimen, generation_laws(scene_, full), skin_, ranks_);
    resting.choose_time_step(StepChoice{});
    ProgressCallback const counted = [&](Progress p) {
      p.disc_steps += disc_steps_;
      return !progress_ || progress_(p);
    };
    if (!settle(resting, stress_, rest_of_specimens, most_steps_to_rest, counted)) {
      if (std::abs(resting.void_ratio() - wanted_) > void_tolerance) refuse(resting.void_ratio(), full);
      throw Refused(text_of_unrest(resting, stress_));
    }
    disc_steps_ += resting.steps() * resting.discs();
    PackedSpecimen packed = packed_at_rest(resting, stress_, closed.friction, closed.lowest_share);
    packed.disc_steps = disc_steps_;
    return packed;
  }

  void tell(Simulation const& simulation) const {
    report(progress_, {"generate", 0.7, "void ratio " + digits(simulation.void_ratio()) + " -> " + digits(wanted_),
                       disc_steps_ + simulation.steps() * simulation.discs()});
  }

  Scene const& scene_;
  SampleDesign const& design_;
  double const stress_ = scene_.bond.stress, wanted_ = design_.void_ratio, d50_ = design_.grading.d50(),
               skin_ = std::min(0.1 * d50_, 0.25 * design_.grading.smallest());
  ProgressCallback const& progress_;
  Ranks const& ranks_;
  std::int64_t disc_steps_ = 0;
};

}  // namespace

PackedSpecimen compress(Specimen const& loose, Scene const& scene, SampleDesign const& design, ProgressCallback const& progress,
                        Ranks const& ranks) {
  return Compression(scene, design, progress, ranks).run(loose);
}

}  // namespace clathra
