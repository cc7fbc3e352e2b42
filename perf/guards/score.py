"""How often the guards of a shear are right: the tests of study.toml against slow ones of the same specimens.

  score.py FOLDER [GUARDS.csv]     FOLDER is the study's; GUARDS.csv gets a row a test

A test is wrong where its peak of q is more than 2 % off that of its slow partners: the mean of the others with the same specimen, law and stiffness,
a damping of 0.3 and I up to 1e-4 (2e-4 for soft grains); one alone scatters by 1 % where bonds break, whatever is paid for it. Undamped tests have
those partners, too: what is quasi-static knows no damping.
"""
import csv
import json
import sys
from pathlib import Path

WRONG = 0.02
WORDS = {"rate": "inertial number I", "balance": "out of balance", "mismatch": "q of the contacts", "share": "of the checks up to", "magnitude": "was off by up to"}


def rows(folder):
    """A row of numbers for each finished test."""
    tests = {}
    for record in sorted(Path(folder).glob("members/*/run.json")):
        group, _, specimen = record.parent.name.partition("_")
        run = json.loads(record.read_text())
        if run["exit"]["reason"] == "finished":
            tests[group, specimen] = run
    for (group, specimen), run in tests.items():
        slow = ("soft-slow", "soft-i2e4") if group.startswith("soft") else ("slow", "i2e5", "i1e4")
        partners = [tests[name, specimen]["stages"]["shear"]["peak_q_Pa"] for name in slow if name != group]
        if group in ("slow", "soft-slow"):
            continue
        shear = run["stages"]["shear"]
        error = shear["peak_q_Pa"] * len(partners) / sum(partners) - 1
        yield {"group": group, "specimen": specimen, "error": error, "inertial_number": run["stages"]["plan"]["inertial_number"],
               "unbalanced": shear.get("mean_unbalanced_to_peak", 0), "mismatch": shear.get("stress_mismatch_to_peak", 0),
               "held": shear.get("sigma3_held_to_peak", 1), "sigma3_error": shear.get("sigma3_error", 0), "deep": shear["deep_overlap_share"],
               "said": " ".join(name for name, words in WORDS.items() if any(words in text for text in run["warnings"]))}


def share(part, whole):
    return f"{len(part)} of {len(whole)}" + (f" ({100 * len(part) / len(whole):.0f} %)" if whole else "")


def main(folder, table=None):
    tests = list(rows(folder))
    wrong, right = [t for t in tests if abs(t["error"]) > WRONG], [t for t in tests if abs(t["error"]) <= WRONG]
    for name, alarm in [(name, lambda t, name=name: name in t["said"].split()) for name in WORDS] + [
            ("any warning of these", lambda t: t["said"])]:
        print(f"{name:22} finds {share([t for t in wrong if alarm(t)], wrong)} of the wrong, "
              f"blames {share([t for t in right if alarm(t)], right)} of the right")
    if table:
        with open(table, "w", newline="") as file:
            writer = csv.DictWriter(file, tests[0])
            writer.writeheader()
            writer.writerows({k: f"{v:.4g}" if isinstance(v, float) else v for k, v in t.items()} for t in tests)


if __name__ == "__main__":
    main(*sys.argv[1:])
