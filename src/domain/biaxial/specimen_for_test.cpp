#include "domain/biaxial/specimen_for_test.hpp"

#include <cmath>

#include "domain/biaxial/biaxial_test.hpp"
#include "domain/generation/compression.hpp"
#include "domain/scene/scene_laws.hpp"
#include "domain/scene/short_number.hpp"
#include "domain/scene/specimen_design.hpp"

namespace clathra {

namespace {

/// What is lost between making and test is lost again by the next specimen, nearly: the second of 20,000 discs has the void
/// ratio. A few hundred lose 0.003 more or less by chance, and grains near the loosest that they hold lose most of what they are
/// given.
GeneratedSpecimen made_for_consolidation(Scene const& scene, ProgressCallback const& progress, Ranks const& ranks) {
  constexpr int most_attempts = 8;
  double const wanted = design_sample(scene).void_ratio;
  Scene made = scene;
  made.specimen.void_ratio = wanted + elastic_loss(scene, wanted, scene.specimen.preparation_stress);
  double disc_steps = 0, reached = 0, lacking = 0;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    GeneratedSpecimen generated;
    try {
      generated = make_specimen(made, progress, ranks);
    } catch (VoidRatioMissed const& missed) {
      throw VoidRatioMissed("for a void ratio of " + short_number(wanted, 4) + " under the confining stress it takes " +
                                short_number(made.specimen.void_ratio, 4) + " before, but " + missed.what(),
                            wanted + missed.reached - made.specimen.void_ratio, missed.denser);
    }
    BiaxialTest const test(scene, generated.specimen, progress, ranks);
    reached = test.preparation().at("void_ratio_after_consolidation");
    disc_steps += generated.record["particle_steps"] + static_cast<double>(test.disc_steps());
    generated.record["particle_steps"] = disc_steps;
    generated.record["void_ratio_at_test"] = reached;
    if (std::abs(reached - wanted) <= void_tolerance) return generated;
    bool const turned = (wanted - reached) * lacking < 0;
    lacking = wanted - reached;
    made.specimen.void_ratio += (turned ? 0.7 : 1) * lacking;
  }
  throw VoidRatioMissed("under the confining stress of " + short_number(scene.test.confining_stress * 1e-6, 4) + " MPa " +
                            std::to_string(most_attempts) + " specimens missed a void ratio of " + short_number(wanted, 4) +
                            ", the last by " + short_number(reached - wanted, 2),
                        reached, reached > wanted);
}

}  // namespace

GeneratedSpecimen specimen_for_test(Scene const& scene, ProgressCallback const& progress, Ranks const& ranks) {
  if (scene.specimen.void_ratio_at == VoidRatioAt::preparation) return generate_specimen(scene, progress, ranks);
  return made_or_advised(scene, [&](Scene const& tried) { return made_for_consolidation(tried, progress, ranks); });
}

}  // namespace clathra
