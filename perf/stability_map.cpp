/// Where leapfrog is stable: step over limit against each factor that moves the limit, on lattices and small packings whose
/// eigenvalues are exact (Eigen), beside the program's own bounds.
///   stability_map FILE [PART]
/// Appends a line a cell to FILE (CSV) and skips those that are there already, so that it may be stopped and called again;
/// PART is a piece of the names of the factors that are wanted. perf/stability.sh makes the table and the picture of it.
///
/// Each cell is a frozen network: contacts that cannot slide, bonds that cannot break, discs at rest but for a trace of motion.
/// Below the limit its energy must stay bounded, above it grow at the rate of the recurrence
///   u(t+dt) = 2 u - u(t-dt) - (1 + alpha) dt^2 M^-1 K u - dt M^-1 C (u - u(t-dt)).
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "domain/generation/equilibration.hpp"
#include "scenes.hpp"

namespace {

using namespace clathra;
using Eigen::MatrixXd;

/// One frozen network.
struct Case {
  std::string factor, level;
  std::function<Specimen()> specimen;
  SimulationLaws laws;
  double dashpot = 0, alpha = 0;
};

/// 144 discs of equally frequent radii between r and r / size_ratio, squeezed to 1 MPa.
Specimen squeezed(double size_ratio, double shear_stiffness = sand_ks) {
  Specimen s = hexagonal_patch(12, 12, 2.02 * grain_radius);
  for (std::size_t i = 0; i < s.size(); ++i) s.radius[i] *= 1 - (1 - 1 / size_ratio) * uniform_random(1, 1, i);
  enclose(s);
  s.d50 = grain_radius * (1 + 1 / size_ratio);
  SimulationLaws laws = sand_laws(0.5, 2);
  laws.contact.grain.shear_stiffness = shear_stiffness;
  laws.motion.damping = 0.7;
  Simulation sim(s, laws, 0.05 * s.d50);
  prepare_servo(sim, 1e6, 1e-2, s.d50, {});
  if (!hold_stress(sim, 1e6, {1e-3}, 1000000, {}, "squeeze")) std::fprintf(stderr, "stability_map: a packing is not at rest\n");
  return sim.specimen();
}

Specimen lattice(bool hexagonal) {
  double const spacing = 2 * grain_radius * (1 - 1e-4);
  Specimen s = hexagonal ? hexagonal_patch(12, 12, spacing) : open_space();
  for (int row = 0; row < 12 && !hexagonal; ++row)
    for (int column = 0; column < 12; ++column) add_disc(s, column * spacing, row * spacing);
  enclose(s, -1e-4 * grain_radius);  // as deep in the walls as in each other
  return s;
}

/// Bonds a share of the pairs that 55 % hydrate would bond.
Specimen bonded(Specimen s, ContactCoupling coupling, double share) {
  bond_all(s, hydrate_scene(0.55, coupling));
  for (std::size_t k = 0; k < s.contacts.size(); ++k)
    if (uniform_random(11, 3, k) >= share) s.contacts[k].formation_overlap = no_bond;
  return s;
}

SimulationLaws frozen(SimulationLaws laws) {
  laws.contact.grain.friction = 1e9;
  laws.wall.friction = 0;
  return laws;
}

void add_bonded(std::vector<Case>& all) {
  for (ContactCoupling const coupling : {ContactCoupling::parallel, ContactCoupling::replaces}) {
    std::string const name = coupling == ContactCoupling::parallel ? "bonds, parallel" : "bonds, replaces";
    for (double const share : {0.25, 0.5, 1.0}) {
      auto const specimen = [coupling, share] { return bonded(squeezed(4), coupling, share); };
      Scene const scene = hydrate_scene(0.55, coupling);
      all.push_back({name, std::to_string(static_cast<int>(100 * share)) + " %", specimen,
                     frozen(unbreakable(bonded_laws(scene, specimen().critical_thickness)))});
    }
  }
}

std::vector<Case> cases() {
  std::vector<Case> all;
  SimulationLaws const sand = frozen(sand_laws(1e9, 2));
  auto const packing = [] { return squeezed(4); };
  auto const add = [&](std::string const& factor, std::string const& level, std::function<Specimen()> const& specimen,
                       SimulationLaws const& laws, double dashpot = 0, double alpha = 0) {
    all.push_back({factor, level, specimen, laws, dashpot, alpha});
  };
  add(
      "network", "square lattice", [] { return lattice(false); }, sand);
  add(
      "network", "hexagonal lattice", [] { return lattice(true); }, sand);
  for (double const ratio : {0.0, 0.25, 2.0 / 3, 1.0}) {
    SimulationLaws laws = sand;
    laws.contact.grain.shear_stiffness = ratio * sand_kn;
    add(
        "k_s / k_n",
        ratio == 0      ? "0"
        : ratio == 1    ? "1"
        : ratio == 0.25 ? "0.25"
                        : "2/3",
        [ratio] { return squeezed(4, ratio * sand_kn); }, laws);
  }
  for (double const ratio : {1.05, 2.0, 4.0, 8.0})
    add(
        "d_max / d_min", ratio == 1.05 ? "1.05" : std::to_string(static_cast<int>(ratio)), [ratio] { return squeezed(ratio); },
        sand);
  for (double const alpha : {0.1, 0.3, 0.7}) add("local damping", std::to_string(alpha).substr(0, 3), packing, sand, 0, alpha);
  for (double const dashpot : {0.05, 0.2, 1.0}) add("dashpots", std::to_string(dashpot).substr(0, 4), packing, sand, dashpot);
  for (double const inertia : {2.0, 3.0, 10.0}) {
    SimulationLaws laws = sand;
    laws.scaling.inertia = inertia;
    add("inertia scaling", std::to_string(static_cast<int>(inertia)), packing, laws);
  }
  add_bonded(all);
  return all;
}

/// M^-1/2 K M^-1/2 and M^-1/2 C M^-1/2 of the springs that carry a force now.
struct Matrices {
  MatrixXd stiffness, viscosity;
};
Matrices matrices_of(Simulation const& sim, double dashpot_per_spring) {
  SpringNetwork const net = sim.assembly().springs();
  int const n = net.particles.owned;
  Matrices m{MatrixXd::Zero(3 * n, 3 * n), MatrixXd::Zero(3 * n, 3 * n)};
  for (int i = 0; i < n; ++i) {
    for_each_spring(net, i, {}, [&](Spring<Real> const& s, int j) {
      // Strains of the spring by the motion of its own disc, and by that of the other.
      Eigen::Matrix3d own, other;
      own << -s.nx, -s.ny, 0, s.ny, -s.nx, -s.arm, 0, 0, -1;
      other << s.nx, s.ny, 0, -s.ny, s.nx, -s.other_arm, 0, 0, 1;
      Eigen::Vector3d const stiffness(s.normal, s.shear, s.rolling), viscosity(dashpot_per_spring * s.dashpot, 0, 0);
      m.stiffness.block<3, 3>(3 * i, 3 * i) += own.transpose() * stiffness.asDiagonal() * own;
      m.viscosity.block<3, 3>(3 * i, 3 * i) += own.transpose() * viscosity.asDiagonal() * own;
      if (j < 0) return;
      m.stiffness.block<3, 3>(3 * i, 3 * j) += own.transpose() * stiffness.asDiagonal() * other;
      m.viscosity.block<3, 3>(3 * i, 3 * j) += own.transpose() * viscosity.asDiagonal() * other;
    });
  }
  Eigen::VectorXd root(3 * n);
  for (int i = 0; i < n; ++i)
    root.segment<3>(3 * i) << std::sqrt(net.particles.inverse_mass(i)), std::sqrt(net.particles.inverse_mass(i)),
        std::sqrt(net.particles.inverse_inertia(i));
  for (MatrixXd* k : {&m.stiffness, &m.viscosity}) *k = root.asDiagonal() * *k * root.asDiagonal();
  return m;
}

double largest(MatrixXd const& symmetric) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues().tail<1>()(0);
}

