#pragma once
/// Where a run's specimen comes from: generated now, or read from a file.
#include "domain/parallel/ranks.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen.hpp"
#include "domain/scene/stage.hpp"
#include "io/results/run_record.hpp"
#include "io/scene/scene_comparison.hpp"
#include "io/scene/scene_file.hpp"
#include "terminal/progress_line.hpp"

namespace clathra {

/// Generates the specimen of a scene; Kokkos must have been started. Numbers, layers and wall time go into the record.
/// Warnings go to the line.
/// @throws Refused, Diverged, Stopped
Specimen generate_recorded(Scene const& scene, ProgressLine& line, RunRecord& record, Ranks const& ranks);

/// Reads the specimen of `specimen.file` for a test by the scene and adds what is odd about it to the warnings. Collective.
/// @return this rank's part;  @throws FileProblem bad_input, file_missing, refused
Specimen read_for_test(LoadedScene& input, Ranks const& ranks = {});

/// JSON text: program, digest of the scene, what the specimen is made of; what a specimen file says of its making.
std::string provenance_text(RunRecord const& record, SceneTexts const& label);

}  // namespace clathra
