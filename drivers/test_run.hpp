#pragma once
/// One run of a scene with its folder, its record and what the user sees of it.
#include <memory>
#include <optional>

#include "domain/parallel/ranks.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen.hpp"
#include "io/scene/scene_file.hpp"

namespace clathra {

/// How a run is guarded against its own end. Wall time in seconds.
struct RunLimits {
  bool resume = false;            ///< go on from the newest checkpoint, if there is one
  bool overwrite = false;         ///< take the place of an earlier run in the folder
  double most_seconds = 0;        ///< stop with a checkpoint then; 0 = never
  double checkpoint_every = 600;  ///< 0 = never
};

class TestRun {
 public:
  /// Takes hold of the output folder. Collective, as is run(). @param specimen  this rank's share, if it was read from a file
  TestRun(LoadedScene input, std::optional<Specimen> specimen, RunLimits const& limits, Ranks const& ranks);
  ~TestRun();
  void warn(std::string const& text);
  /// @throws whatever ended the run, after run.json says so
  ExitCode run();

 private:
  class Running;
  std::unique_ptr<Running> running_;
};

}  // namespace clathra
