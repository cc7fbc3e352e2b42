#!/usr/bin/env bash
# Ten million bonded discs on two ranks: generated, bonded, some 200 steps of shear, a snapshot, a checkpoint in the middle, resumed on two
# ranks and compared with the run that was left alone.
#   perf/ten_million.sh [DISCS [SPECIMEN]]        about an hour on 2 free cores and 16 GiB of memory, a third of it for a specimen made before
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
clathra="$root/build/release/drivers/clathra" scene=("$root/perf/large_bonded.toml")
discs=${1:-10000000} specimen=${2:+$(realpath "$2")}
source "$root/perf/ranks_environment.sh"
folder=$(mktemp -d)
job=
trap 'kill $job 2>/dev/null || true; rm -rf "$folder"' EXIT
cd "$folder"
# Bonded under the confining stress of the test, and sheared without the consolidation, which would take hours.
for key in run.ignore_guards=true specimen.particles=$discs test.consolidation_steps=0 test.axial_strain=0.0013 output.records=20 output.snapshots=1; do scene+=(--set "$key"); done
# Leaves the sum of the greatest resident memories of the ranks, in MB, in a file: watched FILE COMMAND...
watched() {
  local file=$1 peak=0 now
  shift
  "$@" &
  job=$!
  while kill -0 "$job" 2>/dev/null; do
    now=$(for rank in $(pgrep -x clathra); do cat "/proc/$rank/status" 2>/dev/null || true; done |
      awk '$1 == "VmHWM:" { sum += $2 } END { print int(sum / 1000) }')
    ((now <= peak)) || peak=$now
    sleep 1
  done
  echo "$peak" >"$file"
  wait "$job" && job= || { local code=$?; job= && return $code; }
}
timed() { # timed WHAT COMMAND...: the command with its wall time and memory
  local what=$1 begin=$SECONDS code=0
  shift
  watched memory "$@" >>log 2>&1 || code=$?
  echo "$what: $((SECONDS - begin)) s, $(cat memory) MB in all ranks, exit code $code"
  [ "$code" = 0 ] || [ "$code" = 75 ] || { tail -n 5 log && exit 1; }
}

"$clathra" check "${scene[@]}" --ranks 2 | grep -E "memory|disk|steps"
[ -n "$specimen" ] || timed "generated" mpirun -n 2 "$clathra" generate "${scene[@]}" -o specimen.h5
specimen=${specimen:-$PWD/specimen.h5}
given=(run "${scene[@]}" --set "specimen.file=$specimen")
timed "bonded and sheared, left alone" mpirun -n 2 "$clathra" "${given[@]}" --output alone
ls -l "$specimen" alone/*.h5 alone/snap/*.h5 | awk '{ print $9 ": " int($5 / 1e6) " MB" }'
timed "told to stop at its first checkpoint" mpirun -n 2 "$clathra" "${given[@]}" --output resumed --max-walltime 1s
timed "resumed" mpirun -n 2 "$clathra" "${given[@]}" --output resumed --resume
cmp alone/history.csv resumed/history.csv
cmp alone/events.csv resumed/events.csv
[ "$("$clathra" info --state-hash alone)" = "$("$clathra" info --state-hash resumed)" ]
echo "the same history.csv, events.csv and state hash $("$clathra" info --state-hash alone) after $(tail -n 1 alone/history.csv | cut -d, -f2) steps"
