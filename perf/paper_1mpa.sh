#!/bin/sh
# The four biaxial tests at 1 MPa (clean sand, 26, 41 and 55 % hydrate; 20,000 discs, 15 % strain, I = 1e-4) on one specimen, and their table.
#   perf/paper_1mpa.sh OUT [threads]
# Needs a build (cmake --preset release && cmake --build --preset release). About 15 minutes on two cores.
set -eu
out=${1:?usage: perf/paper_1mpa.sh OUT [threads]}
threads=${2:-2}
root=$(cd "$(dirname "$0")/.." && pwd)
clathra=$root/build/release/drivers/clathra
mkdir -p "$out"
[ -f "$out/specimen.h5" ] || "$clathra" generate "$root/examples/paper/s55-1mpa.toml" -o "$out/specimen.h5" --set run.threads="$threads"
specimen=$(cd "$out" && pwd)/specimen.h5
for scene in sand s26 s41 s55; do
  "$clathra" run "$root/examples/paper/$scene-1mpa.toml" --set sample.generator=file --set sample.file="$specimen" \
    --set sample.particles=0 --set run.threads="$threads" --output "$out/$scene-1mpa"
done
cd "$out" && "$root/build/release/perf/paper_table" sand-1mpa s26-1mpa s41-1mpa s55-1mpa | tee table.md
