"""Runs and studies of Clathra in Python.

    import clathra
    run = clathra.open_run("out")              # a folder of `clathra run`
    run.history["q_Pa"].max()                  # a pandas DataFrame; run.history.attrs["units"] has the units
    run.snapshots[-1].particles["position"]    # NumPy arrays, SI units
    study = clathra.open_study("out/study")    # a folder of `clathra study`
    study.means[["group", "peak_q_Pa"]]
    clathra.run({"specimen": {"particles": 2000}, "hydrate": {"saturation": "55 %"}}, "out/s55")

All numbers are in SI units, compression is positive. Needs NumPy, pandas and h5py (Debian: python3-pandas python3-h5py).
"""
from . import program
from .program import ClathraError, check, run, study
from .results import Run, Study, open_run, open_study, units_of
from .states import Columns, Snapshot, Specimen

__all__ = ["ClathraError", "Columns", "Run", "Snapshot", "Specimen", "Study", "check", "open_run", "open_study", "run", "study", "units_of"]
