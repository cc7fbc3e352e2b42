#!/usr/bin/env bash
# scripts/gpu_machine packs what it says and refuses what it must; with a folder of an installed Kokkos the packed sources are built
# too, and the program of the golden states runs: gpu_machine_test.sh PROJECT_FOLDER WORK_FOLDER [KOKKOS BACKEND]
set -euo pipefail
script=$1/scripts/gpu_machine work=$2
rm -rf "$work"
mkdir -p "$work"
fail() {
  echo "gpu_machine_test: $*" >&2
  exit 1
}

# The command after the exit code and a part of the message that are to come.
refuses() {
  local code=0
  "${@:3}" >"$work/output" 2>&1 || code=$?
  [ "$code" = "$1" ] || fail "exit code $code instead of $1: ${*:3}"
  grep -qF -- "$2" "$work/output" || fail "does not say '$2': $(cat "$work/output")"
}

refuses 64 usage "$script"
refuses 64 usage "$script" pack
refuses 64 "for the folder that pack makes" "$script" run
refuses 66 "no sources of Kokkos" "$script" pack "$work" "$work/packed"
refuses 69 "no sources of GoogleTest in /nowhere" env GOOGLETEST_SOURCES=/nowhere "$script" pack - "$work/packed"
mkdir "$work/other"
touch "$work/other/file"
refuses 73 "was not made by this script" "$script" pack - "$work/other"
[ -f "$work/other/file" ] || fail "a foreign folder was emptied"

packed=$work/packed
"$script" pack - "$packed"
"$script" pack - "$packed" # over the first one
for file in clathra/CMakeLists.txt clathra/src/kernels/forces_full.cpp clathra/tests/golden_states.hpp clathra/perf/throughput_card.cpp \
  googletest/CMakeLists.txt googletest/googletest/src/gtest-all.cc commit.txt; do
  [ -s "$packed/$file" ] || fail "$file was not packed"
done
for file in src/kernels/forces_full.cpp tests/CMakeLists.txt; do
  if [ "$packed/clathra/$file" -nt "$1/$file" ] || [ "$packed/clathra/$file" -ot "$1/$file" ]; then
    fail "$file has another date: all would be built again"
  fi
done
refuses 64 usage "$packed/gpu_machine" run --unknown 1
refuses 66 "no Kokkos was packed" "$packed/gpu_machine" run
mkdir -p "$packed/kokkos" "$work/tools"
touch "$packed/kokkos/CMakeLists.txt"
refuses 64 "unknown back end 'abacus'" "$packed/gpu_machine" run --backend abacus
for tool in bash dirname env nproc g++; do ln -s "$(command -v "$tool")" "$work/tools"; done
refuses 69 "cmake is not here" env PATH="$work/tools" "$packed/gpu_machine" run --backend serial

[ $# -gt 2 ] || exit 0
rm -r "$packed/kokkos"
"$packed/gpu_machine" run --backend "$4" --kokkos "$3" golden
grep -qx 'golden: passed, [1-9][0-9]* cases passed' "$packed.$4/results/summary.txt" || fail "no verdict of the golden states"