/// The exact limit: (1 + alpha) lambda_max(dt^2 K + 2 dt C) = 4.
double exact_limit(Matrices const& m, double alpha, bool viscous) {
  double high = 2 / std::sqrt((1 + alpha) * largest(m.stiffness)), low = 0;
  if (!viscous) return high;
  for (int n = 0; n < 24; ++n) {
    double const dt = 0.5 * (low + high);
    ((1 + alpha) * largest(dt * dt * m.stiffness + 2 * dt * m.viscosity) < 4 ? low : high) = dt;
  }
  return low;
}

/// The predicted growth of amplitudes, ln |z| a step, of the fastest solution z^t of the recurrence.
double predicted_growth(Matrices const& m, double alpha, double dt, bool viscous) {
  if (!viscous) return 2 * std::acosh(std::max(1.0, 0.5 * dt * std::sqrt((1 + alpha) * largest(m.stiffness))));
  auto const n = m.stiffness.rows();
  MatrixXd step(2 * n, 2 * n);
  MatrixXd const one = MatrixXd::Identity(n, n), kick = -dt * dt * (1 + alpha) * m.stiffness, kept = one - dt * m.viscosity;
  step << one + kick, kept, kick, kept;  // of (u, v dt): v' = (1 - dt C) v - dt^2 K u, then u' = u + v'
  return std::log(std::max(1.0, Eigen::EigenSolver<MatrixXd>(step, false).eigenvalues().cwiseAbs().maxCoeff()));
}

