#pragma once
/// What a scene makes the program keep and do while a specimen is sheared, and which key asks for it.
#include <string>
#include <vector>

#include "domain/scene/scene.hpp"

namespace clathra {

/// What a field has a value of: a disc, an entry of the neighbour rows (about 5 a disc), or a bond (about 2 a disc).
enum class FieldOf { disc, entry, bond };

struct NeededField {
  std::string name;
  int bytes;  ///< of one value
  FieldOf of;
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
  int bytes(FieldOf of) const {
    int sum = 0;
    for (NeededField const& field : fields) sum += field.of == of ? field.bytes : 0;
    return sum;
  }
};

SceneNeeds needs_of(Scene const& scene);

}  // namespace clathra
