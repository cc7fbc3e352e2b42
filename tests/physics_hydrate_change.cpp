/// Bonds whose hydrate changes between steps: what they keep, what leaves, and that energy is accounted for.
#include <cmath>
#include <utility>

#include "domain/scene/hydrate_loss.hpp"
#include "kernels/bond_law.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

constexpr double formed_at = 0.55, exponent = 1.5;
constexpr HydrateLoss all_losses[] = {HydrateLoss::critical_thickness, HydrateLoss::recession, HydrateLoss::uniform};
constexpr ContactCoupling all_couplings[] = {ContactCoupling::replaces, ContactCoupling::parallel,
                                             ContactCoupling::replaces_keeping_force};

/// 55 % hydrate that is lost by a law.
Scene scene_of(HydrateLoss loss, ContactCoupling coupling) {
  Scene scene = hydrate_scene(formed_at, coupling);
  scene.hydrate.loss = loss;
  scene.hydrate.loss_exponent = exponent;
  return scene;
}

/// Two bonded discs, sheared, rolled and moved apart or together from where the bond formed.
struct Pair {
  /// @param overlap  where the bond forms [m];  @param closing  from there on [m]
  Pair(ContactCoupling coupling, double overlap, double closing, double radius = grain_radius,
       HydrateLoss loss = HydrateLoss::critical_thickness)
      : scene(scene_of(loss, coupling)), sim(made(scene, overlap, radius)) {
    formed = sim.assembly().laws.contact.bond;
    constexpr int steps = 100;
    double const speed = closing / (steps * sim.time_step), slip = 2e-7 / (steps * sim.time_step),
                 turn = 2e-3 / (steps * sim.time_step);
    for (int n = 0; n < steps; ++n) {
      drive(sim, 0, 0, 0, 0);
      drive(sim, 1, -speed, slip, turn);
      sim.step();
    }
    drive(sim, 1, 0, 0, 0);
    sim.evaluate_forces();
  }
  static Simulation made(Scene const& scene, double overlap, double radius) {
    Specimen s = two_discs(overlap, grain_radius, radius);
    s.void_ratio = 1;
    bond_all(s, scene);
    Simulation simulation(s, bonded_laws(scene, s.critical_thickness), 3e-4);
    simulation.time_step = 1e-7;
    simulation.set_ledger(true);
    hold_all(simulation);
    return simulation;
  }

  BondLaw law_at(double saturation) const {
    HydrateScene now = scene.hydrate;
    now.saturation = saturation;
    return changed_bond_law(scene, grain_d50, formed, now);
  }
  void dissolve_to(double saturation) { sim.change_hydrate(law_at(saturation)); }
  bool bonded() const { return sim.assembly().measures().bonded > 0; }
  double energy() const { return sim.assembly().measures().bond_energy; }
  double overlap() const {
    Disc const a = disc(sim, 0), b = disc(sim, 1);
    return radii() - std::hypot(b.x - a.x, b.y - a.y);
  }
  double radii() const { return value(sim.assembly().particles.radius, 0) + value(sim.assembly().particles.radius, 1); }
  /// Compression between the discs [N/m].
  double normal() const {
    Disc const a = disc(sim, 0), b = disc(sim, 1);
    double const dx = b.x - a.x, dy = b.y - a.y;
    return -(a.fx * dx + a.fy * dy) / std::hypot(dx, dy);
  }

  Scene scene;
  Simulation sim;
  BondLaw formed;
};

double shear_of(SpecimenContact const& c, ContactCoupling coupling) {
  return coupling == ContactCoupling::parallel ? c.bond_shear : c.shear;
}
double moment_of(SpecimenContact const& c, ContactCoupling coupling) {
  return coupling == ContactCoupling::parallel ? c.bond_moment : c.moment;
}

/// A formula beside the kernel: B of Eq. 2 and the springs of Eqs. 19 to 21 with h_0 = (h_cr + h_max of formation) / 2, and R_t
/// of a touching bond, with what each law of loss has left of B and E.
struct Shrunk {
  Shrunk(Scene const& scene, BondLaw const& formed, double saturation, double gap, double r = grain_radius) {
    auto const wide = [](double radius, double g) {
      return std::sqrt(4 * radius * radius - (2 * radius - g) * (2 * radius - g));
    };
    double const h_formed = formed.critical_thickness,
                 h_max = h_formed * critical_thickness_ratio(saturation) / critical_thickness_ratio(formed_at);
    double left = 1, B = wide(r, h_formed - gap);
    if (scene.hydrate.loss == HydrateLoss::critical_thickness) B = wide(r, h_max - gap);
    if (scene.hydrate.loss == HydrateLoss::recession) B -= wide(grain_d50 / 2, h_formed) - wide(grain_d50 / 2, h_max);
    if (scene.hydrate.loss == HydrateLoss::uniform) left = std::pow((saturation - 0.2) / (formed_at - 0.2), exponent);
    double const h_0 = 0.5 * (gap + h_formed), k_n = formed.particle_stiffness, E = formed.modulus * left,
                 k_bn = k_n * B * E / (k_n * h_0 + 2 * B * E);
    springs = {k_bn, 2.0 / 3 * k_bn, E * B * B * B / (12 * h_0)};
    tension = left * (1.421e7 * B - 160.2);
  }
  ContactStiffness<double> springs;
  double tension;
};

