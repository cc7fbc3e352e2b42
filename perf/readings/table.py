#!/usr/bin/env python3
"""Markdown of scorecards side by side: perf/readings/table.py FOLDER...

FOLDER are results of `clathra reproduce`. A row a folder, a column a claim: parts whose mean lies within the bounds over all parts, with
P where the claim passes, F where it fails, ~ where it is partial; without a letter it is undetermined. The score is the mean share of parts
inside, over claims 2 to 9 that tell readings apart, and over 10 to 16.
"""
import json
import pathlib
import sys

MARK = {"pass": " P", "fail": " F", "partial": " ~"}


def claims_of(folder):
    card = json.loads((pathlib.Path(folder) / "scorecard.json").read_text())
    return {claim["id"]: claim for claim in card["claims"]}


def cell(claim):
    inside = sum(part["mean_is_inside"] for part in claim["parts"])
    return f"{inside}/{len(claim['parts'])}{MARK.get(claim['verdict'], '')}"


def score(claims, chosen):
    shares = [claims[k]["share_inside"] for k in chosen]
    return sum(shares) / len(shares)


def main():
    rows = []
    for folder in sys.argv[1:]:
        claims = claims_of(folder)
        ids = list(claims)
        first, then = ids[1:ids.index("9") + 1], ids[ids.index("9") + 1:]
        rows.append((score(claims, first), score(claims, then), pathlib.Path(folder).name, claims))
    rows.sort(key=lambda row: row[:2], reverse=True)
    print("| reading | 2 to 9 | 10 to 16 | " + " | ".join(f"({k})" for k in ids) + " |")
    print("|---" * (3 + len(ids)) + "|")
    for chosen, checked, name, claims in rows:
        print(f"| {name} | {chosen:.2f} | {checked:.2f} | " + " | ".join(cell(claims[k]) for k in ids) + " |")


if __name__ == "__main__":
    main()
