#include "domain/scene/dissociation.hpp"

#include <algorithm>
#include <cmath>

#include "domain/scene/hydrate_loss.hpp"
#include "domain/scene/phase_boundary.hpp"

namespace clathra {
namespace {

constexpr double gas_constant = 8.314462618;              // [J/(mol K)]
constexpr double molar_mass = 16.043e-3 + 6 * 18.015e-3;  // of CH4 6 H2O [kg/mol]

}  // namespace

DissociationRate dissociation_rate(Dissociation by) {
  if (by == Dissociation::kim_1987) return {1.24e5, 78.3e3};
  if (by == Dissociation::slow) return {3.6e4, 97.5e3};
  return {3.6e4, 81e3};
}

double recession_speed(Dissociation by, HydrateScene const& hydrate, double temperature, double pore_pressure) {
  DissociationRate const rate = dissociation_rate(by);
  double const drive = std::max(0.0, equilibrium_pressure(temperature, hydrate.salinity) - pore_pressure),
               k = rate.factor * std::exp(-rate.activation_energy / (gas_constant * (zero_celsius + temperature)));
  return k * drive * molar_mass / hydrate.density;
}

/// All but the saturation, which is that of the beginning where it is not given.
HydrateState HydratePath::line(double part) const {
  auto const between = [part](double begin, double end) {
    return !is_given(end) ? begin : part >= 1 ? end : begin + part * (end - begin);
  };
  HydrateState state{between(from.temperature, change.temperature), between(from.pore_pressure, change.pore_pressure),
                     between(from.saturation, change.saturation)};
  if (change.undrained)
    state.pore_pressure = std::max(from.pore_pressure, equilibrium_pressure(state.temperature, scene.hydrate.salinity));
  return state;
}

/// By how much the pressure is too low for hydrate to be stable [Pa].
double HydratePath::beyond(double part) const {
  HydrateState const state = line(part);
  return equilibrium_pressure(state.temperature, scene.hydrate.salinity) - state.pore_pressure;
}

/// The part of the way where the boundary is met; 1 where it is not. Along a line beyond() is convex, as the boundary is.
double HydratePath::first_beyond() const {
  if (beyond(0) >= 0) return 0;
  if (!(beyond(1) > 0)) return 1;
  double low = 0, high = 1;
  for (int n = 0; n < 60; ++n) {
    double const middle = 0.5 * (low + high);
    (beyond(middle) < 0 ? low : high) = middle;
  }
  return high;
}

/// The way has two halves of the same length, that of temperature and pressure and that of the saturation, which interrupts it.
HydrateState HydratePath::instant(double part) const {
  double const met = first_beyond(), gone = 2 * part - met;
  if (gone <= 0 || (met == 1 && !(beyond(1) > 0))) return line(std::min(1.0, 2 * part));
  HydrateState state = line(gone < 1 ? met : 2 * part - 1);
  double const last = std::min(from.saturation, least_cementing);
  state.saturation = gone >= 1 ? last : from.saturation + gone * (last - from.saturation);
  return state;
}

/// 2 times the integral of v, by its values in the middle of equal parts of the whole way: a sum that only grows.
double HydratePath::lost_width(double part) const {
  constexpr int parts = 1000;
  double const of_one = change.duration / parts;
  double lost = 0;
  for (int n = 0; n < parts && n < part * parts; ++n) {
    HydrateState const state = line((n + 0.5) / parts);
    lost += 2 * of_one * std::min(1.0, part * parts - n) *
            recession_speed(change.dissociation, scene.hydrate, state.temperature, state.pore_pressure);
  }
  return lost;
}

HydrateState HydratePath::at(double part) const {
  if (change.dissociation == Dissociation::instant) return instant(part);
  HydrateState state = line(part);
  if (!change.has_rate()) return state;
  double const lost = lost_width(part);
  if (lost > 0)
    state.saturation = std::min(
        from.saturation, saturation_of_width(scene, d50, formed, reference_width(scene, d50, formed, from.saturation) - lost));
  return state;
}

}  // namespace clathra
