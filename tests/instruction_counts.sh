#!/usr/bin/env bash
# The instructions of each variant of the contact kernel, built for AVX2 whatever the machine: within 3 % of those on record, and
# what a scene does not ask for is not there.
#   instruction_counts.sh OBJECT_FILE RECORD
# CLATHRA_RECORD=1 writes the record anew.
set -euo pipefail
object=$1 record=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Of each variant: bonds, friction, rolling, losses, and the instructions of its own functions, not of those that launch, copy and drop it.
objdump -d --no-show-raw-insn "$object" | c++filt | awk '
  /^[0-9a-f]+ <.*>:$/ {
    name = ""
    if ($0 ~ />::~?ContactKernel\(/) next
    if (match($0, /^[0-9a-f]+ <clathra::ContactKernel<clathra::KernelVariant<clathra::FullPrecision, \(clathra::BondKind\)[0-9], [a-z]+, [a-z]+, [a-z]+>/)) {
      name = substr($0, RSTART, RLENGTH)
      sub(/.*BondKind\)/, "", name); sub(/>/, "", name); gsub(/, /, " ", name); gsub(/true/, "1", name); gsub(/false/, "0", name)
    }
    next
  }
  name != "" && /^ +[0-9a-f]+:/ { ++count[name] }
  END { for (name in count) print name, count[name] }' | sort >"$folder/now"
[ -s "$folder/now" ] || { echo "instruction_counts.sh: no contact kernel found in $object"; exit 1; }
if [ -n "${CLATHRA_RECORD:-}" ]; then
  { echo "# bonds (0 none, 1 replace, 2 parallel) friction rolling losses instructions; g++ 12, AVX2"; cat "$folder/now"; } >"$record"
fi
grep -v '^#' "$record" | sort >"$folder/then"
join -j 1 -a 1 -a 2 -e none -o 0,1.2,2.2 <(awk '{ print $1"."$2"."$3"."$4, $5 }' "$folder/then" | sort) \
  <(awk '{ print $1"."$2"."$3"."$4, $5 }' "$folder/now" | sort) | awk '
  { then_ = $2; now = $3; count[$1] = now
    if (then_ == "none" || now == "none" || now > 1.03 * then_ || now < 0.97 * then_) {
      print "variant " $1 " (bonds.friction.rolling.losses): " then_ " instructions on record, " now " now"; wrong = 1 } }
  END {
    # A feature that is off must not cost anything.
    for (name in count) {
      split(name, f, ".")
      for (n = 2; n <= 4; ++n) if (f[n] == 1) {
        off = f[1]; for (m = 2; m <= 4; ++m) off = off "." (m == n ? 0 : f[m])
        if (off in count && count[off] > count[name]) { print off " is longer than " name; wrong = 1 }
      }
    }
    exit wrong }'
