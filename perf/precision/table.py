"""Paired differences, mixed less double, of the numbers of a study: table.py study.csv"""
import csv
import math
import sys

QUANTITIES = [
    ("peak_q_Pa", "peak q", 1e-6, "MPa"),
    ("peak_eps1", "strain at peak", 100, "%"),
    ("secant_modulus_Pa", "E50", 1e-6, "MPa"),
    ("residual_q_Pa", "residual q", 1e-6, "MPa"),
    ("largest_eps_v", "largest contraction", 100, "%"),
    ("end_eps_v", "volumetric strain at the end", 100, "%"),
    ("peak_intact_initial_pct", "bonds intact at the peak", 1, "%"),
    ("end_intact_initial_pct", "bonds intact at the end", 1, "%"),
]
# Student's t at 97.5 % for 1 .. 30 degrees of freedom.
T = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086,
     2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042]


def mean_and_half_width(values):
    n = len(values)
    mean = sum(values) / n
    if n < 2:
        return mean, float("nan")
    deviation = math.sqrt(sum((v - mean) ** 2 for v in values) / (n - 1))
    return mean, T[min(n - 2, 29)] * deviation / math.sqrt(n)


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
            both = [(float(p["double"][column]), float(p["mixed"][column])) for p in pairs if p["double"][column] and p["mixed"][column]]
            if not both:
                continue
            mean, spread = mean_and_half_width([d * factor for d, _ in both])
            change, half = mean_and_half_width([(m - d) * factor for d, m in both])
            share = f"{100 * change / mean:+.2f} +- {100 * half / abs(mean):.2f} %" if mean else ""
            print(f"| {saturation} | {name} [{unit}] | {mean:.4g} +- {spread:.2g} | {change:+.3g} +- {half:.2g} | {share} | {len(both)} |")


if __name__ == "__main__":
    main(sys.argv[1])
