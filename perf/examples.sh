#!/usr/bin/env bash
# What perf/reports/0.1/examples.md shows: the scenes of examples/, run by this program, with tables and pictures.
#   perf/examples.sh OUT [threads]
# One specimen of 20,000 discs for the twelve tests of the paper, the literal reading and the scene `sand`; quick and full-size make
# their own. Writes OUT/examples.md, the tables for that page, and OUT/pictures. A run that is there already is not made again. Needs a
# build (cmake --preset release && cmake --build --preset release) and the packages python3-matplotlib and python3-h5py for the pictures.
# About a quarter of an hour on two cores, half of it for full-size; WITHOUT="full-size" leaves that out.
set -euo pipefail
out=${1:?usage: perf/examples.sh OUT [threads]}
threads=${2:-2}
root=$(cd "$(dirname "$0")/.." && pwd)
program=$root/build/release/drivers/clathra
mkdir -p "$out/pictures"
out=$(cd "$out" && pwd)
[ -f "$out/specimen.h5" ] ||
  "$program" generate "$root/examples/paper/s55-1mpa.toml" -o "$out/specimen.h5" --set run.threads="$threads"

# Runs a scene, with the settings that follow its name, unless it has been run.
run() {
  local name=$1 scene=$root/examples/$1.toml
  shift
  [[ " ${WITHOUT-} " != *" ${name#paper/} "* ]] || return 0
  [ -f "$out/${name#paper/}/final.h5" ] ||
    "$program" run "$scene" --set run.threads="$threads" "$@" --resume --output "$out/${name#paper/}"
}
of_specimen=(--set "specimen.file=$out/specimen.h5")
tests=()
for stress in 1mpa 2mpa 3mpa; do
  for saturation in sand s26 s41 s55; do
    run "paper/$saturation-$stress" "${of_specimen[@]}"
    tests+=("$saturation-$stress")
  done
done
run quick
run sand
run paper/literal-s55-1mpa "${of_specimen[@]}"
run paper/full-size

cd "$out"
others=()
for other in quick sand literal-s55-1mpa full-size; do [ ! -f "$other/final.h5" ] || others+=("$other"); done
{
  "$root/build/release/perf/paper_table" "${tests[@]}"
  echo
  [ ${#others[@]} = 0 ] || "$root/build/release/perf/paper_table" "${others[@]}"
} >examples.md

# draw RUN STRAIN OTHER...: a picture of a run at an axial strain, beside other runs.
draw() {
  local run=$1 strain=$2
  shift 2
  python3 "$root/share/python/specimen_and_curve.py" "$run" -o "pictures/$run.png" --strain "$strain" --beside "$@"
}
if python3 -c 'import matplotlib, h5py' 2>/dev/null; then
  for stress in 1mpa 2mpa 3mpa; do
    for saturation in sand s26 s41 s55; do
      beside=()
      for other in sand s26 s41 s55; do [ "$other" = "$saturation" ] || beside+=("$other-$stress"); done
      draw "$saturation-$stress" 0.05 "${beside[@]}"
    done
  done
  for other in "${others[@]}"; do
    case $other in
      literal-s55-1mpa) draw "$other" 0.1 s55-1mpa sand-1mpa ;;
      quick) draw "$other" 0.02 s55-1mpa ;;
      *) draw "$other" 0.05 s55-1mpa ;;
    esac
  done
fi
