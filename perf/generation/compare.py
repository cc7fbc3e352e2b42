#!/usr/bin/env python3
"""What another way of generation does to specimens and to their tests: compare.py BEFORE AFTER

Both are results of study.toml. Prints means and the difference of the means with its 95 % interval, in percent of the first; needs
python3-h5py and python3-numpy (Debian)."""
import csv
import json
import math
import os
import sys
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from paired import mean_and_half_width  # noqa: E402

OF_TEST = ["peak_q_Pa", "peak_eps1", "secant_modulus_Pa", "largest_eps_v", "residual_q_Pa", "end_eps_v", "void_ratio_before_consolidation",
           "void_ratio_after_consolidation", "consolidated_unbalanced"]
OF_GENERATION = ["layer_void_ratio_sd", "unbalanced", "disc_steps", "generation_friction", "void_ratio"]
BANDS = 20


def void_ratios_of_bands(y, radius, bottom, height, width):
    edges = bottom + np.linspace(0, height, BANDS + 1)

    def area_below(edge):
        s = np.clip((edge - y) / radius, -1, 1)
        return (radius**2 * (np.arccos(-s) + s * np.sqrt(1 - s * s))).sum()

    return height / BANDS * width / np.diff([area_below(edge) for edge in edges]) - 1


def of_specimen(path):
    with h5py.File(path) as file:
        made = json.loads(bytes(file["provenance"][()]).decode())["generate"]
        x, y, radius = (file["particles"][name][()] for name in ("x", "y", "radius"))
        bottom = file.attrs["bottom"]
    bands = void_ratios_of_bands(y, radius, bottom, made["height_m"], made["width_m"])
    first, second = np.nonzero(np.triu(np.hypot(x[:, None] - x, y[:, None] - y) < radius[:, None] + radius, 1))
    contacts = np.bincount(np.concatenate([first, second]), minlength=len(x))
    turn = np.arctan2(y[first] - y[second], x[first] - x[second])
    numbers = {name: made[name] for name in OF_GENERATION}
    numbers |= {"height over width": made["height_m"] / made["width_m"], "sd of inner bands": bands[1:-1].std(), "topmost band": bands[-1],
                "bottommost band": bands[0], "upper less lower half": bands[BANDS // 2:-1].mean() - bands[1:BANDS // 2].mean(),
                "coordination": contacts.mean(), "discs in fewer than two contacts": (contacts < 2).mean(),
                "anisotropy of normals": np.mean(np.sin(turn) ** 2) - 0.5}
    return numbers


def numbers_of(folder):
    """{number: [values]} of all finished members and their specimens."""
    with open(folder / "study.csv", newline="") as file:
        tests = [row for row in csv.DictReader(file) if row["row"] == "member" and row["state"] == "finished"]
    values = {name: [float(test[name]) for test in tests] for name in OF_TEST}
    for path in sorted((folder / "specimens").glob("*.h5")):
        for name, value in of_specimen(path).items():
            values.setdefault(name, []).append(value)
    return values


def main(before, after):
    first, second = numbers_of(Path(before)), numbers_of(Path(after))
    for name in first:
        (a, half_a), (b, half_b) = mean_and_half_width(first[name]), mean_and_half_width(second[name])
        half = math.hypot(half_a, half_b)
        mark = " *" if abs(b - a) > half else ""
        print(f"{name:34s} {a:11.5g} {b:11.5g}   {100 * (b / a - 1):+.2f} +- {100 * half / abs(a):.2f} %{mark}")


if __name__ == "__main__":
    main(*sys.argv[1:])
