#!/usr/bin/env bash
# A small run is opened by a viewer: viewers_test.sh <clathra> <project> paraview <pvpython> | python <python with h5py and matplotlib>
set -euo pipefail
clathra=$1 project=$2 viewer=$3 interpreter=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$clathra" run "$project/examples/quick.toml" --set sample.particles=300 --set test.axial_strain="1 %" --set output.snapshots=3 \
  --output "$folder/out" >"$folder/run.log" 2>&1 || { cat "$folder/run.log"; exit 1; }
if [ "$viewer" = paraview ]; then
  "$interpreter" "$project/tests/paraview_reads.py" "$folder/out"
  if command -v xvfb-run >/dev/null; then
    draw=("$interpreter" "$project/share/paraview/specimen.py" "$folder/out" "$folder/picture.png" --colour stress_yy --strain 0.005)
    if ! xvfb-run -a "${draw[@]}" >"$folder/draw.log" 2>&1; then
      grep -q "bad X server connection" "$folder/draw.log" || { cat "$folder/draw.log"; exit 1; }
      echo "the virtual display came too late: no picture"  # on a busy machine
      exit 0
    fi
    [ "$(stat -c %s "$folder/picture.png")" -gt 20000 ] || { echo "picture.png is all but empty"; exit 1; }
  fi
else
  "$interpreter" "$project/share/python/curves.py" "$folder/out" -o "$folder/curves.pdf"
  "$interpreter" "$project/share/python/bonds.py" "$(find "$folder/out/snap" -name '*.h5' | sort | tail -n 1)" -o "$folder/bonds.pdf"
  "$interpreter" "$project/share/python/specimen_and_curve.py" "$folder/out" -o "$folder/test.pdf" --strain 0.005 --beside "$folder/out"
  "$interpreter" "$project/share/python/specimen_and_curve.py" "$folder/out" -o "$folder/test.png"
  "$interpreter" "$project/share/python/grains.py" "$folder/out/final.h5" -o "$folder/grains.pdf"
  "$interpreter" "$project/share/python/grains.py" "$folder/out/final.h5" -o "$folder/grains.png"
  for picture in curves.pdf bonds.pdf test.pdf test.png grains.pdf grains.png; do
    [ "$(stat -c %s "$folder/$picture")" -gt 5000 ] || { echo "$picture is all but empty"; exit 1; }
  done
fi
