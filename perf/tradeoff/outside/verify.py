"""What `clathra tune` chose beside reference runs: verify.py studies SCENE FOLDER prints a study of both, verify.py table FOLDER the result.

FOLDER has what `run` leaves there: SCENE-TOLERANCE.toml where tune found a setting, and the finished study SCENE-verified.
"""
import csv
import re
import sys
import tomllib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from paired import paired_difference  # noqa: E402

TOLERANCES = (5, 1)
SEEDS = [101, 102, 103, 104, 105]  # none that tune takes
# Half the usual step, true masses, double precision, and a rate below which the campaign knows no change.
REFERENCE = {"run.precision": "double", "run.time_step_safety": 0.475, "run.rotational_inertia_factor": 1, "run.mass_scaled_fraction": 0, "test.inertial_number": 1e-5,
             "test.max_platen_wave_stress": 0}


def chosen(path):
    """The keys of a tuned scene that make its setting; None where tune wrote none."""
    if not path.exists():
        return None
    scene = tomllib.loads(path.read_text())
    return {key: scene[key.split(".")[0]][key.split(".")[1]] for key in REFERENCE if key.split(".")[1] in scene.get(key.split(".")[0], {})}


def study(scene, folder):
    """The text of a study of the reference and of what tune chose at either tolerance."""
    groups = {"reference": REFERENCE} | {f"tuned{t}": keys for t in TOLERANCES if (keys := chosen(folder / f"{scene.stem}-{t}.toml"))}
    lines = [f'scene = "{scene.resolve()}"', f"seeds = {SEEDS}"]
    for name, keys in groups.items():
        lines += [f"[groups.{name}]"] + [f'"{key}" = {value!r}'.replace("'", '"') for key, value in keys.items()]
    return "\n".join(lines)


def peaks(study_csv):
    """Peak q [Pa] by group and specimen (seed)."""
    found = {}
    with open(study_csv, newline="") as file:
        for row in csv.DictReader(file):
            if row["row"] == "member" and row["peak_q_Pa"]:
                found.setdefault(row["group"], {})[row["seed"]] = float(row["peak_q_Pa"])
    return found


def table(folder, out):
    rows = csv.writer(out, lineterminator="\n")
    rows.writerow(["scene", "tolerance_pct", "tune_said", "chosen", "seconds", "reference_peak_q_MPa", "change_pct", "half_width_pct", "pairs"])
    for done in sorted(folder.glob("*.done")):
        scene, tolerance = done.stem.rsplit("-", 1)
        code, seconds = done.read_text().split()
        keys = chosen(folder / f"{scene}-{tolerance}.toml")
        found = peaks(folder / f"{scene}-verified" / "study.csv")
        result = paired_difference(found["reference"], found.get(f"tuned{tolerance}", {}))
        said = "within" if code == "0" else re.search(r"undetermined[^\n]*", (folder / f"{done.stem}.log").read_text()).group()
        numbers = [f"{result[0] / 1e6:.3f}", f"{100 * result[1] / result[0]:.2f}", f"{100 * result[2] / result[0]:.2f}", result[3]] if result else ["", "", "", 0]
        rows.writerow([scene, tolerance, said, " ".join(f"{k}={v}" for k, v in (keys or {}).items()), seconds] + numbers)


if __name__ == "__main__":
    if sys.argv[1] == "studies":
        print(study(Path(sys.argv[2]), Path(sys.argv[3])))
    else:
        table(Path(sys.argv[2]), sys.stdout)
