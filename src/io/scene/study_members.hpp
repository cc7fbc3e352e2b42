#pragma once
/// What the members of a study are: one place says which value of a key counts, that of the scene file, of the study or of the
/// command line, and writes it out again.
#include <cstdint>
#include <string>
#include <vector>

#include "io/scene/study_file.hpp"

namespace clathra {

/// Whether the groups have different values of a key, however these are written, or only some of them have one.
bool groups_differ_in(Study const& study, std::string const& key);

/// Takes overrides "key=value" of the command line into all groups, above the values of the study file. Columns of study.csv
/// follow (Study::keys). A path among them is relative to the current folder.
/// @throws SceneProblems with all of: keys that the groups differ in, the seed, the threads and the folder of a run, unknown
/// keys, values that a scene does not take
void override_study(Study& study, std::vector<std::string> const& overrides);

/// Lets all members go on where a guard refuses.
void ignore_guards(Study& study);

/// "key=value" of a member, as for load_scene(): what counts more comes later.
std::vector<std::string> member_overrides(StudyGroup const& group, std::uint64_t seed);

/// The scene of a member. @throws SceneProblems, which name the group
LoadedScene member_scene(Study const& study, StudyGroup const& group, std::uint64_t seed);

/// "dense_26pct_1MPa-seed3"
std::string member_name(StudyGroup const& group, std::uint64_t seed);

/// "26 %, 1 MPa": the values of a group that others have not, as they were written; "all" where there is one group.
std::string group_label(Study const& study, StudyGroup const& group);

/// A setting as study.csv has it: quantities in SI units without a unit, other values as they were written.
std::string si_text(Setting const& setting);

/// A text as a TOML file states it.
std::string in_quotes(std::string const& text);

/// A study file that loads to the same groups, seeds and folder wherever it lies: paths are absolute, groups are written out.
std::string resolved_study(Study const& study);

}  // namespace clathra
