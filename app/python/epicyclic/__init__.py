"""The program epicyclic in Python: results, computations, and one's own oscillators.

A result folder becomes one object::

    import epicyclic as ep

    result = ep.open("out/speed")
    result.points           # DataFrame: one row for each computed point
    result.plot()           # bifurcation diagram
    result.to_xarray()      # Dataset over direction, value and planet

A stage computes, and so does a system of one's own, if the package has its compiled module::

    stage = ep.Stage.load("inputs/tang2020.json")
    result = stage.sweep(parameter="mesh_frequency_ratio", from_=1.8, to=2.2, points=41)
    duffing = ep.System(f, 2, {"force": 0.3}, period=5.2)
    duffing.regime([0.0, 0.0])

numpy is required. h5py reads ``results.h5``; without it the CSV tables are read. pandas, xarray and
matplotlib are imported when a method needs them.
"""

from ._errors import InputError, NumericalError, OutputError, Problem, ResultError
from ._results import (
    Basins,
    Branches,
    Calibration,
    Crosscheck,
    Gear,
    Map,
    Ramp,
    Result,
    Robustness,
    Run,
    Scorecard,
    Sweep,
    Tolerance,
    open,
)
from ._stage import Stage
from ._system import Branch, Exponents, Orbit, Regime, Section, SpecialPoint, System

__all__ = [
    "Basins",
    "Branch",
    "Branches",
    "Calibration",
    "Crosscheck",
    "Exponents",
    "Gear",
    "InputError",
    "Map",
    "NumericalError",
    "Orbit",
    "OutputError",
    "Problem",
    "Ramp",
    "Regime",
    "Result",
    "ResultError",
    "Robustness",
    "Run",
    "Scorecard",
    "Section",
    "SpecialPoint",
    "Stage",
    "Sweep",
    "System",
    "Tolerance",
    "open",
]
