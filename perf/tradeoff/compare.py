"""The table of collect.py as tests that can be picked and compared, specimen by specimen."""
import csv
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from paired import mean_and_half_width, paired_difference  # noqa: E402

# Column, name, factor to the unit, unit of a value; whether a difference is a share of the reference [%] or in the unit; before or after the peak.
QUANTITIES = {
    "peak_q_Pa": ("peak q", 1e-6, "MPa", "share", "peak"),
    "peak_eps1": ("strain at peak", 100, "%", "share", "peak"),
    "secant_modulus_Pa": ("E50", 1e-6, "MPa", "share", "peak"),
    "largest_eps_v": ("largest contraction", 100, "%", "share", "peak"),
    "peak_bonds_intact_pct": ("intact at peak", 1, "%", "points", "peak"),
    "residual_q_Pa": ("residual q", 1e-6, "MPa", "share", "end"),
    "end_eps_v": ("volumetric strain at the end", 100, "%", "points", "end"),
    "end_bonds_intact_pct": ("intact at the end", 1, "%", "points", "end"),
}
BASE, REFERENCE, SLOWEST = ("base", "", 1e-4), ("dt_safety", "0.475", 1e-5), ("base", "", 2e-5)
TEXT = ("part", "factor", "level", "specimen", "precision")


def load(path):
    with open(path, newline="") as file:
        return [{key: value if key in TEXT else float(value) if value else None for key, value in row.items()} for row in csv.DictReader(file)]


class Tests:
    """All rows, by what they were run with."""

    def __init__(self, rows):
        self.groups = {}
        for row in rows:
            key = (row["saturation"], row["stress_Pa"], row["factor"], row["level"], row["inertial_number"])
            self.groups.setdefault(key, {})[row["specimen"]] = row

    def pick(self, saturation, setting, stress=1e6):
        """The tests of a setting (factor, level, inertial number), by specimen."""
        return self.groups.get((saturation, stress, *setting), {})

    def part(self, saturation, setting, stress=1e6):
        """The parts of the campaign that these tests belong to: names of study files."""
        return ", ".join(sorted({row["part"] for row in self.pick(saturation, setting, stress).values()}))

    def values(self, saturation, setting, quantity, stress=1e6):
        """A number of these tests by specimen, in its unit."""
        scale = QUANTITIES[quantity][1]
        whole = QUANTITIES[quantity][4] == "end"
        return {specimen: row[quantity] * scale for specimen, row in self.pick(saturation, setting, stress).items()
                if row[quantity] is not None and (not whole or row["end_eps1"] > 0.0999)}

    def settings(self, saturation, stress=1e6):
        return sorted({key[2:] for key in self.groups if key[:2] == (saturation, stress)}, key=lambda s: (s[0] != "base", s[0], s[1], -s[2]))

    def reference(self, saturation, quantity, stress=1e6):
        """The setting that `quantity` is measured against: what follows the peak has none slower than SLOWEST."""
        if QUANTITIES[quantity][4] == "peak" and len(self.values(saturation, REFERENCE, quantity, stress)) > 2:
            return REFERENCE
        return SLOWEST

    def change(self, saturation, setting, quantity, against=None, stress=1e6):
        """(difference, half of its interval, pairs) of a setting to another one or the reference, or None: % of that, or points of the unit."""
        against = against or self.reference(saturation, quantity, stress)
        found = paired_difference(self.values(saturation, against, quantity, stress), self.values(saturation, setting, quantity, stress))
        if found is None:
            return None
        mean, change, half, pairs = found
        if QUANTITIES[quantity][3] == "share":
            change, half = 100 * change / mean, 100 * half / abs(mean)
        return change, half, pairs

    def mean_of(self, saturation, setting, column, stress=1e6, whole=False):
        values = [row[column] for row in self.pick(saturation, setting, stress).values() if row[column] and (not whole or row["end_eps1"] > 0.0999)]
        return sum(values) / len(values) if values else math.nan

    def disc_steps(self, saturation, setting, stress=1e6):
        """Particle-steps of a test to 10 % axial strain, the mean over its specimens; of shorter tests those of the base, as their early ones compare."""
        whole = self.mean_of(saturation, setting, "disc_steps", stress, whole=True)
        if whole == whole:
            return whole
        return self.mean_of(saturation, BASE, "disc_steps", stress, whole=True) * self.steps_over(saturation, setting, BASE, stress)

    def steps_over(self, saturation, setting, other, stress=1e6):
        """Steps of a setting over those of another one, to the same strain."""
        return self.mean_of(saturation, setting, "early_disc_steps", stress) / self.mean_of(saturation, other, "early_disc_steps", stress)


def verdict(found, tolerance):
    """Whether a difference lies within +- tolerance, outside, or hangs on the seeds."""
    if found is None or not found[1] == found[1]:
        return "-"
    change, half, _ = found
    if abs(change) + half <= tolerance:
        return "within"
    return "outside" if abs(change) - half > tolerance else "open"


def strength(first, second, stresses):
    """Cohesion [MPa] and friction angle [deg] by specimen, of the line through the peaks of q [MPa] of two stresses [MPa]."""
    found = {}
    for specimen in first.keys() & second.keys():
        slope = 1 + (second[specimen] - first[specimen]) / (stresses[1] - stresses[0])
        cohesion = (first[specimen] - (slope - 1) * stresses[0]) / (2 * math.sqrt(slope))
        found[specimen] = cohesion, math.degrees(math.asin((slope - 1) / (slope + 1)))
    return found


def with_interval(found, digits=1):
    """`found` as a cell: difference +- half of its interval."""
    if found is None or found[1] != found[1]:
        return "-"
    return f"{found[0]:+.{digits}f} ± {found[1]:.{digits}f}"


def mean_cell(values):
    if len(values) < 2:
        return "-"
    mean, half = mean_and_half_width(list(values))
    return f"{mean:.4g} ± {half:.2g}"