/// Of one pair, from increment to increment: force, moment and energy only fall, and are those of the springs that are left.
void expect_forces_of_springs(ContactCoupling coupling, HydrateLoss loss, double gap, double radius) {
  Pair pair(coupling, gap > 0 ? -gap : 1e-7, gap > 0 ? 1e-7 : -2e-7, radius, loss);
  double const r = 2 * grain_radius * radius / (grain_radius + radius), tolerance = within(1e-12, 2e-5);
  auto const springs_at = [&](double saturation) { return Shrunk(pair.scene, pair.formed, saturation, gap, r).springs; };
  SpecimenContact const before = pair_history(pair.sim);
  double const closed = pair.overlap() - before.formation_overlap,
               preload =
                   coupling == ContactCoupling::replaces_keeping_force ? sand_kn * std::max(0.0, before.formation_overlap) : 0,
               of_grains = coupling == ContactCoupling::parallel ? sand_kn * std::max(0.0, pair.overlap()) : 0;
  ContactStiffness<double> const formed = springs_at(formed_at);
  double energy = pair.energy(), shear = shear_of(before, coupling), moment = moment_of(before, coupling);
  for (double const saturation : {0.5, 0.41, 0.33, 0.28}) {
    pair.dissolve_to(saturation);
    ASSERT_TRUE(pair.bonded()) << saturation;
    ContactStiffness<double> const springs = springs_at(saturation);
    SpecimenContact const now = pair_history(pair.sim);
    double const first_shear = shear_of(before, coupling), first_moment = moment_of(before, coupling);
    EXPECT_NEAR(shear_of(now, coupling), first_shear * springs.shear / formed.shear, tolerance * std::abs(first_shear));
    EXPECT_NEAR(moment_of(now, coupling), first_moment * springs.rolling / formed.rolling, tolerance * std::abs(first_moment));
    EXPECT_NEAR(pair.normal(), springs.normal * closed + preload + of_grains,
                within(1e-9, 1e-3) * (std::abs(springs.normal * closed) + std::abs(of_grains)))
        << saturation;
    EXPECT_LT(std::abs(shear_of(now, coupling)), std::abs(shear));
    EXPECT_LT(std::abs(moment_of(now, coupling)), std::abs(moment));
    if (preload == 0) EXPECT_LT(pair.energy(), energy) << saturation;
    energy = pair.energy(), shear = shear_of(now, coupling), moment = moment_of(now, coupling);
  }
  EXPECT_EQ(pair.sim.assembly().broken_bonds(), 0);
}

TEST(HydrateChange, ForcesFollowTheSpringsOfABondThatLosesHydrate) {
  for (HydrateLoss const loss : all_losses)
    for (ContactCoupling const coupling : all_couplings)
      for (double const radius : {grain_radius, 1.6 * grain_radius})
        for (double const gap : {0.0, 3e-6}) {
          SCOPED_TRACE(testing::Message() << int(loss) << int(coupling) << " " << radius << " " << gap);
          expect_forces_of_springs(coupling, loss, gap, radius);
        }
}

/// Nothing is left at 20 %, wide bonds of large discs included; just above that there is.
TEST(HydrateChange, LeavesNoBondAtTheSameSaturationByAllLaws) {
  for (HydrateLoss const loss : all_losses) {
    Pair pair(ContactCoupling::parallel, 1e-7, 0, 4 * grain_radius, loss);
    pair.dissolve_to(0.216);
    EXPECT_TRUE(pair.bonded()) << int(loss);
    pair.dissolve_to(0.2);
    EXPECT_FALSE(pair.bonded()) << int(loss);
    EXPECT_EQ(pair.sim.assembly().break_counts()[BreakMode::dissolved], 1) << int(loss);
  }
}

TEST(HydrateChange, ABondWhoseGapIsNoLongerSpannedLeaves) {
  for (ContactCoupling const coupling : all_couplings) {
    Pair pair(coupling, -6e-6, 0);
    double const gap = 6e-6, d50 = grain_d50;
    double spans = 0.55;
    while (critical_thickness_ratio(spans - 0.01) * d50 > gap) spans -= 0.01;
    pair.dissolve_to(spans - 0.02);
    EXPECT_FALSE(pair.bonded());
    EXPECT_EQ(pair.sim.assembly().break_counts()[BreakMode::dissolved], 1);
    EXPECT_EQ(pair.sim.assembly().broken_bonds(), 1);
    std::vector<BreakEvent> const events = pair.sim.assembly().break_events(0);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].step, pair.sim.assembly().steps());
    EXPECT_EQ(events[0].mode, static_cast<int>(BreakMode::dissolved));
    EXPECT_EQ(pair.normal(), 0);
    EXPECT_EQ(disc(pair.sim, 1).torque, 0);
    pair.sim.step(3);
    EXPECT_EQ(pair.normal(), 0);
  }
}

