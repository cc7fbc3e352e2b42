#!/usr/bin/env bash
# What something costs that the code has in it: steps of this tree and of one with a patch that takes it out, in turns on one core.
#   perf/price_of_patch.sh perf/patches/order-free.patch [ROUNDS [DISCS...]]    ten minutes, of which three build
# order-free.patch        cells and rows in any order, sums over discs in floating point, fused multiply-adds: what it costs that the
#                         bits do not depend on threads, ranks and the order of the input
# without-features.patch  no ledger, dashpots, rough walls and displacement marks: what these cost while they are switched off
# Standard output is the table; above 0 the patched tree is faster. Where other programs share the machine, pairs scatter widely; the
# fastest runs of both are compared in the last column. A second table says what no other program can disturb: how many instructions
# the hot kernels have, and how many of them differ but for offsets into structures.
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
echo "| case | discs | this tree, ns a disc and step | patched | price: median of $rounds pairs | lowest | highest | fastest runs |"
echo "|---|---|---|---|---|---|---|---|"
for case in rolling bonded; do
  for discs in "${sizes[@]}"; do
    for ((n = 0; n < rounds; ++n)); do
      for bench in "$ours" "$patched"; do
        "$bench" --case "$case" --discs "$discs" --seconds 2 --repeat 1 | awk -F, '$1 == "rolling" || $1 == "bonded" { printf "%s ", $7 }'
      done
      echo
    done | awk '{ print $1 / $2, $1, $2 }' | sort -g |
      awk -v case="$case" -v discs="$discs" '{ r[NR] = $1; a[NR] = $2; b[NR] = $3
        if (NR == 1 || $2 < least_a) least_a = $2; if (NR == 1 || $3 < least_b) least_b = $3 } END { m = int((NR + 1) / 2)
        printf "| %s | %d | %.1f | %.1f | %+.1f %% | %+.1f %% | %+.1f %% | %+.1f %% |\n",
          case, discs, a[m], b[m], 100 * (r[m] - 1), 100 * (r[1] - 1), 100 * (r[NR] - 1), 100 * (least_a / least_b - 1) }'
  done
done

# code OBJECT KERNEL: the instructions of a kernel without addresses
code() {
  objdump -dC --no-show-raw-insn "$1" | awk -v kernel="$2" '/^[0-9a-f]+ <.*>:$/ { on = index($0, kernel) > 0 } on && /^ / { sub(/^ *[0-9a-f]+:\t/, ""); print }' |
    sed -E 's/ *#.*//; s/[0-9a-f]+ <[^>]*>.*//; s/0x[0-9a-f]+\(%/(%/g'
}
echo
echo "| kernel | instructions in this tree | patched | differing lines |"
echo "|---|---|---|---|"
objects=build/release/src/kernels/CMakeFiles/clathra_kernels.dir
while IFS=: read -r title object kernel; do
  code "$root/$objects/$object.cpp.o" "$kernel" >"$folder/ours.s"
  code "$objects/$object.cpp.o" "$kernel" >"$folder/patched.s"
  echo "| $title | $(wc -l <"$folder/ours.s") | $(wc -l <"$folder/patched.s") | $(diff "$folder/ours.s" "$folder/patched.s" | grep -c '^[<>]') |"
done <<'END'
contact forces, rolling:forces:ContactKernel<(clathra::BondKind)0, true, false, false>::operator()(int) const>:
contact forces, bonded:forces:ContactKernel<(clathra::BondKind)2, true, false, false>::operator()(int) const>:
kick and drift:integrate:KickAndDrift<false>, Kokkos::RangePolicy<Kokkos::OpenMP>, Kokkos::Max
END
