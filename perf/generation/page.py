#!/usr/bin/env python3
"""A page of pictures of specimens of two ways of generation: page.py BEFORE AFTER PICTURE [NAME NAME]

BEFORE and AFTER are results of large.toml. Needs python3-h5py, python3-matplotlib and python3-numpy (Debian)."""
import csv
import sys
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.collections import EllipseCollection  # noqa: E402
from specimens import BANDS, Specimen  # noqa: E402

COLOURS = ["#0072b2", "#d55e00"]


def draw_discs(axes, s, name):
    """The specimen, discs coloured by their contacts."""
    discs = EllipseCollection(2 * s.radius, 2 * s.radius, 0, units="xy", offsets=np.column_stack([s.x, s.y]), transOffset=axes.transData,
                              array=np.minimum(s.contacts_of_discs, 6), cmap="viridis", linewidths=0)
    axes.add_collection(discs)
    axes.set(xlim=(s.left, s.right), ylim=(s.bottom, s.top), aspect="equal", xticks=[], yticks=[], title=name)
    return discs


def draw_band(axes, colour, name, place, values):
    """Mean over specimens with its 95 % interval."""
    mean, half = values.mean(0), 2.09 * values.std(0, ddof=1) / np.sqrt(len(values))
    axes.fill_betweenx(place, mean - half, mean + half, color=colour, alpha=0.3, linewidth=0)
    axes.plot(mean, place, color=colour, label=name)


def curves(folder):
    """Axial strain [%] and q [MPa] of all members."""
    rows = []
    for path in sorted((folder / "members").glob("*/history.csv")):
        with open(path, newline="") as file:
            table = list(csv.DictReader(line for line in file if not line.startswith("#")))
        table = [row for row in table if row.get("stage", "shear") == "shear"]
        rows.append([[100 * float(row["eps1"]), float(row["q_Pa"]) / 1e6] for row in table])
    shortest = min(map(len, rows))
    return np.array([row[:shortest] for row in rows])


def main(before, after, picture, *names):
    names = names or ("under-compaction", "compression")
    figure = plt.figure(figsize=(13, 13), layout="constrained")
    grid = figure.add_gridspec(3, 4)
    tops = [figure.add_subplot(grid[:2, 2 * n:2 * n + 2]) for n in range(2)]
    void, stress, radial, curve = (figure.add_subplot(grid[2, n]) for n in range(4))
    for axes, folder, name, colour in zip(tops, map(Path, (before, after)), names, COLOURS):
        specimens = [Specimen(path) for path in sorted((folder / "specimens").glob("*.h5"))]
        discs = draw_discs(axes, specimens[0], f"{name}, the first of {len(specimens)}")
        place = (np.arange(BANDS) + 0.5) / BANDS
        draw_band(void, colour, name, place, np.array([s.void_ratios_of_bands() for s in specimens]))
        both = np.array([s.stresses_of_bands() for s in specimens]) / 1e3
        draw_band(stress, colour, f"{name}, vertical", place, both[:, 1])
        draw_band(stress, matplotlib.colors.to_rgba(colour, 0.6), "lateral", place, both[:, 0])
        bins = np.linspace(0, 5, 101)
        radial.plot((bins[1:] + bins[:-1]) / 2, np.mean([s.radial_distribution(bins) for s in specimens[:5]], 0), color=colour, label=name)
        test = curves(folder)
        mean, half = test[:, :, 1].mean(0), 2.09 * test[:, :, 1].std(0, ddof=1) / np.sqrt(len(test))
        curve.fill_between(test[0, :, 0], mean - half, mean + half, color=colour, alpha=0.3, linewidth=0)
        curve.plot(test[0, :, 0], mean, color=colour, label=name)
    figure.colorbar(discs, ax=tops, location="bottom", shrink=0.3, label="contacts of a disc (6: and more)")
    void.set(xlabel="void ratio of a band", ylabel="height over that of the specimen")
    stress.set(xlabel="stress of discs on discs, by bands [kPa]")
    radial.set(xlabel="distance / d50", ylabel="pairs over those at random", xlim=(0, 5))
    curve.set(xlabel="axial strain [%]", ylabel="q [MPa]")
    for axes in (void, stress, radial, curve):
        axes.legend(fontsize=7)
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:])
