"""Paired differences, mixed less double, of the numbers of a study: table.py study.csv"""
import csv
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from paired import mean_and_half_width, paired_difference  # noqa: E402

QUANTITIES = [
    ("peak_q_Pa", "peak q", 1e-6, "MPa"),
    ("peak_eps1", "strain at peak", 100, "%"),
    ("secant_modulus_Pa", "E50", 1e-6, "MPa"),
    ("residual_q_Pa", "residual q", 1e-6, "MPa"),
    ("largest_eps_v", "largest contraction", 100, "%"),
    ("end_eps_v", "volumetric strain at the end", 100, "%"),
    ("peak_bonds_intact_pct", "bonds intact at the peak", 1, "%"),
    ("end_bonds_intact_pct", "bonds intact at the end", 1, "%"),
]


def main(path):
    with open(path, newline="") as file:
        rows = [r for r in csv.DictReader(file) if r["row"] == "member" and r["state"] == "finished"]
    columns = rows[0].keys()
    tests = {}
    for r in rows:
        tests.setdefault((r["hydrate.saturation"], r["seed"]), {})[r["run.precision"]] = r
    print("| saturation | quantity | double | mixed less double (paired, 95 %) | of double | seeds |")
    print("|---|---|---|---|---|---|")
    for saturation in sorted({s for s, _ in tests}):
        pairs = [p for (s, _), p in tests.items() if s == saturation and len(p) == 2]
        for column, name, factor, unit in QUANTITIES:
            if column not in columns:
                continue
            double, mixed = ({p["double"]["seed"]: float(p[precision][column]) * factor for p in pairs if p["double"][column] and p["mixed"][column]}
                             for precision in ("double", "mixed"))
            if not double:
                continue
            spread = mean_and_half_width(list(double.values()))[1]
            mean, change, half, count = paired_difference(double, mixed)
            share = f"{100 * change / mean:+.2f} +- {100 * half / abs(mean):.2f} %" if mean else ""
            print(f"| {saturation} | {name} [{unit}] | {mean:.4g} +- {spread:.2g} | {change:+.3g} +- {half:.2g} | {share} | {count} |")


if __name__ == "__main__":
    main(sys.argv[1])
