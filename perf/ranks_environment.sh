# Sourced by the scripts here that start ranks: as many as they like on whatever cores there are, as root or not; waiting ranks yield.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1 OMP_PROC_BIND=false OMP_WAIT_POLICY=passive
export OMP_NUM_THREADS=1
