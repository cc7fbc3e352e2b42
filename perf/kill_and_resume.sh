#!/usr/bin/env bash
# A biaxial test of 200,000 bonded discs to 3 % strain, killed with -9 at random instants and resumed on another number of ranks each time,
# against one that is left alone on 2 ranks: same history, events and state?
#   perf/kill_and_resume.sh [DISCS [KILLS]]        about ten minutes on 2 free cores
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
clathra="$root/build/release/drivers/clathra" scene=("$root/perf/large_bonded.toml")
discs=${1:-200000} kills=${2:-10}
source "$root/perf/ranks_environment.sh"
source "$root/tests/kill_session.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
for key in specimen.particles=$discs test.axial_strain=0.03 output.records=100 output.snapshots=2; do scene+=(--set "$key"); done
mpirun -n 2 "$clathra" generate "${scene[@]}" -o specimen.h5 2>log >/dev/null
given=(run "${scene[@]}" --set specimen.file=specimen.h5)
begin=$SECONDS
mpirun -n 2 "$clathra" "${given[@]}" --output alone >log 2>&1
echo "left alone on 2 ranks: $((SECONDS - begin)) s, $(tail -n 1 alone/history.csv | cut -d, -f16-19 | tr , +) = $(($(wc -l <alone/events.csv) - 1)) bonds broken"
killed=0
while ((killed < kills)); do
  for ranks in 1 2 3 4 7; do
    ((killed < kills)) || break
    setsid mpirun -n "$ranks" "$clathra" "${given[@]}" --output killed --resume --checkpoint-every 4s >log 2>&1 &
    job=$!
    # The first one must reach the shear: before it there is nothing to go on from.
    while [ ! -e killed/ckpt/0.json ] && kill -0 "$job" 2>/dev/null; do sleep 1; done
    sleep $((3 + RANDOM % 10)).$((RANDOM % 10))
    kill_session "$job"
    if wait "$job" 2>/dev/null; then break 2; fi # it came to its end before
    killed=$((killed + 1))
    echo "kill $killed on $ranks ranks: $(tail -n 1 killed/history.csv 2>/dev/null | cut -d, -f2,4)"
  done
done
mpirun -n 2 "$clathra" "${given[@]}" --output killed --resume >log 2>&1
cmp alone/history.csv killed/history.csv
cmp alone/events.csv killed/events.csv
[ "$("$clathra" info --state-hash alone)" = "$("$clathra" info --state-hash killed)" ]
echo "after $killed kills: the same history.csv, events.csv and state hash $("$clathra" info --state-hash killed)"
