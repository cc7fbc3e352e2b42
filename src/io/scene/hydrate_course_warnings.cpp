#include "io/scene/hydrate_course_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "domain/scene/hydrate_loss.hpp"
#include "domain/scene/phase_boundary.hpp"

namespace clathra {
namespace {

/// How the hydrate is; its saturation is nan where a rate decides.
struct Course {
  double temperature, pore_pressure, saturation;
};

Course after(Course const& before, HydrateChange const& change) {
  auto const next = [](double end, double now) { return is_given(end) ? end : now; };
  return {next(change.temperature, before.temperature), next(change.pore_pressure, before.pore_pressure),
          change.dissociates() ? std::nan("") : next(change.saturation, before.saturation)};
}

/// Above 0 where hydrate is stable [K].
double distance(Course const& at, double salinity) {
  return equilibrium_temperature(at.pore_pressure, salinity) - at.temperature;
}

std::string warning_of(LoadingStage const& stage, Course const& from, Course const& to, double salinity) {
  HydrateChange const& change = stage.hydrate;
  bool const moves = to.temperature != from.temperature || to.pore_pressure != from.pore_pressure;
  Course const middle{0.5 * (from.temperature + to.temperature), 0.5 * (from.pore_pressure + to.pore_pressure), 0};
  double const first = distance(from, salinity), last = distance(to, salinity),
               least = std::min({first, last, distance(middle, salinity)});
  if (change.undrained && change.constant_total_stress)
    return "'hydrate.constant_total_stress' has no effect: 'hydrate.undrained' keeps the total stresses already";
  if (change.constant_total_stress && to.pore_pressure == from.pore_pressure)
    return "'hydrate.constant_total_stress' has no effect: the pore pressure stays";
  if (change.dissociates() && from.saturation <= least_cementing)
    return "'hydrate.dissociation' has no effect: no hydrate is left that cements";
  if (change.dissociates() && least > 0)
    return fmt::format("'hydrate.dissociation' has no effect: hydrate stays stable, by {:.2g} K at the least", least);
  if (!change.dissociates() && !moves && !(to.saturation != from.saturation))
    return "'hydrate' changes nothing: temperature, pore pressure and saturation are those that are there";
  if (to.saturation < from.saturation && first > 0 && last > 0)
    return fmt::format("the hydrate that is lost is stable, by {:.2g} K at the least: a saturation that is given follows nothing",
                       std::min(first, last));
  if (!change.undrained && to.saturation == from.saturation && to.saturation > least_cementing && last < 0)
    return fmt::format("the hydrate stays, {:.2g} K beyond where it is stable: state a 'saturation' or a 'dissociation'", -last);
  return {};
}

}  // namespace

std::vector<std::string> hydrate_course_warnings(Scene const& scene, std::vector<LoadingStage> const& stages) {
  std::vector<std::string> warnings;
  Course now{scene.hydrate.temperature, scene.hydrate.pore_pressure, scene.hydrate.saturation};
  for (LoadingStage const& stage : stages) {
    if (!stage.hydrate.any()) continue;
    Course const next = after(now, stage.hydrate);
    if (std::string const text = warning_of(stage, now, next, scene.hydrate.salinity); !text.empty())
      warnings.push_back(fmt::format("stage '{}': {}", stage.name.substr(0, 60), text));
    now = next;
  }
  return warnings;
}

}  // namespace clathra
