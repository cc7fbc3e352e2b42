#pragma once
/// What is measured on a specimen between steps. All sums are order-free.
#include "kernels/pair_state.hpp"
#include "kernels/wall_forces.hpp"

namespace clathra {

/// Sums over discs, pairs and wall contacts after a step.
struct Measures {
  Real stress_area_xx = 0, stress_area_xy = 0, stress_area_yx = 0,
       stress_area_yy = 0;  ///< sum f (x) l [N], stress times area, compression positive
  /// sum f (x) x [N] of the shear of rough walls alone, by place from the middle of the box: by so much the mean stress times
  /// area of a specimen at rest is more than what its walls are pressed with.
  Real wall_shear_xx = 0, wall_shear_yy = 0;
  Real touching = 0;                                        ///< pairs with u_n > 0
  Real non_rattlers = 0;                                    ///< discs in two interacting pairs or more
  Real contacts_of_non_rattlers = 0;                        ///< their pairs, those between two of them twice
  Real interacting = 0;                                     ///< pairs touching or bonded
  Real bonded = 0;                                          ///< pairs with an intact bond
  Real contact_force = 0;                                   ///< sum of |F| over interacting pairs and wall contacts [N/m]
  Real active_contacts = 0;                                 ///< number of those
  Real unbalanced = 0;                                      ///< sum of |F| over discs [N/m]
  Real kinetic = 0;                                         ///< [J/m]
  Real grain_energy = 0, bond_energy = 0, wall_energy = 0;  ///< elastic [J/m]
  Real deep = 0;                                            ///< pairs that overlap by more than 10 % of the smaller radius

  /// Z_m = (2 C - N_1) / (N - N_0 - N_1) of N discs with C pairs, N_0 and N_1 of them with none and with one (Thornton 2000,
  /// Geotechnique 50(1), 43-53); contacts with walls do not count. 0 where all are rattlers.
  Real mechanical_coordination() const { return non_rattlers > 0 ? contacts_of_non_rattlers / non_rattlers : 0; }

  /// Mean unbalanced force per disc over mean contact force.
  Real unbalanced_ratio(int discs) const {
    return contact_force > 0 && discs > 0 ? (unbalanced / discs) / (contact_force / active_contacts) : 0;
  }
};

Measures measure(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws,
                 WallContacts const& wall_contacts, Walls const& walls, WallLaw const& wall_law, Summation const& sums = {});

/// The largest overlap of a pair over its smaller radius, 0 where none touches.
Real deepest_overlap(ParticleSoA const& particles, ContactRows const& rows);

/// Sums of an energy ledger's loss accounts [J/m].
struct DissipationTotals {
  Real sliding = 0, rolling = 0, dashpot = 0, breakage = 0, damping = 0;
};
DissipationTotals total_losses(Dissipation const& losses, int discs, Summation const& sums = {});

/// Identity of a state: 64 bits over (id, position, angle, velocity, history, bonds) of all owned discs, independent of how they
/// are stored. The sum of a mix per disc and per row entry, so ranks may add their parts. -0 and +0 count as equal.
std::uint64_t state_hash(ParticleSoA const& particles, ContactRows const& rows);

}  // namespace clathra
