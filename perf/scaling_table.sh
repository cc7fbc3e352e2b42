#!/usr/bin/env bash
# The table of perf/machines/<machine>-ranks.md: one core, threads and ranks of the same code side by side, in turns.
#   perf/scaling_table.sh [DISCS]        about ten minutes on 2 free cores; standard output is the table
set -euo pipefail
bench="$(dirname "${BASH_SOURCE[0]}")/../build/release/perf/step_bench"
discs=${1:-1000000} rounds=${2:-3}
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1 OMP_PROC_BIND=false OMP_WAIT_POLICY=passive
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Appends one measurement: measure RANKS THREADS CASE
measure() {
  local launch=()
  [ "$1" = 1 ] || launch=(mpirun -n "$1")
  KOKKOS_DISABLE_WARNINGS=1 OMP_NUM_THREADS=$2 "${launch[@]}" "$bench" --case "$3" --discs "$discs" --seconds 4 --repeat 1 2>/dev/null |
    grep -E "^(rolling|bonded)," >>"$folder/$3.$1.$2"
}

echo "| case | discs | ranks x threads | M particle-steps/s | to one core | neighbour search | bytes a disc |"
echo "|---|---|---|---|---|---|---|"
for case in rolling bonded; do
  for ((n = 0; n < rounds; ++n)); do
    for layout in "1 1" "1 2" "2 1" "4 1"; do measure ${layout% *} ${layout#* } $case; done
  done
  for layout in "1 1" "1 2" "2 1" "4 1"; do
    sort -t, -g -k6 "$folder/$case.${layout% *}.${layout#* }" | sed -n "$(((rounds + 1) / 2))p" |
      awk -F, -v one="$(sort -t, -g -k6 "$folder/$case.1.1" | sed -n "$(((rounds + 1) / 2))p" | cut -d, -f6)" \
        '{ printf "| %s | %d | %d x %d | %.1f | %.2f | %.1f %% | %d |\n", $1, $2, $3, $4, $6 / 1e6, $6 / one, 100 * $11, $12 }'
  done
done
