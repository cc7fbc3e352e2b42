# shellcheck shell=bash disable=SC2034
# Sourced by scripts/run, scripts/test and .ci/run: everything between a bare Debian or Ubuntu and a finished build.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
log=$project/build/setup.log
build_packages=(g++ cmake ninja-build pkg-config git xz-utils libtomlplusplus-dev libcli11-dev libfmt-dev libxxhash-dev
  nlohmann-json3-dev libhdf5-openmpi-dev libopenmpi-dev openmpi-bin libpng-dev libeigen3-dev libboost-dev)

say() { echo "clathra: $*" >&2; }

# Runs a command with its output in the log. When it fails, shows the first errors and the end of the log, and stops.
logged() {
  "$@" >>"$log" 2>&1 </dev/null && return
  grep -E -m 8 'error:|CMake Error|^E: |^kokkos: failed' "$log" >&2 || true
  echo "..." >&2
  tail -n 20 "$log" >&2
  say "failed: $*"
  say "the whole output is in ${log#"$PWD"/}"
  exit 70
}

# Prints those of the packages $@ that are not installed.
missing_packages() {
  local package
  for package; do
    dpkg-query --show --showformat '${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || echo "$package"
  done
}

# Makes sure that the packages $@ are installed; stops with 69 when that needs a right that we do not have.
need_packages() {
  local missing as_root=()
  command -v dpkg-query >/dev/null || { say "no dpkg here: using the libraries that CMake finds"; return; }
  mapfile -t missing < <(missing_packages "$@")
  [ ${#missing[@]} = 0 ] && return
  if [ "$(id -u)" != 0 ]; then
    if ! sudo -n true 2>/dev/null; then
      say "these packages are missing, and installing them needs root:"
      say "  sudo apt-get install ${missing[*]}"
      exit 69
    fi
    as_root=(sudo -n)
  fi
  say "installing ${missing[*]}"
  # A broken entry for some other repository is no reason to stop: what counts is whether the packages install.
  "${as_root[@]}" apt-get -o DPkg::Lock::Timeout=300 update >>"$log" 2>&1 </dev/null || true
  logged "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 install --yes \
    --no-install-recommends "${missing[@]}"
}

# Starts the log. Two set-ups in one folder would be in each other's way: the second waits for the first.
begin() {
  mkdir -p "$project/build"
  exec 8>"$project/build/.lock"
  flock -n 8 || { say "waiting for another set-up in this folder"; flock 8; }
  : >"$log"
}

# Configures and builds the targets $@ with the preset release.
build() {
  cd "$project"
  [ -f build/release/CMakeCache.txt ] || say "configuring, and building Kokkos if there is none yet (half a minute)"
  logged cmake --preset release
  say "building (a few minutes the first time, output in build/setup.log)"
  logged cmake --build --preset release --target "$@"
}
