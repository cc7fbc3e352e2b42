#pragma once
/// How fast this machine steps, measured once and kept in the cache folder.
#include <string>

#include "domain/scene/scene.hpp"

namespace clathra {

struct MachineSpeed {
  double disc_steps_per_second = 0;
  std::string origin;  ///< "measured on this machine"
};

/// The speed of a scene's shear with its threads, on all ranks together. Measured with `clathra bench`, bonded or not, on the
/// largest of 250 to 200,000 particles that a specimen has, the first time that a program asks (some seconds), then kept in
/// $XDG_CACHE_HOME/clathra (~/.cache/clathra); a folder that cannot be written only means that it is measured again.
/// @param particles  of the specimen;  @param may_measure  else 15 million a thread where nothing is kept
MachineSpeed machine_speed(Scene const& scene, double particles, int ranks, bool may_measure);

}  // namespace clathra
