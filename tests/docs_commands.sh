#!/usr/bin/env bash
# Runs the commands of a page of docs/: blocks marked ```sh as they stand, of blocks marked ```sh-long only the beginning: a run and
# a generation as a check, other verbs with --help; blocks marked ```sh-small as they stand but for their runs, which are
# those of a small specimen. A block marked ```out holds what the block before it prints, line for line and in order; a line of dots stands
# for lines left out. All blocks of a page share one empty folder that has examples/.
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
    /^```(sh(-long|-small)?|out)$/ { file = folder "/" ++count "." substr($0, 4); print file; printf "" > file; next }
    /^```/ { file = "/dev/null"; next }
    file { print > file }' "$page"
}

shortened() {
  sed -nE -e 's/[[:space:]]+#.*//' -e 's/^clathra (run|generate) /clathra check /;T other' \
    -e 's/ (-o|--output|--max-walltime|--checkpoint-every) [^ ]+//g; s/ --(resume|overwrite)//g;p;d' -e ':other' -e 's/^(clathra [a-z]+) .*/\1 --help/p' "$1"
}

# Whether the lines of $1 stand in $2, in their order.
shows() {
  awk 'NR == FNR { if ($0 !~ /^ *(\.\.\.)?$/) wanted[++count] = $0; next }
    { sub(/[ \t\r]+$/, "") } $0 == wanted[at + 1] { ++at }
    END { if (at < count) { print "not printed, or not in this order: " wanted[at + 1]; exit 1 } }' "$1" "$2"
}

with_small_runs() {
  sed -E -e ':join' -e '/\\$/{N;s/\\\n//;b join' -e '}' \
    -e 's/^clathra run .*/& --set specimen.particles=300 --set test.axial_strain="1 %"/' "$1"
}

mapfile -t files < <(blocks)
[ ${#files[@]} -gt 0 ] || { echo "$page: no commands"; exit 1; }
cd "$folder/work"
for file in "${files[@]}"; do
  echo "--- $(basename "$page"), ${file##*/}"
  if [[ $file == *.out ]]; then
    shows "$file" "$folder/printed" || exit 1
    continue
  fi
  if [[ $file == *-long ]]; then shortened "$file" >"$file.short" && file=$file.short; fi
  if [[ $file == *-small ]]; then with_small_runs "$file" >"$file.run" && file=$file.run; fi
  PATH="$folder/bin:$PATH" bash -euo pipefail "$file" </dev/null >"$folder/printed" 2>&1 || {
    code=$?
    cat "$file" "$folder/printed"
    exit $code
  }
done
