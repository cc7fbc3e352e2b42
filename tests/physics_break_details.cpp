/// What is told of a bond that breaks, of two discs pulled apart, crushed, sheared and rolled, against closed forms.
#include "scenes.hpp"

namespace clathra::break_details {
namespace {

// S = 55 %, a gap of a quarter of h_max (golden_bonds.hpp).
constexpr double gap = 3.726e-6, h_cr = gap, B = 60.518e-6, R_t = 700.76, R_c = 4048.3;
constexpr double k_bn = 1.3890e8, k_bs = 9.2602e7, k_bm = 0.57300, dt = 1e-7, printed_digits = 2e-4;

/// Eq. 9 at F_n = 0.
double shape_at_rest() {
  double const x = R_t / (R_c + R_t);
  return (R_c + R_t) * x * std::pow(-std::log(x), 0.59);
}
double shear_strength() {
  return (2.05 - 0.89 * std::exp(-std::pow(1000 * h_cr - 1.15, 2))) * (0.41 - 61.07 * h_cr) * shape_at_rest();
}
double moment_strength() {
  return (2.05 - 0.92 * std::exp(-std::pow(1000 * h_cr - 1.15, 2))) * (0.83 - 146.36 * h_cr) * shape_at_rest() * B / 14;
}

/// How the second disc moves: away from the first [m/s], and the spins of both [rad/s].
struct Motion {
  double apart, spin_a, spin_b;
};

constexpr double wall_rate = 50;  // [1/s]

/// The event of a pair whose branch points to `angle` [deg] from disc 0, which is listed second.
/// @param earlier  steps of the walls before the strain counts;  @param later  steps from then to the break
BreakEvents broken(ContactCoupling coupling, double angle, Motion const& motion, int earlier, int& later) {
  Scene const scene = hydrate_scene(0.55, coupling);
  Specimen s = open_space();
  double const nx = std::cos(angle * pi / 180), ny = std::sin(angle * pi / 180), distance = 2 * grain_radius + gap;
  add_disc(s, distance * nx, distance * ny);
  add_disc(s, 0, 0);
  s.id = {1, 0};
  s.void_ratio = 1;
  bond_all(s, scene);
  Simulation sim(s, bonded_laws(scene, s.critical_thickness), 3e-4);
  sim.time_step = dt;
  hold_all(sim);
  sim.loading().y = AxisDrive::at_rate(wall_rate);
  sim.step(earlier);
  sim.keep_breaks(BreakRecord::details);
  drive(sim, 0, 0, 0, motion.spin_a);
  drive(sim, 1, motion.apart * nx, motion.apart * ny, motion.spin_b);
  for (later = 0; sim.assembly().broken_bonds() == 0 && later < 3000; ++later) sim.step();
  return sim.assembly().detailed_break_events(0);
}

struct Expected {
  BreakMode mode;
  double energy, rotation;  // [J/m], [rad]
  double increment;         // of a step over the strength
};

void expect_details(ContactCoupling coupling, double angle, Motion const& motion, Expected const& e) {
  int steps = 0;
  BreakEvents const events = broken(coupling, angle, motion, 20, steps);
  ASSERT_TRUE(events.detailed);
  ASSERT_EQ(events.rows.size(), 1u);
  ASSERT_EQ(events.details.size(), 1u);
  EXPECT_EQ(events.rows[0].id_a, 0);
  EXPECT_EQ(events.rows[0].mode, static_cast<int>(e.mode));
  BreakDetails const& d = events.details[0];
  EXPECT_NEAR(d.eps1, wall_rate * dt * steps, 1e-4 * wall_rate * dt * steps);
  EXPECT_NEAR(d.orientation, angle < 180 ? angle : angle - 180, within(1e-9, 1e-6));
  EXPECT_NEAR(d.thickness, h_cr, printed_digits * h_cr);
  EXPECT_NEAR(d.width, B, printed_digits * B);
  EXPECT_GE(d.utilisation, 1);
  EXPECT_LE(d.utilisation, 1 + e.increment);
  EXPECT_NEAR(d.energy, e.energy * (1 + e.increment), (e.increment + 3 * printed_digits) * e.energy);
  EXPECT_NEAR(d.relative_rotation, e.rotation, (e.increment + 3 * printed_digits) * std::abs(e.rotation) + 1e-12);
}

constexpr ContactCoupling couplings[] = {ContactCoupling::replaces, ContactCoupling::parallel,
                                         ContactCoupling::replaces_keeping_force};

TEST(BreakDetails, OfAPulledBond) {
  double const step = R_t / k_bn / 1000;
  for (ContactCoupling coupling : couplings)
    for (double angle : {0.0, 30.0, 90.0, 130.0, 200.0})
      expect_details(coupling, angle, {step / dt, 0, 0}, {BreakMode::tension, R_t * R_t / (2 * k_bn), 0, 1.01e-3});
}

TEST(BreakDetails, OfACrushedBond) {
  double const step = R_c / k_bn / 1000;
  for (ContactCoupling coupling : couplings)
    expect_details(coupling, 75, {-step / dt, 0, 0}, {BreakMode::compression, R_c * R_c / (2 * k_bn), 0, 1.01e-3});
}

TEST(BreakDetails, OfAShearedBond) {
  double const R_s = shear_strength(), spin = 300, step = k_bs * spin * (2 * grain_radius + gap) * dt;
  for (ContactCoupling coupling : couplings)
    expect_details(coupling, 130, {0, spin, spin}, {BreakMode::shear, R_s * R_s / (2 * k_bs), 0, 1.01 * step / R_s});
}

TEST(BreakDetails, OfARolledBondWithTheSignOfTheTurn) {
  double const R_r = moment_strength(), spin = 20, step = k_bm * 2 * spin * dt;
  for (ContactCoupling coupling : couplings)
    for (double turn : {1.0, -1.0})  // of disc 1 against disc 0
      expect_details(coupling, 130, {0, -turn * spin, turn * spin},
                     {BreakMode::rolling, R_r * R_r / (2 * k_bm), turn * R_r / k_bm, 1.01 * step / R_r});
}

TEST(BreakDetails, UtilisationIsThatOfTheEllipseWithFloors) {
  BondStrength strength{700, 4000, 0.5, 1e-6, 0.9, 0};
  double const normal = 2000, R_s = strength.shear(normal), R_r = strength.rolling(normal);
  EXPECT_EQ(R_s, 0.9 * normal);
  EXPECT_NEAR(strength.utilisation(BreakMode::shear, normal, -1.2 * R_s, 0.9 * R_r), 1.5, 1e-12);
  EXPECT_EQ(strength.utilisation(BreakMode::tension, -1400, 0, 0), 2);
  EXPECT_EQ(strength.utilisation(BreakMode::compression, 6000, 0, 0), 1.5);
  EXPECT_EQ(strength.utilisation(BreakMode::shear, normal, R_s * (1 - 1e-15), 0), 1);
  EXPECT_EQ((BondStrength{0, 4000, 0, 0}).utilisation(BreakMode::tension, 0, 0, 0), BondStrength::no_strength);
  EXPECT_EQ((BondStrength{700, 4000, 0, 1e-6}).utilisation(BreakMode::shear, 0, 1, 0), BondStrength::no_strength);
}

TEST(BreakDetails, AngleOfALineIsBelow180) {
  EXPECT_EQ(angle_of_line(1, 0), 0);
  EXPECT_EQ(angle_of_line(-1, 0), 0);
  EXPECT_EQ(angle_of_line(-1, -0.0), 0);
  EXPECT_EQ(angle_of_line(1, -1e-300), 0);
  EXPECT_EQ(angle_of_line(0, -1), 90);
  EXPECT_EQ(angle_of_line(-1, 1), 135);
}

}  // namespace
}  // namespace clathra::break_details
