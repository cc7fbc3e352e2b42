#pragma once
/// Whether the numbers of a specimen file agree with its discs, and whether its discs can be a specimen.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "domain/measurement/specimen_facts.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen.hpp"

namespace clathra {

/// Measures the discs of a specimen that was read and refuses what cannot be: another unit, places too far out to be exact, discs
/// beyond a wall or in one another by more than the smaller radius, `d50` or `void_ratio` of other discs. Where these two are not
/// numbers (the file does not state them) they become those of the discs. Collective.
/// @param part  this rank's part
/// @throws FileProblem bad_input, on all ranks the same
SpecimenFacts require_sound(std::filesystem::path const& path, Specimen& part, Ranks const& ranks);

/// Warnings of what is odd about a specimen, though it can be: a box larger than its sand, deep overlaps.
std::vector<std::string> oddities(std::filesystem::path const& path, Specimen const& part, SpecimenFacts const& facts);

/// Warns of a specimen whose grains, by their overlaps and their stiffness (that of the scene where the file does not say), carry
/// another stress than it says it rests under. Nothing where bonds or a test have a part in the stress.
std::vector<std::string> stress_oddities(std::filesystem::path const& path, Specimen const& part, SpecimenFacts const& facts,
                                         std::optional<double> kn_of_scene);

/// A test needs walls. @throws FileProblem bad_input where the specimen is a periodic cell
void require_walls(std::filesystem::path const& path, Specimen const& part);

}  // namespace clathra
