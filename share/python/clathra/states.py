"""Snapshots and specimens: HDF5 files, as NumPy arrays."""
import os
from functools import cached_property
from typing import Any

import h5py
import numpy as np


def _text(value):
    return value.decode() if isinstance(value, bytes) else value


class Columns(dict):
    """NumPy arrays by name, of one length. `units` has the unit of each that has one."""

    def __init__(self, group):
        super().__init__((name, dataset[()]) for name, dataset in group.items())
        self.units = {name: _text(dataset.attrs["unit"]) for name, dataset in group.items() if "unit" in dataset.attrs}

    def __len__(self):
        """The number of rows."""
        return len(next(iter(self.values()))) if self.keys() else 0


class _State:
    """What snapshots and specimens have in common. Scalars of the file (eps1, d50, left, ...) are attributes."""

    _format = None

    def __init__(self, path: "os.PathLike[str] | str") -> None:
        """Raises FileNotFoundError, or ValueError where the file is something else."""
        self.path = os.fspath(path)
        if not os.path.isfile(self.path):
            raise FileNotFoundError(self.path)
        if not h5py.is_hdf5(self.path):
            raise ValueError(f"{self.path}: is not an HDF5 file")
        with h5py.File(self.path, "r") as file:
            self.attributes = {name: _text(value) for name, value in file.attrs.items()}
        if self.attributes.get("format") != self._format:
            raise ValueError(f"{self.path}: is no {self._format}")

    def __getattr__(self, name: str) -> Any:
        attributes = self.__dict__.get("attributes", {})
        if name in attributes:
            return attributes[name]
        raise AttributeError(f"{type(self).__name__} of {self.__dict__.get('path')} has no {name}; it has {', '.join(sorted(attributes))}")

    def _columns(self, group):
        with h5py.File(self.path, "r") as file:
            return Columns(file[group])

    @cached_property
    def particles(self) -> Columns:
        """A row for each particle, in no order but that of the file; `id` is its identity."""
        return self._columns("particles")

    @cached_property
    def contacts(self) -> Columns:
        """A row for each pair that touches or is or was bonded."""
        return self._columns("contacts")

    @property
    def walls(self) -> np.ndarray:
        """(left, right, bottom, top) [m]."""
        return np.array([self.attributes[side] for side in ("left", "right", "bottom", "top")])


class Snapshot(_State):
    """A moment of a test: RUN/snap/*.h5. `contacts["pair"]` are places in `particles`."""

    _format = "clathra snapshot"

    @cached_property
    def events(self) -> Columns:
        """Bonds that broke since the snapshot before."""
        return self._columns("events")

    def __repr__(self):
        return f"<Snapshot at eps1 = {100 * self.eps1:.3g} %, {self.attributes['particles']} particles>"


class Specimen(_State):
    """A specimen: of `clathra generate`, or specimen.h5 and final.h5 of a run."""

    _format = "clathra specimen"

    def __repr__(self):
        return f"<Specimen of {self.attributes['particles']} particles, void ratio {self.void_ratio:.4f}>"
