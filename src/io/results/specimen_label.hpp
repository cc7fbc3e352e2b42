#pragma once
/// What a specimen file says of what its specimen is made of, and whether a scene that reads it says the same.
#include <filesystem>
#include <string>
#include <vector>

#include "domain/scene/scene.hpp"
#include "domain/scene/specimen.hpp"
#include "io/scene/scene_comparison.hpp"

namespace clathra {

/// The keys of a scene that a specimen carries with it: under which stress and with which seed it was made, the stiffness of its
/// grains, and of a bonded one what decides where bonds are, how they hold and under which label they go. They stand in its
/// provenance as the object `made_of`, values as a scene file states them, without quotes.
/// @param bonded  it has bonds, which this scene installed
SceneTexts specimen_label(Scene const& scene, bool bonded);

/// The label of a specimen; of files of version 1, which had none, what else they tell. Empty where there is nothing.
SceneTexts label_of(Specimen const& specimen);

/// The version_text() of the program that made a specimen file; nothing where the file does not say or cannot be read: who reads
/// the specimen will say what is wrong with it.
std::string program_of_specimen(std::filesystem::path const& file);

/// The label of what a test by this scene made of a specimen with the label `before`.
SceneTexts label_after(SceneTexts const& before, Scene const& scene, bool bonded);

/// Compares a specimen file with the scene that reads it. Density of the grains and everything that is fixed when bonds form must
/// agree: another label would be wrong. What may be chosen anew, or has no effect any more, is warned of.
/// @return the warnings;  @throws FileProblem refused, with both values of each key that disagrees; run.ignore_guards changes
/// nothing
std::vector<std::string> compare_with_scene(std::filesystem::path const& file, Specimen const& specimen, Scene const& scene);

}  // namespace clathra
