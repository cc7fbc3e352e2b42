#!/usr/bin/env bash
# A study whose programs are killed again and again and that is resumed ends with the study.csv of one that was left alone:
# study_test.sh CLATHRA SCENE SEEDS KILLS
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/kill_session.sh"
clathra=$1 scene=$2 seeds=$3 kills=$4
folder=$(mktemp -d)
job=
# A failure may leave a study at work, which goes on writing into the folder.
trap '[ -z "$job" ] || kill_session "$job"; rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "study: $*"; tail -n 30 log || true; exit 1; }

cat >study.toml <<END
scene = "$scene"
seeds = $seeds
[matrix]
"hydrate.saturation" = ["0 %", "26 %", "55 %"]
"test.confining_stress" = { from = "1 MPa", to = "3 MPa", count = 3 }
"specimen.particles" = 500
"test.axial_strain" = "4 %"
"output.snapshots" = 2
END
members=$((9 * seeds))
# The rows without the times, which are the last two columns, and without the word of a checkpoint that a kill left half written.
rows() { sed -e 's/,[^,]*,[^,]*$//' -e 's/"a checkpoint is passed over: [^"]*"//' "$1/study.csv"; }
study=("$clathra" study study.toml --checkpoint-every 0.3s)

begun=$(date +%s%N)
"${study[@]}" --output alone >log 2>&1 || fail "the study that is left alone failed"
took=$((($(date +%s%N) - begun) / 1000000)) # [ms]
echo "undisturbed: $members members in $took ms"
[ "$(rows alone | grep -c '^member,.*,finished,')" = "$members" ] || fail "not all members are finished"

# The whole session, the driver alone (its members are told to stop), or one member alone (the driver starts it again).
for ((round = 1; round <= kills; ++round)); do
  setsid "${study[@]}" --output killed >log 2>&1 &
  job=$!
  wait_ms=$(((RANDOM % 1000) * took / 1000 / (kills / 2 + 1) + 100))
  sleep "$(printf '%d.%03d' $((wait_ms / 1000)) $((wait_ms % 1000)))"
  case $((round % 3)) in
    0) kill_session "$job" ;;
    1) kill -KILL "$job" 2>/dev/null || true ;;
    2)
      member=$(ps -o pid= --ppid "$job" | head -n 1 || true) # none while the study waits for members of one that was killed
      [ -z "$member" ] || kill -KILL "$member" 2>/dev/null || true
      sleep 0.3
      kill_session "$job"
      ;;
  esac
  wait "$job" 2>/dev/null || true
  echo "round $round: killed after $wait_ms ms, $(rows killed 2>/dev/null | grep -c '^member,.*,finished,' || true) members finished"
done
"${study[@]}" --output killed >log 2>&1 || fail "cannot be resumed"
rows alone >alone.rows
rows killed >killed.rows
cmp alone.rows killed.rows || fail "another study.csv"
[ -s killed/study.html ] || fail "no page"

# What is finished is not run again.
begun=$(date +%s%N)
"${study[@]}" --output killed >log 2>&1 || fail "cannot be run again"
[ $((($(date +%s%N) - begun) / 1000000)) -lt $((took / 2 + 2000)) ] || fail "ran finished members again"
rows killed | cmp - alone.rows || fail "another study.csv when all was finished"
