"""Folders that `clathra run` and `clathra study` wrote."""
from __future__ import annotations

import glob
import json
import os
from functools import cached_property
from typing import List, Union

import pandas

from .states import Snapshot, Specimen

Path = Union[str, "os.PathLike[str]"]

_ENDINGS = {"Pa": "Pa", "s": "s", "m": "m", "m2": "m^2", "pct": "%", "deg": "deg", "rad": "rad", "degC": "degC", "K": "K"}


def units_of(column: str) -> str:
    """The unit of a column by its name: "q_Pa" is in Pa, "time_s" in s, energies "..._J_per_m" in J per metre of thickness, shares
    "..._pct" in %. What has no such ending, strains (natural ones) among it, is a plain number: ""."""
    if column.endswith("_per_s"):
        return "1/s"
    if column.endswith("_per_Pa"):
        return "1/Pa"
    if column.endswith("_J_per_m"):
        return "J/m"
    return _ENDINGS.get(column.rpartition("_")[2], "") if "_" in column else ""


def _table(path):
    table = pandas.read_csv(path, keep_default_na=False, na_values=["", "nan"], float_precision="round_trip")
    for whole in {"seed", "n"} & set(table.columns):
        table[whole] = table[whole].astype("Int64")
    table.attrs["units"] = {name: units_of(name) for name in table.columns}
    return table


class Run:
    """The folder of a run. What is read is kept: open it again to see what a running test has written since."""

    def __init__(self, folder: Path) -> None:
        """Raises FileNotFoundError where there is no run."""
        self.folder = os.fspath(folder)
        path = os.path.join(self.folder, "run.json")
        if not os.path.isfile(path):
            raise FileNotFoundError(f"{self.folder}: is not the folder of a run, it has no run.json")
        with open(path, encoding="utf-8") as file:
            self.record = json.load(file)

    def __repr__(self):
        return f"<Run {self.folder}: {self.record['exit']['reason']}>"

    @property
    def finished(self) -> bool:
        return self.record["exit"]["reason"] == "finished"

    @property
    def scene(self) -> dict:
        """The scene by sections, SI units: run.scene["test"]["confining_stress"]."""
        return self.record["scene"]

    @property
    def numbers(self) -> dict:
        """Peak, residual, dilation angle and the other numbers of the test, by their names in run.json."""
        return self.record["stages"].get("shear", {})

    @cached_property
    def stages(self) -> pandas.DataFrame:
        """The whole of history.csv, with all stages of the test; column `stage` names them."""
        return _table(os.path.join(self.folder, "history.csv"))

    def _rows(self, of_loading):
        stage = self.stages.get("stage", pandas.Series("shear", self.stages.index))
        rows = self.stages[~stage.isin(["consolidation", "consolidation with hydrate"]) == of_loading].reset_index(drop=True)
        rows.attrs["units"] = self.stages.attrs["units"]
        return rows

    @cached_property
    def history(self) -> pandas.DataFrame:
        """The rows of the loading in history.csv, all but the consolidation; `history.attrs["units"]` has the unit of each column."""
        return self._rows(of_loading=True)

    @cached_property
    def consolidation(self) -> pandas.DataFrame:
        """The rows of the consolidation, with strains since it began: `run.consolidation.plot("p_Pa", "void_ratio")`."""
        return self._rows(of_loading=False)

    @cached_property
    def events(self) -> pandas.DataFrame:
        """Every broken bond: events.csv as a DataFrame, with more columns where output.event_details asked for them. Raises
        FileNotFoundError where the run kept none."""
        return _table(os.path.join(self.folder, "events.csv"))

    @cached_property
    def snapshots(self) -> List[Snapshot]:
        """Snapshots in the order of their steps; each reads its arrays when they are asked for."""
        return [Snapshot(path) for path in sorted(glob.glob(os.path.join(glob.escape(self.folder), "snap", "*.h5")))]

    def snapshot_at(self, eps1: float) -> Snapshot:
        """The snapshot nearest to an axial strain. Raises LookupError where there are none."""
        if not self.snapshots:
            raise LookupError(f"{self.folder} has no snapshots")
        return min(self.snapshots, key=lambda snapshot: abs(snapshot.eps1 - eps1))

    @property
    def specimen(self) -> Specimen:
        """The specimen that the run made and tested. Where it read one: FileNotFoundError, that file has it."""
        return Specimen(os.path.join(self.folder, "specimen.h5"))

    @property
    def final(self) -> Specimen:
        """The specimen at the end."""
        return Specimen(os.path.join(self.folder, "final.h5"))

    @property
    def label(self) -> str:
        """"55 %, 1 MPa": saturation and confining stress."""
        return f"{100 * self.scene['hydrate']['saturation']:g} %, {self.scene['test']['confining_stress'] / 1e6:g} MPa"


