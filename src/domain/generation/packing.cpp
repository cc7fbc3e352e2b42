#include "domain/generation/packing.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "domain/generation/compression.hpp"
#include "domain/generation/loose_discs.hpp"
#include "domain/generation/random.hpp"
#include "domain/generation/random_sequential_addition.hpp"

namespace clathra {

namespace {

constexpr double slowing_range = 0.15;  // in void ratio: the wall slows down as the layers are about to jam
constexpr double loose_skin = 0.2;      // in d50, while discs still fly

/// The loose discs of a layer. Wide layers are placed in patches side by side, whatever the number of ranks.
struct Layer {
  std::int64_t first_id, discs;
  std::uint64_t seed, stream;
  std::int64_t patches() const { return (discs + most_in_patch - 1) / most_in_patch; }
  std::int64_t begin(std::int64_t patch) const { return discs * patch / patches(); }
  std::vector<double> radii(Grading const& grading, std::int64_t patch) const {
    return random_radii(grading, begin(patch + 1) - begin(patch), seed, 100 + stream_of(patch));
  }
  std::uint64_t stream_of(std::int64_t patch) const { return stream + 1000 * static_cast<std::uint64_t>(patch); }
};

/// Adds discs above the present ones and lifts the top wall over them; ranks take the patches by turns. The discs begin to move
/// as a layer that is compacted homogeneously by a wall coming down at `speed` [m/s], so that no compaction front runs ahead of
/// the wall.
void add_layer(Specimen& specimen, Grading const& grading, Layer const& layer, double from, double speed, Ranks const& ranks) {
  double solid = 0;
  std::int64_t const patches = layer.patches();
  std::map<std::int64_t, double> solid_of;  // by number of discs: patches differ by one at the most
  for (std::int64_t patch = 0; patch < patches; ++patch) {
    double& area = solid_of[layer.begin(patch + 1) - layer.begin(patch)];
    if (area == 0) {
      for (double r : layer.radii(grading, patch)) area += pi * r * r;
    }
    solid += area;
  }
  double const height = solid / loose_solid_fraction / specimen.width();
  for (std::int64_t patch = ranks.rank(); patch < patches; patch += ranks.count()) {
    std::vector<double> const radii = layer.radii(grading, patch);
    auto const edge = [&](std::int64_t p) {
      return specimen.width() * static_cast<double>(layer.begin(p)) / static_cast<double>(layer.discs);
    };
    Region const region{specimen.left + edge(patch), from, edge(patch + 1) - edge(patch), height, false};
    Placement const placed = place_by_random_addition(radii, region, layer.seed, layer.stream_of(patch));
    add_discs(specimen, layer.first_id + layer.begin(patch), radii, placed, from, height, speed);
  }
  specimen.top = from + height;
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

/// All discs in layers, each compacted to its own void ratio of Jiang's rule on those below it; unjammed and without motion.
/// @param counted  gets the disc-steps of all layers
Specimen compacted_layers(Scene const& scene, SampleDesign const& design, SimulationLaws const& laws,
                          ProgressCallback const& counted, std::int64_t& disc_steps, Ranks const& ranks) {
  Specimen specimen;
  specimen.right = design.width;
  specimen.density = scene.grains.density;
  specimen.d50 = design.grading.d50();
  double const speed = 0.5 * std::sqrt(scene.bond.stress / scene.grains.density);
  int const layers = compaction_layers(scene, design);
  for (int layer = 1; layer <= layers; ++layer) {
    std::int64_t const upto = design.particles * layer / layers, before = design.particles * (layer - 1) / layers;
    Layer const loose{before, upto - before, scene.run.seed, static_cast<std::uint64_t>(layer)};
    add_layer(specimen, design.grading, loose, highest_point(specimen, ranks), speed, ranks);
    Simulation simulation(specimen, laws, loose_skin * specimen.d50, ranks);
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

std::vector<double> random_radii(Grading const& grading, std::int64_t particles, std::uint64_t seed, std::uint64_t stream) {
  std::vector<double> radii = grading.diameters(static_cast<std::size_t>(particles));
  for (double& r : radii) r *= 0.5;
  shuffle(radii, seed, stream);
  return radii;
}

PackedSpecimen pack_by_under_compaction(Scene const& scene, SampleDesign const& design, ProgressCallback const& progress,
                                        Ranks const& ranks) {
  double const d50 = design.grading.d50();
  GenerationFriction friction;
  friction.shape_factor = design.void_ratio > 0.28 ? 2 : 1;  // friction alone packs to about 0.25, with impacts to 0.24
  std::int64_t of_layers = 0;
  ProgressCallback const counted = [&](Progress p) {
    p.disc_steps += of_layers;
    return !progress || progress(p);
  };
  SimulationLaws const laws = flowing_laws(generation_laws(scene, friction), scene.bond.stress, design.grading);
  Specimen const layers = compacted_layers(scene, design, laws, counted, of_layers, ranks);
  CompressionTarget target;
  target.stress = scene.bond.stress;
  target.void_ratio = design.void_ratio;
  target.d50 = d50;
  PackedSpecimen packed = compress_to_void_ratio(layers, scene, friction, target, 0.1 * d50, counted, ranks);
  packed.disc_steps += of_layers;
  return packed;
}

PackedSpecimen pack_by_compression(Scene const& scene, SampleDesign const& design, ProgressCallback const& progress,
                                   Ranks const& ranks) {
  Specimen loose;
  loose.right = design.width * std::sqrt((1 + design.void_ratio + unjammed) / (1 + design.void_ratio));
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
