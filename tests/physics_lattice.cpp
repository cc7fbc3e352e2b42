/// A periodic hexagonal lattice of bonded discs against its exact dispersion, its continuum and its strength.
#include "kernels/stability.hpp"
#include "scenes.hpp"

namespace clathra::lattice {
namespace {

constexpr double d = 2 * grain_radius, dt = 1e-7;

/// A periodic cell of touching, bonded discs; all bonds unloaded. Bonds cross the edges.
Specimen periodic_lattice(int columns, int rows) {
  Specimen s = hexagonal_patch(columns, rows);
  s.periodic = true;
  s.left = -0.3 * d;  // no disc lies on an edge
  s.bottom = -0.3 * d;
  s.right = s.left + columns * d;
  s.top = s.bottom + rows * std::sqrt(0.75) * d;
  auto const id = [&](int column, int row) { return (row + rows) % rows * columns + (column + columns) % columns; };
  auto const bond = [&](int a, int b) { s.contacts.push_back({std::min(a, b), std::max(a, b), 0, 0, 0}); };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      int const here = id(column, row), shift = row % 2;
      bond(here, id(column + 1, row));
      bond(here, id(column + shift, row + 1));
      bond(here, id(column + shift - 1, row + 1));
    }
  }
  return s;
}

SimulationLaws lattice_laws() {
  Scene const scene = hydrate_scene(0.55, ContactCoupling::replaces);
  return bonded_laws(scene, h_max_of(scene));
}
ContactStiffness<Real> bond_of(SimulationLaws const& laws) {
  BondLaw const& law = laws.contact.bond;
  return law.stiffness(law.width(grain_radius, 0.0), 0.0);
}

/// Angular frequency [1/s] of a standing wave along x, cleared of leapfrog's own dispersion sin(w' dt/2) = w dt/2.
/// @param spin_ratio  amplitude of the rotation over that of the displacement across (S) [1/m];  `longitudinal`: P
double frequency_of_wave(int columns, bool longitudinal, double spin_ratio) {
  Specimen s = periodic_lattice(columns, 4);
  double const q = 2 * pi / (columns * d), speed = within(1e-3, 1e-2);  // far above round-off
  for (std::size_t i = 0; i < s.size(); ++i) {
    (longitudinal ? s.vx : s.vy)[i] = speed * std::cos(q * s.x[i]);
    if (!longitudinal) s.omega[i] = -spin_ratio * speed * std::sin(q * s.x[i]);
  }
  Simulation sim(s, lattice_laws(), 0.05 * d);
  sim.time_step = dt;
  auto const amplitude = [&] {
    Specimen const now = sim.specimen();
    double sum = 0;
    for (std::size_t i = 0; i < s.size(); ++i)
      sum += (longitudinal ? now.x[i] - s.x[i] : now.y[i] - s.y[i]) * std::cos(q * s.x[i]);
    return sum;
  };
  // a(n - m) + a(n + m) = 2 a(n) cos(m w' dt), n near the first crest.
  int const m = columns;
  double a[3];
  for (double& value_at : a) {
    sim.step(m);
    value_at = amplitude();
  }
  double const numerical = std::acos((a[0] + a[2]) / (2 * a[1])) / (m * dt);
  return 2 / dt * std::sin(numerical * dt / 2);
}

TEST(HexagonalLattice, CarriesCompressionWavesAtItsExactFrequency) {
  SimulationLaws const laws = lattice_laws();
  auto const [kn, ks, km] = bond_of(laws);
  double const m = grain_mass(), continuum = d * std::sqrt((9 * kn + 3 * ks) / (8 * m));
  double error[2];
  for (int level = 0; level < 2; ++level) {
    int const columns = 16 << level;
    double const q = 2 * pi / (columns * d), w = frequency_of_wave(columns, true, 0);
    double const exact = std::sqrt((2 * kn * (1 - std::cos(q * d)) + (kn + 3 * ks) * (1 - std::cos(q * d / 2))) / m);
    EXPECT_NEAR(w / exact, 1, within(1e-6, 2e-4)) << columns;
    error[level] = w / q / continuum - 1;
  }
  EXPECT_LT(std::abs(error[1]), 2e-3);  // long waves: c_p^2 = (lambda + 2 mu) / rho
  EXPECT_TRUE(shrinks(error[0], error[1], 2));
}

