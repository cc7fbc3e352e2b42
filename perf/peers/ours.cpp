/// Our side of the comparison with other codes: perf/peers/run starts it.
///   peers_ours write SPECIMEN FOLDER
///     writes discs.txt (id x y radius), forces.txt (id fx fy) and bonds.txt (id id) there and prints the settings for the peers
///   peers_ours run SPECIMEN CASE DT CHECK STEPS
///     steps CHECK times, prints the contact stress, then times STEPS more
/// CASE: frictional, rolling or bonded, with -mixed behind it in mixed precision. Every run starts as the peers do: at rest,
/// without history of the contacts, between four walls that stand still, and without damping.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

#include "domain/generation/bonding.hpp"
#include "domain/measurement/snapshot.hpp"
#include "domain/parallel/host_memory.hpp"
#include "domain/scene/hydrate.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen.hpp"
#include "domain/scene/stage.hpp"
#include "domain/simulation/simulation.hpp"
#include "io/results/specimen_file.hpp"
#include "kernels/stability.hpp"
#include "throughput/throughput.hpp"

namespace {

using namespace clathra;

constexpr double skin_in_d50 = 0.1;  // of all codes

Specimen read_at_rest(char const* path) {
  Specimen specimen = read_specimen(path);
  specimen.contacts.clear();
  for (auto* motion : {&specimen.vx, &specimen.vy, &specimen.omega}) std::fill(motion->begin(), motion->end(), 0.0);
  return specimen;
}

/// A case without its precision.
std::string law_of(std::string const& what) { return what.substr(0, what.find('-')); }

Scene scene_of(Specimen const& specimen, std::string const& what) {
  Scene scene;
  scene.grains.density = specimen.density;
  scene.grains.rolling_width_factor = law_of(what) == "frictional" ? 0 : scene.grains.rolling_width_factor;
  scene.specimen.preparation_stress = specimen.stress;
  scene.hydrate.saturation = law_of(what) == "bonded" ? 0.55 : 0;
  return scene;
}

Simulation simulation_of(Specimen specimen, std::string const& what) {
  Scene const scene = scene_of(specimen, what);
  SimulationLaws laws;
  laws.precision = what.ends_with("-mixed") ? Precision::mixed : Precision::full;
  laws.contact.grain = {scene.grains.normal_stiffness, scene.grains.shear_stiffness, scene.grains.friction,
                        scene.grains.rolling_width_factor, 0};
  laws.motion.damping = 0;
  if (law_of(what) == "bonded") {
    StageRecord record;
    bond_specimen(scene, specimen, record);
    laws.contact.bond_kind = BondKind::parallel;
    laws.contact.bond = make_bond_law(scene, specimen.d50, specimen.critical_thickness);
  }
  Simulation simulation(specimen, laws, skin_in_d50 * specimen.d50);
  simulation.evaluate_forces();
  return simulation;
}

double stable_step(Simulation const& simulation) { return simulation.assembly().stable_time_step(usual_share_of_estimate); }

template <class T>
auto on_host(Field<T> const& field) {
  return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, field);
}

/// Discs by id with 17 digits, which bring every double back to the bit.
void write_discs(Simulation const& simulation, std::string const& folder) {
  Specimen const specimen = simulation.specimen();
  std::FILE* const discs = std::fopen((folder + "/discs.txt").c_str(), "w");
  std::FILE* const forces = std::fopen((folder + "/forces.txt").c_str(), "w");
  if (!discs || !forces) throw std::runtime_error("cannot write into " + folder);
  for (std::size_t i = 0; i < specimen.size(); ++i)
    std::fprintf(discs, "%d %.17g %.17g %.17g\n", specimen.id[i], specimen.x[i], specimen.y[i], specimen.radius[i]);
  ParticleSoA const& p = simulation.assembly().particles;
  auto const id = on_host(p.id);
  std::vector<double> const fx = on_host(p.force_x, specimen.size()), fy = on_host(p.force_y, specimen.size());
  for (std::size_t i = 0; i < specimen.size(); ++i) std::fprintf(forces, "%d %.17g %.17g\n", id(i), fx[i], fy[i]);
  if (std::fclose(discs) + std::fclose(forces) != 0) throw std::runtime_error("cannot write into " + folder);
}

