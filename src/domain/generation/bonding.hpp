#pragma once
/// Where hydrate bonds form in a resting specimen (Jiang et al. 2017, section 4), and how much hydrate they are.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "domain/parallel/ranks.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen.hpp"
#include "domain/scene/stage.hpp"

namespace clathra {

/// What bonding did.
struct BondingOutcome {
  double critical_thickness = 0;  ///< h_max [m]
  std::int64_t bonds = 0;
  std::int64_t rejected_no_tension = 0;  ///< pairs in reach whose R_t <= 0
  std::int64_t rejected_out_of_fit = 0;  ///< pairs whose R_c, K_s or K_r is not positive (gaps of millimetres)
  double bond_area = 0;                  ///< sum of Eq. 5 [m^2]
  double areal_saturation = 0;           ///< bond area / void area
  double target_area = 0;                ///< (S - 20 %) e/(1+e) A of Eq. 4 [m^2]
};

/// h_max [m] of a scene: Eq. 3 (`saturation`), the given one, or by bisection the one whose bond area meets Eq. 4 (`bond_area`).
double critical_thickness(Scene const& scene, Specimen const& share, Ranks const& ranks);

/// Adds a bond to every pair of `specimen` with gap < h_max (strictly), R_t > 0 and a positive envelope. The bond is stress-free
/// at its formation: u_0 = u_n. Grain contact history stays; `replace` and `memory` begin with the grain's shear and moment only
/// where they keep it.
/// @param share  this rank's discs and the contacts whose smaller id is among them;  @return the outcome of all ranks
BondingOutcome install_bonds(Scene const& scene, Specimen& share, Ranks const& ranks = {});

/// Installs bonds on a resting, unbonded specimen by scene.bond and scene.hydrate.
/// The record holds h_max, the bonds, the pairs that got none and why, and the areal saturation.
/// @param specimen  this rank's share as Simulation::specimen() or by_place() give it; gains the bonds
void bond_specimen(Scene const& scene, Specimen& specimen, StageRecord& record, Ranks const& ranks = {});

}  // namespace clathra
