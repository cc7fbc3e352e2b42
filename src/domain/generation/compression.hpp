#pragma once
/// Closing an assembly of any size to a wanted void ratio, at which it rests under an isotropic stress.
///
/// The void ratio is reached by closing the box at a rate with the friction as a knob, not by waiting for a servo: a servo at
/// constant friction stops wherever the grains jam, and says so only after the whole compression.
#include "domain/generation/equilibration.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen.hpp"
#include "domain/scene/specimen_design.hpp"
#include "domain/scene/stage.hpp"

namespace clathra {

/// The void ratio above the target at which an assembly has left to close in both directions.
inline constexpr double unjammed = 0.04;
/// How far a specimen may be off the void ratio that was asked for.
inline constexpr double void_tolerance = 0.001;

/// The void ratio that was asked for is not one at which these grains rest.
struct VoidRatioMissed : Refused {
  VoidRatioMissed(std::string const& text, double rests_at, bool is_denser)
      : Refused(text), reached(rests_at), denser(is_denser) {}
  double reached;  ///< at rest
  bool denser;     ///< the wanted one is
};

/// make(1), or where that fails by chance make(2), make(3), make(4), which have to divide their rates by the number: in a small
/// specimen some discs may jam, a large disc may crush a small one against another on its way, and at another rate they may not.
/// @throws what the last one does;  VoidRatioMissed at once where the grains hold nothing as loose
template <class Make>
auto slower_where_it_fails(Make const& make) {
  constexpr int most_attempts = 4;
  for (int attempt = 1;; ++attempt) {
    try {
      return make(attempt);
    } catch (VoidRatioMissed const& missed) {
      if (attempt == most_attempts || !missed.denser) throw;
    } catch (Refused const&) {  // did not come to rest
      if (attempt == most_attempts) throw;
    } catch (Diverged const&) {
      if (attempt == most_attempts) throw;
    }
  }
}

/// Strains box and discs together from a loose state, first by the height alone, until the discs are about to jam, then from all
/// sides; the friction is lowered where the stress inside exceeds that of the design and raised where it falls short, so that the
/// assembly yields everywhere alike. A periodic cell closes from all sides throughout. Most of the way the grains are soft. Then
/// it comes to rest at the stress with its own stiffness and the full friction, so that it creeps no further; where it rests at
/// another void ratio, the last part of the closing is done again. Each disc has only its neighbours to find a place among, so
/// that the number of steps hardly depends on that of the discs.
/// @throws VoidRatioMissed where the design is denser than frictionless grains pack, or looser than full friction holds;
/// Refused where it does not come to rest
PackedSpecimen compress(Specimen const& loose, Scene const& scene, SpecimenDesign const& design, ProgressCallback const& progress,
                        Ranks const& ranks = {});

}  // namespace clathra
