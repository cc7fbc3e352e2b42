/// A bond breaks at its own share of the strength, in whichever mode.
#include <cmath>

#include "domain/scene/hydrate.hpp"
#include "kernels/bond_law.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

/// A pair with a bond of 55 % hydrate that is moved by a part of what would break it. @param sign  1 pulls, -1 presses
struct PairOfAShare {
  PairOfAShare(std::uint64_t seed, double sign, double part) : sim(made(seed)) {
    BondLaw const law = sim.assembly().laws.contact.bond;
    double const width = law.width_formed_at(grain_radius, 0.0), share = law.scatter.share(0, 1),
                 strength =
                     sign > 0 ? tensile_strength(law.strength, width, 0.0) : compressive_strength(law.strength, width, 0.0),
                 distance = sign * part * share * strength / law.stiffness(width, 0.0).normal;
    constexpr int steps = 200;
    for (int n = 0; n < steps; ++n) {
      drive(sim, 0, 0, 0, 0);
      drive(sim, 1, distance / (steps * sim.time_step), 0, 0);
      sim.step();
    }
  }
  static Simulation made(std::uint64_t seed) {
    Scene scene = hydrate_scene(0.55, ContactCoupling::replaces);
    scene.bond.strength_modulus = 3;
    scene.bond.strength_seed = seed;
    Specimen s = two_discs(0);
    s.void_ratio = 1;
    bond_all(s, scene);
    Simulation simulation(s, bonded_laws(scene, s.critical_thickness), 3e-4);
    simulation.time_step = 1e-7;
    hold_all(simulation);
    return simulation;
  }
  std::int64_t broken(BreakMode mode) const { return sim.assembly().break_counts()[mode]; }
  Simulation sim;
};

TEST(ScatteredStrength, IsWhatABondBreaksAt) {
  double const close = within(1e-4, 2e-2);
  double least = 2, most = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    for (auto const& [sign, mode] : {std::pair{1.0, BreakMode::tension}, std::pair{-1.0, BreakMode::compression}}) {
      EXPECT_EQ(PairOfAShare(seed, sign, 1 - close).broken(mode), 0) << seed;
      EXPECT_EQ(PairOfAShare(seed, sign, 1 + close).broken(mode), 1) << seed;
    }
    double const share = PairOfAShare(seed, 1, 0).sim.assembly().laws.contact.bond.scatter.share(0, 1);
    least = std::min(least, share), most = std::max(most, share);
  }
  EXPECT_LT(least, 0.7);
  EXPECT_GT(most, 1.2);
}

}  // namespace
}  // namespace clathra
