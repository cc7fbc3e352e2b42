#pragma once
/// A study as arrays of jobs: the script that submits them, and what one of the jobs does.
#include "io/errors/problems.hpp"
#include "study/slurm_script.hpp"

namespace clathra {

/// One program in place of this one: what a job of an array does. @param number  of the specimen or member, from 1
/// @throws Refused where there are not so many; FileProblem file_missing where a member lacks its specimen
ExitCode run_alone(StudyPlan const& plan, SlurmJobs const& jobs, bool specimen, int number);

/// A script, and beside it the study that its jobs read: without the groups that guards refuse, which jobs would count.
ExitCode write_script(StudyPlan const& plan, SlurmJobs const& jobs);

}  // namespace clathra
