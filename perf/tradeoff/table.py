#!/usr/bin/env python3
"""Makes the tables of perf/reports/0.1/accuracy.md and its picture: table.py DATA.csv COST.csv FOLDER

DATA.csv is what collect.py makes, COST.csv the nanoseconds a particle-step of each precision and material (cost.sh).
"""
import csv
import math
import sys
from pathlib import Path

import picture
from compare import BASE, QUANTITIES, REFERENCE, SLOWEST, Tests, load, mean_cell, strength, verdict, with_interval
from paired import deviation, mean_and_half_width, paired_difference

SAND, BONDED = 0.0, 0.55
NAMES = {SAND: "sand", BONDED: "55 %"}
OTHER_SPECIMENS = ("discs", "aspect_ratio", "kn_Pa")  # factors that change what is tested, not how
FACTORS = {"base": "base", "precision": "precision", "dt_safety": "dt_safety", "inertia_scaling": "inertia x", "mass_scaling": "mass",
           "damping": "damping", "contact_damping": "dashpots", "skin_m": "skin [m]", "discs": "discs", "aspect_ratio": "height / width",
           "kn_Pa": "k_n [Pa]"}
PLAIN, CHAOS = ("base", "", 2e-4), ("skin_m", "1.3552e-05", 2e-4)  # tests that differ by rounding only
BEFORE = [q for q, about in QUANTITIES.items() if about[4] == "peak"]
BEFORE_HEADINGS = [f"{QUANTITIES[q][0]} [{'points' if QUANTITIES[q][3] == 'points' else '%'}]" for q in BEFORE]
AFTER = [q for q, about in QUANTITIES.items() if about[4] == "end"]


def name_of(setting):
    """A setting in words: what differs from the base."""
    return ", ".join(" ".join(filter(None, pair)) for pair in zip((FACTORS[f] for f in setting[0].split("+")), setting[1].split("+")))


