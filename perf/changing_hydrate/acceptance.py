"""Whether sand that loses its hydrate under load stands or fails where its own strength says: acceptance.py CLATHRA FOLDER

First the sand alone, five seeds at three stresses; from its envelope the loads and the stress of failure, which is printed before
anything else runs; then hydrate that is warmed under 0.6 and 1.2 times the strength of the sand, sand under the same loads, and
hydrate that is depressurised and repressurised. Some three minutes on two cores. FOLDER/warmed and FOLDER/pressed have pages.
"""
import csv
import json
import math
import os
import statistics
import subprocess
import sys

CLATHRA, FOLDER = sys.argv[1:3]
HERE = os.path.dirname(os.path.abspath(__file__))
SEEDS = 5
STUDENT = {2: 12.706, 3: 4.303, 4: 3.182, 5: 2.776}  # 95 %, two-sided


def study(name, scene, matrix, settings=()):
    file = os.path.join(FOLDER, name + ".toml")
    with open(file, "w", encoding="utf-8") as text:
        text.write(f'scene = "{os.path.join(HERE, scene)}"\nseeds = {SEEDS}\n[matrix]\n{matrix}\n')
    folder = os.path.join(FOLDER, name)
    subprocess.run([CLATHRA, "study", file, "--output", folder, *(word for one in settings for word in ("--set", one))],
                   check=True, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    return folder


def members(folder):
    """The group of each member, its run.json and the last row of its history."""
    for name in sorted(os.listdir(os.path.join(folder, "members"))):
        path = os.path.join(folder, "members", name)
        with open(os.path.join(path, "run.json"), encoding="utf-8") as file:
            record = json.load(file)
        with open(os.path.join(path, "history.csv"), encoding="utf-8") as file:
            yield name.split("-seed")[0], record, list(csv.DictReader(file))[-1]


def interval(values):
    half = STUDENT[len(values)] * statistics.stdev(values) / math.sqrt(len(values))
    return statistics.mean(values), half


def text(values, unit):
    mean, half = interval(values)
    return f"{mean:.3g} +- {half:.2g} {unit} ({len(values)} seeds)"


def main():
    os.makedirs(FOLDER, exist_ok=True)
    sand = study("sand", "sand.toml", 'test.confining_stress = ["1 MPa", "2 MPa", "3 MPa"]')
    with open(os.path.join(sand, "study.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    strength = statistics.mean(float(row["peak_q_Pa"]) for row in rows if row["row"] == "member" and row["group"] == "1MPa")
    predicted = []
    for row in rows:
        if row["row"] == "envelope":
            c, phi = float(row["peak_cohesion_Pa"]), math.radians(float(row["peak_friction_angle_deg"]))
            n = math.tan(math.pi / 4 + phi / 2) ** 2
            predicted.append((3.8e6 - 2 * c * math.sqrt(n)) / (n - 1) * 1e-6)
    print(f"sand at 1 MPa bears q = {strength * 1e-6:.3g} MPa; repressurised under 3.8 MPa it is to fail at sigma_3' = "
          f"{text(predicted, 'MPa')}", flush=True)

    loads = "test.dead_load = [" + ", ".join(f'"{share * strength * 1e-6:.3g} MPa"' for share in (0.6, 1.2)) + "]"
    warmed = study("warmed", "warmed.toml", loads)
    alone = study("loaded_sand", "warmed.toml", loads, ["test.kind=creep", "hydrate.saturation=0 %"])
    for name, folder in (("warmed", warmed), ("sand alone", alone)):
        for group in sorted({group for group, _, _ in members(folder)}):
            own = [(record, row) for other, record, row in members(folder) if other == group]
            stages = [list(record["stages"][record["loading"][-1]["stage"]].items()) for record, _ in own]
            failed = sum(dict(numbers)["failed"] for numbers in stages)
            strain = text([100 * float(row["eps1"]) for _, row in own], "%")
            print(f"{name} under {group}: {failed:.0f} of {len(own)} fail, eps1 {strain}", flush=True)

    pressed = study("pressed", "pressed.toml", "test.dead_load = [\"3.8 MPa\"]")
    at, before = [], 0
    for _, record, _ in members(pressed):
        numbers = record["stages"]["repressurisation"]
        before += record["stages"]["depressurisation"]["failed"]
        if numbers["failed"]:
            at.append((numbers["failed_p_Pa"] - numbers["failed_q_Pa"] / 2) * 1e-6)
    print(f"depressurised {before:.0f} of {SEEDS} fail; repressurised {len(at)} fail, at sigma_3' = {text(at, 'MPa')}")


main()
