#pragma once
/// What more is told of a bond that broke, where a scene asks for it: numbers of the trial state, which broke it.
namespace clathra {

struct BreakDetails {
  double eps1;               ///< natural axial strain at the end of the step of the break
  double orientation;        ///< of the branch from disc a to disc b, 0 <= .. < 180 from the horizontal, anticlockwise [deg]
  double thickness;          ///< h_cr when the bond formed [m]
  double width;              ///< B [m]
  double utilisation;        ///< load over strength, >= 1: BondStrength::utilisation()
  double energy;             ///< elastic energy of the bond [J/m]
  double relative_rotation;  ///< M / k_bm, by which b had elastically turned against a; anticlockwise positive [rad]
};

/// The details as columns: the one list of them that files follow.
struct BreakDetailColumn {
  char const* heading;  ///< in events.csv
  char const* name;     ///< in HDF5 files, in the group `events`
  char const* unit;
  double BreakDetails::*value;
};
inline constexpr BreakDetailColumn break_detail_columns[] = {
    {"eps1", "eps1", "", &BreakDetails::eps1},
    {"orientation_deg", "orientation", "deg", &BreakDetails::orientation},
    {"thickness_m", "thickness", "m", &BreakDetails::thickness},
    {"width_m", "width", "m", &BreakDetails::width},
    {"utilisation", "utilisation", "", &BreakDetails::utilisation},
    {"energy_J_per_m", "energy", "J/m", &BreakDetails::energy},
    {"relative_rotation_rad", "relative_rotation", "rad", &BreakDetails::relative_rotation}};

}  // namespace clathra
