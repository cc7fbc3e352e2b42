"""Prints the rows of src/domain/biaxial/expected_error.cpp from the study of loading rates.

usage: python3 perf/expected_error.py study.csv
Errors are paired with the slowest rate in double precision, seed by seed; intervals are Student's. Rows of heavier rotation are in
docs/accuracy.md."""
import collections
import csv
import sys

T95 = {1: 12.706, 2: 4.303, 3: 3.182, 4: 2.776, 5: 2.571, 6: 2.447, 7: 2.365, 8: 2.306, 9: 2.262}


def peaks(path):
    """{(bonded, precision): {I: {seed: peak q}}} of the finished members."""
    found = collections.defaultdict(lambda: collections.defaultdict(dict))
    for row in csv.DictReader(open(path)):
        if row["row"] == "member" and row["state"] == "finished":
            key = row["hydrate.saturation"] != "0", row["run.precision"]
            found[key][float(row["test.inertial_number"])][row["seed"]] = float(row["peak_q_Pa"])
    return found


def error(values, reference):
    seeds = sorted(set(values) & set(reference))
    if len(seeds) < 2:
        return None
    base = sum(reference[s] for s in seeds) / len(seeds)
    parts = [(values[s] - reference[s]) / base for s in seeds]
    mean = sum(parts) / len(parts)
    deviation = (sum((p - mean) ** 2 for p in parts) / (len(parts) - 1)) ** 0.5
    return mean, T95[len(seeds) - 1] * deviation / len(seeds) ** 0.5, len(seeds)


def text(found):
    return "not measured" if found is None else "{%.4f, %.4f}" % found[:2]


def main(path):
    all_peaks = peaks(path)
    slowest = {bonded: min(all_peaks[bonded, "double"]) for bonded in (False, True)}
    reference = {bonded: all_peaks[bonded, "double"][slowest[bonded]] for bonded in (False, True)}
    for rate in sorted(set(all_peaks[True, "double"]) | set(all_peaks[False, "double"])):
        both = [error(all_peaks[bonded, "double"].get(rate, {}), reference[bonded]) for bonded in (False, True)]
        print("    {%g, %s, %s},  // %s seeds" % (rate, text(both[0]), text(both[1]), [b and b[2] for b in both]))
    for bonded in (False, True):
        differences = {}
        for rate, values in all_peaks[bonded, "mixed"].items():
            for seed in set(values) & set(all_peaks[bonded, "double"].get(rate, {})):
                double = all_peaks[bonded, "double"][rate][seed]
                differences.setdefault(seed, []).append(values[seed] / double - 1)
        means = {seed: sum(v) / len(v) for seed, v in differences.items()}
        print("mixed, %s: %s, mean over rates for each seed" % ("bonded" if bonded else "sand", error({s: 1 + m for s, m in means.items()}, {s: 1 for s in means})))


if __name__ == "__main__":
    main(sys.argv[1])
