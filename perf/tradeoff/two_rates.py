#!/usr/bin/env python3
"""What a rate that follows the state of a test could save at most, from what fixed rates did: two_rates.py DATA.csv FOLDER

Every error that was measured behind half of the peak grows with the rate. So a test whose errors shall be those of a fixed rate
may be faster before half of the peak only, up to the fastest rate that leaves E50 alone. Writes a table into accuracy.md and a picture.
"""
import sys
from pathlib import Path

import picture
from compare import BASE, Tests, load
from paired import mean_and_half_width
from table import NAMES, SAND, BONDED, markdown, put

FIXED = 2e-4  # the rate whose errors a test shall have
LEAST_GAIN = 1.5  # below which a controller is not worth its own faults
STRAINS = [0.02 + 0.0025 * n for n in range(53)]


def mean_over(tests, saturation, setting, quantity):
    return mean_and_half_width(list(tests.values(saturation, setting, quantity).values()))[0]


def half_peak_strain(tests, saturation, setting):
    """Where q is half of its peak: E50 is the secant to there."""
    return mean_over(tests, saturation, setting, "peak_q_Pa") / 2 / mean_over(tests, saturation, setting, "secant_modulus_Pa")


def plain(rate):
    """Own masses, usual step, double precision, at a rate."""
    return (*BASE[:2], rate)


def fastest_rise(tests, saturation, within=1.0):
    """The fastest measured rate at which E50 is the same within so many percent."""
    rates = sorted({s[2] for s in tests.settings(saturation) if s[:2] == BASE[:2] and s[2] > FIXED})
    changes = {rate: tests.change(saturation, plain(rate), "secant_modulus_Pa", plain(FIXED)) for rate in rates}
    return max((rate for rate, of in changes.items() if of and abs(of[0]) + of[1] <= within), default=FIXED)


def largest_gain(half, rise, strain):
    """Cost of a test at FIXED over that of one at `rise` up to the strain `half`."""
    fast = min(half, strain)
    return strain / (strain - fast + fast * FIXED / rise)


def table(tests):
    rows = []
    for saturation in (SAND, BONDED):
        half, rise = half_peak_strain(tests, saturation, plain(FIXED)), fastest_rise(tests, saturation)
        peak = mean_over(tests, saturation, plain(FIXED), "peak_eps1") / 100
        behind = [tests.change(saturation, plain(1e-3), q, plain(FIXED)) for q in ("peak_q_Pa", "largest_eps_v", "residual_q_Pa", "end_bonds_intact_pct")]
        words = [f"{of[0]:+.1f} ± {of[1]:.1f}" if of and any(of[:2]) else "-" for of in behind]
        gains = [f"{largest_gain(half, rise, strain):.2f}" for strain in (peak, 0.1, 0.15)]
        rows.append([NAMES[saturation], *words, f"{100 * half:.2f}", f"{100 * peak:.2f}", f"{rise:g}", *gains])
    return markdown(["material", "peak q [%]", "largest contraction [%]", "residual q [%]", "intact at the end [points]", "half of the peak at [%]", "peak at [%]",
                     "rate of the rise", "gain to the peak", "to 10 %", "to 15 %"], rows)


def draw(tests, path):
    x, y = picture.Axis(0.02, 0.15, picture.LEFT, picture.WIDTH - picture.RIGHT), picture.Axis(1, 2, picture.HEIGHT - picture.BOTTOM, picture.TOP)
    panels = []
    for saturation, colour in ((SAND, picture.COLOURS[0]), (BONDED, picture.COLOURS[1])):
        half, rise = half_peak_strain(tests, saturation, plain(FIXED)), fastest_rise(tests, saturation)
        parts = picture.frame(x, y, f"{NAMES[saturation]}: fast up to half of the peak", "axial strain at the end of the test", "largest gain in cost")
        points = " ".join(f"{x.at(strain):.1f},{y.at(largest_gain(half, rise, strain)):.1f}" for strain in STRAINS)
        parts.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.6"/>')
        parts.append(f'<path d="M{picture.LEFT} {y.at(LEAST_GAIN):.1f}H{picture.WIDTH - picture.RIGHT}" stroke="black" stroke-dasharray="5 4"/>')
        panels.append(parts)
    picture.draw(path, panels, [NAMES[SAND], NAMES[BONDED]])


def main(data, folder):
    tests, page = Tests(load(data)), folder / "accuracy.md"
    page.write_text(put(page.read_text(), "two rates", table(tests), "two_rates.py"))
    draw(tests, folder / "pictures" / "two-rates.svg")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], Path(sys.argv[2]))
