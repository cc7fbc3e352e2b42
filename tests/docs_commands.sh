#!/usr/bin/env bash
# Runs the commands of a page: blocks marked ```sh as they stand, of blocks marked ```sh-long only the beginning: a run and
# a generation as a check, other commands with --help; as they stand, too, where CLATHRA_DOCS_LONG is set. Blocks marked ```python are
# run with the Python package. A block marked ```out holds what the block before it prints, line for line and in order; a line of dots
# stands for lines left out, dots at the end of a line for its rest. All blocks of a page share one empty folder that has examples/
# and share/.
# usage: tests/docs_commands.sh <program clathra> <folder of the project> <page>
set -euo pipefail
program=$1 project=$2 page=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin" "$folder/work"
ln -s "$program" "$folder/bin/clathra"
ln -s "$project/examples" "$project/share" "$folder/work"

# Writes the blocks to $folder/1.sh, 2.sh-long, ... and prints their names.
blocks() {
  awk -v folder="$folder" '
    /^```/ && file { close(file); file = ""; next }
    /^```(sh(-long)?|python|out)$/ { file = folder "/" ++count "." substr($0, 4); print file; printf "" > file; next }
    /^```/ { file = "/dev/null"; next }
    file { print > file }' "$page"
}

shortened() {
  sed -nE -e 's/[[:space:]]+#.*//' -e ':join' -e '/\\$/{N;s/\\\n//;b join' -e '}' \
    -e 's/^clathra (run|generate) /clathra check /;T other' \
    -e 's/ (-o|--output|--max-walltime|--checkpoint-every) [^ ]+//g; s/ --(resume|overwrite)//g; s/ --set specimen.file=[^ ]+//;p;d' \
    -e ':other' -e 's/^(clathra [a-z]+) .*/\1 --help/p' "$1"
}

# Whether the lines of $1 stand in $2, in their order.
shows() {
  awk 'NR == FNR { if ($0 !~ /^ *(\.\.\.)?$/) wanted[++count] = $0; next }
    { sub(/[ \t\r]+$/, ""); want = wanted[at + 1] }
    $0 == want || want ~ /\.\.\.$/ && index($0, substr(want, 1, length(want) - 3)) == 1 { ++at }
    END { if (at < count) { print "not printed, or not in this order: " wanted[at + 1]; exit 1 } }' "$1" "$2"
}

mapfile -t files < <(blocks)
[ ${#files[@]} -gt 0 ] || { echo "$page: no commands"; exit 1; }
cd "$folder/work"
export PYTHONDONTWRITEBYTECODE=1 # share/ is that of the sources
for file in "${files[@]}"; do
  echo "--- $(basename "$page"), ${file##*/}"
  if [[ $file == *.out ]]; then
    shows "$file" "$folder/printed" || { cat "$folder/printed"; exit 1; }
    continue
  fi
  if [[ $file == *-long && ! ${CLATHRA_DOCS_LONG-} ]]; then shortened "$file" >"$file.short" && file=$file.short; fi
  runner=(bash -euo pipefail)
  if [[ $file == *.python ]]; then runner=(env PYTHONPATH=share/python python3); fi
  PATH="$folder/bin:$PATH" "${runner[@]}" "$file" </dev/null >"$folder/printed" 2>&1 || {
    code=$?
    cat "$file" "$folder/printed"
    exit $code
  }
done
