#include "io/results/strength_groups.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/scene/schema.hpp"

namespace clathra {
namespace {

void add_test(StrengthGroup& group, RunResults const& run) {
  TestNumbers const n = test_numbers(run.history.curves());
  auto const add = [&](TestStresses& tests, FailureStress const& stress) {
    tests.all.push_back(stress);
    if (n.passed_peak)
      tests.reached.push_back({static_cast<std::uint64_t>(run.number("/scene/run/seed").value_or(0)),
                               run.number("/scene/test/confining_stress").value_or(stress.sigma3), stress});
    else
      tests.rising.push_back(run.name);
  };
  add(group.peaks, {n.peak_sigma3 + n.peak_q, n.peak_sigma3});
  add(group.residuals, {n.residual_sigma3 + n.residual_q, n.residual_sigma3});
}

}  // namespace

std::vector<StrengthGroup> strength_groups(std::vector<RunResults> const& runs) {
  std::vector<StrengthGroup> groups;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].has_peak()) continue;
    if (!runs[i].history.has("sigma3_Pa")) continue;
    SceneValues material = material_of(runs[i]);
    material.erase(stress_key);
    auto same =
        std::find_if(groups.begin(), groups.end(), [&](StrengthGroup const& group) { return group.material == material; });
    if (same == groups.end()) {
      double const saturation = runs[i].has_bonds() ? runs[i].number("/scene/hydrate/saturation").value_or(0) : 0;
      same = groups.insert(groups.end(), StrengthGroup());
      same->material = std::move(material);
      same->saturation = static_cast<double>(std::lround(saturation * 1e6)) * 1e-4;
    }
    same->members.push_back(i);
    add_test(*same, runs[i]);
  }
  for (StrengthGroup& group : groups) {
    group.at_peak = paired_strength(group.peaks.reached);
    group.residual = paired_strength(group.residuals.reached);
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](StrengthGroup const& a, StrengthGroup const& b) { return a.saturation < b.saturation; });
  return groups;
}

}  // namespace clathra
