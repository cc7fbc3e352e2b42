#!/usr/bin/env bash
# A small run is opened by a viewer: viewers_test.sh <clathra> <project> paraview <pvpython> | picture <pvpython> <Xvfb> | python
# <python with h5py and matplotlib>
set -euo pipefail
clathra=$1 project=$2 viewer=$3 interpreter=$4
export CLATHRA=$clathra # for the scripts that call it
folder=$(mktemp -d)
server=
finish() {
  if [ -n "$server" ]; then kill "$server" 2>/dev/null || true; fi
  rm -rf "$folder"
}
trap finish EXIT

# Starts the X server $1 on a display that is free and sets DISPLAY. The server says the number when it takes connections, so
# nothing comes too late on a busy machine; when it ends instead, the number is empty. It must not begin anew when its last client leaves:
# the next one may come in between.
begin_display() {
  local number=
  mkfifo "$folder/number"
  "$1" -displayfd 3 -noreset -screen 0 1280x1024x24 -nolisten tcp 3>"$folder/number" >"$folder/server.log" 2>&1 &
  server=$!
  read -r number <"$folder/number" || true
  [ -n "$number" ] || { cat "$folder/server.log"; echo "$1 gave no display"; exit 1; }
  export DISPLAY=:$number
}

"$clathra" run "$project/examples/quick.toml" --set specimen.particles=300 --set test.axial_strain="1 %" --set output.snapshots=3 \
  --output "$folder/out" >"$folder/run.log" 2>&1 || { cat "$folder/run.log"; exit 1; }
if [ "$viewer" = paraview ]; then
  "$interpreter" "$project/tests/paraview_reads.py" "$folder/out"
elif [ "$viewer" = picture ]; then
  begin_display "$5"
  "$interpreter" "$project/share/paraview/specimen.py" "$folder/out" "$folder/picture.png" --colour stress_yy --strain 0.005
  [ "$(stat -c %s "$folder/picture.png")" -gt 20000 ] || { echo "picture.png is all but empty"; exit 1; }
else
  "$interpreter" "$project/share/python/curves.py" "$folder/out" -o "$folder/curves.pdf"
  "$interpreter" "$project/share/python/bonds.py" "$(find "$folder/out/snap" -name '*.h5' | sort | tail -n 1)" -o "$folder/bonds.pdf"
  "$interpreter" "$project/share/python/specimen_and_curve.py" "$folder/out" -o "$folder/test.pdf" --strain 0.005 --beside "$folder/out"
  "$interpreter" "$project/share/python/specimen_and_curve.py" "$folder/out" -o "$folder/test.png"
  "$interpreter" "$project/share/python/grains.py" "$folder/out/final.h5" -o "$folder/grains.pdf"
  "$interpreter" "$project/share/python/grains.py" "$folder/out/final.h5" -o "$folder/grains.png"
  for picture in curves.pdf bonds.pdf test.pdf test.png grains.pdf grains.png; do
    [ "$(stat -c %s "$folder/$picture")" -gt 4000 ] || { echo "$picture is all but empty"; exit 1; }
  done
fi
