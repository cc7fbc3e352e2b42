#!/usr/bin/env bash
# A run that is killed and resumed, on any number of ranks, ends as one that was left alone: restart_test.sh CLATHRA SCENE [MPIEXEC]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/kill_session.sh"
clathra=$1 scene=$2 mpiexec=${3:-}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "restart: $*"; cat log || true; exit 1; }

"$clathra" generate "$scene" -o specimen.h5 >log 2>&1 || fail "no specimen"
given=(run "$scene" --set specimen.file=specimen.h5 --set test.axial_strain=0.008
  --set output.event_details=true --set bond.rolling_lever="0.04 B" --set output.records=60 --set output.snapshots=3 --set output.energy=true --set output.keep_checkpoint=false)
begun=$(date +%s%N)
"$clathra" "${given[@]}" --output alone >log 2>&1 || fail "the run that is left alone failed"
[ "$(head -n 1 alone/events.csv | tr , '\n' | grep -c .)" = 14 ] || fail "events without details"
[ "$(wc -l <alone/events.csv)" -gt 20 ] || fail "too few bonds broke"
quarter=$((($(date +%s%N) - begun) / 4000000)) # of its time [ms]
seconds() { printf '%d.%03d' $(($1 / 1000)) $(($1 % 1000)); }

# Sets `front`: the program on $1 ranks, under the launcher where there is more than one.
front_for() {
  front=("$clathra")
  if [ -n "$mpiexec" ] && [ "$1" -gt 1 ]; then front=("$mpiexec" -n "$1" "$clathra"); fi
}
start() {
  front_for "$1"
  shift
  "${front[@]}" "$@"
}

# Killed five times at different instants; some come before the first checkpoint, some after the end.
killed=0
for round in 1 2 3 4 5; do
  ranks=$((round % 3 + 1))
  front_for "$ranks"
  setsid "${front[@]}" "${given[@]}" --output killed --resume --checkpoint-every 0.2s >log 2>&1 &
  job=$!
  sleep "$(seconds $((round * quarter)))"
  kill_session "$job"
  code=0
  wait "$job" 2>/dev/null || code=$?
  if [ "$code" = 137 ]; then killed=$((killed + 1)); fi
done
[ "$killed" -gt 0 ] || fail "no run was killed"
start 2 "${given[@]}" --output killed --resume >log 2>&1 || fail "cannot be resumed"
compare() {
  cmp "alone/history.csv" "$1/history.csv" || fail "$1: another history"
  cmp "alone/events.csv" "$1/events.csv" || fail "$1: other events"
  [ "$("$clathra" info --state-hash alone)" = "$("$clathra" info --state-hash "$1")" ] || fail "$1: another state"
  [ "$(ls alone/snap)" = "$(ls "$1/snap")" ] || fail "$1: other snapshots: $(ls "$1/snap" | tr '\n' ' ')"
  [ -z "$(find "$1" -name '*.tmp-*')" ] || [ "$1" = killed ] || fail "$1: left-over files"
  [ ! -e "$1/ckpt" ] || fail "$1: a finished run keeps checkpoints"
}
compare killed
start 2 "${given[@]}" --output killed --resume >log 2>&1 || fail "a finished run cannot be resumed"
grep -q "this run is finished" log || fail "does not know that the run is finished"
compare killed
code=0
"$clathra" "${given[@]}" --output killed --resume --set damping.local=0.2 >log 2>&1 || code=$?
[ "$code" = 73 ] && grep -q "finished run of another scene" log || fail "would destroy another scene's results ($code)"
compare killed

