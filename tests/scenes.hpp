#pragma once
/// Small specimens made by hand, and ways to read and drive their discs. Equal grains of sand unless said otherwise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "domain/generation/bonding.hpp"
#include "domain/generation/random.hpp"
#include "domain/scene/hydrate.hpp"
#include "domain/simulation/simulation.hpp"

namespace clathra {

inline constexpr double grain_radius = 0.0847e-3, grain_d50 = 0.1694e-3, sand_density = 2600, sand_kn = 3e8, sand_ks = 2e8;

inline double grain_mass(double radius = grain_radius) { return pi * radius * radius * sand_density; }

/// Space without walls in reach.
inline Specimen open_space() {
  Specimen s;
  s.left = s.bottom = -1e9;
  s.right = s.top = 1e9;
  s.density = sand_density;
  s.d50 = grain_d50;
  return s;
}

/// @return the id of the new disc
inline int add_disc(Specimen& s, double x, double y, double radius = grain_radius, double vx = 0, double vy = 0,
                    double omega = 0) {
  s.id.push_back(static_cast<int>(s.id.size()));
  s.x.push_back(x);
  s.y.push_back(y);
  s.radius.push_back(radius);
  s.angle.push_back(0);
  s.vx.push_back(vx);
  s.vy.push_back(vy);
  s.omega.push_back(omega);
  return s.id.back();
}

/// Two discs side by side that overlap by `overlap` [m] (negative: a gap).
inline Specimen two_discs(double overlap, double r1 = grain_radius, double r2 = grain_radius) {
  Specimen s = open_space();
  add_disc(s, 0, 0, r1);
  add_disc(s, r1 + r2 - overlap, 0, r2);
  return s;
}

/// A disc that just touches the wall below it.
inline Specimen disc_on_floor(double overlap = 0, double radius = grain_radius) {
  Specimen s = open_space();
  s.bottom = 0;
  add_disc(s, 0, radius - overlap, radius);
  return s;
}

/// Rows of equal discs that just touch, every second row shifted by half a disc.
inline Specimen hexagonal_patch(int columns, int rows, double spacing = 2 * grain_radius) {
  Specimen s = open_space();
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column)
      add_disc(s, (column + 0.5 * (row % 2)) * spacing, row * std::sqrt(0.75) * spacing);
  }
  return s;
}

/// Walls at the outermost discs.
inline void enclose(Specimen& s, double clearance = 0) {
  s.left = s.bottom = 1e9;
  s.right = s.top = -1e9;
  double solid = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    s.left = std::min(s.left, s.x[i] - s.radius[i] - clearance);
    s.right = std::max(s.right, s.x[i] + s.radius[i] + clearance);
    s.bottom = std::min(s.bottom, s.y[i] - s.radius[i] - clearance);
    s.top = std::max(s.top, s.y[i] + s.radius[i] + clearance);
    solid += pi * s.radius[i] * s.radius[i];
  }
  s.void_ratio = s.width() * s.height() / solid - 1;
}

/// A hexagonal patch of unequal discs between walls: gaps of 0 to 2 `spread` of a diameter, no libm in its making.
inline Specimen disordered_patch(int columns, int rows, double spread = 0.04, std::uint64_t seed = 1) {
  Specimen s = hexagonal_patch(columns, rows, 2 * grain_radius * (1 + spread));
  for (std::size_t i = 0; i < s.size(); ++i) s.radius[i] *= 1 + spread * (2 * uniform_random(seed, 1, i) - 1);
  enclose(s);
  return s;
}

/// Discs apart from each other that fly at speeds over three decades [m/s].
inline Specimen gas() {
  Specimen s = disordered_patch(8, 8, 0.3);
  for (std::size_t i = 0; i < s.size(); ++i) {
    double const speed = 3 * std::pow(10, -3 * uniform_random(7, 1, i)), angle = 2 * pi * uniform_random(7, 2, i);
    s.vx[i] = speed * std::cos(angle);
    s.vy[i] = speed * std::sin(angle);
  }
  return s;
}

