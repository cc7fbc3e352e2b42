#pragma once
/// A study as arrays of Slurm.
#include <filesystem>
#include <string>
#include <vector>

#include "study/study_plan.hpp"

namespace clathra {

/// What the jobs of the arrays are told.
struct SlurmJobs {
  std::filesystem::path script;  ///< to be written
  std::string launcher;          ///< of each member, inside its job; empty = srun
  int threads = 0;               ///< cores of a job and threads of a rank; 0 = 1 core, and as many threads as the launcher gives
  std::string most_time;         ///< of a job, "3h50m"; empty = 24 hours
  std::string checkpoint_every;  ///< "10m"
  bool allow_mixed = false;      ///< jobs take what another program made
};

/// A word for a shell, in quotes.
std::string shell_word(std::string const& text);

/// Writes the resolved study (SCRIPT.toml), and a script for bash that submits an array of specimens, an array of members that
/// begins when they are there, and a job that collects them. A job that is told to stop (USR1, two minutes before its time is
/// over) or whose node is set down is queued again and goes on from its checkpoint. @throws FileProblem, also where one of the
/// two files is there already; Refused for a study with a goal, whose members nobody knows before
void write_slurm_script(StudyPlan const& plan, SlurmJobs const& jobs);

}  // namespace clathra
