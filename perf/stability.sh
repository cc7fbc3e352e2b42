#!/bin/sh
# What perf/reports/0.1/stability.md states: the map of stability (step over limit against what moves the limit) and the table of extremes.
#   perf/stability.sh OUT
# Needs a build with tests, and Python with matplotlib for the picture. About 15 minutes on two cores; called again it goes on where
# it was stopped. Writes the tables between their marks in perf/reports/0.1/stability.md and its picture.
set -eu
out=${1:?usage: perf/stability.sh OUT}
root=$(cd "$(dirname "$0")/.." && pwd)
build=$root/build/release
mkdir -p "$out"
export OMP_NUM_THREADS=1 OMP_PROC_BIND=false
"$build/perf/stability_map" "$out/map.csv" >"$out/map.log" &
if [ ! -f "$out/extremes.md" ]; then
  rm -f "$out/extremes.part"
  CLATHRA_EXTREME_ROWS=$out/extremes.part
  export CLATHRA_EXTREME_ROWS
  { "$build/tests/extreme_tests" && "$build/tests/parallel_tests" --gtest_filter='Scale*'; } >"$out/extremes.log" ||
    { cat "$out/extremes.log"; exit 1; }
  mv "$out/extremes.part" "$out/extremes.md"
fi
wait
python3 "$root/perf/stability_table.py" "$out/map.csv" "$out/extremes.md" "$root/perf/reports/0.1"