class Study:
    """The folder of a study."""

    _STATISTICS = {"mean": "mean", "standard_deviation": "standard_deviation", "interval_low": "low", "interval_high": "high"}

    def __init__(self, folder: Path) -> None:
        """Raises FileNotFoundError where there is no study."""
        self.folder = os.fspath(folder)
        path = os.path.join(self.folder, "study.csv")
        if not os.path.isfile(path):
            raise FileNotFoundError(f"{self.folder}: is not the folder of a study, it has no study.csv")
        self.table = _table(path)

    def __repr__(self):
        return f"<Study {self.folder}: {len(self.members)} members of {self.members['group'].nunique()} groups>"

    def _rows(self, kind):
        return self.table[self.table["row"] == kind].drop(columns="row").dropna(axis="columns", how="all").reset_index(drop=True)

    @cached_property
    def members(self) -> pandas.DataFrame:
        """A row for each member: its group, a label, what it varies (SI units), its seed, its state, its warnings, its numbers."""
        return self._rows("member")

    @cached_property
    def envelopes(self) -> pandas.DataFrame:
        """A row for each Mohr-Coulomb envelope, one of each material and seed."""
        return self._rows("envelope")

    @cached_property
    def means(self) -> pandas.DataFrame:
        """A row for each group (and material): means over `n` seeds; where fewer seeds have some numbers, these have a row of their
        own with that `n`."""
        return self._rows("mean")

    def interval(self, number: str) -> pandas.DataFrame:
        """A row for each group that has this number: of how many seeds (n), mean, standard_deviation, and low and high of the 95 %
        interval."""
        if number not in self.table:
            raise KeyError(f"{number}: no such number in {self.folder}/study.csv")
        rows = self.table[self.table["row"].isin(self._STATISTICS) & self.table[number].notna()]
        wide = rows.pivot(index=["group", "n"], columns="row", values=number).rename(columns=self._STATISTICS).reset_index()
        wide.columns.name = None
        order = list(dict.fromkeys(rows["group"]))
        wide = wide.sort_values("group", key=lambda groups: groups.map(order.index)).reset_index(drop=True)
        return wide.reindex(columns=["group", "n", *self._STATISTICS.values()])

    def run(self, group: str, seed: int) -> Run:
        """The run of a member."""
        return Run(os.path.join(self.folder, "members", f"{group}-seed{seed}"))

    def runs(self, group: str) -> List[Run]:
        """The finished runs of a group, in the order of study.csv; none where all its members failed. Raises KeyError where there is
        no such group."""
        rows = self.members[self.members["group"] == group]
        if rows.empty:
            raise KeyError(f"{group}: no group of {self.folder} has that name; there are {', '.join(dict.fromkeys(self.members['group']))}")
        return [self.run(group, int(seed)) for seed in rows["seed"][rows["state"] == "finished"]]


def open_run(folder: Path) -> Run:
    """The run in a folder. Raises FileNotFoundError."""
    return Run(folder)


def open_study(folder: Path) -> Study:
    """The study in a folder. Raises FileNotFoundError."""
    return Study(folder)
