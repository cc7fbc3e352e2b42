#include "io/results/input_digests.hpp"

#include "io/formats/digest.hpp"

namespace clathra {

InputDigests input_digests(Scene const& scene) {
  InputDigests digests;
  if (scene.specimen.is_read())
    digests.specimen = file_digest(scene.specimen.file);
  else if (!scene.grading.file.empty())
    digests.grading = file_digest(scene.grading.file);
  return digests;
}

}  // namespace clathra
