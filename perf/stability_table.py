#!/usr/bin/env python3
"""Puts what perf/stability_map and the tests of extremes measured into perf/reports/0.1/stability.md and its picture.

    stability_table.py MAP.csv EXTREMES.md FOLDER
"""
import csv
import sys
from pathlib import Path


def cases_of(path):
    """The rows of the map by (factor, level), in order."""
    cases = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file, delimiter=";"):
            cases.setdefault((row["factor"], row["level"]), []).append(row)
    return cases


def verdict(rows, share):
    for row in rows:
        if float(row["share"]) == share:
            if row["verdict"] == "bounded":
                return "bounded"
            return f"{float(row['growth']):.3f} ({float(row['predicted']):.3f})"
    return "-"


def map_table(cases):
    shares = sorted({float(row["share"]) for rows in cases.values() for row in rows})
    lines = [
        "| factor | level | exact limit [s] | bound / exact | Lanczos / exact | " + " | ".join(f"{s:g}" for s in shares) + " |",
        "|---|---|---|---|---|" + "---|" * len(shares),
    ]
    for (factor, level), rows in cases.items():
        first = rows[0]
        lanczos = float(first["lanczos_over_exact"])
        cells = [factor, level, f"{float(first['exact_limit_s']):.4g}", f"{float(first['bound_over_exact']):.4f}"]
        cells.append(f"{1 / lanczos:.4f}" if lanczos else "-")
        cells += [verdict(rows, share) for share in shares]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def draw(cases, path):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    names = [f"{factor}: {level}" for factor, level in cases]
    figure, axes = plt.subplots(figsize=(8, 0.28 * len(names) + 1.2))
    for y, rows in enumerate(cases.values()):
        for row in rows:
            share, stable = float(row["share"]), row["verdict"] == "bounded"
            axes.scatter(share, y, marker="o" if stable else "x", s=36, color="#1f77b4" if stable else "#d62728", zorder=3)
        bound = 1 / float(rows[0]["bound_over_exact"])
        axes.plot([bound, bound], [y - 0.4, y + 0.4], color="black", linewidth=2, zorder=2)
    axes.axvline(1, color="grey", linewidth=1)
    axes.set_yticks(range(len(names)), names, fontsize=8)
    axes.invert_yaxis()
    axes.set_xlabel("time step over the exact limit (o bounded, x diverges, | the program's bound)")
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def put(text, mark, table):
    begin, end = f"<!-- {mark}: made by perf/stability.sh -->", f"<!-- end of {mark} -->"
    before, rest = text.split(begin)
    return before + begin + "\n\n" + table + "\n\n" + end + rest.split(end)[1]


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    cases, folder = cases_of(sys.argv[1]), Path(sys.argv[3])
    extremes = "| tried | came out | had to |\n|---|---|---|\n" + Path(sys.argv[2]).read_text().strip()
    page = folder / "stability.md"
    page.write_text(put(put(page.read_text(), "map", map_table(cases)), "extremes", extremes))
    draw(cases, folder / "pictures" / "stability.png")


main()
