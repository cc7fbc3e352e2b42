#!/usr/bin/env python3
"""Writes the study files that score readings of what the paper leaves open: a reading is a set of scene keys.

  perf/readings/screen.py OUT            OUT/screen.toml, OUT/sand.toml: 144 readings, 2,000 discs, four cells, one seed (an hour)
  clathra study OUT/screen.toml; clathra study OUT/sand.toml
"""
import itertools
import pathlib
import sys

LENGTHS = {
    "14th": {"bond.moment_ratio": 1 / 14},
    "10th": {"bond.moment_ratio": 1 / 10},
    "8th": {"bond.moment_ratio": 1 / 8},
    "6th": {"bond.moment_ratio": 1 / 6},
    "5th": {"bond.moment_ratio": 1 / 5},
    "3rd": {"bond.moment_ratio": 1 / 3},
    "mm": {"bond.moment_scale": "rod_mm"},
    "m": {"bond.moment_scale": "paper_si"},
}
RODS = ["printed", "clamped", "scaled"]
COMPOSITES = ["parallel", "memory", "replace"]
SHAPES = [1, 2]
STRESSES = ["1 MPa", "3 MPa"]
SHARED = {"sample.particles": 2000, "test.inertial_number": 2e-4, "output.snapshots": 0, "output.keep_checkpoint": False}


def readings():
    """(name, keys); hydrate forms under the confining stress, except where a bond that replaces the contact would drop its force."""
    for (length, keys), rod, composite, shape in itertools.product(LENGTHS.items(), RODS, COMPOSITES, SHAPES):
        settings = dict(keys)
        settings |= {"bond.rod_thickness": rod, "bond.composite": composite, "grains.shape_factor": shape}
        settings["bond.after_consolidation"] = composite != "replace"
        yield f"{composite}-{length}-{rod}-beta{shape}", settings


def value(v):
    if isinstance(v, bool):
        return str(v).lower()
    if isinstance(v, list):
        return "[" + ", ".join(value(x) for x in v) + "]"
    return f'"{v}"' if isinstance(v, str) else repr(v)


def table(keys):
    return "".join(f'"{key}" = {value(v)}\n' for key, v in keys.items())


def study(groups, matrix):
    text = 'scene = "scene.toml"\nseeds = [1]\n'
    for name, keys in groups:
        text += f"[groups.{name}]\n" + table(keys)
    return text + "[matrix]\n" + table(matrix | SHARED)


def main():
    out = pathlib.Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    (out / "scene.toml").write_text("")
    matrix = {"hydrate.saturation": ["26 %", "55 %"], "test.confining_stress": STRESSES}
    (out / "screen.toml").write_text(study(list(readings()), matrix))
    sand = [(f"beta{shape}", {"grains.shape_factor": shape}) for shape in SHAPES]
    (out / "sand.toml").write_text(study(sand, {"hydrate.saturation": 0, "test.confining_stress": STRESSES}))


if __name__ == "__main__":
    main()
