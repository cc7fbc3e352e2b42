#!/usr/bin/env bash
# Runs the commands of a page of docs/: blocks marked ```sh as they stand, of blocks marked ```sh-long only the beginning: a run as
# --dry-run, a generation as a check, other verbs with --help; blocks marked ```sh-small as they stand but for their runs, which are
# those of a small specimen. All blocks of a page share one empty folder that has examples/.
# usage: tests/docs_commands.sh <program clathra> <folder of the project> <page>
set -euo pipefail
program=$1 project=$2 page=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin" "$folder/work"
ln -s "$program" "$folder/bin/clathra"
ln -s "$project/examples" "$folder/work/examples"

# Writes the blocks to $folder/1.sh, 2.sh-long, ... and prints their names.
blocks() {
  awk -v folder="$folder" '
    /^```/ && file { close(file); file = ""; next }
    /^```sh(-long|-small)?$/ { file = folder "/" ++count "." substr($0, 4); print file; printf "" > file; next }
    /^```/ { file = "/dev/null"; next }
    file { print > file }' "$page"
}

shortened() {
  sed -nE -e 's/[[:space:]]+#.*//' -e 's/^(clathra run .*)/\1 --dry-run/p;t' \
    -e 's/^clathra generate (.*) -o [^ ]+/clathra check \1/p;t' -e 's/^(clathra [a-z]+) .*/\1 --help/p' "$1"
}

with_small_runs() {
  sed -E -e ':join' -e '/\\$/{N;s/\\\n//;b join' -e '}' \
    -e 's/^clathra run .*/& --set sample.particles=300 --set test.axial_strain="1 %"/' "$1"
}

mapfile -t files < <(blocks)
[ ${#files[@]} -gt 0 ] || { echo "$page: no commands"; exit 1; }
cd "$folder/work"
for file in "${files[@]}"; do
  if [[ $file == *-long ]]; then shortened "$file" >"$file.short" && file=$file.short; fi
  if [[ $file == *-small ]]; then with_small_runs "$file" >"$file.run" && file=$file.run; fi
  echo "--- $(basename "$page"), ${file##*/}"
  PATH="$folder/bin:$PATH" bash -euxo pipefail "$file" </dev/null
done
