#pragma once
/// What can be seen of a specimen at one instant: discs with their stress and motion, contacts and bonds with their forces.
///
/// A snapshot is a plain copy on the host, so that whoever writes, draws or measures needs neither the simulation nor Kokkos, and
/// a picture made from a file is the picture that would have been made in the run.
#include <array>
#include <cstdint>
#include <vector>

#include "domain/simulation/break_event.hpp"
#include "kernels/break_mode.hpp"

namespace clathra {

class Simulation;

/// What a pair of discs is. A pair whose bond broke stays listed by the mode of its breakage, touching or not: broken_in().
enum class ContactState : std::uint8_t { contact, bonded };
constexpr ContactState broken_in(BreakMode mode) { return static_cast<ContactState>(1 + static_cast<int>(mode)); }
inline constexpr int contact_state_count = 1 + break_mode_count;

/// Discs in spatial order (`id` is their identity), pairs once each; with several ranks this rank's discs and pairs, and discs
/// are numbered through all ranks. Compression and closing are positive, the contact normal points from a to b.
struct Snapshot {
  std::string stage;                                    ///< that the test is in
  std::int64_t step = 0;                                ///< since the consolidation
  double time = 0;                                      ///< [s]
  double path = 0;                                      ///< of the axial strain, to and fro; of a series
  double eps1 = 0, eps_v = 0;                           ///< natural strains since the consolidation
  double left = 0, right = 0, bottom = 0, top = 0;      ///< walls [m]
  double sigma1 = 0, sigma3 = 0;                        ///< wall stresses [Pa]
  double density = 0, d50 = 0, critical_thickness = 0;  ///< of the grains [kg/m^3], [m]; h_max of the bonds [m], 0 = no bonds

  std::int64_t first_disc = 0;  ///< number of this rank's first disc
  std::vector<std::int32_t> id;
  std::vector<double> x, y;                               ///< centres [m]
  std::vector<float> radius;                              ///< [m]
  std::vector<float> angle;                               ///< rotation since the specimen was made [rad]
  std::vector<float> vx, vy, omega;                       ///< [m/s], [rad/s]
  std::vector<float> ux, uy;                              ///< displacement since the shear began [m]
  std::vector<float> stress_xx, stress_yy, stress_xy;     ///< mean in the disc: sum of branch (x) force over its area [Pa]
  std::vector<std::uint8_t> coordination;                 ///< pairs that carry force
  std::vector<std::uint8_t> bonds_intact, bonds_initial;  ///< bonds now, and with those that broke since they were installed

  std::vector<std::int32_t> a, b;                 ///< numbers of the discs of a pair: places in the lists above, plus first_disc
  std::vector<std::uint8_t> state;                ///< ContactState
  std::vector<double> normal_force, shear_force;  ///< [N/m]
  std::vector<double> moment;                     ///< on disc a [N m/m]
  std::vector<double> gap;                        ///< surface to surface [m], negative = overlap
  std::vector<double> width;                      ///< B of an intact bond [m], else 0

  BreakEvents events;  ///< bonds broken since the snapshot before
};

/// How finely a column is written unless all digits are asked for.
enum class Rounding {
  none,
  length,   ///< to d50 / fineness
  typical,  ///< to the mean size of `scale` / fineness
  fixed     ///< to 1 / fineness
};

/// A table of `Parts` lists of numbers, side by side.
template <class Value, std::size_t Parts>
struct SnapshotColumn {
  using List = std::vector<Value> Snapshot::*;
  char const* name;                     ///< of the dataset
  char const* unit;                     ///< in files
  char const* suffix;                   ///< behind the parts' names in CSV: "_m"
  std::array<List, Parts> parts;        ///< the lists
  std::array<char const*, Parts> part;  ///< their names
  std::size_t width = Parts;            ///< in files: vectors have a third component, 0
  Rounding rounding = Rounding::none;
  double fineness = 1;
  std::array<List, 2> scale{};        ///< lists of which the coarser one counts
  char const* viewer_name = nullptr;  ///< in viewers, where it is not `name`
};

/// Visits the columns of the discs but for their ids: visit(SnapshotColumn).
template <class Visit>
void for_each_disc_column(Visit&& visit) {
  using S = Snapshot;
  using Single = SnapshotColumn<float, 1>;
  using Vector = SnapshotColumn<float, 2>;
  using Small = SnapshotColumn<std::uint8_t, 1>;
  visit(SnapshotColumn<double, 2>{"position", "m", "_m", {&S::x, &S::y}, {"x", "y"}, 2, Rounding::length, 4096});
  visit(Single{"radius", "m", "_m", {&S::radius}, {"radius"}, 1, Rounding::length, 8192});
  visit(Single{"angle", "rad", "_rad", {&S::angle}, {"angle"}, 1, Rounding::fixed, 1024});
  visit(Vector{"displacement", "m", "_m", {&S::ux, &S::uy}, {"ux", "uy"}, 3, Rounding::length, 512});
  visit(Vector{"velocity", "m/s", "_m_per_s", {&S::vx, &S::vy}, {"vx", "vy"}, 3, Rounding::typical, 8, {&S::vx, &S::vy}});
  visit(Single{"angular_velocity", "rad/s", "_rad_per_s", {&S::omega}, {"omega"}, 1, Rounding::typical, 8, {&S::omega}});
  visit(SnapshotColumn<float, 3>{"stress",
                                 "Pa (xx, yy, xy)",
                                 "_Pa",
                                 {&S::stress_xx, &S::stress_yy, &S::stress_xy},
                                 {"stress_xx", "stress_yy", "stress_xy"},
                                 3,
                                 Rounding::typical,
                                 16,
                                 {&S::stress_yy},
                                 "stress_xx_yy_xy"});
  visit(Small{"coordination", "", "", {&S::coordination}, {"coordination"}});
  visit(Small{"bonds_intact", "", "", {&S::bonds_intact}, {"bonds_intact"}});
  visit(Small{"bonds_initial", "", "", {&S::bonds_initial}, {"bonds_initial"}});
}

/// Visits the columns of the pairs but for their discs and their state.
template <class Visit>
void for_each_pair_column(Visit&& visit) {
  using S = Snapshot;
  using Double = SnapshotColumn<double, 1>;
  std::array<Double::List, 2> const forces{&S::normal_force};
  visit(Double{"normal_force", "N/m", "_N_per_m", {&S::normal_force}, {"normal_force"}, 1, Rounding::typical, 16, forces});
  visit(Double{"shear_force", "N/m", "_N_per_m", {&S::shear_force}, {"shear_force"}, 1, Rounding::typical, 16, forces});
  visit(Double{"moment", "N m/m", "_Nm_per_m", {&S::moment}, {"moment"}, 1, Rounding::typical, 8, {&S::moment}});
  visit(Double{"gap", "m", "_m", {&S::gap}, {"gap"}, 1, Rounding::length, 8192});
  visit(Double{"width", "m", "_m", {&S::width}, {"width"}, 1, Rounding::length, 256});
}

/// The present state of a simulation; without mark_start() no disc is displaced. Strains, step, time and events are the caller's
/// to fill in.
Snapshot take_snapshot(Simulation const& simulation);

}  // namespace clathra
