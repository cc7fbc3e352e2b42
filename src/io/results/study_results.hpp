#pragma once
/// What the members of a study came to: their numbers, groups of them, and study.csv.
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "domain/measurement/confidence.hpp"
#include "domain/measurement/paired_strength.hpp"
#include "io/scene/study_members.hpp"

namespace clathra {

/// `refused`: a guard would not have it, and the study was told to go on without.
enum class MemberState { waiting, finished, failed, refused };

/// A member with what its folder holds.
struct MemberResult {
  std::size_t group = 0;  ///< place in Study::groups
  std::uint64_t seed = 0;
  MemberState state = MemberState::waiting;
  std::string message;                    ///< why it failed or was refused
  std::vector<std::string> warnings;      ///< of its run
  std::map<std::string, double> numbers;  ///< all of run.json's stages `prepare` and `shear`, by their names there; SI units
  std::optional<FailureStress> peak, residual;  ///< where the test passed its peak
  double confining_stress = 0;                  ///< that was asked for [Pa]
  std::string state_hash, program, specimen_digest;
  double wall_seconds = 0, disc_steps_per_second = 0;
};

/// By guards, and left out (--skip-refused).
inline bool is_refused(MemberResult const& member) { return member.state == MemberState::refused; }

/// Reads what a finished run left. @throws FileProblem, also where run.json has a text where a number belongs
void read_member(MemberResult& member, std::filesystem::path const& run_folder);

/// Numbers of members that differ in their seed only, in the order of the seeds as they were asked for.
struct GroupNumbers {
  std::string name, label;
  std::vector<Setting> settings;
  std::vector<std::uint64_t> seeds;
  std::map<std::string, std::vector<double>> values;  ///< by name; of the seeds that have it

  /// How many seeds did not pass a peak (TestNumbers::passed_peak).
  std::size_t without_peak() const;
};

/// The finished members by group, in the order of the study. Groups without any are left out.
std::vector<GroupNumbers> numbers_by_group(Study const& study, std::vector<MemberResult> const& members);

/// The envelopes of each material (StudyGroup::material), one of each complete seed (paired_strength()): peak_cohesion_Pa,
/// peak_friction_angle_deg, peak_r_squared, peak_curvature_per_Pa, and the same of the residual state.
std::vector<GroupNumbers> envelopes_by_material(Study const& study, std::vector<MemberResult> const& members);

/// The content of study.csv. Rows `member`: one each, in the order of groups and seeds; `mean`, `standard_deviation`,
/// `interval_low` and `interval_high` (95 %): over the seeds of a group; `envelope` and the same four: of a material's envelopes.
/// Columns: row, group, label, the keys that the study sets (SI), seed, n, state, message, warnings, the numbers in the order of
/// the alphabet, program, specimen_digest, state_hash; last those that differ between two runs of the same study, wall_seconds
/// and particle_steps_per_second. `n` is how many values the statistics of a row are of: where some numbers are not those of all
/// seeds, they have rows of their own.
std::string study_csv(Study const& study, std::vector<MemberResult> const& members);

}  // namespace clathra
