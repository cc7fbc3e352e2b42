"""Adds the finished members of the studies in a folder to one table, which is made where there is none: collect.py FOLDER DATA.csv

One row a test: the part (study file) it belongs to, what it was run with (settings that differ from base.toml make its factor and level), what came out, and its cost in
particle-steps, which other load on the machine does not change. The inertial number is that of the test, which a bound of W may have lowered, to two digits.
"""
import csv
import json
import sys
from pathlib import Path

# Column, section and key of the scene, value in base.toml. Inertial number, saturation, stress and seed stand beside factor and level.
SETTINGS = [
    ("discs", "plan", "particles", 2000),
    ("aspect_ratio", "specimen", "aspect_ratio", 2),
    ("kn_Pa", "grains", "normal_stiffness", 3e8),
    ("precision", "run", "precision", "double"),
    ("dt_safety", "run", "time_step_safety", 0.95),
    ("inertia_scaling", "run", "rotational_inertia_factor", 1),
    ("mass_scaling", "run", "mass_scaled_fraction", 0),
    ("damping", "damping", "local", 0.3),
    ("contact_damping", "damping", "viscous_ratio", 0),
    ("skin_m", "run", "verlet_skin", 0),
]
# Numbers of the stage `shear` of run.json.
NUMBERS = ["peak_q_Pa", "peak_eps1", "secant_modulus_Pa", "residual_q_Pa", "largest_eps_v", "end_eps_v", "peak_bonds_intact_pct",
           "end_bonds_intact_pct", "end_eps1", "largest_kinetic_share"]
EARLY = 0.0348  # axial strain that every test reaches: steps until there compare the cost of tests of different length
LEDGER = ["damping", "dashpot", "breakage", "sliding", "rolling", "kinetic"]
COLUMNS = (["part", "factor", "level", "saturation", "stress_Pa", "inertial_number", "platen_wave_stress", "seed", "specimen"] + [s[0] for s in SETTINGS] + NUMBERS +
           ["contact_peak_q_Pa", "contact_peak_eps1", "contact_q_at_peak_Pa"] + [f"{name}_share" for name in LEDGER] + ["disc_steps", "early_disc_steps"])


def short(value):
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def settings_of(run):
    """What the test was run with, by column, and how it differs from the base."""
    places = dict(run["scene"], plan=run["stages"]["plan"])
    values = {column: places[section][key] for column, section, key, _ in SETTINGS}
    changed = [column for column, _, _, base in SETTINGS if values[column] != base]
    values["factor"] = "+".join(changed) or "base"
    values["level"] = "+".join(short(values[column]) for column in changed)
    return values


def of_history(path):
    """Stresses of the contacts beside those of the walls, and where the work went until the peak, from history.csv."""
    with open(path, newline="") as file:
        shear = [row for row in csv.DictReader(file) if row.pop("stage", "shear") == "shear"]
    rows = [{key: float(value) for key, value in row.items()} for row in shear]
    inner = [r["contact_sigma1_Pa"] - r["contact_sigma3_Pa"] for r in rows]
    peak, inner_peak = (max(range(len(rows)), key=q.__getitem__) for q in ([r["q_Pa"] for r in rows], inner))
    found = {"contact_peak_q_Pa": inner[inner_peak], "contact_peak_eps1": rows[inner_peak]["eps1"], "contact_q_at_peak_Pa": inner[peak],
             "platen_wave_stress": rows[0]["platen_wave_stress"]}
    early = next((r for r in rows if r["eps1"] >= EARLY), None)
    if early:
        found["early_steps"] = int(early["step"])
    work = rows[peak].get("boundary_work_J_per_m")
    if work:
        found.update({f"{name}_share": rows[peak][f"{name}_J_per_m"] / work for name in LEDGER})
    return found


def row_of(member):
    """One row, or nothing where the member has not finished."""
    try:
        run = json.loads((member / "run.json").read_text())
    except FileNotFoundError:
        return None
    if run.get("exit", {}).get("reason") != "finished":
        return None
    row = settings_of(run)
    row.update(of_history(member / "history.csv"))
    row["early_disc_steps"] = row.pop("early_steps", 0) * int(row["discs"]) or ""
    row.update({name: run["stages"]["shear"].get(name, "") for name in NUMBERS})
    row.update(part=member.parent.parent.name, saturation=run["scene"]["hydrate"]["saturation"], stress_Pa=run["scene"]["test"]["confining_stress"], seed=run["seed"],
               inertial_number=float(f"{run['stages']['plan']['inertial_number']:.2g}"), disc_steps=run["particle_steps"],
               specimen=run["input"]["specimen_digest_xxh3_128"][:12])
    return row


def key_of(row):
    """What two rows share that are the same test of the same specimen, perhaps to another strain or with other outputs."""
    return tuple(row[c] for c in ["factor", "level"]) + tuple(float(row[c]) for c in ["saturation", "stress_Pa", "inertial_number", "seed"]) + (row["specimen"],)


def collect(folder):
    """The rows of all parts. Of the same test twice the longer one stays, and what only the other one knows (its ledger) is added."""
    rows = {}
    for member in sorted(Path(folder).glob("*/members/*")):
        row = row_of(member)
        if row is None:
            continue
        other = rows.get(key_of(row))
        if other is None:
            rows[key_of(row)] = row
            continue
        longer, shorter = (row, other) if row["end_eps1"] > other["end_eps1"] else (other, row)
        rows[key_of(row)] = {**shorter, **{key: value for key, value in longer.items() if value != ""}}
    return [{column: short(row.get(column, "")) for column in COLUMNS} for row in rows.values()]


def main(folder, path):
    rows = {}
    if Path(path).exists():
        with open(path, newline="") as file:
            rows = {key_of(row): row for row in csv.DictReader(file)}
    rows.update({key_of(row): row for row in collect(folder)})
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        table.writeheader()
        table.writerows(rows[key] for key in sorted(rows))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
