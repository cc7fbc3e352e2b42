#include "domain/generation/packing.hpp"

#include <algorithm>
#include <cmath>

#include "domain/generation/compression.hpp"
#include "domain/generation/loose_discs.hpp"

namespace clathra {

namespace {

// Inertial numbers of the closing of a layer, far from jamming and near it.
constexpr double far_rate = 0.015, near_rate = 5e-3;
constexpr double slowing_range = 0.15;  // in void ratio
// Of the friction, in layers: with all of it those below jam as a layer closes above them, again and again, and end looser, with
// half the lateral stress of those above; without it specimens have 3 % more contacts than such that are closed at once.
constexpr double share_in_layers = 0.5;

/// Of a box that has left to close alike in both directions [m].
double unjammed_width(SpecimenDesign const& design) {
  return design.width * std::sqrt((1 + design.void_ratio + unjammed) / (1 + design.void_ratio));
}

double highest_point(Specimen const& specimen, Ranks const& ranks) {
  double highest = specimen.bottom;
  for (std::size_t i = 0; i < specimen.size(); ++i) highest = std::max(highest, specimen.y[i] + specimen.radius[i]);
  return ranks.max(highest);
}

/// How a layer closes on those below it.
struct LayerClosing {
  double floor;                ///< what lies above it closes [m]
  double void_ratio;           ///< of all at its end
  double far_rate, near_rate;  ///< of the height above the floor, far from jamming and near it [1/s]
  double resistance;           ///< it ends at this vertical stress, too [Pa]
};

/// Strains what lies above the floor, top wall and discs together, ever slower as it is about to jam. A wall that came down by
/// itself would compact what is next to it first.
void compact(Simulation& simulation, LayerClosing const& layer, Progress const& stage, ProgressCallback const& progress) {
  simulation.choose_time_step(StepChoice{});
  simulation.loading().x = simulation.loading().y = AxisDrive::held();
  simulation.evaluate_forces();
  while (simulation.assembly().void_ratio() > layer.void_ratio && stress_inside(simulation).y < layer.resistance) {
    double const far = std::clamp((simulation.assembly().void_ratio() - layer.void_ratio) / slowing_range, 0.0, 1.0);
    double const rate = layer.near_rate + far * (layer.far_rate - layer.near_rate);
    simulation.strain_above(layer.floor, rate * steering * simulation.time_step);
    simulation.step(steering);
    if (simulation.assembly().steps() % 500 == 0)
      report(progress, {stage.stage, stage.fraction,
                        stage.detail + ", e " + std::to_string(simulation.assembly().void_ratio()).substr(0, 5),
                        simulation.assembly().steps() * simulation.assembly().discs()});
  }
}

/// All discs in layers, each compacted to its own void ratio of Jiang's rule on those below it; unjammed and without motion.
/// @param slowness  divides the rates;  @param counted  gets the disc-steps of all layers
Specimen compacted_layers(Scene const& scene, SpecimenDesign const& design, SimulationLaws const& laws, double slowness,
                          ProgressCallback const& counted, std::int64_t& disc_steps, Ranks const& ranks) {
  Specimen specimen;
  specimen.right = unjammed_width(design);
  specimen.density = scene.grains.density;
  specimen.d50 = design.grading.d50();
  int const layers = compaction_layers(scene, design);
  LooseDiscs const loose(design.grading, design.particles, layers, scene.run.seed);
  for (int layer = 1; layer <= layers; ++layer) {
    double const floor = highest_point(specimen, ranks);
    loose.add_layer(specimen, layer - 1, floor, ranks);
    Simulation simulation(specimen, laws, usual_skin(specimen.d50, design.grading.smallest()), ranks);
    Progress const stage{"generate", 0.6 * layer * layer / (layers * layers),
                         "layer " + std::to_string(layer) + "/" + std::to_string(layers), 0};
    double const unit =
        strain_rate_of(1, scene.specimen.preparation_stress, simulation.assembly().facts.moving_density(), specimen.d50) /
        slowness;
    compact(simulation,
            {floor, under_compaction_void_ratio(design.void_ratio, layer, layers) + unjammed, unit * far_rate, unit * near_rate,
             20 * scene.specimen.preparation_stress},
            stage, counted);
    disc_steps += simulation.assembly().steps() * simulation.assembly().discs();
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

PackedSpecimen pack_by_under_compaction(Scene const& scene, SpecimenDesign const& design, ProgressCallback const& progress,
                                        Ranks const& ranks) {
  std::int64_t of_layers = 0;
  ProgressCallback const counted = [&](Progress p) {
    p.disc_steps += of_layers;
    return !progress || progress(p);
  };
  GenerationFriction friction = generation_friction(design.void_ratio);
  friction.share = share_in_layers;
  SimulationLaws const laws = flowing_laws(generation_laws(scene, friction), scene.specimen.preparation_stress, design.grading);
  Specimen const layers = slower_where_it_fails(
      [&](int slowness) { return compacted_layers(scene, design, laws, slowness, counted, of_layers, ranks); });
  PackedSpecimen packed = compress(layers, scene, design, counted, ranks);
  packed.disc_steps += of_layers;
  return packed;
}

PackedSpecimen pack_by_compression(Scene const& scene, SpecimenDesign const& design, ProgressCallback const& progress,
                                   Ranks const& ranks) {
  Specimen loose;
  loose.right = unjammed_width(design);
  loose.density = scene.grains.density;
  loose.d50 = design.grading.d50();
  LooseDiscs(design.grading, design.particles, 1, scene.run.seed).add_layer(loose, 0, 0, ranks);
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
