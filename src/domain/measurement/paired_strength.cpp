#include "domain/measurement/paired_strength.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace clathra {
namespace {

constexpr double equal_stress = 1e-9;  // part by which two texts of one stress may differ

/// The confining stresses that any test has, rising.
std::vector<double> stresses_of(std::vector<SeedTest> const& tests) {
  std::vector<double> stresses;
  for (SeedTest const& test : tests) stresses.push_back(test.confining_stress);
  std::sort(stresses.begin(), stresses.end());
  auto const same = [](double a, double b) { return std::abs(a - b) <= equal_stress * std::abs(b); };
  stresses.erase(std::unique(stresses.begin(), stresses.end(), same), stresses.end());
  return stresses;
}

Envelope mean_of(std::vector<Envelope> const& fits, PairedStrength& strength) {
  std::vector<double> cohesions, angles, curvatures;
  for (Envelope const& fit : fits) {
    cohesions.push_back(fit.cohesion);
    angles.push_back(fit.friction_angle);
    if (fit.curvature) curvatures.push_back(*fit.curvature);
  }
  strength.cohesion = mean_interval(cohesions);
  strength.friction_angle = mean_interval(angles);
  Envelope mean;
  mean.cohesion = strength.cohesion->mean;
  mean.friction_angle = strength.friction_angle->mean;
  if (curvatures.size() == fits.size()) mean.curvature = mean_interval(curvatures).mean;
  return mean;
}

}  // namespace

PairedStrength paired_strength(std::vector<SeedTest> const& tests) {
  PairedStrength strength;
  std::size_t const stresses = stresses_of(tests).size();
  std::set<std::uint64_t> seen;
  std::vector<FailureStress> all;
  for (SeedTest const& first : tests) {
    all.push_back(first.at);
    if (!seen.insert(first.seed).second) continue;
    std::vector<SeedTest> own;
    std::copy_if(tests.begin(), tests.end(), std::back_inserter(own), [&](SeedTest const& t) { return t.seed == first.seed; });
    std::vector<FailureStress> at;
    for (SeedTest const& test : own) at.push_back(test.at);
    std::optional<Envelope> const fit = stresses_of(own).size() == stresses ? fitted_envelope(at) : std::nullopt;
    (fit ? strength.seeds : strength.incomplete).push_back(first.seed);
    if (fit) strength.of_seeds.push_back(*fit);
  }
  if (strength.of_seeds.size() > 1)
    strength.envelope = mean_of(strength.of_seeds, strength);
  else
    strength.envelope = strength.of_seeds.empty() ? fitted_envelope(all) : strength.of_seeds.front();
  return strength;
}

}  // namespace clathra
