#!/usr/bin/env bash
# The table of perf/machines/<machine>-ranks.md: one core, threads and ranks of the same code side by side, in turns.
#   perf/scaling_table.sh [DISCS [ROUNDS [CASE...]]]        about half an hour on 2 free cores; standard output is the table
# The last column is what rank 0 spends in exchanging the copies of neighbours, waiting for the other ranks included.
set -euo pipefail
bench="$(dirname "${BASH_SOURCE[0]}")/../build/release/perf/step_bench"
discs=${1:-1000000} rounds=${2:-3}
cases=("${@:3}")
[ ${#cases[@]} -gt 0 ] || cases=(rolling bonded)
# A large packing takes long to come to rest and shows little of it.
if ((discs > 500000)); then relax=500; else relax=3000; fi
source "$(dirname "${BASH_SOURCE[0]}")/ranks_environment.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Appends one measurement: measure RANKS THREADS CASE
measure() {
  local launch=()
  [ "$1" = 1 ] || launch=(mpirun -n "$1")
  KOKKOS_DISABLE_WARNINGS=1 OMP_NUM_THREADS=$2 "${launch[@]}" "$bench" --case "$3" --discs "$discs" --seconds 4 --repeat 1 --relax $relax 2>/dev/null |
    awk -F, '$1 == "rolling" || $1 == "bonded" { row = $0 } $1 == "halo_trade" { halo = $3 } END { print row "," halo + 0 }' >>"$folder/$3.$1.$2"
}

echo "| case | discs | ranks x threads | M particle-steps/s | to one core | neighbour search | bytes a disc | exchange |"
echo "|---|---|---|---|---|---|---|---|"
for case in "${cases[@]}"; do
  for ((n = 0; n < rounds; ++n)); do
    for layout in "1 1" "1 2" "2 1" "4 1"; do measure ${layout% *} ${layout#* } $case; done
  done
  for layout in "1 1" "1 2" "2 1" "4 1"; do
    sort -t, -g -k6 "$folder/$case.${layout% *}.${layout#* }" | sed -n "$(((rounds + 1) / 2))p" |
      awk -F, -v one="$(sort -t, -g -k6 "$folder/$case.1.1" | sed -n "$(((rounds + 1) / 2))p" | cut -d, -f6)" \
        '{ printf "| %s | %d | %d x %d | %.1f | %.2f | %.1f %% | %d | %.1f %% |\n", $1, $2, $3, $4, $6 / 1e6, $6 / one, 100 * $11, $12, 100 * $NF }'
  done
done
