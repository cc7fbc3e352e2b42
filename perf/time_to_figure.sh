#!/usr/bin/env bash
# How long a figure takes: the paper's test with 55 % hydrate at 1 MPa, 20,000 discs to 15 % axial strain, from nothing to its results.
#   perf/time_to_figure.sh OUT [threads] [CLATHRA]     minutes on a quiet machine; CLATHRA of another commit makes the row beside it
set -euo pipefail
out=${1:?usage: perf/time_to_figure.sh OUT [threads] [CLATHRA]} threads=${2:-2}
root=$(cd "$(dirname "$0")/.." && pwd)
clathra=${3:-$root/build/release/drivers/clathra}
export OMP_NUM_THREADS=$threads
begin=$(date +%s.%N)
"$clathra" run "$root/examples/paper/s55-1mpa.toml" --output "$out" >"$out.log" 2>&1
python3 - "$out/run.json" "$begin" "$(date +%s.%N)" <<'EOF'
import json
import sys

run = json.load(open(sys.argv[1]))
wall, shear = run["wall_seconds"], run["stages"]["shear"]
print(f"{run['program']['git_hash']}: {float(sys.argv[3]) - float(sys.argv[2]):.0f} s, of them generation {wall['generate']:.0f} s, shear {wall['shear']:.0f} s; "
      f"{run['particle_steps']:.3g} particle-steps; peak q {shear['peak_q_Pa'] / 1e6:.3f} MPa at {100 * shear['peak_eps1']:.2f} %")
EOF
