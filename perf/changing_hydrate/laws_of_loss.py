"""Which bonds the three laws of loss take first, and that they end alike: laws_of_loss.py CLATHRA FOLDER

Five seeds a law, 41 % hydrate lost under a dead load of 1 MPa; from events.csv and the widths of the first snapshot. Bonds that
dissolve are ranked by when they do; of those that break before, the orientation counts. Some two minutes on two cores.
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
STUDENT = 2.776  # 95 %, two-sided, five seeds
LAWS = ("critical_thickness", "recession", "uniform")


def interval(values):
    return f"{statistics.mean(values):.3g} +- {STUDENT * statistics.stdev(values) / math.sqrt(len(values)):.2g}"


def ranks(values):
    """Ties share theirs."""
    order, rank = sorted(range(len(values)), key=values.__getitem__), [0.0] * len(values)
    first = 0
    while first < len(order):
        last = first
        while last < len(order) and values[order[last]] == values[order[first]]:
            last += 1
        for k in order[first:last]:
            rank[k] = (first + last) / 2
        first = last
    return rank


def correlation(a, b):
    """Spearman's; nothing where all are alike."""
    if len(set(a)) < 2 or len(set(b)) < 2:
        return float("nan")
    return statistics.correlation(ranks(a), ranks(b))


def rows(file):
    with open(file, encoding="utf-8") as text:
        return list(csv.DictReader(text))


def first_widths(folder):
    """Widths of formation by the ids of a pair."""
    tables = os.path.join(folder, "tables")
    subprocess.run([CLATHRA, "export", folder, "--to", "csv", "--quiet", "-o", tables], check=True)
    first = sorted(name for name in os.listdir(tables) if name.startswith("contacts"))[0]
    return {frozenset((row["id_a"], row["id_b"])): float(row["width_m"]) for row in rows(os.path.join(tables, first))}


def numbers(folder):
    widths, history, found = first_widths(folder), rows(os.path.join(folder, "history.csv")), {}
    events = [row for row in rows(os.path.join(folder, "events.csv")) if row["stage"] == "heating"]
    gone = [row for row in events if row["mode"] == "dissolved"]
    broken = [row for row in events if row["mode"] != "dissolved"]
    when = [int(row["step"]) for row in gone]
    over_gap = [row for row in gone if float(row["thickness_m"]) > 0]
    found["rank correlation with h_cr, of bonds over gaps"] = correlation([int(row["step"]) for row in over_gap],
                                                                          [float(row["thickness_m"]) for row in over_gap])
    found["rank correlation with B of formation"] = correlation(
        when, [widths[frozenset((row["id_a"], row["id_b"]))] for row in gone])
    found["broke under load before they dissolved [%]"] = 100 * len(broken) / len(events)
    found["left in the last increment [%]"] = 100 * when.count(max(when)) / len(events)
    found["orientation of those that broke, -cos 2 theta"] = -statistics.mean(
        math.cos(2 * math.radians(float(row["orientation_deg"]))) for row in broken)
    heated = [row for row in history if row["stage"] == "heating"]
    bonds = int(heated[0]["bonds_intact"])
    found["S with half of the bonds left [%]"] = next(float(row["saturation_pct"]) for row in heated
                                                      if int(row["bonds_intact"]) <= bonds / 2)
    found["bonds left at the end"] = int(heated[-1]["bonds_intact"])
    found["eps_1 at the end [%]"] = 100 * float(heated[-1]["eps1"])
    with open(os.path.join(folder, "run.json"), encoding="utf-8") as text:
        found["failed"] = json.load(text)["stages"]["heating"]["failed"]
    return found


def main():
    os.makedirs(FOLDER, exist_ok=True)
    file, folder = os.path.join(FOLDER, "laws.toml"), os.path.join(FOLDER, "laws")
    with open(file, "w", encoding="utf-8") as text:
        text.write(f'scene = "{os.path.join(HERE, "lost.toml")}"\nseeds = {SEEDS}\n[matrix]\nhydrate.loss = {json.dumps(LAWS)}\n')
    subprocess.run([CLATHRA, "study", file, "--output", folder], check=True, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    members = os.path.join(folder, "members")
    of_laws = [[numbers(os.path.join(members, name)) for name in sorted(os.listdir(members)) if name.startswith(law.replace("_", "-"))]
               for law in LAWS]
    print("| | " + " | ".join(LAWS) + " |\n|---|" + "---|" * len(LAWS))
    for name in of_laws[0][0]:
        cells = [[one[name] for one in law] for law in of_laws]
        print(f"| {name} | " + " | ".join("all at once" if math.isnan(sum(values)) else interval(values) for values in cells) + " |")


main()
