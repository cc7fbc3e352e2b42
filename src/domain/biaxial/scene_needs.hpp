#pragma once
/// What a scene makes the program keep and do while a specimen is sheared, and which key asks for it.
#include <string>
#include <vector>

#include "domain/scene/scene.hpp"

namespace clathra {

struct NeededField {
  std::string name;
  int bytes;  ///< a disc, or an entry of the neighbour rows (about 5 a disc)
  bool of_entry;
  std::string asked_by;  ///< keys of the scene, or "every scene"
};

struct NeededKernel {
  std::string name;  ///< its Kokkos label
  std::string does, asked_by;
};

struct SceneNeeds {
  std::vector<NeededField> fields;
  std::vector<NeededKernel>
      kernels;  ///< launched in each step; others run at neighbour searches, records and choices of the step
  /// @param of_entry  an entry of the rows, else a disc
  int bytes(bool of_entry) const {
    int sum = 0;
    for (NeededField const& field : fields) sum += field.of_entry == of_entry ? field.bytes : 0;
    return sum;
  }
};

SceneNeeds needs_of(Scene const& scene);

}  // namespace clathra
