"""The floor that chaos sets: tests of the campaign's base (base.toml) and the same with one disc moved by 1e-12 d50.

  chaos.py CLATHRA FOLDER CHAOS.csv     ten seeds of clean sand and of 55 % of hydrate, 40 tests; some minutes on two cores; needs h5py

CHAOS.csv has both numbers of each specimen. Printed: what a row of perf/reports/0.1/accuracy.md says, the mean size of the change and the largest one.
"""
import csv
import json
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py

from compare import QUANTITIES

SEEDS, MATERIALS, NUDGE = range(1, 11), {"sand": 0, "55 %": 0.55}, 1e-12
BASE = Path(__file__).with_name("base.toml")


def clathra(program, *words):
    subprocess.run([program, *map(str, words)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def nudged(specimen):
    """A copy of a specimen file with one disc in its middle moved to the right."""
    copy = specimen.with_name(specimen.stem + "-nudged.h5")
    shutil.copy(specimen, copy)
    with h5py.File(copy, "r+") as file:
        x = file["particles/x"]
        x[len(x) // 2] += NUDGE * file.attrs["d50"]
    return copy


def sheared(program, folder, specimen, material):
    """Numbers of a test, by column of the campaign's table."""
    out = folder / f"{specimen.stem}-{MATERIALS[material]}"
    if not (out / "run.json").exists():
        clathra(program, "run", BASE, "--set", f"specimen.file={specimen}", "--set",
                f"hydrate.saturation={MATERIALS[material]}", "--set", "run.threads=1", "--output", out)
    return json.loads((out / "run.json").read_text())["stages"]["shear"]


def both(program, folder, seed):
    specimen = folder.resolve() / f"seed{seed}.h5"
    if not specimen.exists():
        clathra(program, "generate", BASE, "--set", f"run.seed={seed}", "--set", "run.threads=1", "--output", specimen)
    pair = [specimen, nudged(specimen)]
    return [(material, seed, *(sheared(program, folder, s, material) for s in pair)) for material in MATERIALS]


def rows_of(tests):
    """material, quantity, seed, number, that of the nudged specimen; in the units of the campaign's tables."""
    for material, seed, plain, moved in tests:
        for column, (name, factor, _, _, _) in QUANTITIES.items():
            if column in plain and column in moved:
                yield material, name, seed, factor * plain[column], factor * moved[column]


def floor(rows, material, name):
    """Mean size and largest size of the changes [% of the number, or points where the campaign counts in points]."""
    kind = next(q[3] for q in QUANTITIES.values() if q[0] == name)
    sizes = [abs(b - a) * (100 / abs(a) if kind == "share" else 1) for m, n, _, a, b in rows if (m, n) == (material, name)]
    return (sum(sizes) / len(sizes), max(sizes)) if sizes else None


def main(program, folder, path):
    Path(folder).mkdir(parents=True, exist_ok=True)
    with ThreadPoolExecutor(2) as pool:
        rows = [row for tests in pool.map(lambda seed: list(rows_of(both(program, Path(folder), seed))), SEEDS) for row in tests]
    with open(path, "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["material", "quantity", "seed", "plain", "nudged"])
        table.writerows((m, n, s, f"{a:.6g}", f"{b:.6g}") for m, n, s, a, b in rows)
    for material in MATERIALS:
        for name, *_ in QUANTITIES.values():
            found = floor(rows, material, name)
            if found:
                print(f"| {material} | {name} | {found[0]:.2g} | {found[1]:.2g} |")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
