#include "domain/generation/generation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "domain/generation/compression.hpp"
#include "domain/generation/packing.hpp"
#include "domain/measurement/disc_grading.hpp"
#include "domain/scene/short_number.hpp"
#include "domain/scene/specimen_design.hpp"

namespace clathra {

namespace {

double standard_deviation(std::vector<double> const& values) {
  double mean = 0, square = 0;
  for (double v : values) mean += v / static_cast<double>(values.size());
  for (double v : values) square += (v - mean) * (v - mean) / static_cast<double>(values.size());
  return std::sqrt(square);
}

PackedSpecimen pack(Scene const& scene, ProgressCallback const& progress, Ranks const& ranks) {
  bool const layered = scene.specimen.generator == Generator::under_compaction;
  return (layered ? pack_by_under_compaction : pack_by_compression)(scene, design_sample(scene), progress, ranks);
}

/// A void ratio of three digits that this scene's grains do rest at when it is asked for: the nearest that is found by making
/// such specimens, since what one specimen came to rest at depends on what was asked of it. Nothing where none is found.
std::optional<double> reachable_void_ratio(Scene scene, VoidRatioMissed const& missed, SpecimenMaker const& make) {
  constexpr int most_attempts = 8;
  double const way = missed.denser ? 1 : -1;
  auto const rounded_away = [&](double ratio) { return way * std::ceil(way * ratio * 1000 - 1e-6) / 1000; };
  double step = 0.002, next = rounded_away(missed.reached), near = next, farthest = next;
  std::optional<double> beyond;  // missed from the other side
  for (int attempt = 0; attempt < most_attempts; ++attempt, step *= 2) {
    scene.specimen.void_ratio = next;
    try {
      (void)make(scene);
      return next;
    } catch (VoidRatioMissed const& again) {
      farthest = way * std::max(way * farthest, way * next);
      (again.denser != missed.denser ? beyond.emplace() : near) = next;
      double const between = beyond ? rounded_away(0.5 * (near + *beyond)) : near;
      if (between != near && between != beyond) {
        next = between;
      } else {  // nothing between them, or not missed from the other side: further away
        beyond.reset();
        next = near = rounded_away(way * std::max(way * (farthest + way * step), way * again.reached));
      }
    }
  }
  return {};
}

/// A void ratio that works, in the words of an error. A denser specimen is a smaller one, which may be too small for a test.
std::string offer_of(Scene scene, double void_ratio) {
  std::string const offer = "specimen.void_ratio = " + short_number(void_ratio) + " was tried and works";
  scene.specimen.void_ratio = void_ratio;
  SpecimenDesign const design = design_sample(scene);
  std::string const problem = narrowness(design.width, design.height, design.grading.largest());
  return problem.empty() ? offer : offer + ", with more specimen.particles: " + problem;
}

/// What a user should know of a specimen that was made as it was asked for.
std::vector<std::string> warnings_of(StageRecord const& made) {
  constexpr double most_deep = 0.001, farthest = 0.02;
  std::vector<std::string> warnings;
  if (double const share = made.at("deep_overlap_share"); share > most_deep)
    warnings.push_back("under the preparation stress " + short_number(100 * share) +
                       " % of the contacts overlap by more than 10 % of the smaller radius: the grains are soft for it "
                       "(grains.normal_stiffness, "
                       "specimen.preparation_stress)");
  if (double const distance = made.at("grading_distance"); distance > farthest)
    warnings.push_back(
        "the particles miss the grading curve by " + short_number(100 * distance) +
        " % at most: they are too few for it (specimen.particles), or for so many layers (specimen.compaction_layers)");
  return warnings;
}

}  // namespace

GeneratedSpecimen make_specimen(Scene const& scene, ProgressCallback const& progress, Ranks const& ranks) {
  SpecimenDesign const design = design_sample(scene);
  PackedSpecimen packed = pack(scene, progress, ranks);
  GeneratedSpecimen generated;
  int const layers = scene.specimen.generator == Generator::under_compaction ? compaction_layers(scene, design)
                                                                             : scene.specimen.compaction_layers;
  generated.layer_void_ratios = layer_void_ratios(packed.specimen, layers, ranks);
  StageRecord& r = generated.record;
  r["particles"] = static_cast<double>(ranks.sum(static_cast<std::int64_t>(packed.specimen.size())));
  r["void_ratio"] = packed.specimen.void_ratio;
  r["void_ratio_wanted"] = design.void_ratio;
  r["layer_void_ratio_sd"] = standard_deviation(generated.layer_void_ratios);
  r["d50_m"] = diameter_finer(packed.specimen.radius, 0.5, ranks);
  r["d50_wanted_m"] = design.grading.d50();
  r["grading_distance"] = grading_distance(design.grading, packed.specimen.radius, ranks);
  r["generation_friction"] = packed.friction;
  r["generation_rolling_width_factor"] = packed.shape_factor;
  r["stress_x_Pa"] = packed.stress_x;
  r["stress_y_Pa"] = packed.stress_y;
  r["unbalanced"] = packed.unbalanced;
  r["deep_overlap_share"] = packed.deep_overlap_share;
  r["particle_steps"] = static_cast<double>(packed.disc_steps);
  r["width_m"] = packed.specimen.width();
  r["height_m"] = packed.specimen.height();
  generated.warnings = warnings_of(r);
  generated.specimen = std::move(packed.specimen);
  return generated;
}

GeneratedSpecimen made_or_advised(Scene const& scene, SpecimenMaker const& make) {
  try {
    return make(scene);
  } catch (VoidRatioMissed const& missed) {
    bool const box = scene.specimen.width > 0 && scene.specimen.height > 0;
    if (scene.specimen.void_ratio == 0 && box)
      throw Refused(std::string(missed.what()) + "; it follows from specimen.particles and the box: change one of these");
    std::optional<double> const instead = reachable_void_ratio(scene, missed, make);
    throw Refused(std::string(missed.what()) +
                  (instead ? "; " + offer_of(scene, *instead) : "; none near it was found that works"));
  }
}

GeneratedSpecimen generate_specimen(Scene const& scene, ProgressCallback const& progress, Ranks const& ranks) {
  return made_or_advised(scene, [&](Scene const& tried) { return make_specimen(tried, progress, ranks); });
}

}  // namespace clathra
