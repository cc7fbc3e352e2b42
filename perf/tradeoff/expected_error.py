#!/usr/bin/env python3
"""Prints the tables of drivers/expected_error.cpp: expected_error.py DATA.csv

Errors of the peak of q, paired specimen by specimen with the reference (perf/reports/0.1/accuracy.md), with Student's intervals."""
import sys

from compare import REFERENCE, Tests, load

SAND, BONDED = 0.0, 0.55
PEAK = "peak_q_Pa"


def effect(found):
    return "{%.4f, %.4f}" % (found[0] / 100, found[1] / 100)


def print_rates(title, tests, factor, level, against):
    print(title)
    rates = sorted({s[2] for s in tests.settings(BONDED) if s[:2] == (factor, level)})
    for rate in rates:
        found = [tests.change(material, (factor, level, rate), PEAK, against(rate)) for material in (SAND, BONDED)]
        if None not in found:
            print("    {%g, %s, %s},  // %d and %d specimens" % (rate, effect(found[0]), effect(found[1]), found[0][2], found[1][2]))


def main(path):
    tests = Tests(load(path))
    print_rates("rates", tests, "base", "", lambda _: REFERENCE)
    print_rates("heavier_rotation", tests, "inertia_scaling", "3", lambda rate: ("base", "", rate))
    print_rates("mixed", tests, "precision", "mixed", lambda rate: ("base", "", rate))
    print_rates("mixed with heavier_rotation", tests, "precision+inertia_scaling", "mixed+3", lambda rate: ("inertia_scaling", "3", rate))


if __name__ == "__main__":
    main(sys.argv[1])
