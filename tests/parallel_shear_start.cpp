/// The first steps of a shear: walls and discs set out together.
#include <gtest/gtest.h>

#include "small_test.hpp"

namespace clathra {
namespace {

// Where discs move one step before the walls do they leave them by the way of a step, which is some per cent of their overlap:
// the first rows then have q at -1 to -8 % of sigma_3, the more the larger and the faster the specimen is.
TEST(ShearStart, TakesNoDiscsAwayFromTheWalls) {
  for (double const saturation : {0.0, 0.55})
    for (double const inertial_number : {2e-4, 1e-3}) {
      Scene scene = small_test();
      scene.hydrate.saturation = saturation;
      scene.test.inertial_number = inertial_number;
      scene.test.max_platen_wave_stress = 0;
      scene.output.records = 4000;
      BiaxialTest test(scene, small_specimen(), {});
      for (int row = 0; row < 20; ++row) {
        while (!test.advance(1)) continue;
        HistoryRow const now = test.record();
        EXPECT_GT(now.q_Pa, -1e-3 * scene.test.confining_stress) << saturation << " " << inertial_number << " row " << row;
      }
    }
}

}  // namespace
}  // namespace clathra