# Asked to stop: the step's end, a checkpoint, 75.
code=0
start 3 "${given[@]}" --output stopped --max-walltime "$(seconds $quarter)s" --checkpoint-every 0s >log 2>&1 || code=$?
[ "$code" = 75 ] || fail "code $code instead of 75 where the wall time is over"
[ -f stopped/ckpt/0.json ] || fail "stopped without a checkpoint"
grep -q -- "--resume goes on" log || fail "does not say how to go on"
hash=$("$clathra" info --state-hash stopped/ckpt/0.h5)
[ "${#hash}" = 18 ] || fail "a checkpoint without a state hash: '$hash'"
code=0
"$clathra" "${given[@]}" --output stopped --resume --set bond.rolling_lever="1 mm" >log 2>&1 || code=$?
[ "$code" = 73 ] && grep -q "bond.rolling_lever was .*, is" log || fail "a checkpoint of another scene is not refused with the key ($code)"
grep -q "rod_mm" stopped/run.json && fail "a refused scene left its record in the folder"
printf 'x' | dd of=stopped/ckpt/0.h5 bs=1 seek=5000 conv=notrunc 2>/dev/null
code=0
"$clathra" "${given[@]}" --output stopped --resume >log 2>&1 || code=$?
[ "$code" = 66 ] && grep -q "has digest" log || fail "a damaged checkpoint is not refused ($code)"
code=0
start 2 "${given[@]}" --output stopped --max-walltime "$(seconds $quarter)s" >log 2>&1 || code=$?
[ "$code" = 73 ] && grep -q "holds a run that is not finished" log || fail "a run that is not finished is not kept ($code)"
code=0
start 2 "${given[@]}" --output stopped --overwrite --max-walltime "$(seconds $quarter)s" >log 2>&1 || code=$?
[ "$code" = 75 ] || fail "code $code at the second try"
"$clathra" "${given[@]}" --output stopped --resume >log 2>&1 || fail "cannot be resumed on one rank"
compare stopped

# Told by a batch system through the launcher, twice: all ranks stop with one checkpoint.
front_for 3
"${front[@]}" "${given[@]}" --output told --checkpoint-every 0s >log 2>&1 &
job=$!
until [ -s told/history.csv ]; do sleep 0.1; done
kill -USR1 "$job"
sleep 0.2
kill -USR1 "$job" 2>/dev/null || true
code=0
wait "$job" || code=$?
[ "$code" = 75 ] && [ -f told/ckpt/0.json ] || fail "code $code where a launcher passes USR1 on"
start 2 "${given[@]}" --output told --resume >log 2>&1 || fail "cannot be resumed after USR1"
compare told

# A full disk in a checkpoint: said so, and the one before serves.
code=0
"$clathra" "${given[@]}" --output full --max-walltime 0.1s >log 2>&1 || code=$?
[ "$code" = 75 ] || fail "code $code at the third try"
code=0
(ulimit -f 300 && exec "$clathra" "${given[@]}" --output full --resume --max-walltime 0.1s >log 2>&1) || code=$?
[ "$code" = 74 ] && grep -q "ckpt/1.h5: cannot" log || fail "a full disk in a checkpoint gives code $code"
"$clathra" "${given[@]}" --output full --resume >log 2>&1 || fail "cannot be resumed after a full disk"
compare full

# Bad use is refused with numbers.
if [ -n "$mpiexec" ]; then
  code=0
  "$mpiexec" -n 3 "$clathra" "${given[@]}" --output few --set specimen.file= --set specimen.particles=120 >log 2>&1 || code=$?
  [ "$code" = 77 ] && grep -q "120 particles cannot be cut among 3 ranks" log || fail "too many ranks are not refused ($code)"
  code=0
  "$mpiexec" -n 2 "$clathra" info specimen.h5 >log 2>&1 || code=$?
  [ "$code" = 64 ] && grep -q "runs on one rank, 2 were started" log || fail "a verb of one rank on two ($code)"
  code=0
  "$mpiexec" -n 1 "$clathra" "${given[@]}" --output mixed : -n 1 "$clathra" "${given[@]}" --output mixed --set damping.local=0.2 >log 2>&1 || code=$?
  [ "$code" = 77 ] && grep -q "1 of the 2 ranks have another scene" log || fail "different scenes are not refused ($code)"
fi
