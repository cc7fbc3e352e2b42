#!/usr/bin/env python3
"""Writes the study files that score readings of what the paper leaves open: a reading is a set of scene keys.

  perf/readings/screen.py OUT
  for study in sand screen others; do clathra study OUT/$study.toml --output OUT/$study; done
  build/release/perf/readings_score share/papers/jiang-2017.toml OUT/*/members

144 readings in screen.toml, 16 in others.toml, their clean sands in sand.toml: 2,000 discs, four cells, one seed, an hour on two cores.
"""
import itertools
import pathlib
import sys

LENGTHS = {
    "14th": {"bond.rolling_lever": "B/14"},
    "10th": {"bond.rolling_lever": "B/10"},
    "8th": {"bond.rolling_lever": "B/8"},
    "6th": {"bond.rolling_lever": "B/6"},
    "5th": {"bond.rolling_lever": "B/5"},
    "3rd": {"bond.rolling_lever": "B/3"},
    "mm": {"bond.rolling_lever": "1 mm"},
    "m": {"bond.rolling_lever": "1 m"},
}
RODS = ["identity", "clamped", "scaled"]
COUPLINGS = ["parallel", "replaces_keeping_force", "replaces"]
SHAPES = [1, 2]
STRESSES = ["1 MPa", "3 MPa"]
SHARED = {"bond.grain_stiffness_factor": 1, "specimen.particles": 2000, "test.inertial_number": 2e-4, "run.rotational_inertia_factor": 1, "output.snapshots": 0, "output.keep_checkpoint": False}


def readings():
    """(name, keys); hydrate forms under the confining stress, except where a bond that replaces the contact would drop its force."""
    for (length, keys), rod, coupling, shape in itertools.product(LENGTHS.items(), RODS, COUPLINGS, SHAPES):
        settings = dict(keys)
        settings |= {"bond.thickness_mapping": rod, "bond.contact_coupling": coupling, "grains.rolling_width_factor": shape}
        settings["bond.after_consolidation"] = coupling != "replaces"
        yield f"{coupling}-{length}-{rod}-beta{shape}", settings


BEST = {"bond.rolling_lever": "B/8", "bond.contact_coupling": "parallel", "grains.rolling_width_factor": 1, "bond.after_consolidation": True}


def others():
    """(name, keys, whether its sand is another): one change at a time on the best of the 144, and floors where bonds replace contacts."""
    best = "parallel-8th-identity-beta1"
    for name, keys in {
        "8th-identity-low": {"bond.after_consolidation": False},
        "7th-identity": {"bond.rolling_lever": "B/7"},
        "8th-identity-kn2": {"bond.grain_stiffness_factor": 2},  # a grain is twice as stiff as a contact of two in series
        "6th-identity-kn2": {"bond.rolling_lever": "B/6", "bond.grain_stiffness_factor": 2},
        "5th-identity-kn2": {"bond.rolling_lever": "B/5", "bond.grain_stiffness_factor": 2},
        "4th-identity-kn2": {"bond.rolling_lever": "B/4", "bond.grain_stiffness_factor": 2},
    }.items():
        yield f"parallel-{name}-beta1", BEST | keys, None
    for name, keys in {
        "e26": {"specimen.void_ratio": 0.26},
        "e28": {"specimen.void_ratio": 0.28},
        "damping1": {"damping.local": 0.1},
        "damping7": {"damping.local": 0.7},
        "wider": {"grains.rolling_width_factor": 1.5},
    }.items():
        yield f"{best}-{name}", BEST | keys, {"grains.rolling_width_factor": 1} | keys
    for coupling, ratio, rod in [("replaces", 1 / 8, "identity"), ("replaces", 1 / 5, "identity"), ("replaces", 1 / 10, "clamped"),
                                  ("replaces", 1 / 14, "scaled"), ("replaces", 1 / 8, "scaled")]:
        keys = {"bond.rolling_lever": f"{ratio} B", "bond.contact_coupling": coupling, "bond.thickness_mapping": rod, "bond.friction_floor": True,
                "grains.rolling_width_factor": 1, "bond.after_consolidation": coupling != "replaces"}
        yield f"{coupling}-{round(1 / ratio)}th-{rod}-floor-beta1", keys, None


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
    (out / "others.toml").write_text(study([(name, keys) for name, keys, _ in others()], matrix))
    sand = [(f"beta{shape}", {"grains.rolling_width_factor": shape}) for shape in SHAPES]
    sand += [(name[name.index("beta1"):], keys) for name, _, keys in others() if keys]
    (out / "sand.toml").write_text(study(sand, {"hydrate.saturation": 0, "test.confining_stress": STRESSES}))


if __name__ == "__main__":
    main()
