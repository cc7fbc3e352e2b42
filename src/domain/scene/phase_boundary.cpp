#include "domain/scene/phase_boundary.hpp"

#include <cmath>

#include "domain/scene/units.hpp"

namespace clathra {
double equilibrium_pressure(double temperature, double salinity) {
  double const t = zero_celsius + temperature, log_t = std::log(t);
  double const c0 = -1.6444866e3 - 0.1374178 * t + 5.4979866e4 / t + 264.118188 * log_t,
               c1 = 1.1178266e4 + 7.67420344 * t - 4.515213e-3 * t * t - 2.04872879e5 / t - 2172.46046 * log_t,
               c2 = 170.484431 + 0.118594073 * t - 7.0581304e-5 * t * t - 3097.96169 / t - 33.2031996 * log_t;
  return 1e6 * std::exp(c0 + salinity * (c1 + salinity * c2));
}

double equilibrium_temperature(double pore_pressure, double salinity) {
  double low = -10, high = 28;
  if (!(pore_pressure > equilibrium_pressure(low, salinity))) return low;
  if (pore_pressure >= equilibrium_pressure(high, salinity)) return high;
  constexpr double close = 1e-9;
  while (high - low > close) {
    double const middle = 0.5 * (low + high);
    (equilibrium_pressure(middle, salinity) < pore_pressure ? low : high) = middle;
  }
  return low;
}

std::string boundary_warning(double temperature, double salinity) {
  std::string outside;
  if (!(temperature >= 273 - zero_celsius && temperature <= 293 - zero_celsius))
    outside = format_number(temperature) + " degC (-0.15 to 19.85 degC)";
  if (!(salinity >= 0 && salinity <= 70))
    outside += (outside.empty() ? "" : ", ") + format_number(salinity) + " ppt (0 to 70 ppt)";
  return outside.empty() ? outside : "the phase boundary of hydrate was not fitted to " + outside;
}

}  // namespace clathra
