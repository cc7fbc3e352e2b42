#pragma once
/// Where methane hydrate is stable: pore pressure against temperature and salinity (Tishchenko, Hensen, Wallmann and Wong 2005,
/// Chemical Geology 219, 37-52).
#include <string>

namespace clathra {

inline constexpr double zero_celsius = 273.15;  ///< [K]

/// Below this pore pressure [Pa] hydrate dissociates: ln(p / MPa) = c0 + c1 s + c2 s^2 with the salinity s in ppt and functions
/// c0, c1, c2 of the temperature.
/// @param temperature  [deg C];  @param salinity  of the pore water [ppt]
double equilibrium_pressure(double temperature, double salinity);

/// Above this temperature [deg C] it does: the inverse, to 1e-9 K; between -10 and 28 deg C, which are returned beyond (the
/// boundary turns back further on).
double equilibrium_temperature(double pore_pressure, double salinity);

/// What of a state the boundary was not fitted to (273 to 293 K, 0 to 70 ppt), in words; empty where nothing is.
std::string boundary_warning(double temperature, double salinity);

}  // namespace clathra
