#pragma once
/// How fast hydrate goes beyond the boundary of stability, and how its state moves along a stage. A stage states how long it
/// lasts where that matters; a simulation lasts milliseconds, so that this time orders increments and nothing else.
#include "domain/scene/scene.hpp"

namespace clathra {

/// Temperature [deg C], pore pressure [Pa] and saturation, as stages change them.
struct HydrateState {
  double temperature = 0, pore_pressure = 0, saturation = 0;
  bool operator==(HydrateState const&) const = default;

  template <class Visit>
  void for_each_number(std::string const& of, Visit&& visit) {
    visit(of + "_temperature", temperature);
    visit(of + "_pore_pressure", pore_pressure);
    visit(of + "_saturation", saturation);
  }
};

/// dn/dt = k_0 exp(-E_a / R T) A (p_eq - p): moles of methane that a surface A of hydrate sets free.
struct DissociationRate {
  double factor;             ///< k_0 [mol/(m^2 Pa s)]
  double activation_energy;  ///< E_a [J/mol]
};
/// Published ones differ by 1e4: `clarke_2001` 3.6e4, 81 kJ/mol (Clarke and Bishnoi 2001); `kim_1987` 1.24e5, 78.3 (Kim et al.
/// 1987); `slow` 3.6e4, 97.5, the slowest that we found.
DissociationRate dissociation_rate(Dissociation by);

/// Speed of a surface of hydrate that dissociates, CH4 6 H2O [m/s]: 3.05 nm/s for each MPa below the boundary at 5 degC by
/// clarke_2001. 0 where hydrate is stable.
double recession_speed(Dissociation by, HydrateScene const& hydrate, double temperature, double pore_pressure);

/// What the hydrate of a stage goes along: straight lines of temperature and pore pressure over its duration, and a saturation
/// that is given likewise or follows. By a rate the bond between two touching grains of the size d50 gets narrower by 2 v t (the
/// law of recession), and the saturation is the one that goes with its width. `instant`: where the boundary is met temperature
/// and pressure wait until the hydrate has gone in equal parts to 20 %.
struct HydratePath {
  Scene const& scene;
  double d50;     ///< of the grains [m]
  double formed;  ///< h_max of formation [m]
  HydrateChange change;
  HydrateState from;

  /// @param part  of the way, 0 to 1. Never back: for a larger part the saturation is not higher.
  HydrateState at(double part) const;

 private:
  HydrateState line(double part) const;
  double beyond(double part) const;
  double first_beyond() const;
  HydrateState instant(double part) const;
  double lost_width(double part) const;
};

}  // namespace clathra
