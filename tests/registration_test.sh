#!/usr/bin/env bash
# Each case of a test program is a test of ctest exactly once for each number of threads, and none but those named is labelled long:
# registration_test.sh CTEST BUILD_FOLDER [PROGRAM THREADS,THREADS... CASE:CASE...]...
set -euo pipefail
ctest=$1 build=$2
shift 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# A line for each test that ctest knows: program, case, number of threads, "long" or "".
"$ctest" --test-dir "$build" -N -V | awk '
  /^[0-9]+: Test command: / { program = name = threads = label = "" }
  /^[0-9]+: Test command: .*"--gtest_filter=/ {
    program = name = $0
    sub(/"? "--gtest_filter=.*/, "", program); sub(/.*\//, "", program)
    sub(/.*"--gtest_filter=/, "", name); sub(/".*/, "", name)
  }
  /^[0-9]+: +OMP_NUM_THREADS=/ { threads = $0; sub(/.*=/, "", threads) }
  /^Labels:.* long( |$)/ { label = " long" }
  /^ +Test +#[0-9]+: / { if (name != "") print program, name, threads label }' | sort >"$folder/registered"

while [ $# -gt 0 ]; do
  program=$1 threads=$2 long=$3
  shift 3
  "$program" --gtest_list_tests | sed 's/ *#.*//' | awk -v program="${program##*/}" -v threads="$threads" -v long="$long" '
    BEGIN { count = split(threads, number, ","); split(long, names, ":"); for (n in names) if (names[n] != "") label[names[n]] = " long" }
    /^[^ ].*\.$/ { suite = $1; next }
    /^  / { for (n = 1; n <= count; ++n) print program, suite $1, number[n] label[suite $1]; seen[suite $1] = 1 }
    END { for (name in label) if (!(name in seen)) print program, name, "is named as a long case, but there is none" }'
done | sort >"$folder/wanted"

[ -s "$folder/wanted" ] || { echo "registration: the programs list no case"; exit 1; }
if grep -n 'DISABLED_' "$folder/wanted"; then echo "registration: a case that is disabled tests nothing"; exit 1; fi
diff "$folder/wanted" "$folder/registered" && exit
echo "registration: '<' is what the programs hold (program, case, threads, label), '>' is what ctest runs"
exit 1
