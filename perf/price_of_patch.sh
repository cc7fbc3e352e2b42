#!/usr/bin/env bash
# What something costs that the code has in it: steps of this tree and of one with a patch that takes it out, in turns on one core.
#   perf/price_of_patch.sh perf/patches/order-free.patch [ROUNDS [DISCS...]]    ten minutes, of which three build
# order-free.patch        cells and rows in any order, sums over discs in floating point, fused multiply-adds: what it costs that the
#                         bits do not depend on threads, ranks and the order of the input
# without-features.patch  no ledger, dashpots, rough walls and displacement marks: what these cost while they are switched off
# Standard output is the table; above 0 the patched tree is faster.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
patch=$(realpath "$1") rounds=${2:-7}
sizes=("${@:3}")
[ ${#sizes[@]} -gt 0 ] || sizes=(20000 200000)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/tree"
cmake --build "$root/build/release" --target step_bench >/dev/null
(cd "$root" && git ls-files -co --exclude-standard | tar cf - --ignore-failed-read -T - 2>/dev/null) | tar xf - -C "$folder/tree"
cd "$folder/tree"
patch --quiet -p1 <"$patch"
kokkos=$(sed -n 's/^Kokkos_DIR:PATH=//p' "$root/build/release/CMakeCache.txt")
cmake --preset release -DKokkos_DIR="$kokkos" >"$folder/log" 2>&1 && cmake --build build/release --target step_bench >>"$folder/log" 2>&1 ||
  { tail -n 20 "$folder/log" && exit 1; }

export OMP_NUM_THREADS=1 OMP_PROC_BIND=false KOKKOS_DISABLE_WARNINGS=1
ours="$root/build/release/perf/step_bench" patched="$folder/tree/build/release/perf/step_bench"
echo "| case | discs | this tree, ns a disc and step | patched | price: median of $rounds pairs | lowest | highest |"
echo "|---|---|---|---|---|---|---|"
for case in rolling bonded; do
  for discs in "${sizes[@]}"; do
    for ((n = 0; n < rounds; ++n)); do
      for bench in "$ours" "$patched"; do
        "$bench" --case "$case" --discs "$discs" --seconds 3 --repeat 1 | awk -F, '$1 == "rolling" || $1 == "bonded" { printf "%s ", $7 }'
      done
      echo
    done | awk '{ print $1 / $2, $1, $2 }' | sort -g |
      awk -v case="$case" -v discs="$discs" '{ r[NR] = $1; a[NR] = $2; b[NR] = $3 } END { m = int((NR + 1) / 2)
        printf "| %s | %d | %.1f | %.1f | %+.1f %% | %+.1f %% | %+.1f %% |\n", case, discs, a[m], b[m], 100 * (r[m] - 1), 100 * (r[1] - 1), 100 * (r[NR] - 1) }'
  done
done
