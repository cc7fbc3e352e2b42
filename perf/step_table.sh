#!/usr/bin/env bash
# The table of perf/machines/<machine>-steps.md: step_bench on packings of 20,000, 200,000, 1,000,000 and 5,000,000 discs with 1 and 2
# threads, in double and mixed precision side by side.
#   perf/step_table.sh [DISCS ...]        about 80 minutes on 2 free cores and 8 GiB; standard output is the table
set -euo pipefail
bench="$(dirname "${BASH_SOURCE[0]}")/../build/release/perf/step_bench"
sizes=("$@")
[ ${#sizes[@]} -gt 0 ] || sizes=(20000 200000 1000000 5000000)

echo "| case | precision | discs | threads | M particle-steps/s | M contact-steps/s | neighbour search | bytes a disc | of the bandwidth | of the arithmetic | contact kernel | drift |"
echo "|---|---|---|---|---|---|---|---|---|---|---|---|"
for discs in "${sizes[@]}"; do
  # A large packing takes long to come to rest and shows little of it.
  if ((discs > 500000)); then how=(--relax 500 --repeat 1); else how=(--repeat 3); fi
  for case in rolling bonded breaking; do
    [ "$case" != breaking ] || ((discs <= 500000)) || continue # thousands of steps until their bonds break
    for threads in 1 2; do for precision in double mixed; do
      OMP_NUM_THREADS=$threads OMP_PROC_BIND=false "$bench" --case $case --precision $precision --discs "$discs" --seconds 3 "${how[@]}" |
        awk -F, -v precision=$precision '
          $1 == "rolling" || $1 == "bonded" || $1 == "breaking" { n++; rate[n] = $6; row[n] = $0 }
          $1 ~ /^contact_forces/ { contact = $2 " ns" }
          $1 == "kick_and_drift" { drift = $2 " ns" }
          END {
            middle = 1
            for (k = 1; k <= n; k++) {
              below = 0
              for (m = 1; m <= n; m++) if (rate[m] < rate[k] || (rate[m] == rate[k] && m < k)) below++
              if (below == int(n / 2)) middle = k
            }
            split(row[middle], f, ",")
            printf "| %s | %s | %d | %d | %.1f | %.1f | %.1f %% | %d | %.0f %% | %.0f %% | %s | %s |\n", f[1], precision, f[2], f[4], f[6] / 1e6,
                   f[8] / 1e6, 100 * f[11], f[12], 100 * f[14], 100 * f[15], contact, drift
          }'
    done; done
  done
done
