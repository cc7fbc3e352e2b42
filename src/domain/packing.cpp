#include "domain/packing.hpp"

#include <algorithm>
#include <cmath>

#include "domain/loose_placement.hpp"
#include "domain/random.hpp"
#include "domain/settling.hpp"

namespace clathra {

namespace {

constexpr double loose_solid_fraction = 0.46;  // of the random placement
constexpr double unjammed = 0.04;              // in void ratio: how far above e_(i) a layer's compaction stops
constexpr double slowing_range = 0.15;         // in void ratio: the wall slows down as the layers are about to jam
constexpr double loose_skin = 0.25;            // in d50, while discs still fly

/// Adds discs above the present ones and lifts the top wall over them. They begin to move as a layer that is compacted
/// homogeneously by a wall coming down at `speed` [m/s], so that no compaction front runs ahead of the wall.
void add_layer(Specimen& specimen, std::vector<double> const& radii, double from, double speed, std::uint64_t seed,
               std::uint64_t stream) {
  double solid = 0;
  for (double r : radii) solid += pi * r * r;
  Region region{specimen.left, from, specimen.width(), solid / loose_solid_fraction / specimen.width(), false};
  Placement const placed = place_loosely(radii, region, seed, stream);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    specimen.id.push_back(static_cast<int>(specimen.id.size()));
    specimen.x.push_back(placed.x[i]);
    specimen.y.push_back(placed.y[i]);
    specimen.radius.push_back(radii[i]);
    specimen.vy.push_back(-speed * (placed.y[i] - from) / region.height);
    for (auto* field : {&specimen.angle, &specimen.vx, &specimen.omega}) field->push_back(0);
  }
  specimen.top = from + region.height;
}

double highest_point(Specimen const& specimen) {
  double highest = specimen.bottom;
  for (std::size_t i = 0; i < specimen.size(); ++i) highest = std::max(highest, specimen.y[i] + specimen.radius[i]);
  return highest;
}

/// Drives the top wall down, ever slower as the assembly is about to jam, until it has the void ratio or resists with twenty
/// times the stress.
void compact(Simulation& simulation, double void_ratio, double stress, double speed, Progress const& stage,
             ProgressCallback const& progress) {
  simulation.loading.x = AxisDrive::held();
  double mean_stress = 0;  // over the last steps: single blows of flying discs are no stress
  while (simulation.void_ratio() > void_ratio && mean_stress < 20 * stress) {
    double const slowed = speed * std::clamp((simulation.void_ratio() - void_ratio - 0.02) / slowing_range, 0.03, 1.0);
    simulation.loading.y = AxisDrive::at_rate(slowed / simulation.walls().height(), true);
    constexpr int look = 200;
    simulation.time_step = 0.8 * simulation.stable_time_step();
    mean_stress = 0;
    for (int n = 0; n < look && simulation.void_ratio() > void_ratio; ++n) {
      simulation.step();
      mean_stress += simulation.stress().y / look;
    }
    report(progress, {stage.stage, stage.fraction, stage.detail + ", e " + std::to_string(simulation.void_ratio()).substr(0, 5),
                      simulation.steps() * simulation.discs()});
  }
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

PackedSpecimen pack_by_under_compaction(Scene const& scene, SampleDesign const& design, ProgressCallback const& progress) {
  double const d50 = design.grading.d50();
  GenerationFriction knob;
  knob.shape_factor = design.void_ratio > 0.28 ? 2 : 1;  // friction alone packs to about 0.25, with impacts to 0.24
  SimulationLaws const laws = generation_laws(scene, knob);
  Specimen specimen;
  specimen.right = design.width;
  specimen.density = scene.grains.density;
  specimen.d50 = d50;
  PackedSpecimen packed;
  ProgressCallback const counted = [&](Progress p) {
    p.disc_steps += packed.disc_steps;  // of the layers before
    return !progress || progress(p);
  };
  double const speed = 0.5 * std::sqrt(scene.bond.stress / scene.grains.density);
  int const layers =
      static_cast<int>(std::min<std::int64_t>(scene.sample.layers, std::max<std::int64_t>(1, design.particles / 50)));
  for (int layer = 1; layer <= layers; ++layer) {
    std::int64_t const upto = design.particles * layer / layers, before = design.particles * (layer - 1) / layers;
    auto const stream = static_cast<std::uint64_t>(layer);
    add_layer(specimen, random_radii(design.grading, upto - before, scene.run.seed, 100 + stream), highest_point(specimen), speed,
              scene.run.seed, stream);
    Simulation simulation(specimen, laws, loose_skin * d50);
    Progress const stage{"generate", 0.6 * layer * layer / (layers * layers),
                         "layer " + std::to_string(layer) + "/" + std::to_string(layers), 0};
    compact(simulation, under_compaction_void_ratio(design.void_ratio, layer, layers) + unjammed, scene.bond.stress, speed, stage,
            counted);
    packed.disc_steps += simulation.steps() * simulation.discs();
    simulation.stop_discs();
    specimen = simulation.specimen();
  }
  Simulation simulation(specimen, laws, 0.1 * d50);
  simulation.stop_discs();
  SettlingTarget target;
  target.stress = scene.bond.stress;
  target.void_ratio = design.void_ratio;
  target.d50 = d50;
  double const share = settle(simulation, scene, knob, target, counted);
  packed.disc_steps += simulation.steps() * simulation.discs();
  packed.specimen = simulation.specimen();
  packed.specimen.stress = scene.bond.stress;
  packed.friction = knob.friction * share;
  packed.shape_factor = knob.shape_factor * share;
  packed.unbalanced = simulation.measures().unbalanced_ratio(simulation.discs());
  packed.stress_x = simulation.stress().x;
  packed.stress_y = simulation.stress().y;
  return packed;
}

double disc_area_below(double radius, double offset) {
  if (offset <= -radius) return 0;
  if (offset >= radius) return pi * radius * radius;
  double const s = offset / radius;
  return radius * radius * (std::acos(-s) + s * std::sqrt(1 - s * s));
}

std::vector<double> layer_void_ratios(Specimen const& specimen, int layers) {
  std::vector<double> solid(static_cast<std::size_t>(layers), 0.0);
  double const height = specimen.height() / layers;
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    double const y = specimen.y[i] - specimen.bottom, r = specimen.radius[i];
    int const first = std::clamp(static_cast<int>((y - r) / height), 0, layers - 1),
              last = std::clamp(static_cast<int>((y + r) / height), 0, layers - 1);
    for (int k = first; k <= last; ++k) {
      double const top = k == layers - 1 ? pi * r * r : disc_area_below(r, (k + 1) * height - y);
      double const bottom = k == 0 ? 0 : disc_area_below(r, k * height - y);
      solid[static_cast<std::size_t>(k)] += top - bottom;
    }
  }
  std::vector<double> ratios;
  for (double area : solid) ratios.push_back(height * specimen.width() / area - 1);
  return ratios;
}

}  // namespace clathra
