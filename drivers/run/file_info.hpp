#pragma once
/// What the files of a run hold, in words and as JSON (SI units).
#include <nlohmann/json.hpp>
#include <string>

#include "domain/measurement/snapshot.hpp"
#include "domain/measurement/specimen_facts.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen.hpp"

namespace clathra {

std::string snapshot_text(Snapshot const& snapshot);
nlohmann::ordered_json snapshot_json(Snapshot const& snapshot);

std::string specimen_text(Specimen const& specimen, SpecimenFacts const& facts);
nlohmann::ordered_json specimen_json(Specimen const& specimen, SpecimenFacts const& facts);

/// Of run.json. @throws nlohmann::json::exception where it is none
std::string run_text(nlohmann::json const& record);

/// What a scene keeps in memory and computes in each step, with the keys that ask for it.
std::string needs_text(Scene const& scene);

}  // namespace clathra
