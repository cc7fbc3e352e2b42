"""Nanoseconds a particle-step of the shear by material and precision, the least of the tests of a study: cost.py STUDY COST.csv"""
import csv
import json
import sys
from pathlib import Path


def main(study, path):
    found = {}
    for run in (json.loads(file.read_text()) for file in sorted(Path(study).glob("members/*/run.json"))):
        key = run["scene"]["hydrate"]["saturation"], run["scene"]["run"]["precision"]
        found.setdefault(key, []).append(1e9 / run["particle_steps_per_second"])
    with open(path, "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["saturation", "precision", "ns_per_disc_step", "tests"])
        for (saturation, precision), values in sorted(found.items()):
            table.writerow([f"{saturation:g}", precision, f"{min(values):.2f}", len(values)])


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
