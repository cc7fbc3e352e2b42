"""The bonds of one snapshot of a Clathra run as a map: intact ones grey, broken ones coloured by what broke them.

    python3 share/python/bonds.py OUT/snap/000000012345.h5 -o bonds.pdf

Needs matplotlib, pandas and h5py.
"""
import argparse

import clathra
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import LineCollection

STATES = {1: ("intact", "0.7", 0.3), 2: ("tension", "#009e73", 1), 3: ("compression", "#e69f00", 1), 4: ("shear", "#0072b2", 1),
          5: ("rolling", "#d55e00", 1), 6: ("dissolved", "#56b4e9", 1)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("snapshot")
    parser.add_argument("-o", "--output", default="bonds.pdf")
    options = parser.parse_args()
    snapshot = clathra.Snapshot(options.snapshot)
    position = 1e3 * snapshot.particles["position"]
    pair, state = snapshot.contacts["pair"], snapshot.contacts["state"]
    figure, axis = plt.subplots(figsize=(3.5, 7), constrained_layout=True)
    for value, (name, colour, width) in STATES.items():
        lines = position[pair[state == value]]
        if len(lines):
            axis.add_collection(LineCollection(lines, colors=colour, linewidths=width, label=f"{name} ({len(lines)})"))
    axis.autoscale()
    axis.set_aspect("equal")
    axis.set_xlabel("x [mm]")
    axis.set_ylabel("y [mm]")
    axis.set_title(f"$\\varepsilon_1$ = {100 * snapshot.eps1:.2f} %", fontsize=9)
    axis.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncol=2, frameon=False)
    figure.savefig(options.output)


main()
