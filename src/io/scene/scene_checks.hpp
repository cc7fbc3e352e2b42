#pragma once
/// What single values cannot show: keys of a scene that contradict each other, or a scene that cannot work.
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "domain/scene/scene.hpp"
#include "io/errors/problems.hpp"

namespace clathra {

/// Something wrong between keys. The first key that the scene file states gives the place of the message.
struct Finding {
  std::vector<std::string_view> keys;
  std::string text;
  Severity severity = Severity::error;
};

struct SceneFindings {
  std::vector<Finding> problems;
  std::vector<std::string> warnings;  ///< of keys without effect and the like
};

/// @param given  whether a key was stated, with a value other than its "not given"
SceneFindings check_scene(Scene const& scene, std::function<bool(std::string_view)> const& given);

}  // namespace clathra
