#pragma once
/// run.json: what was run, with what, and what came out.
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "domain/scene/scene.hpp"
#include "domain/scene/stage.hpp"
#include "io/results/input_digests.hpp"
#include "io/scene/scene_file.hpp"

namespace clathra {

/// How a stage of the loading ended: "axial strain", ...; empty where it did not.
struct StageEnding {
  std::string stage, ended_by;
};

/// Everything but what the program knows of itself. No user names, no environment.
struct RunRecord {
  std::string version, git_hash;
  LoadedScene input;
  InputDigests digests;           ///< of the files that were read
  std::string checkpoint_digest;  ///< of the checkpoint that the run went on from, if it did
  int threads = 0;                ///< of each rank
  int ranks = 1;
  std::map<std::string, StageRecord> stages;  ///< "generate", "prepare", "plan", and those of the loading by their names
  std::vector<StageEnding> stage_ends;        ///< of the loading, in their order
  std::vector<double> layer_void_ratios;
  std::vector<std::string> warnings;
  std::map<std::string, double> wall_seconds;  ///< by stage
  std::int64_t disc_steps = 0;                 ///< of the loading
  double disc_steps_per_second = 0;
  std::optional<std::uint64_t> state_hash;            ///< of the final state
  std::map<std::string, std::string> result_digests;  ///< XXH3-128 by file, of a finished run
  int exit_code = 0;
  std::string exit_reason;  ///< "running", "finished", or why it ended
};

inline constexpr std::size_t largest_run_record = std::size_t{64} << 20;  ///< bytes of a run.json that is read

/// Puts run.json in place of an older one. @throws FileProblem
void write_run_record(std::filesystem::path const& path, RunRecord const& record);

/// A scene as JSON, by sections, in SI units.
nlohmann::json scene_json(Scene const& scene);
/// The scene of such a JSON, with defaults for the keys that it does not have. @throws std::exception where
/// a value is none of its key
Scene scene_of(nlohmann::json const& json);

/// "0.1.0 (4f3a2b1c9d8e)": a program by its version and git revision.
std::string version_text(std::string const& version, std::string const& git_hash);

/// "0x" and 16 hexadecimal digits.
std::string hash_text(std::uint64_t hash);

/// Name and version of the compiler that built this program, of Kokkos, and of the backend that runs the kernels.
std::string compiler_name();
std::string kokkos_version();
std::string backend_name();

}  // namespace clathra
