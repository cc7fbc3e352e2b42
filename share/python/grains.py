"""A specimen file as a whole and magnified twice: the void ratio from place to place, and the grains.

    python3 share/python/grains.py specimen.h5 -o grains.png

Needs matplotlib, numpy, pandas and h5py.
"""
import argparse
import io

import clathra
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.patches import Rectangle
from PIL import Image
from specimen_and_curve import circles

CELL = 15  # mean diameters


def void_ratio(x, y, radius, left, right, bottom, top):
    """In square cells: the area of a disc goes to the cells around its centre by its bounding square's share in each."""
    size = CELL * 2 * radius.mean()
    cells = [max(2, int((right - left) / size)), max(2, int((top - bottom) / size))]
    solid = np.zeros(cells)
    step = [(right - left) / cells[0], (top - bottom) / cells[1]]
    parts = (np.arange(5) - 2) / 2.5
    for dx in parts:
        for dy in parts:
            at = [np.clip(((v - v0 + d * radius) / h).astype(int), 0, n - 1)
                  for v, v0, d, h, n in ((x, left, dx, step[0], cells[0]), (y, bottom, dy, step[1], cells[1]))]
            np.add.at(solid, tuple(at), np.pi * radius**2 / parts.size**2)
    return step[0] * step[1] / solid.T - 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("specimen")
    parser.add_argument("-o", "--output", default="grains.png")
    options = parser.parse_args()
    specimen = clathra.Specimen(options.specimen)
    x, y, radius = (1e3 * specimen.particles[name] for name in ("x", "y", "radius"))
    walls = 1e3 * specimen.walls
    left, right, bottom, top = walls
    figure = plt.figure(figsize=(8, 4.4), dpi=90)
    axes = [figure.add_axes([0.02 + 0.34 * k, 0.165, 0.29, 0.77], anchor="S") for k in range(3)]
    values = void_ratio(x, y, radius, *walls)
    least, most = np.percentile(values, (2, 98))
    image = axes[0].imshow(values, vmin=least, vmax=most, extent=walls, origin="lower", cmap="Blues_r", interpolation="nearest")
    figure.colorbar(image, cax=figure.add_axes([0.055, 0.125, 0.22, 0.025]), orientation="horizontal", label="void ratio")
    axes[0].set_title(f"{len(x):,} discs", fontsize=10)
    width, height, middle = right - left, top - bottom, ((left + right) / 2, (bottom + top) / 2)
    for before, axis in zip(axes, axes[1:]):
        width, height = width / 10, height / 10
        corner = (middle[0] - width / 2, middle[1] - height / 2)
        before.add_patch(Rectangle(corner, width, height, fill=False, edgecolor="#d55e00", linewidth=1.2, zorder=3))
        inside = (abs(x - middle[0]) < width / 2 + radius) & (abs(y - middle[1]) < height / 2 + radius)
        axis.add_collection(PolyCollection(circles(np.column_stack((x, y))[inside], 2 * radius[inside], 40), facecolors="#dccba8",
                                           edgecolors="#8a744a", linewidths=min(0.8, 0.9 / width)))
        axis.set(xlim=(corner[0], corner[0] + width), ylim=(corner[1], corner[1] + height))
        axis.set_title(f"{width:.3g} mm wide, {np.count_nonzero(inside):,} discs", fontsize=10)
    for axis in axes:
        axis.set(aspect="equal", xticks=[], yticks=[])
    if options.output.endswith(".png"):
        buffer = io.BytesIO()
        figure.savefig(buffer, format="png")
        Image.open(buffer).convert("RGB").quantize(32, method=1, dither=0).save(options.output, optimize=True)
    else:
        figure.savefig(options.output)


main()
