#!/usr/bin/env bash
# The script of `clathra study --slurm` run by an sbatch that executes its jobs gives the study.csv of the study run at once:
# slurm_test.sh CLATHRA
set -euo pipefail
clathra=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "slurm: $*"; tail -n 40 ./*.log logs/* 2>/dev/null || true; exit 1; }

# A cluster of one machine: sbatch runs each job of an array at once, in the order in which they come.
mkdir bin
cat >bin/sbatch <<'END'
#!/bin/bash
array=0 name=? out=
while [ "${1#--}" != "$1" ]; do
  case $1 in
    --array=1-*) array=${1#--array=1-} ;;
    --job-name=*) name=${1#--job-name=} ;;
    --dependency=*) case $1 in *:) echo "sbatch: no job in $1" >&2; exit 1 ;; esac ;;
    --time=*) [[ $1 =~ ^--time=[0-9]+:[0-9][0-9]:[0-9][0-9]$ ]] || { echo "sbatch: $1" >&2; exit 1; } ;;
  esac
  shift
done
cp "$1" "$CLUSTER/job.sh" # as Slurm does: the job does not see the script's own name
shift
for ((i = 1; i <= (array > 0 ? array : 1); ++i)); do
  variables=(SLURM_ARRAY_JOB_ID=7)
  [ "$array" = 0 ] || variables+=(SLURM_ARRAY_TASK_ID=$i)
  env "${variables[@]}" bash "$CLUSTER/job.sh" "$@" >>"$CLUSTER/$name.log" 2>&1 ||
    echo "$name $i ended with $?" >>"$CLUSTER/ended.log"
done
echo 7
END
# Passes on what it is told to start, and writes down which note it was given.
cat >bin/srun <<'END'
#!/bin/bash
echo "$NOTE" >>"$CLUSTER/notes.log"
exec "$@"
END
printf '#!/bin/bash\nexit 0\n' >bin/scontrol
chmod +x bin/*
export PATH=$PWD/bin:$PATH CLUSTER=$PWD OMP_NUM_THREADS=1

cat >base.toml <<'END'
[specimen]
particles = 100
void_ratio = 0.28
compaction_layers = 1
[hydrate]
saturation = "55 %"
[test]
axial_strain = "0.3 %"
inertial_number = 0.012
[output]
records = 10
snapshots = 0
END
cat >study.toml <<'END'
scene = "base.toml"
seeds = 7
[matrix]
test.confining_stress = ["1 MPa", "2 MPa", "3 MPa"]
END
options=(--seeds 3 --ignore-guards --set grains.friction=0.4 --set "damping.local=25 %" --checkpoint-every "10 min")
"$clathra" study study.toml "${options[@]}" --output at-once >at-once.log 2>&1 || fail "the study at once failed"
launcher="env \"NOTE=a 'quoted' \$note\" srun"
"$clathra" study study.toml "${options[@]}" --output "it's hér€" --max-walltime "1 h" --threads 1 --launcher "$launcher" \
  --slurm "my script.sh" >script.log 2>&1 || fail "no script"
grep -q "submit it with: bash 'my script.sh'" script.log || fail "how to submit it: $(cat script.log)"
# From wherever it is called.
(mkdir elsewhere && cd elsewhere && bash "../my script.sh" --partition=short) >submitted.log 2>&1 || fail "the script failed"
[ ! -e ended.log ] || fail "jobs failed: $(cat ended.log)"
[ "$(sort -u notes.log)" = "a 'quoted' \$note" ] || fail "the launcher was not taken as it was given: $(sort -u notes.log)"
[ "$(wc -l <notes.log)" = 12 ] || fail "not 3 specimens and 9 members: $(wc -l <notes.log)"
# The rows without the times, which are the last two columns.
rows() { sed 's/,[^,]*,[^,]*$//' "$1/study.csv"; }
[ "$(rows at-once | grep -c '^member,.*,finished,')" = 9 ] || fail "not all members are finished"
rows at-once >a.rows
rows "it's hér€" >b.rows
cmp a.rows b.rows || fail "another study.csv: $(diff a.rows b.rows | head -n 4)"
[ -s "it's hér€/study.html" ] || fail "no page"
