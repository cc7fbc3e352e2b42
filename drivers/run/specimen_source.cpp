#include "run/specimen_source.hpp"

#include <nlohmann/json.hpp>

#include "domain/biaxial/specimen_for_test.hpp"
#include "io/formats/digest.hpp"
#include "io/results/specimen_check.hpp"
#include "io/results/specimen_file.hpp"
#include "io/results/specimen_label.hpp"
#include "run/stage_progress.hpp"

namespace clathra {

Specimen generate_recorded(Scene const& scene, ProgressLine& line, RunRecord& record, Ranks const& ranks) {
  Speedometer const clock;
  GeneratedSpecimen generated = specimen_for_test(scene, show_stage(line, ranks), ranks);
  for (std::string const& warning : generated.warnings) line.warn(warning);
  record.wall_seconds["generate"] = clock.seconds();
  record.stages["generate"] = generated.record;
  record.layer_void_ratios = generated.layer_void_ratios;
  generated.specimen.provenance = provenance_text(record, specimen_label(scene, false));
  return std::move(generated.specimen);
}

Specimen read_for_test(LoadedScene& input, Ranks const& ranks) {
  std::filesystem::path const file = input.scene.specimen.file;
  CheckedSpecimen read = read_checked_specimen(file, ranks);
  require_walls(file, read.specimen);
  for (auto const& found : {compare_with_scene(file, read.specimen, input.scene), oddities(file, read.specimen, read.facts),
                            stress_oddities(file, read.specimen, read.facts, input.scene.grains.normal_stiffness)})
    input.warnings.insert(input.warnings.end(), found.begin(), found.end());
  return std::move(read.specimen);
}

std::string provenance_text(RunRecord const& record, SceneTexts const& label) {
  nlohmann::ordered_json json;
  json["program"] = "clathra " + record.version;
  json["git_hash"] = record.git_hash;
  json["scene_digest_xxh3_128"] = text_digest(record.input.source);
  std::vector<std::string> overrides = record.input.overrides;
  std::erase_if(overrides,
                [](std::string const& text) { return text.starts_with("run.threads="); });  // the same file for any number
  json["overrides"] = overrides;
  json["made_of"] = label;
  if (!record.digests.specimen.empty()) json["specimen_digest_xxh3_128"] = record.digests.specimen;
  if (!record.digests.grading.empty()) json["grading_digest_xxh3_128"] = record.digests.grading;
  if (auto const stage = record.stages.find("generate"); stage != record.stages.end()) json["generate"] = stage->second;
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace clathra
