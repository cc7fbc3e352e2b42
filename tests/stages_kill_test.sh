#!/usr/bin/env bash
# A run of stages that is killed at ten random instants and resumed on 1 to 4 ranks leaves the bytes of one that was left
# alone: stages_kill_test.sh CLATHRA SCENE [MPIEXEC [SEED]]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/kill_session.sh"
clathra=$1 scene=$2 mpiexec=${3:-} RANDOM=${4:-1}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "stages_kill: $*"; cat log || true; exit 1; }

"$clathra" generate "$scene" -o specimen.h5 >log 2>&1 || fail "no specimen"
given=(run "$scene" --set specimen.file=specimen.h5 --set output.keep_checkpoint=false)
begun=$(date +%s%N)
"$clathra" "${given[@]}" --output alone >log 2>&1 || fail "the run that is left alone failed"
milliseconds=$((($(date +%s%N) - begun) / 1000000))
[ "$(cut -d, -f1 alone/history.csv | sort -u | grep -cv -e stage -e consolidation)" = "$(grep -c '^\[\[stage\]\]' "$scene")" ] || fail "not all stages"

killed=0
for round in 0 1 2 3 4 5 6 7 8 9; do
  ranks=$((round % 4 + 1)) front=("$clathra")
  if [ -n "$mpiexec" ] && [ "$ranks" -gt 1 ]; then front=("$mpiexec" -n "$ranks" "$clathra"); fi
  setsid "${front[@]}" "${given[@]}" --output killed --resume --checkpoint-every 0.1s >log 2>&1 &
  job=$!
  # Short at first, so that each kill finds something left to do.
  after=$((200 + RANDOM % (milliseconds / 4 + 1)))
  sleep "$((after / 1000)).$(printf %03d $((after % 1000)))"
  kill_session "$job"
  code=0
  wait "$job" 2>/dev/null || code=$?
  if [ "$code" = 137 ]; then killed=$((killed + 1)); fi
done
[ "$killed" -gt 3 ] || fail "only $killed runs were killed"
"$clathra" "${given[@]}" --output killed --resume >log 2>&1 || fail "cannot be resumed"
for file in history.csv events.csv; do cmp "alone/$file" "killed/$file" || fail "another $file"; done
[ "$("$clathra" info --state-hash alone)" = "$("$clathra" info --state-hash killed)" ] || fail "another state"
[ "$(ls alone/snap)" = "$(ls killed/snap)" ] || fail "other snapshots"
numbers() { sed -n '/"loading": \[/,/\]/p' "$1/run.json"; }
[ "$(numbers alone)" = "$(numbers killed)" ] || fail "other ends of stages"
echo "stages_kill: $killed of 10 runs were killed"