/// The same specimen with its discs and contacts in another order.
inline Specimen shuffled(Specimen const& s, std::uint64_t seed) {
  Specimen mixed = s;
  std::vector<std::size_t> order(s.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  shuffle(order, seed, 7);
  for (std::size_t i = 0; i < order.size(); ++i) mixed.id[i] = s.id[order[i]];
  for (auto field :
       {&Specimen::x, &Specimen::y, &Specimen::angle, &Specimen::vx, &Specimen::vy, &Specimen::omega, &Specimen::radius}) {
    for (std::size_t i = 0; i < order.size(); ++i) (mixed.*field)[i] = (s.*field)[order[i]];
  }
  shuffle(mixed.contacts, seed, 8);
  return mixed;
}

/// What physics and extremes are tested in: ctest runs them in either precision (CLATHRA_TEST_PRECISION).
inline Precision tested_precision() {
  char const* const name = std::getenv("CLATHRA_TEST_PRECISION");
  return name && std::string(name) == "mixed" ? Precision::mixed : Precision::full;
}
/// A tolerance of either precision.
inline double within(double of_full, double of_mixed) { return tested_precision() == Precision::full ? of_full : of_mixed; }

/// Sand without any damping.
inline SimulationLaws sand_laws(double friction = 0.5, double shape_factor = 2) {
  SimulationLaws laws;
  laws.precision = tested_precision();
  laws.contact.grain = {sand_kn, sand_ks, friction, shape_factor, 0};
  laws.wall = {sand_kn, sand_ks, 0, 0};
  laws.motion.damping = 0;
  return laws;
}

/// A scene with hydrate, strength and stiffness as printed, L_r = B/14.
inline Scene hydrate_scene(double saturation, ContactCoupling coupling, RollingLever lever = {0, 1.0 / 14}) {
  Scene scene;
  scene.bond.grain_stiffness_factor = 1;
  scene.hydrate.saturation = saturation;
  scene.bond.contact_coupling = coupling;
  scene.bond.strength_from = StrengthFrom::printed;
  scene.bond.rolling_lever = lever;
  return scene;
}

/// Sand with the bonds of a scene, without any damping.
inline SimulationLaws bonded_laws(Scene const& scene, double h_max) {
  SimulationLaws laws = sand_laws();
  laws.contact.bond_kind = scene.bond.contact_coupling == ContactCoupling::parallel ? BondKind::parallel : BondKind::replace;
  laws.contact.bond = make_bond_law(scene, grain_d50, h_max);
  return laws;
}
inline double h_max_of(Scene const& scene) { return critical_thickness_ratio(scene.hydrate.saturation) * grain_d50; }

/// Bonds as strong as one likes: for elastic bodies.
inline SimulationLaws unbreakable(SimulationLaws laws) {
  laws.contact.bond.strength.tensile_stress = laws.contact.bond.strength.compressive_stress = 1e15;
  laws.contact.bond.strength.moment_length = 1;
  return laws;
}

/// Bonds all pairs nearer than h_max as a scene says.
inline void bond_all(Specimen& s, Scene const& scene) { install_bonds(scene, s); }

// --- Discs of a running simulation, by id.

inline int index_of(Simulation const& sim, int id) {
  auto const ids = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sim.assembly().particles.id);
  for (int i = 0; i < sim.assembly().discs(); ++i) {
    if (ids(i) == id) return i;
  }
  return -1;
}
template <class T>
double value(Field<T> const& field, int index) {
  return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), field)(index);
}
inline double value(RealField const& field, int index) {
  return on_host(field, field.extent(0))[static_cast<std::size_t>(index)];
}
inline void assign(RealField const& field, int index, double to) {
  std::vector<double> values = on_host(field, field.extent(0));
  values[static_cast<std::size_t>(index)] = to;
  set_from_host(field, values);
}
template <class T>
void assign(Field<T> const& field, int index, double to) {
  Kokkos::deep_copy(Kokkos::subview(field, index), static_cast<T>(to));
}

struct Disc {
  double x, y, vx, vy, omega, fx, fy, torque;
};
inline Disc disc(Simulation const& sim, int id) {
  int const i = index_of(sim, id);
  ParticleSoA const& p = sim.assembly().particles;
  return {value(p.x, i),     value(p.y, i),       value(p.vx, i),      value(p.vy, i),
          value(p.omega, i), value(p.force_x, i), value(p.force_y, i), value(p.torque, i)};
}

/// Takes all inertia away: the discs then move as drive() tells them, whatever pushes them.
inline void hold_all(Simulation& sim) {
  fill(sim.assembly().particles.inverse_mass, 0);
  fill(sim.assembly().particles.inverse_inertia, 0);
}
/// Sets the motion of one disc, without a word of the host to a GPU's memory: tests drive discs for thousands of steps.
struct SetMotion {
  Field<int> ids;
  RealField vx, vy, omega;
  int id;
  double to_vx, to_vy, to_omega;
  KOKKOS_FUNCTION void operator()(int i) const {
    if (ids(i) != id) return;
    auto const at = static_cast<std::size_t>(i);
    vx.set(at, to_vx);
    vy.set(at, to_vy);
    omega.set(at, to_omega);
  }
};
inline void drive(Simulation& sim, int id, double vx, double vy, double omega) {
  ParticleSoA const& p = sim.assembly().particles;
  Kokkos::parallel_for("test_drive", Kokkos::RangePolicy<ExecutionSpace>(0, sim.assembly().discs()),
                       SetMotion{p.id, p.vx, p.vy, p.omega, id, vx, vy, omega});
}

/// The history of the pair (0, 1), as a specimen file would hold it.
inline SpecimenContact pair_history(Simulation const& sim) {
  auto const contacts = sim.specimen().contacts;
  return contacts.empty() ? SpecimenContact{0, 1} : contacts.front();
}

/// Whether an error that was `coarse` at a step dt and is `fine` at dt / 2 shrank as dt^order.
/// @param floor  of mixed precision: an error that rounding alone makes
inline testing::AssertionResult shrinks(double coarse, double fine, double order, double slack = 0.1, double floor = 0) {
  if (tested_precision() == Precision::mixed && std::abs(fine) < floor) return testing::AssertionSuccess();
  double const ratio = std::abs(coarse / fine), wanted = std::pow(2.0, order);
  if (ratio > wanted * (1 - slack) && ratio < wanted * (1 + slack)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "errors " << coarse << " and " << fine << ": ratio " << ratio << ", wanted " << wanted;
}

}  // namespace clathra