TEST(HexagonalLattice, CarriesShearWavesAtItsExactFrequency) {
  SimulationLaws const laws = lattice_laws();
  auto const [kn, ks, km] = bond_of(laws);
  double const m = grain_mass(), inertia = m * grain_radius * grain_radius / 2,
               continuum = d * std::sqrt(3 * (kn + ks) / (8 * m));
  double error[2];
  for (int level = 0; level < 2; ++level) {
    int const columns = 16 << level;
    double const q = 2 * pi / (columns * d), c1 = std::cos(q * d), c2 = std::cos(q * d / 2);
    // Displacement across and rotation, a quarter wave apart, are coupled: the lower branch of a 2 x 2 problem.
    double const across = (2 * ks * (1 - c1) + (3 * kn + ks) * (1 - c2)) / m;
    double const coupling = ks * d * (std::sin(q * d) + std::sin(q * d / 2));
    double const turning = (ks * d * d / 2 * (3 + c1 + 2 * c2) + km * (2 * (1 - c1) + 4 * (1 - c2))) / inertia;
    double const half = 0.5 * (turning - across);
    double const w2 = 0.5 * (across + turning) - std::sqrt(half * half + coupling * coupling / (m * inertia));
    double const w = frequency_of_wave(columns, false, coupling / (inertia * (turning - w2)));
    EXPECT_NEAR(w / std::sqrt(w2), 1, within(1e-6, 2e-4)) << columns;
    error[level] = w / q / continuum - 1;
  }
  EXPECT_LT(std::abs(error[1]), 5e-3);  // long waves: c_s^2 = mu / rho
  EXPECT_TRUE(shrinks(error[0], error[1], 2));
}

TEST(HexagonalLattice, ResistsCompressionWithRootThreeHalvesOfTheStiffness) {
  SimulationLaws const laws = lattice_laws();
  double const bulk = std::sqrt(3.0) / 2 * bond_of(laws).normal;
  double error[2];
  for (int level = 0; level < 2; ++level) {
    Simulation sim(periodic_lattice(8, 8), laws, 0.05 * d);
    sim.time_step = dt;
    double const area = sim.assembly().area();
    double const strain = (level == 0 ? 2e-4 : 1e-4) / 100;
    for (int n = 0; n < 100; ++n) {
      sim.strain(strain, strain);
      sim.step();
    }
    Measures const m = sim.assembly().measures();
    double const pressure = 0.5 * (m.stress_area_xx + m.stress_area_yy) / sim.assembly().area();
    EXPECT_NEAR(m.stress_area_xx / m.stress_area_yy, 1, within(1e-9, 3e-5));
    EXPECT_NEAR(m.stress_area_xy / m.stress_area_xx, 0, within(1e-9, 1e-5));
    error[level] = pressure / (1 - sim.assembly().area() / area) / bulk - 1;
    EXPECT_NEAR(m.bonded, 3 * 64, 0);
  }
  EXPECT_LT(std::abs(error[1]), 2e-4);
  EXPECT_TRUE(shrinks(error[0], error[1], 1));  // first order in the strain
}

TEST(HexagonalLattice, FailsInIsotropicTensionWhereEveryBondDoes) {
  Simulation sim(periodic_lattice(8, 8), lattice_laws(), 0.05 * d);
  sim.time_step = dt;
  double const R_t = 827.13;  // golden: S = 55 %, gap 0
  double const strain = R_t / 1.4209e8 / d;
  double last = 0;
  while (sim.assembly().broken_bonds() == 0 && sim.assembly().steps() < 1200) {
    Measures const m = sim.assembly().measures();
    last = -0.5 * (m.stress_area_xx + m.stress_area_yy) / sim.assembly().area();
    sim.strain(-strain / 1000, -strain / 1000);
    sim.step();
  }
  double const distance = d * (1 + strain);
  EXPECT_NEAR(last / (std::sqrt(3.0) * R_t / distance), 1, 2e-3);
  sim.step();
  EXPECT_EQ(sim.assembly().break_counts()[BreakMode::tension], 3 * 64);
  EXPECT_EQ(sim.assembly().measures().interacting, 0);
}

/// Thornton (2000): Z_m = (2 C - N_1) / (N - N_0 - N_1).
TEST(MechanicalCoordination, LeavesRattlersOut) {
  Specimen s = open_space();
  double const touch = 1.999 * grain_radius, half = touch / 2, high = touch * std::sqrt(0.75);
  add_disc(s, 0, 0), add_disc(s, touch, 0), add_disc(s, half, high);  // each touches the two others
  add_disc(s, half, high + touch);                                    // hangs on one of them
  add_disc(s, 10 * touch, 0);                                         // alone
  Simulation sim(s, sand_laws(), 0.1 * grain_d50);
  Measures const m = sim.assembly().measures();
  EXPECT_EQ(m.interacting, 4);
  EXPECT_EQ(m.non_rattlers, 3);
  EXPECT_DOUBLE_EQ(m.mechanical_coordination(), (2 * 4 - 1) / (5.0 - 1 - 1));
  EXPECT_EQ(Measures().mechanical_coordination(), 0);
}

}  // namespace
}  // namespace clathra::lattice
