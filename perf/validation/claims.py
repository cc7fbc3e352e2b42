#!/usr/bin/env python3
"""Puts the verdicts of a scorecard of `clathra reproduce` into a page, between its marks: claims.py SCORECARD.md PAGE.md"""
import re
import sys
import textwrap
from collections import Counter
from pathlib import Path

BEGIN, END = "<!-- claims: made by perf/validation/claims.py -->", "<!-- end of claims -->"
COLUMNS = 110


def item(text, indent=""):
    return textwrap.fill(text, COLUMNS, initial_indent=indent + "- ", subsequent_indent=indent + "  ", break_long_words=False, break_on_hyphens=False)


def rows(text):
    """The cells of a table, without its head."""
    return [[cell.strip() for cell in line.strip("| ").split(" | ")] for line in text.splitlines() if line.startswith("| ")][1:]


def claims(card):
    summary, *parts = card.split("\n## ")
    verdicts = rows(summary)
    counts = Counter(verdict for _, verdict, _ in verdicts)
    lines = ["Of {} claims {} pass, {} are partial, {} fail and {} are undetermined.".format(
        len(verdicts), *(counts[v] for v in ("pass", "partial", "fail", "undetermined"))), ""]
    for (words, verdict, inside), part in zip(verdicts, parts):
        lines.append(item(re.sub(r"^\((\w+)\) ", rf"**(\1) {verdict}**: ", words) + f"; means within the bounds: {inside}"))
        for line in part.splitlines():
            if line.startswith("| ") and not line.startswith("| number "):
                what, mean, unit, claimed, _, found = [cell.strip() for cell in line[1:-1].split("|")]
                if found != "pass":
                    lines.append(item(f"{found}: {what}, {mean} {unit}".rstrip() + f"; claimed: {claimed}", "    "))
    return "\n".join(lines)


def main(card, page):
    before, rest = page.read_text().split(BEGIN)
    page.write_text(before + BEGIN + "\n\n" + claims(card.read_text()) + "\n\n" + END + rest.split(END)[1])


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*map(Path, sys.argv[1:]))