/// The bonds as pairs of ids; prints means over them of what a bond of constant stiffness and strength needs: stiffness (Eqs. 19
/// to 21), R_t, and R_s and R_r of a bond without normal force.
void write_bonds(Simulation const& bonded, std::string const& folder) {
  Snapshot const s = take_snapshot(bonded);
  BondLaw const& law = bonded.assembly().laws.contact.bond;
  std::ofstream file(folder + "/bonds.txt");
  ContactStiffness<Real> stiffness{0, 0, 0}, strength{0, 0, 0};
  Real bonds = 0, longest = 0;
  for (std::size_t k = 0; k < s.a.size(); ++k) {
    Real const width = s.width[k];
    if (!(width > 0)) continue;
    auto const a = static_cast<std::size_t>(s.a[k]), b = static_cast<std::size_t>(s.b[k]);
    file << s.id[a] << ' ' << s.id[b] << '\n';
    Real const gap = law.bond_thickness(-Real(s.gap[k]));
    ContactStiffness<Real> const k_bond = law.stiffness(width, gap);
    BondStrength const limit = bond_strength(law.strength, width, gap);
    stiffness = {stiffness.normal + k_bond.normal, stiffness.shear + k_bond.shear, stiffness.rolling + k_bond.rolling};
    strength = {strength.normal + limit.tension, strength.shear + limit.shear(0), strength.rolling + limit.rolling(0)};
    longest = std::max(longest, std::hypot(s.x[b] - s.x[a], s.y[b] - s.y[a]));
    bonds += 1;
  }
  if (!file.flush()) throw std::runtime_error("cannot write into " + folder);
  std::printf("bond_normal_stiffness %.17g\nbond_shear_stiffness %.17g\nbond_rolling_stiffness %.17g\n", stiffness.normal / bonds,
              stiffness.shear / bonds, stiffness.rolling / bonds);
  std::printf("bond_normal_strength %.17g\nbond_shear_strength %.17g\nbond_rolling_strength %.17g\nlongest_bond %.17g\n",
              strength.normal / bonds, strength.shear / bonds, strength.rolling / bonds, longest);
}

void write_for_peers(char const* path, std::string const& folder) {
  Specimen const specimen = read_at_rest(path);
  Simulation const rolling = simulation_of(specimen, "rolling"), bonded = simulation_of(specimen, "bonded");
  write_discs(rolling, folder);
  write_bonds(bonded, folder);
  Scene const scene = scene_of(specimen, "rolling");
  GrainLaw const& law = rolling.assembly().laws.contact.grain;
  double const dt = std::min(stable_step(rolling), stable_step(bonded));
  std::printf("dt %.17g\nskin %.17g\nkn %.17g\nks %.17g\nfriction %.17g\nshape_factor %.17g\ndensity %.17g\n", dt,
              skin_in_d50 * specimen.d50, law.normal_stiffness, law.shear_stiffness, law.friction, law.shape_factor,
              specimen.density);
  std::printf("left %.17g\nright %.17g\nbottom %.17g\ntop %.17g\n", specimen.left, specimen.right, specimen.bottom, specimen.top);
  std::printf("discs %d\ntouching %.0f\nbonds %.0f\nbond_reach %.17g\nd50 %.17g\n", rolling.assembly().discs(),
              rolling.assembly().measures().touching, bonded.assembly().measures().bonded,
              bonded.assembly().facts.critical_thickness, specimen.d50);
}

/// Stress of the contacts between discs [Pa], without those at the walls: all that the peers report alike.
void print_stress(Simulation const& simulation) {
  Snapshot const s = take_snapshot(simulation);
  double xx = 0, yy = 0;
  for (std::size_t k = 0; k < s.a.size(); ++k) {
    auto const a = static_cast<std::size_t>(s.a[k]), b = static_cast<std::size_t>(s.b[k]);
    double const lx = s.x[b] - s.x[a], ly = s.y[b] - s.y[a], distance = std::sqrt(lx * lx + ly * ly);
    double const nx = lx / distance, ny = ly / distance;
    xx += (s.normal_force[k] * nx + s.shear_force[k] * ny) * lx;
    yy += (s.normal_force[k] * ny - s.shear_force[k] * nx) * ly;
  }
  double const area = simulation.assembly().area();
  std::printf("stress_xx %.9g\nstress_yy %.9g\n", xx / area, yy / area);
}

void run(char const* path, std::string const& what, double dt, int check, int steps) {
  Simulation simulation = simulation_of(read_at_rest(path), what);
  simulation.time_step = dt;
  for (int n = 0; n < check; ++n) simulation.step();
  print_stress(simulation);
  std::int64_t const searches = simulation.assembly().upkeep.searches();
  Kokkos::fence();
  Kokkos::Timer const clock;
  for (int n = 0; n < steps; ++n) simulation.step();
  Kokkos::fence();
  std::printf("loop %.9g\nsearches %lld\nbroken %d\n", clock.seconds(),
              static_cast<long long>(simulation.assembly().upkeep.searches() - searches), simulation.assembly().broken_bonds());
}

}  // namespace

int main(int argc, char** argv) {
  std::string const verb = argc > 1 ? argv[1] : "";
  bool const write = verb == "write" && argc == 4, time = verb == "run" && argc == 7;
  if (!write && !time) {
    std::fprintf(stderr, "usage: peers_ours write SPECIMEN FOLDER | peers_ours run SPECIMEN CASE DT CHECK STEPS\n");
    return 64;
  }
  ::setenv("OMP_PROC_BIND", "false", 0);
  set_up_host_memory();
  int none = 1;
  Kokkos::ScopeGuard const guard(none, argv);
  try {
    if (write)
      write_for_peers(argv[2], argv[3]);
    else
      run(argv[2], argv[3], std::atof(argv[4]), std::atoi(argv[5]), std::atoi(argv[6]));
  } catch (std::exception const& problem) {
    std::fprintf(stderr, "peers_ours: %s\n", problem.what());
    return 70;
  }
  return 0;
}