def markdown(head, rows):
    if not rows:
        return "Not run."
    return "\n".join(["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + ["| " + " | ".join(row) + " |" for row in rows])


class Cost:
    """Seconds of one core that a test takes: its particle-steps times what one takes on a quiet machine."""

    def __init__(self, path):
        with open(path, newline="") as file:
            self.nanoseconds = {(float(r["saturation"]), r["precision"]): float(r["ns_per_disc_step"]) for r in csv.DictReader(file)}

    def seconds(self, tests, saturation, setting, stress=1e6):
        precision = "mixed" if "mixed" in setting[1] else "double"
        return tests.disc_steps(saturation, setting, stress) * self.nanoseconds[saturation, precision] * 1e-9


def trade_settings(tests, saturation):
    return [s for s in tests.settings(saturation) if not set(s[0].split("+")) & set(OTHER_SPECIMENS)]


def references(tests, _):
    """What the reference and the base give, what seeds scatter, and what chaos does to a single test."""
    rows = []
    for saturation in (SAND, BONDED):
        for quantity, (name, _, unit, _, _) in QUANTITIES.items():
            if saturation == SAND and "intact" in name:
                continue
            reference = tests.values(saturation, tests.reference(saturation, quantity), quantity)
            base, again = (tests.values(saturation, s, quantity) for s in (BASE, CHAOS))
            plain = tests.values(saturation, PLAIN, quantity)
            spread = [again[k] - plain[k] for k in again.keys() & plain.keys()]
            where = "" if tests.reference(saturation, quantity) == REFERENCE else " (I = 2e-5)"
            rows.append([NAMES[saturation], f"{name} [{unit}]", mean_cell(reference.values()) + where, mean_cell(base.values()),
                         f"{deviation(list(base.values())):.2g}", f"{deviation(spread) / math.sqrt(2):.2g}" if len(spread) > 1 else "-"])
    return markdown(["material", "number", "reference", "base, I = 1e-4", "scatter of seeds", "scatter of chaos"], rows)


def trade(saturation):
    """Every setting against the reference: the numbers before the peak."""

    def table(tests, cost):
        quantities = [q for q in BEFORE if saturation or "intact" not in q]
        base = cost.seconds(tests, saturation, BASE)
        rows = []
        for setting in trade_settings(tests, saturation):
            if setting == REFERENCE:
                continue
            seconds = cost.seconds(tests, saturation, setting)
            found = tests.change(saturation, setting, "peak_q_Pa")
            rows.append([name_of(setting), f"{setting[2]:g}"] + [with_interval(tests.change(saturation, setting, q)) for q in quantities] +
                        [verdict(found, 2), f"{seconds:.2f}", f"{base / seconds:.3g}", str(found[2]) if found else "-", tests.part(saturation, setting)])
        units = ["points" if QUANTITIES[q][3] == "points" else "%" for q in quantities]
        head = ["setting", "I"] + [f"{QUANTITIES[q][0]} [{u}]" for q, u in zip(quantities, units)]
        return markdown(head + ["peak q within 2 %?", "core s", "speed", "seeds", "part"], rows)

    return table


def after(tests, _):
    """The numbers after the peak."""
    rows = []
    for saturation in (SAND, BONDED):
        quantities = [q for q in AFTER if saturation or "intact" not in q]
        for setting in trade_settings(tests, saturation):
            cells = [with_interval(tests.change(saturation, setting, q)) for q in quantities]
            if setting != SLOWEST and any(cell != "-" for cell in cells):
                rows.append([NAMES[saturation], name_of(setting), f"{setting[2]:g}"] + cells + ["-"] * (len(AFTER) - len(cells)) + [tests.part(saturation, setting)])
    return markdown(["material", "setting", "I", "residual q [%]", "volumetric strain at the end [points]", "intact at the end [points]", "part"], rows)


def option_at_equal_rate(factor):
    """What an option does beside the value of the base at the same inertial number, on the same specimens."""

    def table(tests, _):
        rows = []
        for saturation in (SAND, BONDED):
            for setting in trade_settings(tests, saturation):
                plain = ("base", "", setting[2])
                if not setting[0].startswith(factor) or not tests.pick(saturation, plain):
                    continue
                cells = [with_interval(tests.change(saturation, setting, q, plain), 2) if saturation or "intact" not in q else "-" for q in BEFORE]
                ratio = 1 / tests.steps_over(saturation, setting, plain)
                found = tests.change(saturation, setting, "peak_q_Pa", plain)
                if found:
                    rows.append([NAMES[saturation], name_of(setting), f"{setting[2]:g}"] + cells + [f"{ratio:.2f}", str(found[2]), tests.part(saturation, setting)])
        units = ["points" if QUANTITIES[q][3] == "points" else "%" for q in BEFORE]
        return markdown(["material", "option", "I"] + [f"{QUANTITIES[q][0]} [{u}]" for q, u in zip(BEFORE, units)] + ["steps saved", "seeds", "part"], rows)

    return table


def energy(tests, _):
    """Peaks by what takes up energy and by rate, with the shares of the walls' work until the peak."""
    rows = []
    for saturation in (SAND, BONDED):
        for setting in trade_settings(tests, saturation):
            known = [r for r in tests.pick(saturation, setting).values() if r["damping_share"] is not None]
            if setting[0] not in ("base", "damping", "damping+contact_damping") or not known:
                continue
            shares = [f"{100 * sum(r[f'{name}_share'] for r in known) / len(known):.2g}" for name in
                      ("damping", "dashpot", "breakage", "sliding", "rolling")]
            kinetic = max(r["kinetic_share"] for r in known)
            rows.append([NAMES[saturation], name_of(setting), f"{setting[2]:g}", mean_cell(tests.values(saturation, setting, "peak_q_Pa").values()),
                         mean_cell(tests.values(saturation, setting, "peak_eps1").values())] + shares + [f"{100 * kinetic:.2g}", tests.part(saturation, setting)])
    head = ["damping", "dashpots", "breakage", "sliding", "rolling"]
    return markdown(["material", "setting", "I", "peak q [MPa]", "strain at peak [%]"] + [f"{h} [%]" for h in head] + ["kinetic [%], most", "part"], rows)


def waves(tests, _):
    """Rate beside wave number: specimens of other sizes and heights, each against its own slowest test of the campaign."""
    rows = []
    kinds = [("base", ""), ("discs", "500"), ("discs", "5000"), ("discs", "20000"), ("aspect_ratio", "1"), ("aspect_ratio", "4")]
    for kind in kinds:
        slow = (*kind, 1e-4)
        for setting in [s for s in tests.settings(BONDED) if s[:2] == kind and s[2] >= 1e-4]:
            picked = tests.pick(BONDED, setting)
            wave = sum(r["platen_wave_stress"] for r in picked.values()) / len(picked)
            inner = [{k: r[c] for k, r in picked.items()} for c in ("contact_peak_q_Pa", "contact_q_at_peak_Pa", "peak_q_Pa")]
            slow_inner = {k: r["contact_peak_q_Pa"] for k, r in tests.pick(BONDED, slow).items()}
            found = paired_difference(slow_inner, inner[0])
            contact = found and (100 * found[1] / found[0], 100 * found[2] / found[0], found[3])
            lead = [100 * (inner[2][k] / inner[1][k] - 1) for k in picked]
            rows.append([name_of(setting[:2] + (0,)).replace("base", "2,000 discs, 2"), f"{setting[2]:g}", f"{wave:.2g}",
                         mean_cell(tests.values(BONDED, setting, "peak_q_Pa").values()), with_interval(tests.change(BONDED, setting, "peak_q_Pa", slow)),
                         with_interval(contact), f"{sum(lead) / len(lead):+.2f}", with_interval(tests.change(BONDED, setting, "peak_eps1", slow)),
                         with_interval(tests.change(BONDED, setting, "peak_bonds_intact_pct", slow)), str(len(picked)), tests.part(BONDED, setting)])
    return markdown(["specimen", "I", "W", "peak q [MPa]", "its change [%]", "that by the contacts [%]", "walls over contacts at the peak [%]",
                     "strain at peak [%]", "intact at peak [points]", "seeds", "part"], rows)


def angles(tests, _):
    """Cohesion and friction angle from 1 and 3 MPa."""
    rows = []
    for saturation in (SAND, BONDED):
        slow = None
        for setting in reversed(sorted(trade_settings(tests, saturation), key=lambda s: (s[2], s[0] == "base"), reverse=True)):
            found = strength(*(tests.values(saturation, setting, "peak_q_Pa", stress) for stress in (1e6, 3e6)), (1, 3))
            if not found:
                continue
            slow = slow or {k: v[1] for k, v in found.items()}
            change = paired_difference(slow, {k: v[1] for k, v in found.items()})
            rows.append([NAMES[saturation], name_of(setting), f"{setting[2]:g}", mean_cell([v[1] for v in found.values()]),
                         mean_cell([v[0] for v in found.values()]), with_interval(change and (change[1], change[2], change[3])), str(len(found)), tests.part(saturation, setting, 3e6)])
    return markdown(["material", "setting", "I", "φ [deg]", "c [MPa]", "φ less that of the slowest [deg]", "seeds", "part"], rows)


def stiffness(tests, _):
    """Other grains are other materials."""
    rows = []
    for saturation in (SAND, BONDED):
        for setting in [s for s in tests.settings(saturation) if s[0] in ("kn_Pa", "base") and s[2] in (1e-3, 1e-4)]:
            ratio = float(setting[1] or 3e8) / 1e6
            slow = (*setting[:2], 1e-4)
            cells = [mean_cell(tests.values(saturation, setting, q).values()) for q in ("peak_q_Pa", "peak_eps1", "secant_modulus_Pa")]
            rows.append((saturation, ratio, [NAMES[saturation], f"{ratio:g}", f"{setting[2]:g}"] + cells +
                         [with_interval(tests.change(saturation, setting, "peak_q_Pa", slow)), f"{tests.disc_steps(saturation, setting) / 1e6:.0f}", tests.part(saturation, setting)]))
    rows.sort(key=lambda r: r[:2])
    return markdown(["material", "k_n / σ_3", "I", "peak q [MPa]", "strain at peak [%]", "E50 [MPa]", "peak q less that at 1e-4 [%]", "particle-steps [millions]", "part"],
                    [row for *_, row in rows])


def many(tests, _):
    """Where verdicts hang on the seeds: up to twenty specimens, against the base."""
    rows = []
    for setting in trade_settings(tests, BONDED):
        found = tests.change(BONDED, setting, "peak_q_Pa", BASE)
        if setting == BASE or found is None or found[2] <= 5:
            continue
        cells = [with_interval(tests.change(BONDED, setting, q, BASE), 2) for q in BEFORE]
        rows.append([name_of(setting), f"{setting[2]:g}"] + cells + [verdict(found, 2), f"{1 / tests.steps_over(BONDED, setting, BASE):.1f}", str(found[2])])
    return markdown(["setting", "I"] + BEFORE_HEADINGS + ["peak q within 2 %?", "steps saved", "seeds"], rows)


LARGE_REFERENCE = ("discs+dt_safety", "20000+0.475", 5e-5)


def large(tests, _):
    """20,000 discs, against a reference of half the step."""
    rows = []
    for setting in [s for s in tests.settings(BONDED) if s[1].split("+")[0] == "20000" and s != LARGE_REFERENCE]:
        found = tests.change(BONDED, setting, "peak_q_Pa", LARGE_REFERENCE)
        if found is None:
            continue
        cells = [with_interval(tests.change(BONDED, setting, q, LARGE_REFERENCE)) for q in BEFORE]
        waves = [float(row["platen_wave_stress"]) for row in tests.pick(BONDED, setting).values()]
        name = ("mixed, " if "mixed" in setting[1] else "") + ("inertia x 3" if "inertia" in setting[0] else "true masses")
        rows.append([name, f"{setting[2]:g}", f"{sum(waves) / len(waves):.2g}"] + cells +
                    [verdict(found, 2), str(found[2])])
    return markdown(["setting", "I", "W"] + BEFORE_HEADINGS + ["peak q within 2 %?", "seeds"], rows)


def by_seeds(tests, saturation, setting, seeds):
    return {k: r for k, r in tests.pick(saturation, setting).items() if r["seed"] in seeds}


def repeated(tests, _):
    """Rows measured twice, with seeds 1 to 5 and 6 to 10."""
    rows = []
    for setting in (("inertia_scaling", "3", 2e-4), ("damping", "0", 2e-4)):
        for quantity in ("peak_q_Pa", "peak_eps1", "largest_eps_v"):
            found = []
            for seeds in (range(1, 6), range(6, 11)):
                pair = [{k: r[quantity] for k, r in by_seeds(tests, BONDED, s, seeds).items()} for s in (PLAIN, setting)]
                change = paired_difference(*pair)
                found.append(change and (100 * change[1] / change[0], 100 * change[2] / change[0]))
            if None in found:
                continue
            apart = abs(found[0][0] - found[1][0])
            rows.append([name_of(setting), QUANTITIES[quantity][0], *(with_interval(f, 2) for f in found),
                         "yes" if apart <= math.hypot(found[0][1], found[1][1]) else "no"])
    return markdown(["setting, less base at I = 2e-4", "number", "seeds 1 to 5 [%]", "seeds 6 to 10 [%]", "agree"], rows)


METHODS = {"double": ("base", ""), "mixed": ("precision", "mixed"), "inertia x 3": ("inertia_scaling", "3"),
           "inertia x 3, mixed": ("precision+inertia_scaling", "mixed+3"), "inertia x 3, mass 0.1": ("inertia_scaling+mass_scaling", "3+0.1"),
           "half the step": ("dt_safety", "0.475"), "damping 0.7": ("damping", "0.7"), "damping 0": ("damping", "0")}


def pictures(tests, cost, path):
    panels = []
    for saturation, quantity in ((BONDED, "peak_q_Pa"), (BONDED, "peak_eps1"), (SAND, "peak_q_Pa"), (SAND, "largest_eps_v")):
        lines = {}
        for method, kind in METHODS.items():
            lines[method] = []
            for setting in [s for s in tests.settings(saturation) if s[:2] == kind and s != tests.reference(saturation, quantity)]:
                found = tests.change(saturation, setting, quantity)
                if found and found[1] == found[1]:
                    lines[method].append((cost.seconds(tests, saturation, setting), abs(found[0]), abs(found[0]) + found[1]))
        floor = tests.change(saturation, CHAOS, quantity, PLAIN)
        panels.append(picture.panel(f"{NAMES[saturation]}: {QUANTITIES[quantity][0]}", "seconds of one core to 10 % strain", "error to the reference [%]",
                                    lines, floor[1] if floor else None, ((0.03, 200), (0.05, 100))))
    picture.draw(path, panels, list(METHODS))


def costs(tests, cost):
    rows = []
    for saturation in (SAND, BONDED):
        for precision, setting in (("double", BASE), ("mixed", ("precision", "mixed", 1e-4))):
            rows.append([NAMES[saturation], precision, f"{cost.nanoseconds[saturation, precision]:.1f}",
                         f"{tests.disc_steps(saturation, setting) / 1e6:.0f}", f"{cost.seconds(tests, saturation, setting):.1f}"])
    return markdown(["material", "precision", "ns a particle-step", "millions of particle-steps to 10 % at I = 1e-4", "core s"], rows)


TABLES = {"reference": references, "cost": costs, "sand": trade(SAND), "bonded": trade(BONDED), "many": many, "after": after,
          "precision": option_at_equal_rate("precision"), "step": option_at_equal_rate("dt_safety"), "skin": option_at_equal_rate("skin"),
          "masses": option_at_equal_rate("inertia"), "damping": option_at_equal_rate("damping"), "energy": energy, "waves": waves,
          "angles": angles, "stiffness": stiffness, "repeated": repeated, "large": large}


def put(page, mark, table, maker="table.py"):
    begin, end = f"<!-- {mark}: made by perf/tradeoff/{maker} -->", f"<!-- end of {mark} -->"
    before, rest = page.split(begin)
    return before + begin + "\n\n" + table + "\n\n" + end + rest.split(end)[1]


def main(data, cost, folder):
    tests, cost, page = Tests(load(data)), Cost(cost), folder / "accuracy.md"
    words = page.read_text()
    for mark, table in TABLES.items():
        words = put(words, mark, table(tests, cost))
    page.write_text(words)
    pictures(tests, cost, folder / "pictures" / "work-precision.svg")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], Path(sys.argv[3]))
