#pragma once
/// What can be seen of a specimen at one instant: discs with their stress and motion, contacts and bonds with their forces.
#include <cstdint>
#include <vector>

#include "domain/simulation.hpp"

namespace clathra {

/// What a pair of discs is. A pair whose bond broke stays listed by the mode of its breakage, touching or not: broken_in().
enum class ContactState : std::uint8_t { contact, bonded };
constexpr ContactState broken_in(BreakMode mode) { return static_cast<ContactState>(1 + static_cast<int>(mode)); }
inline constexpr int contact_state_count = 1 + break_mode_count;

/// Discs in spatial order (`id` is their identity), pairs once each; with several ranks this rank's discs and pairs, and discs
/// are numbered through all ranks. Compression and closing are positive, the contact normal points from a to b.
struct Snapshot {
  std::int64_t step = 0;                                ///< of the shear
  double time = 0;                                      ///< [s]
  double eps1 = 0, eps_v = 0;                           ///< natural strains since the shear began
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

  std::vector<BreakEvent> events;  ///< bonds broken since the snapshot before
};

/// The present state of a simulation; without mark_start() no disc is displaced. Strains, step, time and events are the caller's
/// to fill in.
Snapshot take_snapshot(Simulation const& simulation);

}  // namespace clathra
