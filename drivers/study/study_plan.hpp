#pragma once
/// What has to be run for a study: specimens first, then the members that are sheared of them.
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "domain/scene/specimen_design.hpp"
#include "io/results/laboratory_data.hpp"
#include "io/results/study_results.hpp"
#include "io/scene/study_members.hpp"

namespace clathra {

/// One call of the program.
struct StudyTask {
  std::string name;                      ///< of the member, or of the specimen's file
  std::vector<std::string> arguments;    ///< "run", "scene.toml", "--set", ...
  std::filesystem::path result;          ///< folder of the run, or the specimen's file
  std::filesystem::path log;             ///< where its messages go
  double particles = 0, disc_steps = 0;  ///< predicted
  double memory = 0, disk = 0;           ///< predicted [bytes]
  std::vector<std::string> refusals;     ///< of its guards; none where guards are ignored
  std::optional<std::size_t> specimen;   ///< place of the task that makes what this one reads
  std::string failure;                   ///< of a specimen: why it could not be made
};

/// Members by group and seed, and the tasks of each.
struct StudyPlan {
  Study study;
  std::vector<MemberResult> members;
  std::vector<StudyTask> runs;                              ///< of members[i]
  std::vector<StudyTask> specimens;                         ///< each for all members of the same scene of generation and seed
  std::map<std::string, std::vector<std::string>> refused;  ///< by group: what the guards of its scene say
  std::map<std::string, SpecimenDesign> designs;            ///< of the specimens that scenes read from files of their own
  std::optional<LaboratoryData> data;                       ///< laid over the curves of the page
  std::filesystem::path figures;                            ///< folder for those of the page as files; empty = none

  /// The scene of a run, once its specimen is there. @throws SceneProblems, FileProblem
  LoadedScene scene_of_run(std::size_t member) const;
};

/// A plan without members. Makes sure that groups differ, that their scenes are right and that seeds make a difference: where all
/// specimens come from files and the study states no seeds, there is one. @throws SceneProblems
StudyPlan plan_study(Study study);

/// Adds a member. @throws SceneProblems
void add_member(StudyPlan& plan, std::size_t group, std::uint64_t seed);

/// Adds all seeds of all groups.
void add_members(StudyPlan& plan);

/// How many specimens there are, and how many members share each: "5, each for 3 members".
std::string sharing_text(StudyPlan const& plan);

/// A specimen by what it differs in from those of other groups: "specimen.void_ratio = 0.1, seed 2".
std::string specimen_words(StudyPlan const& plan, std::size_t specimen);

/// The message of a member whose specimen could not be made.
std::string failure_of_specimen(StudyTask const& specimen);

/// What the guards of the members say, before any is started. @param skip  members that they refuse are marked so and left out,
/// with the specimens that only they need: they cost nothing
/// @throws SceneProblems (refused) with all groups that would be, unless they are skipped and others are left
void heed_guards(StudyPlan& plan, bool skip);

/// Specimens and members that are there already must be of this program, or results of two programs would be averaged.
/// @throws Refused
void require_one_program(StudyPlan const& plan);

/// Reads what is there already: a member that is finished, by its scene and specimen, has its numbers then. One whose folder
/// holds a run of another scene, or one that cannot be read, has failed, with the reason.
void find_finished(StudyPlan& plan, std::size_t member);
/// The same for all that are waiting.
void find_all_finished(StudyPlan& plan);

/// Of any program of the study [bytes].
double largest_memory(StudyPlan const& plan);

}  // namespace clathra
