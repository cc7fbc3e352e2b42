"""A test in one picture: where bonds are lost, where the specimen sheared, and its curves of q and volumetric strain.

    python3 share/python/specimen_and_curve.py OUT -o test.png [--strain 0.05] [--beside OUT...]

Left: each disc by the share of its bonds that are lost, in the snapshot nearest to --strain (clean sand: the shear strain until then).
Middle: the shear strain until the last snapshot, from zero to five times what it would be were it the same everywhere.
Right: q and the volumetric strain, compression positive; --beside adds other runs in grey and makes the axes hold them all.
Needs the program clathra (see clathra.program), matplotlib, numpy, pandas and h5py.
"""
import argparse
import glob
import io
import os
import subprocess
import tempfile

import clathra
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pandas
from matplotlib.collections import PolyCollection
from matplotlib.colors import LinearSegmentedColormap, to_rgb
from matplotlib.ticker import MaxNLocator
from PIL import Image

LOST = LinearSegmentedColormap.from_list("lost", ["0.9", "#f0b890", "#d55e00", "#a03000"])
LINE, MARK = "#0072b2", "#d55e00"
SCALE = 5  # times the mean shear strain


class Moment:
    """What one snapshot says, in mm."""

    def __init__(self, snapshot):
        self.path = snapshot.path
        self.eps1, self.eps_v = snapshot.eps1, snapshot.eps_v
        self.walls = 1e3 * snapshot.walls
        discs = snapshot.particles
        self.position = 1e3 * discs["position"]
        self.diameter = 2e3 * discs["radius"]
        initial, intact = discs["bonds_initial"].astype(float), discs["bonds_intact"].astype(float)
        self.bonded = initial.max() > 0
        self.lost = np.where(initial > 0, 100 - 100 * intact / np.maximum(initial, 1), 0)

    def mean_shear(self):
        return 100 * (2 * self.eps1 - self.eps_v)

    def shear(self):
        """Shear strain of each disc [%], as the report shows it."""
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([clathra.program.program(), "export", self.path, "--to", "csv", "--output", folder], check=True, stdout=subprocess.DEVNULL)
            return 100 * pandas.read_csv(glob.glob(os.path.join(folder, "particles_*.csv"))[0])["shear_strain"].to_numpy()


def circles(position, diameter, corners):
    """The discs as polygons."""
    angle = np.arange(corners) * 2 * np.pi / corners
    return position[:, None, :] + diameter[:, None, None] / 2 * np.column_stack((np.cos(angle), np.sin(angle)))


def draw_discs(axis, moment, values, largest, colours, name):
    wider = 1.2 * moment.diameter  # the gaps between the discs say nothing here
    shapes = PolyCollection(circles(moment.position, wider, 10), array=values, cmap=colours, linewidths=0, antialiaseds=False)
    shapes.set_clim(0, largest)
    return axis.add_collection(shapes), name


def draw_shear(axis, moment):
    return draw_discs(axis, moment, moment.shear(), SCALE * moment.mean_shear(), "viridis", "shear strain [%]")


def draw_lost(axis, moment):
    return draw_discs(axis, moment, moment.lost, 100, LOST, "lost bonds of a disc [%]")


def draw_specimen(figure, left_edge, moment, draw):
    axis = figure.add_axes([left_edge, 0.165, 0.29, 0.77], anchor="S")
    image, what = draw(axis, moment)
    left, right, bottom, top = moment.walls
    axis.set(xlim=(left, right), ylim=(bottom, top), aspect="equal", xticks=[], yticks=[])
    axis.set_title(f"$\\varepsilon_1$ = {100 * moment.eps1:.3g} %", fontsize=10)
    figure.colorbar(image, cax=figure.add_axes([left_edge + 0.035, 0.125, 0.22, 0.025]), orientation="horizontal", label=what)


def draw_curves(q_axis, v_axis, folder, **style):
    history = clathra.open_run(folder).history
    strain = 100 * history["eps1"]
    q_axis.plot(strain, history["q_Pa"] / 1e6, **style)
    v_axis.plot(strain, 100 * history["eps_v"], **style)


def save(figure, output):
    """A .png with the colours of the maps, greys and the tints of the two lines, not one for each mixture at an edge."""
    if not output.endswith(".png"):
        figure.savefig(output)
        return
    colours = [(k / 11,) * 3 for k in range(12)] + [to_rgb(LOST(k / 5)) for k in range(6)]
    colours += [to_rgb(plt.get_cmap("viridis")(k / 15)) for k in range(16)]
    for line in (LINE, MARK):
        colours += [[share * part + 1 - share for part in to_rgb(line)] for share in (0.25, 0.5, 0.75, 1)]
    palette = Image.new("P", (1, 1))
    palette.putpalette([round(255 * part) for colour in colours for part in colour])
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    Image.open(buffer).convert("RGB").quantize(palette=palette, dither=0).save(output, optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="OUT")
    parser.add_argument("-o", "--output", default="test.png")
    parser.add_argument("--strain", type=float, default=0.05, help="axial strain of the picture on the left")
    parser.add_argument("--beside", nargs="*", default=[], metavar="OUT", help="other runs, in grey")
    options = parser.parse_args()
    run = clathra.open_run(options.folder)
    early, last = Moment(run.snapshot_at(options.strain)), Moment(run.snapshots[-1])
    figure = plt.figure(figsize=(8, 4.4), dpi=90)
    draw_specimen(figure, 0.01, early, draw_lost if early.bonded else draw_shear)
    draw_specimen(figure, 0.32, last, draw_shear)
    q_axis = figure.add_axes([0.68, 0.585, 0.305, 0.35])
    v_axis = figure.add_axes([0.68, 0.125, 0.305, 0.35], sharex=q_axis)
    for other in options.beside:
        draw_curves(q_axis, v_axis, other, color="0.75", linewidth=1)
    draw_curves(q_axis, v_axis, options.folder, color=LINE, linewidth=1.5)
    for axis in (q_axis, v_axis):
        axis.axvline(100 * early.eps1, color=MARK, linewidth=0.8, linestyle=":")
        axis.yaxis.set_major_locator(MaxNLocator(5, integer=True))
        axis.grid(color="0.93", linewidth=0.6)
    q_axis.set(ylabel="$q$ [MPa]", ylim=(0, None), xlim=(0, None))
    v_axis.set(ylabel=r"$\varepsilon_v$ [%]", xlabel=r"$\varepsilon_1$ [%]")
    sample, stress = run.label.split(", ")
    q_axis.set_title(f"{sample} hydrate, {stress}" if early.bonded else f"clean sand, {stress}", fontsize=10)
    save(figure, options.output)


if __name__ == "__main__":
    main()
