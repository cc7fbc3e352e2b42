"""Curves of Clathra runs for a publication: q, volumetric strain and intact bonds against axial strain.

    python3 share/python/curves.py OUT... -o curves.pdf

Needs matplotlib, pandas and h5py. Compression is positive.
"""
import argparse

import clathra
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("-o", "--output", default="curves.pdf")
    options = parser.parse_args()
    figure, axes = plt.subplots(3, 1, figsize=(3.5, 7), sharex=True, constrained_layout=True)
    styles = ["-", "--", "-.", ":"]
    for k, folder in enumerate(options.folders):
        run = clathra.open_run(folder)
        history = run.history
        strain = 100 * history["eps1"]
        style = {"linestyle": styles[k % len(styles)], "color": f"C{k % 10}", "linewidth": 1}
        axes[0].plot(strain, history["q_Pa"] / 1e6, label=run.label, **style)
        axes[1].plot(strain, 100 * history["eps_v"], **style)
        if history["bonds_intact"][0] > 0:
            axes[2].plot(strain, history["bonds_intact_pct"], **style)
    axes[0].set_ylabel(r"$q$ [MPa]")
    axes[1].set_ylabel(r"$\varepsilon_v$ [%], compression > 0")
    axes[2].set_ylabel("intact bonds [%]")
    axes[2].set_xlabel(r"$\varepsilon_1$ [%]")
    axes[0].legend(frameon=False, fontsize=8, title="saturation, $\\sigma_3$", title_fontsize=8)
    figure.savefig(options.output)


if __name__ == "__main__":
    main()
