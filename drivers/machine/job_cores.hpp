#pragma once
/// The cores that all ranks of a job share on this machine.

namespace clathra {

/// @param own  cores that this process may use. A launcher may have bound each rank to its own share of the job's cores already
/// (srun does, mpirun too): then the job has more than one rank sees. Known from Slurm's SLURM_CPUS_ON_NODE, else from the cores
/// of the launcher (mpirun, or its daemon) that started this process; else they are taken to be `own`.
int job_cores(int own);

}  // namespace clathra
