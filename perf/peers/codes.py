"""The codes that are compared: how each is given the packing, started, and read. Used by perf/peers/run."""
import json
import math
import os
import re
import shutil
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

here = Path(__file__).resolve().parent
project = here.parent.parent


class Failed(Exception):
    """A program that could not be run; the text says which and where its output is."""


def start(command, log, cores, threads):
    """Runs a command bound to cores, its output in a log. Returns the output, and the share of the cores that it got."""
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads), OMP_PROC_BIND="false",
                       OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    pinned = ["taskset", "-c", ",".join(map(str, cores))] + [str(word) for word in command]
    before, clock = os.times(), time.monotonic()
    with open(log, "w") as output:
        status = subprocess.call(pinned, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT, env=environment,
                                 cwd=Path(log).parent)
    after, passed = os.times(), time.monotonic() - clock
    if status != 0:
        raise Failed(f"{command[0]} ended with {status}, see {log}")
    used = after.children_user + after.children_system - before.children_user - before.children_system
    return Path(log).read_text(errors="replace"), used / passed / len(cores)


def named_numbers(text):
    """The lines `name number` of an output."""
    return {name: float(value) for name, value in re.findall(r"^(\w+) (-?[\d.]+(?:e[+-]?\d+)?)$", text, re.MULTILINE)}


def read_forces(path):
    """{id: (fx, fy)} from the rows of three numbers in a file, whatever header it has. Ids from 0."""
    rows = [line.split() for line in Path(path).read_text().splitlines()]
    numbers = [row for row in rows if len(row) == 3 and row[0].isdigit()]
    first = min(int(row[0]) for row in numbers)
    return {int(row[0]) - first: (float(row[1]), float(row[2])) for row in numbers}


@dataclass
class Measurement:
    """What one run of one code gave."""
    rate: float  # particle-steps/s
    searches: float  # neighbour searches in 1000 timed steps
    share: float  # of its cores that it got
    stress: tuple  # mean stress xx, yy after the first steps [Pa]
    forces: dict  # on the discs of the frozen packing


class Packing:
    """Our packing and the numbers of its laws, as the peers get them."""

    def __init__(self, specimen, folder, cores):
        self.specimen, self.folder = specimen, folder
        text, _ = start([ours_program(), "write", specimen, folder], folder / "write.log", cores, 1)
        self.settings = named_numbers(text)
        self.discs = [line.split() for line in (folder / "discs.txt").read_text().splitlines()]
        self.forces = read_forces(folder / "forces.txt")

    def write_data(self, path, density_of, bonded):
        """The data file of LAMMPS and LIGGGHTS; `density_of` gives the density that makes a disc of a particle of this radius.
        With bonds the discs have a number of their molecule as well."""
        s = self.settings
        bonds = (self.folder / "bonds.txt").read_text().splitlines() if bonded else []
        lines = ["Discs of Clathra, one metre deep", "", f"{len(self.discs)} atoms", "2 atom types"]
        lines += [f"{len(bonds)} bonds", "1 bond types"] * bonded
        lines += ["", f"{s['left']!r} {s['right']!r} xlo xhi", f"{s['bottom']!r} {s['top']!r} ylo yhi", "-0.5 0.5 zlo zhi", "",
                  "Atoms", ""]
        for number, x, y, radius in self.discs:
            first = f"{int(number) + 1} 1" + " 1" * bonded
            lines.append(f"{first} {2 * float(radius)!r} {density_of(float(radius))!r} {x} {y} 0")
        lines += ["", "Bonds", ""] * bonded
        for number, bond in enumerate(bonds):
            a, b = bond.split()
            lines.append(f"{number + 1} 1 {int(a) + 1} {int(b) + 1}")
        path.write_text("\n".join(lines) + "\n")


def measurement_of(text, share, log, packing, steps, forces):
    """A measurement from an output of lines `name number`."""
    n = named_numbers(text)
    if "loop" not in n:
        raise Failed(f"no loop time in {log}")
    return Measurement(steps * len(packing.discs) / n["loop"], 1000 * n["searches"] / steps, share,
                       (n["stress_xx"], n["stress_yy"]), forces)


def ours_program():
    return project / "build/release/perf/peers/peers_ours"


class Ours:
    name = "Clathra"
    laws = {"frictional": "springs, friction", "rolling": "springs, friction, rolling",
            "bonded": "springs, friction, rolling, bonds (55 %)",
            "rolling-mixed": "springs, friction, rolling; mixed precision",
            "bonded-mixed": "springs, friction, rolling, bonds (55 %); mixed precision"}

    def run(self, packing, law, cores, check, steps):
        log = packing.folder / f"clathra-{law}-{len(cores)}.log"
        words = [ours_program(), "run", packing.specimen, law, repr(packing.settings["dt"]), check, steps]
        return measurement_of(*start(words, log, cores, len(cores)), log, packing, steps, packing.forces)


class Packaged:
    """A code that Debian packages."""
    package = None

    def version(self):
        return version(self.package)

    def has(self, law):
        return law in self.laws