/// Where the bond was, the grain contact goes on with what it bears of the shear force.
TEST(HydrateChange, LeavesAGrainContactWithinItsLimits) {
  for (ContactCoupling const coupling : all_couplings) {
    Pair pair(coupling, 2e-7, 1e-7);
    pair.dissolve_to(0.2);
    EXPECT_FALSE(pair.bonded());
    double const normal = sand_kn * pair.overlap();
    SpecimenContact const now = pair_history(pair.sim);
    EXPECT_NEAR(pair.normal(), normal, within(1e-9, 1e-3) * normal);
    EXPECT_LE(std::abs(now.shear), 0.5 * normal * (1 + 1e-6));
    EXPECT_EQ(now.bond_shear, 0);
  }
}

/// R_t of a touching bond reaches 0 only with the hydrate: what is left at 20 % is spread linearly over two per cent above it.
TEST(HydrateChange, SpreadsTheJumpOfEquation3) {
  double const edge = critical_thickness_ratio(0.22) / critical_thickness_ratio(0.55);
  EXPECT_EQ(remaining_thickness(0.55, 0.55, 0.02), 1);
  EXPECT_DOUBLE_EQ(remaining_thickness(0.55, 0.22, 0.02), edge);
  EXPECT_NEAR(remaining_thickness(0.55, 0.21, 0.02), edge / 2, 1e-15);
  EXPECT_EQ(remaining_thickness(0.55, 0.2, 0.02), 0);
  EXPECT_EQ(remaining_thickness(0.55, 0.1, 0.02), 0);
}

/// Moves the second of two discs by a distance along x.
void pull(Simulation& sim, double distance) {
  for (int n = 0; n < 100; ++n) {
    drive(sim, 0, 0, 0, 0);
    drive(sim, 1, distance / (100 * sim.time_step), 0, 0);
    sim.step();
  }
  drive(sim, 1, 0, 0, 0);
}

/// At the S where R_t (Eq. 9 at F_s = M = 0) has fallen to the load, which stays: the bond gives way as it gets softer.
TEST(HydrateChange, ABondUnderADeadLoadBreaksWhereItsStrengthHasFallenToTheLoad) {
  constexpr double load = 300;  // [N/m] of the 827 that it bears
  for (HydrateLoss const loss : all_losses) {
    Scene const scene = scene_of(loss, ContactCoupling::replaces);
    Simulation sim = Pair::made(scene, 0, grain_radius);
    BondLaw const formed = sim.assembly().laws.contact.bond;
    auto const at = [&](double saturation) { return Shrunk(scene, formed, saturation, 0); };
    double low = 0.225, high = formed_at, pulled = 0;
    ASSERT_TRUE(at(high).tension > load && at(low).tension < load);
    while (high - low > 1e-9) (at(0.5 * (low + high)).tension > load ? high : low) = 0.5 * (low + high);
    auto const load_at = [&](double saturation) {
      HydrateScene now = scene.hydrate;
      now.saturation = saturation;
      sim.change_hydrate(changed_bond_law(scene, grain_d50, formed, now));
      double const wanted = load / at(saturation).springs.normal;
      pull(sim, wanted - std::exchange(pulled, wanted));
    };
    load_at(high + 1e-3);
    EXPECT_EQ(sim.assembly().broken_bonds(), 0) << int(loss);
    load_at(high - 1e-3);
    EXPECT_EQ(sim.assembly().break_counts()[BreakMode::tension], 1) << int(loss);
  }
}

/// Temperature and pressure change what a bond bears, both ways, and nothing else.
TEST(HydrateChange, OfTemperatureAndPressureChangesTheStrengthAlone) {
  Scene scene = hydrate_scene(formed_at, ContactCoupling::parallel);
  scene.bond.strength_from = StrengthFrom::conditions;
  BondLaw const formed = make_bond_law(scene, grain_d50, h_max_of(scene));
  HydrateScene now = scene.hydrate;
  EXPECT_EQ(changed_bond_law(scene, grain_d50, formed, now).strength.tensile_stress, formed.strength.tensile_stress);
  now.temperature = 9;
  now.pore_pressure = 13e6;
  BondLaw const changed = changed_bond_law(scene, grain_d50, formed, now);
  HydrateStrength const solid = hydrate_strength(9, 13e6, 900);
  EXPECT_EQ(changed.strength.tensile_stress, 3 * solid.tension);
  EXPECT_EQ(changed.strength.compressive_stress, 3 * solid.compression);
  EXPECT_EQ(changed.modulus, formed.modulus) << "repressurising makes no energy";
  EXPECT_EQ(changed.critical_thickness, formed.critical_thickness);
  scene.bond.strength_from = StrengthFrom::printed;
  EXPECT_EQ(changed_bond_law(scene, grain_d50, make_bond_law(scene, grain_d50, 1e-5), now).strength.tensile_stress, 1.421e7);
}

}  // namespace
}  // namespace clathra
