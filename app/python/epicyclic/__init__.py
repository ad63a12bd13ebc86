"""Results of the program epicyclic in Python.

A result folder becomes one object::

    import epicyclic as ep

    result = ep.open("out/speed")
    result.points           # DataFrame: one row for each computed point
    result.plot()           # bifurcation diagram
    result.to_xarray()      # Dataset over direction, value and planet

numpy is required. h5py reads ``results.h5``; without it the CSV tables are read. pandas, xarray and
matplotlib are imported when a method needs them.
"""

from ._errors import ResultError
from ._results import (
    Basins,
    Branches,
    Calibration,
    Crosscheck,
    Gear,
    Map,
    Result,
    Robustness,
    Run,
    Scorecard,
    Sweep,
    Tolerance,
    open,
)

__all__ = [
    "Basins",
    "Branches",
    "Calibration",
    "Crosscheck",
    "Gear",
    "Map",
    "Result",
    "ResultError",
    "Robustness",
    "Run",
    "Scorecard",
    "Sweep",
    "Tolerance",
    "open",
]
