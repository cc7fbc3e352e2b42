#pragma once
/// Do two scenes give the same results?
#include <filesystem>
#include <map>
#include <string>

#include "domain/scene/scene.hpp"

namespace clathra {

/// Keys of a scene with their values as a scene file states them: what is kept beside something that was computed.
using SceneTexts = std::map<std::string, std::string>;

/// The keys that results depend on, paths relative to `folder`. Left out are those that say where and with what a run computes
/// (output.folder, run.threads, output.keep_checkpoint), the name of other keys' values (run.preset), whether it overrode a
/// guard (run.ignore_guards), and specimen.file: what counts of a specimen is its content.
SceneTexts scene_texts(Scene const& scene, std::filesystem::path const& folder);

/// What has to agree. `same_test`: every key that results depend on. `further`: but for test.axial_strain and
/// output.snapshots_at, with which a test is extended.
enum class Agreement { same_test, further };

/// "; damping.local was 0.3, is 0.2" for each such key with another value, nothing where there is none. A key that is not kept
/// is one. A path may be written in any way that leads to the same file, from `folder` or from the current one.
std::string scene_differences(SceneTexts const& then, Scene const& now, std::filesystem::path const& folder,
                              Agreement agreement = Agreement::same_test);

}  // namespace clathra
