#pragma once
/// Tests of a list of stages on small sand, run to their end: rows, results of stages, hash.
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "small_test.hpp"

namespace clathra {

/// Sand, so that a test takes a second.
inline Scene sand() {
  Scene scene = small_test();
  scene.hydrate.saturation = 0;
  scene.test.max_platen_wave_stress = 0;
  scene.test.inertial_number = 5e-4;
  return scene;
}

inline Scene with(std::vector<LoadingStage> stages) {
  Scene scene = sand();
  scene.test.kind = TestKind::list;
  scene.stages = std::move(stages);
  return scene;
}

struct StageRun {
  std::vector<HistoryRow> rows;
  std::vector<StageResult> stages;
  std::uint64_t hash = 0;
  Specimen specimen;
  std::vector<HistoryRow> of(std::string const& name) const {
    std::vector<HistoryRow> found;
    for (HistoryRow const& row : rows)
      if (row.stage == name) found.push_back(row);
    return found;
  }
  StageResult const& result(std::string const& name) const {
    for (StageResult const& one : stages)
      if (one.name == name) return one;
    throw std::logic_error("no stage " + name);
  }
};

/// @param pace  steps between two looks of the caller;  @param restarts  taken apart and put together after every so many calls
inline StageRun run_stages(Scene const& scene, std::int64_t pace = 100'000, int restarts = 0,
                           Specimen const& specimen = small_specimen()) {
  auto test = std::make_unique<BiaxialTest>(scene, specimen, ProgressCallback());
  StageRun course;
  course.rows.push_back(test->record());
  for (int calls = 1; !test->finished(); ++calls) {
    if (restarts > 0 && calls % restarts == 0) test = std::make_unique<BiaxialTest>(scene, test->state(), Ranks{});
    if (test->advance(pace)) course.rows.push_back(test->record());
  }
  course.stages = test->stage_results();
  course.hash = test->state_hash();
  course.specimen = test->specimen();
  return course;
}

}  // namespace clathra
