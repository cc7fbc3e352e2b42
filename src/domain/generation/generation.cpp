#include "domain/generation/generation.hpp"

#include <algorithm>
#include <cmath>

#include "domain/generation/packing.hpp"
#include "domain/generation/tiled.hpp"
#include "domain/measurement/disc_grading.hpp"
#include "domain/scene/sample_design.hpp"

namespace clathra {

namespace {

double standard_deviation(std::vector<double> const& values) {
  double mean = 0, square = 0;
  for (double v : values) mean += v / static_cast<double>(values.size());
  for (double v : values) square += (v - mean) * (v - mean) / static_cast<double>(values.size());
  return std::sqrt(square);
}

}  // namespace

GeneratedSpecimen generate_specimen(Scene const& scene, ProgressCallback const& progress, Ranks const& ranks) {
  SampleDesign const design = design_sample(scene);
  PackedSpecimen packed = scene.sample.generator == Generator::tiled ? pack_by_tiling(scene, design, progress, ranks)
                                                                     : pack_by_under_compaction(scene, design, progress, ranks);
  GeneratedSpecimen generated;
  generated.layer_void_ratios = layer_void_ratios(packed.specimen, std::max(1, scene.sample.layers), ranks);
  StageRecord& r = generated.record;
  r["discs"] = static_cast<double>(ranks.sum(static_cast<std::int64_t>(packed.specimen.size())));
  r["void_ratio"] = packed.specimen.void_ratio;
  r["void_ratio_wanted"] = design.void_ratio;
  r["layer_void_ratio_sd"] = standard_deviation(generated.layer_void_ratios);
  r["d50_m"] = diameter_finer(packed.specimen.radius, 0.5, ranks);
  r["d50_wanted_m"] = design.grading.d50();
  r["grading_distance"] = grading_distance(design.grading, packed.specimen.radius, ranks);
  r["generation_friction"] = packed.friction;
  r["generation_shape_factor"] = packed.shape_factor;
  r["stress_x_Pa"] = packed.stress_x;
  r["stress_y_Pa"] = packed.stress_y;
  r["unbalanced"] = packed.unbalanced;
  r["disc_steps"] = static_cast<double>(packed.disc_steps);
  r["width_m"] = packed.specimen.width();
  r["height_m"] = packed.specimen.height();
  generated.specimen = std::move(packed.specimen);
  return generated;
}

}  // namespace clathra