class Lammps(Packaged):
    """LAMMPS, and LIGGGHTS which has its input language. The lever of their rolling laws is R_eff = Rbar / 2, so that our
    k_m = k_n beta^2 Rbar^2 / 12 is a spring of k_n beta^2 / 3 there, and our |M| <= F_n beta Rbar / 6 a coefficient of beta / 3."""
    name, package, program, input = "LAMMPS", "lammps", "lmp", "lammps.in"
    laws = {"frictional": "gran/hooke/history", "rolling": "granular, rolling sds",
            "bonded": "granular, rolling sds, bpm/rotational"}

    def __init__(self, program=None):
        """With `program` instead of Debian's."""
        if program:
            self.package, self.program = None, os.path.abspath(shutil.which(program))

    def help(self):
        return subprocess.run([self.program, "-h"], capture_output=True, text=True).stdout

    def version(self):
        return super().version() if self.package else re.search(r"Parallel Simulator - (.*)", self.help())[1]

    def has(self, law):
        return law in self.laws and (law != "bonded" or "bpm/rotational" in self.help())

    def density_of(self, packing, radius):
        """The mass of a sphere is 4/3 pi r^3 times this density: that of a disc one metre deep."""
        return 0.75 * packing.settings["density"] / radius

    def variables(self, packing, law, check, steps):
        s = packing.settings
        names = ("dt", "skin", "kn", "ks", "friction", "left", "right", "bottom", "top")
        values = {name: repr(s[name]) for name in names}
        parts = ("normal", "shear", "rolling", "rolling")  # rolling for twisting too, which discs do not do
        bond = {f"bond_{name}": " ".join(repr(s[f"bond_{part}_{name}"]) for part in parts) for name in ("stiffness", "strength")}
        return values | bond | {"data": packing.folder / f"{self.name.lower()}-{law}.data",
                                "forces": packing.folder / f"{self.name.lower()}-{law}.forces", "law": law, "check": check,
                                "steps": steps, "rolling_stiffness": repr(s["kn"] * s["shape_factor"]**2 / 3),
                                "rolling_friction": repr(s["shape_factor"] / 3), "longest": repr(1.5 * s["longest_bond"])}

    def run(self, packing, law, cores, check, steps):
        log = packing.folder / f"{self.name.lower()}-{law}-{len(cores)}.log"
        words = ["mpirun", "--bind-to", "none", "--oversubscribe", "-np", len(cores)] if len(cores) > 1 else []
        words += [self.program, "-in", here / self.input, "-log", "none"]
        values = self.variables(packing, law, check, steps)
        packing.write_data(values["data"], lambda radius: self.density_of(packing, radius), law == "bonded")
        for name, value in values.items():
            words += ["-var", name, value]
        text, share = start(words, log, cores, 1)
        loops = re.findall(r"^Loop time of ([\d.e+-]+) on", text, re.MULTILINE)
        stress = re.search(rf"^\s*{check} +(\S+) +(\S+)\s*$", text, re.MULTILINE)
        if len(loops) != 3 or not stress:
            raise Failed(f"{self.name}: no loop time or no stress in {log}")
        searches = re.findall(r"^Neighbor list builds = (\d+)", text, re.MULTILINE)
        return Measurement(steps * len(packing.discs) / float(loops[-1]), 1000 * int(searches[-1]) / steps, share,
                           (float(stress[1]), float(stress[2])), read_forces(values["forces"]))


class Liggghts(Lammps):
    name, package, program, input = "LIGGGHTS", "liggghts", "liggghts", "liggghts.in"
    laws = {"frictional": "hooke/stiffness, history", "rolling": "hooke/stiffness, history, epsd2"}

    def density_of(self, packing, radius):
        """LIGGGHTS takes pi r^2 in two dimensions."""
        return packing.settings["density"]

    def variables(self, packing, law, check, steps):
        return super().variables(packing, law, check, steps) | {"rolling": "off" if law == "frictional" else "epsd2"}


class Yade(Packaged):
    name, package = "YADE", "yade"
    laws = {"frictional": "FrictPhys_CundallStrack", "bonded": "CohFrictPhys_CohesionMoment"}

    def run(self, packing, law, cores, check, steps):
        folder = packing.folder
        settings = dict(packing.settings, law=law, check=check, steps=steps, discs=str(folder / "discs.txt"),
                        forces=str(folder / f"yade-{law}.forces"))
        (folder / "yade.json").write_text(json.dumps(settings))
        words = ["yade", "-n", "-x", f"-j{len(cores)}", here / "yade.py", folder / "yade.json"]
        log = folder / f"yade-{law}-{len(cores)}.log"
        return measurement_of(*start(words, log, cores, len(cores)), log, packing, steps, read_forces(settings["forces"]))


def version(package):
    """The version of an installed Debian package, or nothing."""
    if not shutil.which("dpkg-query"):
        return ""
    query = ["dpkg-query", "--show", "--showformat", "${db:Status-Status} ${Version}", package]
    status, _, number = subprocess.run(query, capture_output=True, text=True).stdout.partition(" ")
    return re.split(r"[+.](?:git|repack|ds)|-\d", number)[0] if status == "installed" else ""


def force_difference(ours, theirs):
    """Largest difference of a force component over the mean force on a disc."""
    mean = sum(math.hypot(*force) for force in ours.values()) / len(ours)
    if ours.keys() != theirs.keys():
        return math.inf
    return max(max(abs(f[0] - theirs[i][0]), abs(f[1] - theirs[i][1])) for i, f in ours.items()) / mean


def stress_difference(ours, theirs):
    """Largest relative difference of a principal stress."""
    return max(abs(b / a - 1) for a, b in zip(ours, theirs))
