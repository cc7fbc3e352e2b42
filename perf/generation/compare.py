#!/usr/bin/env python3
"""What another way of generation does to specimens and to their tests: compare.py BEFORE AFTER

Both are results of study.toml, or of large.toml. Prints means and the difference of the means with its 95 % interval, in percent of the first; needs
python3-h5py and python3-numpy (Debian)."""
import csv
import math
import os
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from paired import mean_and_half_width  # noqa: E402
from specimens import Specimen  # noqa: E402

OF_TEST = ["peak_q_Pa", "peak_eps1", "secant_modulus_Pa", "largest_eps_v", "residual_q_Pa", "end_eps_v", "void_ratio_before_consolidation",
           "void_ratio_after_consolidation", "consolidated_unbalanced"]
OF_GENERATION = ["layer_void_ratio_sd", "unbalanced", "particle_steps", "generation_friction", "void_ratio", "stress_x_Pa", "stress_y_Pa"]


def of_specimen(path):
    s = Specimen(path)
    bands, contacts, stress = s.void_ratios_of_bands(), s.contacts_of_discs, s.stresses_of_bands()
    inner = slice(1, -1)
    numbers = {name: s.made[name] for name in OF_GENERATION}
    numbers |= {"height over width": s.made["height_m"] / s.made["width_m"], "sd of inner bands": bands[inner].std(),
                "topmost band": bands[-1], "bottommost band": bands[0],
                "upper less lower half": bands[len(bands) // 2:-1].mean() - bands[1:len(bands) // 2].mean(),
                "sd of vertical stress of inner bands": stress[1][inner].std() / stress[1][inner].mean(),
                "sd of lateral stress of inner bands": stress[0][inner].std() / stress[0][inner].mean(),
                "coordination": contacts.mean(), "discs in fewer than two contacts": (contacts < 2).mean(),
                "anisotropy of normals": np.mean(np.sin(s.direction) ** 2) - 0.5}
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
