#!/bin/bash
# One large run under Slurm, over as many jobs as it takes: sbatch large_run.sh SCENE FOLDER [options of clathra run]
#SBATCH --job-name=clathra
#SBATCH --ntasks=2
#SBATCH --cpus-per-task=1
#SBATCH --time=24:00:00
#SBATCH --signal=B:USR1@300
#SBATCH --requeue
#SBATCH --open-mode=append
# Slurm sends USR1 to this script five minutes before the time is over; mpirun passes it on to the ranks, which write a checkpoint and
# end with 75. The job then goes back into the queue, as it does by itself where its node is set down, and --resume goes on.
# Build the program on a node of the kind that runs it, or with -DCLATHRA_NATIVE=OFF: elsewhere it says which instructions it lacks.
set -u
scene=$1 folder=$2
shift 2
# Open MPI starts the ranks on the nodes of the job; --bind-to none leaves each rank the threads that --cpus-per-task gives it.
export OMP_NUM_THREADS=${SLURM_CPUS_PER_TASK:-1}
mpirun --bind-to none clathra run "$scene" --output "$folder" --resume "$@" &
run=$!
trap 'kill -USR1 "$run"' USR1
wait "$run"
code=$?
while kill -0 "$run" 2>/dev/null; do # a signal ends `wait` before the ranks have written their checkpoint
  wait "$run"
  code=$?
done
[ "$code" != 75 ] || scontrol requeue "$SLURM_JOB_ID"
exit "$code"
