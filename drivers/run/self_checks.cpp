#include "run/self_checks.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "domain/generation/bonding.hpp"
#include "domain/generation/random.hpp"
#include "domain/measurement/specimen_facts.hpp"
#include "domain/scene/hydrate.hpp"
#include "domain/simulation/simulation.hpp"
#include "io/results/specimen_file.hpp"

namespace clathra {
namespace {

/// Equal discs of d50 = 0.1694 mm, strength as printed in Eq. 15, k_n = 3e8 N/m/m in Eq. 16, too; `share` is the gap over h_max,
/// forces at F_n = 0. Five digits.
struct GoldenBond {
  double saturation, share, B, R_t, R_c, k_bn, k_bm, R_s, R_r_per_length;
};
constexpr GoldenBond golden_bonds[] = {
    {0.26, 0.0, 36.326e-6, 355.99, 3441.9, 1.4589e8, 0.58590, 439.94, 886.68},
    {0.26, 0.5, 25.762e-6, 206.40, 3162.1, 1.4157e8, 0.13932, 280.93, 566.16},
    {0.41, 0.0, 59.450e-6, 684.59, 4036.5, 1.4326e8, 0.93931, 750.20, 1512.0},
    {0.41, 0.5, 42.381e-6, 443.48, 3575.1, 1.3649e8, 0.22687, 524.15, 1056.2},
    {0.55, 0.0, 69.482e-6, 827.13, 4294.4, 1.4209e8, 1.0840, 876.23, 1766.0},
    {0.55, 0.5, 49.693e-6, 547.93, 3754.5, 1.3432e8, 0.26437, 621.85, 1252.9},
};
constexpr double median_diameter = 0.1694e-3, golden_tolerance = 1e-4;

/// Keeps count of comparisons and of the largest relative difference.
struct Comparison {
  double tolerance;
  int count = 0;
  double largest = 0;

  void operator()(char const* what, double found, double wanted) {
    double const difference = std::fabs(found / wanted - 1);
    ++count;
    if (!(difference <= tolerance)) throw CheckFailed(fmt::format("{} is {:.6g}, it should be {:.6g}", what, found, wanted));
    largest = std::max(largest, difference);
  }
};

void compare(Comparison& same, GoldenBond const& golden) {
  Scene scene;
  scene.hydrate.saturation = golden.saturation;
  scene.bond.strength_from = StrengthFrom::printed;
  scene.bond.grain_stiffness_factor = 1;
  double const gap = golden.share * critical_thickness_ratio(golden.saturation) * median_diameter, radius = median_diameter / 2;
  BondCard const card = evaluate_bond(scene, median_diameter, radius, radius, gap, 0);
  same("B", card.B, golden.B);
  same("R_t", card.R_t, golden.R_t);
  same("R_c", card.R_c, golden.R_c);
  same("k_bn", card.k_bn, golden.k_bn);
  same("k_bm", card.k_bm, golden.k_bm);
  same("R_s", card.R_s, golden.R_s);
  same("R_r / L_r", card.R_r_per_length, golden.R_r_per_length);
}

/// Two discs that just touch, each with half of the speed.
Specimen two_discs(double radius, double speed) {
  Specimen s;
  s.left = s.bottom = -1e3;
  s.right = s.top = 1e3;
  s.id = {0, 1};
  s.x = {-radius, radius};
  s.vx = {speed / 2, -speed / 2};
  s.radius = {radius, radius};
  s.y = s.vy = s.angle = s.omega = {0, 0};
  return s;
}

/// A folder for this check alone, gone with it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "clathra-selftest-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw CheckFailed("cannot make the folder " + name);
    path = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  TemporaryFolder(TemporaryFolder const&) = delete;
  TemporaryFolder& operator=(TemporaryFolder const&) = delete;

