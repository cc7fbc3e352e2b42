#include "domain/generation/packing.hpp"

#include <algorithm>
#include <cmath>

#include "domain/generation/compression.hpp"
#include "domain/generation/loose_discs.hpp"

namespace clathra {

namespace {

constexpr double slowing_range = 0.15;  // in void ratio: the wall slows down as the layers are about to jam

/// Of a box that has left to close alike in both directions [m].
double unjammed_width(SampleDesign const& design) {
  return design.width * std::sqrt((1 + design.void_ratio + unjammed) / (1 + design.void_ratio));
}

double highest_point(Specimen const& specimen, Ranks const& ranks) {
  double highest = specimen.bottom;
  for (std::size_t i = 0; i < specimen.size(); ++i) highest = std::max(highest, specimen.y[i] + specimen.radius[i]);
  return ranks.max(highest);
}

/// Drives the top wall down, ever slower as the assembly is about to jam, until it has the void ratio or resists with twenty
/// times the stress.
void compact(Simulation& simulation, StepChoice const& step, double void_ratio, double stress, double speed,
             Progress const& stage, ProgressCallback const& progress) {
  simulation.choose_time_step(step);
  simulation.loading().x = AxisDrive::held();
  double mean_stress = 0;  // over the last steps: single blows of flying discs are no stress
  while (simulation.void_ratio() > void_ratio && mean_stress < 20 * stress) {
    double const slowed = speed * std::clamp((simulation.void_ratio() - void_ratio - 0.02) / slowing_range, 0.05, 1.0);
    simulation.loading().y = AxisDrive::at_rate(slowed / simulation.walls().height(), true);
    constexpr int interval = 200;
    mean_stress = 0;
    for (int n = 0; n < interval && simulation.void_ratio() > void_ratio; ++n) {
      simulation.step();
      mean_stress += simulation.stress().y / interval;
    }
    report(progress, {stage.stage, stage.fraction, stage.detail + ", e " + std::to_string(simulation.void_ratio()).substr(0, 5),
                      simulation.steps() * simulation.discs()});
  }
}

/// make(1), or where that diverges make(2), make(3), make(4), which have to divide their speeds by the number. @throws Diverged
template <class Make>
auto slower_where_it_diverges(Make const& make) {
  constexpr int most_attempts = 4;
  for (int attempt = 1; attempt < most_attempts; ++attempt) {
    try {
      return make(attempt);
    } catch (Diverged const&) {  // the last attempt's goes to the caller
    }
  }
  return make(most_attempts);
}

/// All discs in layers, each compacted to its own void ratio of Jiang's rule on those below it; unjammed and without motion.
/// @param speed  of the top wall [m/s];  @param counted  gets the disc-steps of all layers
Specimen compacted_layers(Scene const& scene, SampleDesign const& design, SimulationLaws const& laws, double speed,
                          ProgressCallback const& counted, std::int64_t& disc_steps, Ranks const& ranks) {
  Specimen specimen;
  specimen.right = unjammed_width(design);
  specimen.density = scene.grains.density;
  specimen.d50 = design.grading.d50();
  int const layers = compaction_layers(scene, design);
  LooseDiscs const loose(design.grading, design.particles, layers, scene.run.seed);
  for (int layer = 1; layer <= layers; ++layer) {
    loose.add_layer(specimen, layer - 1, highest_point(specimen, ranks), speed, ranks);
    Simulation simulation(specimen, laws, usual_skin(specimen.d50, design.grading.smallest()), ranks);
    Progress const stage{"generate", 0.6 * layer * layer / (layers * layers),
                         "layer " + std::to_string(layer) + "/" + std::to_string(layers), 0};
    compact(simulation, StepChoice{}, under_compaction_void_ratio(design.void_ratio, layer, layers) + unjammed, scene.bond.stress,
            speed, stage, counted);
    disc_steps += simulation.steps() * simulation.discs();
    simulation.stop_discs();
    specimen = simulation.specimen();
  }
  return specimen;
}

}  // namespace

double under_compaction_void_ratio(double target, int layer, int layers, double excess, double exponent) {
  if (layers < 2) return target;
  return target + excess * std::pow(1 - static_cast<double>(layer - 1) / (layers - 1), exponent);
}

PackedSpecimen pack_by_under_compaction(Scene const& scene, SampleDesign const& design, ProgressCallback const& progress,
                                        Ranks const& ranks) {
  std::int64_t of_layers = 0;
  ProgressCallback const counted = [&](Progress p) {
    p.disc_steps += of_layers;
    return !progress || progress(p);
  };
  SimulationLaws const laws =
      flowing_laws(generation_laws(scene, generation_friction(design.void_ratio)), scene.bond.stress, design.grading);
  double const usual = 0.5 * gentleness(design.grading) * std::sqrt(scene.bond.stress / scene.grains.density);
  // A large disc on its way may crush a small one against another: then all go slower.
  Specimen const layers = slower_where_it_diverges(
      [&](int attempt) { return compacted_layers(scene, design, laws, usual / attempt, counted, of_layers, ranks); });
  PackedSpecimen packed = compress(layers, scene, design, counted, ranks);
  packed.disc_steps += of_layers;
  return packed;
}

PackedSpecimen pack_by_compression(Scene const& scene, SampleDesign const& design, ProgressCallback const& progress,
                                   Ranks const& ranks) {
  Specimen loose;
  loose.right = unjammed_width(design);
  loose.density = scene.grains.density;
  loose.d50 = design.grading.d50();
  LooseDiscs(design.grading, design.particles, 1, scene.run.seed).add_layer(loose, 0, 0, 0, ranks);
  return compress(loose, scene, design, progress, ranks);
}

double disc_area_below(double radius, double offset) {
  if (offset <= -radius) return 0;
  if (offset >= radius) return pi * radius * radius;
  double const s = offset / radius;
  return radius * radius * (std::acos(-s) + s * std::sqrt(1 - s * s));
}

std::vector<double> layer_void_ratios(Specimen const& specimen, int layers, Ranks const& ranks) {
  std::vector<ExactSum> solid(static_cast<std::size_t>(layers), ExactSum(SumUnits::near(specimen.d50 * specimen.d50)));
  double const height = specimen.height() / layers;
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    double const y = specimen.y[i] - specimen.bottom, r = specimen.radius[i];
    int const first = std::clamp(static_cast<int>((y - r) / height), 0, layers - 1),
              last = std::clamp(static_cast<int>((y + r) / height), 0, layers - 1);
    for (int k = first; k <= last; ++k) {
      double const top = k == layers - 1 ? pi * r * r : disc_area_below(r, (k + 1) * height - y);
      double const bottom = k == 0 ? 0 : disc_area_below(r, k * height - y);
      solid[static_cast<std::size_t>(k)].add(top - bottom);
    }
  }
  std::vector<double> ratios;
  for (ExactSum& area : solid) ratios.push_back(height * specimen.width() / area.over(ranks.summation()) - 1);
  return ratios;
}

}  // namespace clathra
