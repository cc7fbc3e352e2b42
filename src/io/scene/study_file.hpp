#pragma once
/// Study files: TOML that says over which keys of a scene, values and seeds runs are made.
///
///     scene = "quick.toml"       # what all members share; relative to the study file
///     seeds = 5                  # 1 to 5, or a list
///     [matrix]                   # each value with each of the others; a value that is no list holds for all and names no group
///     "hydrate.saturation" = ["26 %", "41 %", "55 %"]
///     "test.confining_stress" = { from = "1 MPa", to = "3 MPa", count = 3 }
///     [groups.dense]             # named sets of keys, each of them with the whole matrix
///     material = "dense sand"    # groups of one material share an envelope; left out, those that differ in their stress alone
///     "specimen.void_ratio" = 0.2
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/scene/scene_file.hpp"
#include "io/scene/study_goal.hpp"

namespace clathra {

/// A key of a scene with its value as text, as after --set.
using Setting = std::pair<std::string, std::string>;

/// The value of a key among settings, or nullptr.
std::string const* value_in(std::vector<Setting> const& settings, std::string_view key);

/// Members that differ in their seed only.
struct StudyGroup {
  std::string name;               ///< of letters, digits and ._+-: "dense_26pct_1MPa"
  std::vector<Setting> settings;  ///< those of the named set, then those of the matrix, in the order of the file
  std::string material;           ///< the name without the confining stress: groups of one material share an envelope
};

struct Study {
  std::filesystem::path file, scene;
  std::filesystem::path folder;  ///< of the results: "out/" and the name of the file, where it does not say
  std::vector<std::uint64_t> seeds;
  bool seeds_stated = false;        ///< else these are the usual ones
  std::vector<StudyGroup> groups;   ///< one at least
  std::vector<std::string> keys;    ///< of all settings, in the order in which they first appear (add_key())
  std::vector<Setting> overridden;  ///< those of the settings that the command line stated
  std::optional<StudyGoal> precision_target;
  int max_seeds = 40;  ///< with a goal
};

inline constexpr int usual_seeds = 5;
inline constexpr std::size_t most_members = 100000;

/// @throws SceneProblems with all that is wrong in the file: unknown keys, values that a scene does not take, two groups of one
/// name, more than most_members;  FileProblem if it cannot be read
Study load_study(std::filesystem::path const& path);

/// The same from text. @param path  what the file would be called: paths in the text are relative to its folder
Study parse_study(std::string const& text, std::filesystem::path const& path);

/// Takes a key into those of the study. Left out is run.ignore_guards, which changes no result.
void add_key(Study& study, std::string const& key);

/// What to write instead of a key that each run has its own value of: the seed, threads, the folder. Nothing for other keys.
char const* key_of_each_run(std::string_view name);

}  // namespace clathra