  std::filesystem::path path;
};

/// A column of discs whose numbers use all bits.
Specimen awkward_specimen() {
  Specimen s;
  s.right = 1e-3;
  for (int i = 0; i < 100; ++i) {
    s.id.push_back(i);
    s.radius.push_back(1e-4 / (3 + i % 7));
    s.x.push_back(5e-4 + 1e-4 / (i + 1.0));
    s.y.push_back(3e-4 * (i + 1));
    for (auto field : {&Specimen::angle, &Specimen::vx, &Specimen::vy, &Specimen::omega}) (s.*field).push_back(1 / (i - 50.3));
    if (i > 0) s.contacts.push_back({i - 1, i, 1.0 / i, -1.0 / 3, -1e-6 / i, 0.1 * i, 7.0 / i});
  }
  s.top = 3e-4 * 101;
  s.critical_thickness = 1e-5 / 3;
  SpecimenOutline const outline = outline_of(s);
  s.d50 = outline.sizes.d50, s.void_ratio = outline.void_ratio;
  return s;
}

/// Unequal discs in shifted rows, so near that many can be bonded, between walls. Made with + - * / alone: the same on every
/// machine.
Specimen bondable_patch(int side) {
  constexpr double pitch = 0.98 * median_diameter, height = 0.866 * pitch;
  Specimen s;
  s.d50 = median_diameter;
  s.left = s.bottom = -0.55 * pitch;
  s.right = (side + 0.05) * pitch;
  s.top = (side - 1) * height + 0.55 * pitch;
  for (int i = 0; i < side * side; ++i) {
    s.id.push_back(i);
    s.x.push_back((i % side + 0.5 * (i / side % 2)) * pitch);
    s.y.push_back(i / side * height);
    s.radius.push_back(median_diameter * (0.48 + 0.04 * uniform_random(1, 1, static_cast<std::uint64_t>(i))));
    for (auto field : {&Specimen::angle, &Specimen::vx, &Specimen::vy, &Specimen::omega}) (s.*field).push_back(0);
  }
  return s;
}

}  // namespace

std::string check_bond_law() {
  Comparison same{golden_tolerance};
  for (GoldenBond const& golden : golden_bonds) compare(same, golden);
  HydrateStrength const hydrate = hydrate_strength(5, 8e6, 900);
  same("q_c", hydrate.compression, 8.57009e6);
  same("q_t", hydrate.tension, 4.75494e6);
  same("E_m", hydrate.modulus, 289.001e6);
  return fmt::format("{} numbers, largest difference {:.1g}", same.count, same.largest);
}

std::string check_collision() {
  constexpr double radius = 1e-4, speed = 1e-3;
  constexpr int steps_of_contact = 2000;
  SimulationLaws laws;
  laws.motion.damping = 0;
  Specimen const specimen = two_discs(radius, speed);
  double const effective_mass = pi * radius * radius * specimen.density / 2;
  double const period = std::sqrt(effective_mass / laws.contact.grain.normal_stiffness);
  Simulation simulation(specimen, laws, radius / 10);
  simulation.time_step = pi * period / steps_of_contact;
  double largest = 0, overlap = 0, end = 0;
  for (int step = 0; step < steps_of_contact + 2; ++step) {
    simulation.step();
    Specimen const now = simulation.specimen();
    overlap = 2 * radius - (now.x[1] - now.x[0]);
    largest = std::max(largest, overlap);
    if (overlap > 0) end = simulation.assembly().time();
  }
  Specimen const after = simulation.specimen();
  Comparison same{2e-3};
  same("the largest overlap", largest, speed * period);
  same("the contact time", end, pi * period);
  same("the parting speed", after.vx[1] - after.vx[0], speed);
  return fmt::format("overlap, time and speed within {:.1g} of the closed form", same.largest);
}

std::string check_specimen_file() {
  TemporaryFolder const folder;
  std::filesystem::path const file = folder.path / "specimen.h5";
  Specimen const specimen = awkward_specimen();
  write_specimen(file, specimen);
  if (specimen_hash(read_specimen(file)) != specimen_hash(specimen))
    throw CheckFailed("what was read from " + file.string() + " is not what was written");
  return fmt::format("{} particles and {} contacts read as written", specimen.size(), specimen.contacts.size());
}

std::uint64_t bonded_state_hash() {
  Scene scene;
  scene.hydrate.saturation = 0.55;
  scene.bond.strength_from = StrengthFrom::printed;
  Specimen specimen = bondable_patch(20);
  install_bonds(scene, specimen);
  SimulationLaws laws;
  laws.contact.bond_kind = BondKind::parallel;
  laws.contact.bond = make_bond_law(scene, specimen.d50, specimen.critical_thickness);
  Simulation simulation(specimen, laws, median_diameter / 20);
  simulation.time_step = 1e-7;
  simulation.loading().y = AxisDrive::at_rate(400);
  simulation.loading().x = AxisDrive::at_rate(-150);
  for (int step = 0; step < 1500; ++step) simulation.step();
  if (simulation.assembly().broken_bonds() < 20) throw CheckFailed("no bonds broke");
  return simulation.assembly().hash();
}

}  // namespace clathra
