#!/usr/bin/env bash
# Completes command lines as bash does. usage: tests/completion_test.sh <program clathra>
set -euo pipefail
eval "$("$1" completion bash)"
failed=0

# offers <what must be offered, in order> <words of the command line as bash cuts them...>
offers() {
  local wanted=$1
  shift
  COMP_WORDS=(clathra "$@") COMP_CWORD=$#
  COMPREPLY=()
  _clathra || true
  [ "${COMPREPLY[*]}" = "$wanted" ] && return
  echo "clathra $*: offered '${COMPREPLY[*]}', wanted '$wanted'"
  failed=1
}

folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"
mkdir folder
touch scene.toml
offers "check" ch
offers "--version" --ve
offers "--dry-run" study --dr
offers "--set" run scene.toml --s
offers "hydrate.saturation=" run --set hydrate.sat
offers "parallel" run scene.toml --set bond.contact_coupling = pa
offers "replaces parallel replaces_keeping_force" run --set bond.contact_coupling =
offers "true false" run --set run.ignore_guards =
offers "" run --set test.axial_strain =
offers "printed conditions" bond --strength-from ""
offers "vtu lammpsdump csv spreadsheet" export folder --to ""
offers "quick" init q
offers "paper/s41-1mpa paper/s41-2mpa paper/s41-3mpa" init paper/s41
offers "scene.toml" check sc
offers "folder" run --output ""
COMP_WORDBREAKS=${COMP_WORDBREAKS//=/}
offers "bond.law=none" run --set bond.law=n
exit "$failed"