/// Made anew for each cell: copies of a simulation share their discs.
Simulation at_rest(Case const& c, Specimen const& s) {
  SimulationLaws laws = c.laws;
  laws.motion.damping = 0.7;
  laws.contact.grain.damping_ratio = 0;
  Simulation sim(s, laws, 0.05 * s.d50);
  sim.time_step = 0.5 * sim.assembly().stable_limit();
  for (int n = 0; n < 20000; ++n) sim.step();
  sim.stop_discs();
  laws.motion.damping = c.alpha;
  laws.contact.grain.damping_ratio = c.dashpot;
  sim.set_laws(laws);
  return sim;
}

/// What a trace of motion has become.
struct Course {
  double growth = 0;   ///< ln of the amplitude a step, at the end
  double largest = 0;  ///< kinetic energy at the end over that after 20 steps
  bool bounded = false;
};

Course move(Simulation&& sim, double dt, int steps) {
  constexpr double trace = 1e-10;  // [m/s]
  sim.time_step = dt;
  double const elastic = sim.assembly().measures().grain_energy + sim.assembly().measures().bond_energy;
  ParticleSoA const& p = sim.assembly().particles;
  auto const radius = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), p.radius);
  std::vector<double> vx, omega;
  for (int i = 0; i < p.owned; ++i) {
    vx.push_back(trace * (uniform_random(7, 1, i) - 0.5));
    omega.push_back(trace / radius(i) * (uniform_random(7, 2, i) - 0.5));
  }
  set_from_host(p.vx, vx);
  set_from_host(p.omega, omega);
  Course m;
  std::vector<double> logs;
  double first = 0;
  for (int n = 0; n < steps; ++n) {
    sim.step();
    if (n >= 2000 && n % 1000 != 0) continue;
    double const kinetic = sim.assembly().measures().kinetic;
    if (n == 20) first = kinetic;
    if (n > 20) m.largest = std::max(m.largest, kinetic / first);
    logs.push_back(0.5 * std::log(kinetic));
    if (kinetic > 1e-7 * elastic) break;  // soon contacts open and it is no frozen network any more
  }
  if (logs.size() > 6 && logs.size() < 1900) m.growth = (logs.back() - logs[logs.size() - 3]) / 2;
  m.bounded = m.largest < 1e3 && static_cast<int>(logs.size()) > 1900;
  return m;
}

std::set<std::string> done_in(std::string const& path) {
  std::set<std::string> done;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::size_t const third = line.find(';', line.find(';', line.find(';') + 1) + 1);
    done.insert(line.substr(0, third));
  }
  return done;
}

void write_cell(std::string const& path, std::string const& line) {
  std::ofstream(path, std::ios::app) << line << '\n';
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

/// All cells of one case that are not done.
void run_case(Case const& c, std::string const& path, std::set<std::string> const& done) {
  std::vector<double> shares;
  for (double const share : {0.5, 0.9, 0.99, 1.02, 1.05, 1.2}) {
    char key[160];
    std::snprintf(key, sizeof key, "%s;%s;%g", c.factor.c_str(), c.level.c_str(), share);
    if (done.count(key) == 0) shares.push_back(share);
  }
  if (shares.empty()) return;
  Specimen const specimen = c.specimen();
  Simulation const sim = at_rest(c, specimen);
  bool const viscous = c.dashpot > 0;
  Matrices const m = matrices_of(sim, 1);
  double const exact = exact_limit(m, c.alpha, viscous),
               bound = exact / stable_limit(sim.assembly().springs(), c.alpha, 0, sim.assembly().across()),
               lanczos = viscous ? 0 : 2 / std::sqrt(1 + c.alpha) / sim.assembly().largest_frequency(40) / exact;
  for (double const share : shares) {
    int const steps = share == 0.99 ? 1000000 : 10000;
    Course const motion = move(at_rest(c, specimen), share * exact, steps);
    double const predicted = predicted_growth(m, c.alpha, share * exact, viscous);
    char line[400];
    std::snprintf(line, sizeof line, "%s;%s;%g;%d;%.6g;%.4f;%.4f;%s;%.3g;%.4f;%.4f", c.factor.c_str(), c.level.c_str(), share,
                  sim.assembly().discs(), exact, bound, lanczos, motion.bounded ? "bounded" : "diverges", motion.largest,
                  motion.growth, predicted);
    write_cell(path, line);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: stability_map FILE [PART]\n");
    return 64;
  }
  Kokkos::ScopeGuard const guard(argc, argv);
  std::string const path = argv[1], part = argc > 2 ? argv[2] : "";
  std::set<std::string> const done = done_in(path);
  if (done.empty())
    write_cell(
        path, "factor;level;share;discs;exact_limit_s;bound_over_exact;lanczos_over_exact;verdict;energy_ratio;growth;predicted");
  for (Case const& c : cases())
    if (c.factor.find(part) != std::string::npos) run_case(c, path, done);
  return 0;
}
