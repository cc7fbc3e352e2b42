#pragma once
/// One run of a scene: its specimen is made, bonded, consolidated and sheared; its folder, its record and what the user sees of
/// it.
#include <memory>
#include <optional>

#include "domain/parallel/ranks.hpp"
#include "domain/scene/specimen.hpp"
#include "io/scene/scene_comparison.hpp"
#include "io/scene/scene_file.hpp"
#include "run/loading_loop.hpp"
#include "run/run_reporter.hpp"
#include "run/run_session.hpp"

namespace clathra {

class BiaxialRun {
 public:
  /// Takes hold of the output folder. Collective, as is run(). @param specimen  this rank's share, if it was read from a file
  BiaxialRun(LoadedScene input, std::optional<Specimen> specimen, RunLimits const& limits, Ranks const& ranks);
  void warn(std::string const& text) { reporter_.warn(text); }
  /// @return how it ended, after run.json says so
  ExitCode run();

 private:
  void make_test();
  std::unique_ptr<BiaxialTest> test_to_go_on_with();
  void record_loading(BiaxialTest const& test);
  Specimen sheared_specimen(BiaxialTest const& test);
  ExitCode diverged(Diverged const& fault);
  ExitCode stopped(std::string const& cause);
  ExitCode fail(ExitCode code, std::string const& reason);

  RunReporter reporter_;
  std::optional<Specimen> specimen_;
  SceneTexts label_before_;   // of the specimen before this test
  double strain_before_ = 0;  // axial, of earlier tests
  RunSession session_;
  LoadingLoop loop_;
};

}  // namespace clathra
