#pragma once
/// One record of a test: a row of history.csv.
#include <cstdint>
#include <limits>
#include <string>

#include "domain/scene/loading_stage.hpp"
#include "kernels/break_mode.hpp"

namespace clathra {

/// Stresses are effective and positive in compression; sigma_1 is vertical, sigma_3 lateral (walls); eps_v = eps_1 + eps_3.
struct HistoryRow {
  std::string stage = shear_stage;  ///< of the consolidation, or one of stages_of()
  std::int64_t step = 0;            ///< since the consolidation ended, as time and strains; in it since it began
  double time_s = 0;
  double eps1 = 0, eps_v = 0;                               ///< natural strains
  double sigma1_Pa = 0, sigma3_Pa = 0, q_Pa = 0, p_Pa = 0;  ///< q = s1 - s3, p = (s1 + s3) / 2
  double contact_sigma1_Pa = 0, contact_sigma3_Pa = 0;      ///< the same stresses from the contacts (Love-Weber)
  double void_ratio = 0;                                    ///< nominal
  std::int64_t bonds_intact = 0;
  double bonds_intact_pct = 0;         ///< of the bonds at installation
  double bonded_contacts_pct = 0;      ///< bonded / (touching or bonded), the paper's measure
  BreakCounts broken;                  ///< bonds since they formed, by mode: those of consolidation are among them
  double coordination = 0;             ///< 2 * interacting pairs / discs
  double mechanical_coordination = 0;  ///< the same without rattlers (Thornton 2000)
  double inertial_number = 0, platen_wave_stress = 0;  ///< I and W
  double unbalanced = 0;                               ///< mean unbalanced force / mean contact force
  double largest_q_Pa = 0, largest_q_eps1 = 0;         ///< of all steps since the record before, and the axial strain there
  /// Largest angle of dilation over a stretch of 1 % strain that ended since the record before; nan before the first one.
  double dilation_deg = std::numeric_limits<double>::quiet_NaN();
  // Only where stages change the hydrate:
  double temperature = 0, pore_pressure = 0, saturation_pct = 0;  ///< [deg C], [Pa], [%]
  double boundary_K = 0, boundary_Pa = 0;  ///< how much warmer, and under how much less pressure, hydrate would be stable still
};

template <class Row, class Visit>
void for_each_hydrate_column(Row& row, Visit&& visit) {
  visit("temperature_degC", row.temperature);
  visit("pore_pressure_Pa", row.pore_pressure);
  visit("saturation_pct", row.saturation_pct);
  visit("boundary_K", row.boundary_K);
  visit("boundary_Pa", row.boundary_Pa);
}

/// Visits (column name, value) in file order; values are double, int64 or, of the stage, a string.
template <class Row, class Visit>
void for_each_column(Row& row, Visit&& visit) {
  visit("stage", row.stage);
  visit("step", row.step);
  visit("time_s", row.time_s);
  visit("eps1", row.eps1);
  visit("eps_v", row.eps_v);
  visit("sigma1_Pa", row.sigma1_Pa);
  visit("sigma3_Pa", row.sigma3_Pa);
  visit("q_Pa", row.q_Pa);
  visit("p_Pa", row.p_Pa);
  visit("contact_sigma1_Pa", row.contact_sigma1_Pa);
  visit("contact_sigma3_Pa", row.contact_sigma3_Pa);
  visit("void_ratio", row.void_ratio);
  visit("bonds_intact", row.bonds_intact);
  visit("bonds_intact_pct", row.bonds_intact_pct);
  visit("bonded_contacts_pct", row.bonded_contacts_pct);
  for (BreakModeNames const& m : break_modes) visit(m.broken, row.broken[m.mode]);
  visit("coordination", row.coordination);
  visit("mechanical_coordination", row.mechanical_coordination);
  visit("inertial_number", row.inertial_number);
  visit("platen_wave_stress", row.platen_wave_stress);
  visit("unbalanced", row.unbalanced);
  visit("largest_q_Pa", row.largest_q_Pa);
  visit("largest_q_eps1", row.largest_q_eps1);
  visit("dilation_deg", row.dilation_deg);
}

/// The energy ledger at a record [J/m], present only with output.energy: stored energies now, work and losses since the shear
/// began; nan before it. No account is computed as the remainder: `residual` = work - (change of stored energies) - losses is the
/// check.
struct EnergyRow {
  double boundary_work = 0;
  double kinetic = 0, grain_elastic = 0, bond_elastic = 0, wall_elastic = 0;
  double sliding = 0, rolling = 0, dashpot = 0, damping = 0, breakage = 0, dissolved = 0;
  double residual = 0;
};

template <class Row, class Visit>
void for_each_energy_column(Row& row, Visit&& visit) {
  visit("boundary_work_J_per_m", row.boundary_work);
  visit("kinetic_J_per_m", row.kinetic);
  visit("grain_elastic_J_per_m", row.grain_elastic);
  visit("bond_elastic_J_per_m", row.bond_elastic);
  visit("wall_elastic_J_per_m", row.wall_elastic);
  visit("sliding_J_per_m", row.sliding);
  visit("rolling_J_per_m", row.rolling);
  visit("dashpot_J_per_m", row.dashpot);
  visit("damping_J_per_m", row.damping);
  visit("breakage_J_per_m", row.breakage);
  visit("dissolved_J_per_m", row.dissolved);
  visit("residual_J_per_m", row.residual);
}

}  // namespace clathra
