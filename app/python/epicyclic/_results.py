"""Result folders as objects, one class for each kind of study."""

from __future__ import annotations

import hashlib
import html
import json
import re
from pathlib import Path
from typing import Any, Dict, List, Optional, Tuple, Type, Union

import numpy as np

from ._errors import InputError, ResultError, needed, repr_of, word_of
from ._tables import Array, Hdf5, Table, csv_header, read_csv

_SPEEDS = {"rpm": "sun_speed_rpm", "Hz": "mesh_frequency_Hz"}


class Result:
    """A finished result folder.

    Attributes
    ----------
    folder
        Its path.
    kind
        Kind of the study, such as ``"sweep"``.
    input
        The complete study: ``input.resolved.json``.
    run
        What ``run.json`` records: versions, host, times, files.
    """

    #: CSV file behind ``points``, and its group in results.h5.
    _points: Tuple[str, str] = ("points", "points")
    #: CSV files that have no group of their name with the same rows.
    _csv_only: Tuple[str, ...] = ()

    def __init__(self, folder: Path, kind: str, resolved: Dict[str, Any], run: Dict[str, Any]) -> None:
        self.folder = folder
        self.kind = kind
        self.input = resolved
        self.run = run
        self._hdf5 = Hdf5(folder / "results.h5")
        self._read: Dict[str, Table] = {}

    # -- tables

    @property
    def tables(self) -> List[str]:
        """Names of all tables: the CSV files without their ending."""
        return sorted(file.stem for file in self.folder.glob("*.csv"))

    def table(self, name: str) -> Any:
        """Return one table as a pandas DataFrame of a row per line.

        Parameters
        ----------
        name
            One of ``tables``, such as ``"poincare"``.

        Returns
        -------
        pandas.DataFrame
            ``attrs["units"]`` and ``attrs["meaning"]`` describe columns that results.h5 has too.

        Raises
        ------
        ResultError
            If there is no such table, or it is damaged.
        """
        return self._table(name).frame()

    @property
    def points(self) -> Any:
        """The main table as a pandas DataFrame: one row for each computed point."""
        return self.table(self._points[0])

    @property
    def units(self) -> Dict[str, str]:
        """Unit of each column of ``points``; empty without h5py."""
        return dict(self._table(self._points[0]).units)

    def _table(self, name: str) -> Table:
        if name not in self._read:
            file = self.folder / f"{name}.csv"
            if name not in self.tables:
                raise ResultError(f"{self.folder}: has no table {word_of(name)}; it has {', '.join(self.tables) or 'none'}")
            header = csv_header(file)
            group = self._points[1] if name == self._points[0] else name
            found = None if name in self._csv_only else self._hdf5.table(group, header)
            if found is not None and header and set(header) <= set(found.columns):
                table = Table({column: found.columns[column] for column in header}, found.units, found.meanings)
            else:
                table = read_csv(file)
                # A group with other rows still knows the units.
                if found is not None:
                    known = [column for column in table.columns if column in found.units]
                    table.units = {column: found.units[column] for column in known}
                    table.meanings = {c: found.meanings[c] for c in known if c in found.meanings}
            self._read[name] = table
        return self._read[name]

    # -- what the study says

    @property
    def name(self) -> str:
        """Name of the study, or of the stage if the study has none."""
        return str(self.input.get("name") or self._stage.get("name") or self.folder.name)

    @property
    def study(self) -> Dict[str, Any]:
        """The object ``study`` of the input."""
        study = self.input.get("study", {})
        return study if isinstance(study, dict) else {}

    @property
    def parameter(self) -> Optional[str]:
        """Name of the parameter that is varied, or None."""
        parameter = self.study.get("parameter")
        return None if parameter is None else str(parameter)

    @property
    def planets(self) -> int:
        """Number of planets."""
        planets = self._stage.get("planets", {})
        for key in ("count", "number"):
            if isinstance(planets, dict) and isinstance(planets.get(key), (int, float)):
                return int(planets[key])
        return self._planets_of(list(self._table(self._points[0]).columns)) if self.tables else 0

    @property
    def _stage(self) -> Dict[str, Any]:
        stage = self.input.get("stage", self.input)
        return stage if isinstance(stage, dict) else {}

    @staticmethod
    def _planets_of(names: List[str]) -> int:
        """Count the planets by names with ``_sp_1``, ``_sp_2`` and so on."""
        numbers = [int(m.group(1)) for n in names for m in [re.search(r"_sp_(\d+)(?:_|$)", n)] if m]
        return max(numbers, default=0)

    @property
    def summary(self) -> str:
        """The results in words, as the program wrote them: ``sweep.md``, ``continue.md`` and so on.

        Of a sweep: ranges of regimes, changes, coexisting attractors, largest forces, and what is not certain.

        Raises
        ------
        ResultError
            If the program writes no such file for this kind.
        """
        for name in (f"{self.kind}.md", "summary.md"):
            if (self.folder / name).is_file():
                return (self.folder / name).read_text(encoding="utf-8")
        raise ResultError(f"{self.folder}: a {self.kind} has no results in words")

    @property
    def warnings(self) -> List[str]:
        """What a reader should know before the numbers are used: a sentence each."""
        said: List[str] = []
        if not self._hdf5.installed and (self.folder / "results.h5").exists():
            said.append("h5py is not installed: tables are read from CSV files, and units are not known")
        counts = self.run.get("counts", {})
        if counts.get("undrawn"):
            said.append(f"{counts['undrawn']} figures were not drawn by the program")
        if self._points[0] in self.tables:
            columns = self._table(self._points[0]).columns
            said += self._row_warnings(columns)
        for file, size in self._changed():
            said.append(f"{file} has {size} bytes, not as many as the program wrote: it was changed")
        return said

    @staticmethod
    def _row_warnings(columns: Dict[str, Array]) -> List[str]:
        said = []
        if "status" in columns:
            for status in sorted(set(columns["status"]) - {"ok"}):
                said.append(f"{int(np.sum(columns['status'] == status))} points have status {status}")
        if "regime" in columns and np.any(columns["regime"] == "undecided"):
            said.append(f"{int(np.sum(columns['regime'] == 'undecided'))} points have the regime undecided")
        for name in ("converged", "settled"):
            if name in columns and columns[name].dtype.kind in "if" and np.any(columns[name] == 0):
                count = int(np.sum(columns[name] == 0))
                said.append(f"the record of {count} points had not converged to the orbit")
        return said

    def _changed(self) -> List[Tuple[str, int]]:
        found = []
        for name, facts in sorted(self.run.get("files", {}).items()):
            file = self.folder / name
            if "/" not in name and file.is_file() and file.stat().st_size != facts.get("bytes"):
                found.append((name, file.stat().st_size))
        return found

    def verify(self) -> None:
        """Compare size and SHA-256 of each file with ``run.json``.

        Raises
        ------
        ResultError
            If a file is missing or differs; the message names all such files.
        """
        wrong = []
        for name, facts in sorted(self.run.get("files", {}).items()):
            file = self.folder / name
            if not file.is_file():
                wrong.append(f"{name} is missing")
            elif hashlib.sha256(file.read_bytes()).hexdigest() != facts.get("sha256"):
                wrong.append(f"{name} differs")
        if wrong:
            raise ResultError(
                f"{self.folder}: {', '.join(wrong)}; repeat the command of the folder to restore the files"
            )

    # -- points

    def near(self, value: float, direction: Optional[str] = None, by: Optional[str] = None) -> Any:
        """Return the computed point that is nearest to a value.

        Parameters
        ----------
        value
            In the unit of the column `by`.
        direction
            ``"up"`` or ``"down"``; both if it is None.
        by
            Column with the value. ``"rpm"`` is the speed of the sun, ``"Hz"`` the mesh frequency. The
            default is the varied parameter in the unit of the study.

        Returns
        -------
        pandas.Series
            The row of ``points``; its ``name`` is the number of the row.

        Raises
        ------
        ResultError
            If there is no such column, no point with a finite value, or no point with a value as small
            or as large, such as for a speed in rpm where the study varies the mesh frequency ratio.
        """
        table = self._table(self._points[0])
        column = self._value_column(by)
        values = table.columns[column]
        if values.dtype.kind not in "if":
            raise ResultError(f"{self.folder}: column {column} has texts, not numbers")
        try:
            value = float(value)
        except (OverflowError, TypeError, ValueError):
            raise ResultError(f"{self.folder}: {repr_of(value)} is no number to be near to") from None
        distance = np.abs(values.astype(float) - value)
        if direction is not None:
            if "direction" not in table.columns:
                raise ResultError(f"{self.folder}: points have no direction")
            distance = np.where(table.columns["direction"] == direction, distance, np.nan)
        if not np.any(np.isfinite(distance)):
            raise ResultError(
                f"{self.folder}: no point has a known {column}"
                + ("" if direction is None else f" in direction {word_of(direction)}")
            )
        known = np.unique(values.astype(float)[np.isfinite(distance)])
        spacing = (known[-1] - known[0]) / max(known.size - 1, 1)
        if not known[0] - spacing <= value <= known[-1] + spacing:
            raise ResultError(
                f"{self.folder}: {value:g} is outside of {column}, which is {known[0]:g} to {known[-1]:g}; "
                'by="rpm" takes the speed of the sun, by="Hz" the mesh frequency'
            )
        return self.points.iloc[int(np.nanargmin(distance))]

    def _value_column(self, by: Optional[str]) -> str:
        columns = self._table(self._points[0]).columns
        if by is None:
            # A study may give its range in rpm or Hz; the column value has the mesh frequency ratio.
            by = self.parameter if self.parameter in columns else "value"
        by = _SPEEDS.get(by or "value", by or "value")
        if by not in columns:
            raise ResultError(f"{self.folder}: points have no column {word_of(by)}")
        return by

    def section(self, point: Any) -> Any:
        """Return the Poincaré points of one point.

        Parameters
        ----------
        point
            Number of the point: column ``point`` of ``points``. A row of ``points``, as ``near`` returns
            it, is possible too.

        Returns
        -------
        pandas.DataFrame
            Shape (Poincaré points, columns): states and deflections in b_c, rates in b_c per τ.

        Raises
        ------
        ResultError
            If the folder has no Poincaré points, or no such point.
        """
        (number,) = (int(point),) if isinstance(point, (int, np.integer)) else self._of_row(point, "point")
        points = self._table("points").columns["point"] if "points" in self.tables else np.array([])
        if number not in points:
            raise ResultError(f"{self.folder}: there is no point {number}; numbers go from 0 to {len(points) - 1}")
        if "poincare" not in self.tables:
            raise ResultError(f"{self.folder}: a {self.kind} has no Poincaré points")
        table = self._table("poincare")
        if "point" in table.columns:
            table = table.rows(np.flatnonzero(table.columns["point"] == number))
        return table.frame()

    def run_at(
        self, point: Any, *, out: Union[None, str, Path] = None, threads: Optional[int] = None, progress: Any = None,
        **keys: Any,
    ) -> Run:
        """Compute one point again with all results, as ``epicyclic run --from``.

        The initial state is that of the point, so the response is on the same attractor. Stage, model and integrator are
        those of this folder. The package needs its compiled module.

        Parameters
        ----------
        point
            Number of the point: column ``point`` of ``points``; or a row of ``points``, as ``near`` returns it.
        out, threads, progress
            As of ``Stage.sweep``.
        **keys
            Keys of the study of kind ``run``, such as ``exponent_periods=2000``.

        Raises
        ------
        ResultError
            If there is no such point, or no point of this kind has a state.
        """
        from ._jobs import Job
        from ._stage import assignment, without_file

        if self.kind not in ("sweep", "map", "basins", "run"):
            raise ResultError(f"{self.folder}: points of a {self.kind} have no state to start from")
        (number,) = (int(point),) if isinstance(point, (int, np.integer)) else self._of_row(point, "point")
        if not 0 <= number < len(self._table("points")):
            raise ResultError(f"{self.folder}: there is no point {number} of {len(self._table('points'))}")
        sets = [assignment(f"/study/{key[:-1] if key.endswith('_') else key}", value) for key, value in keys.items()]
        try:
            found = Job("run", None, out, threads, progress, origins=[f"{self.folder}:{number}"], sets=sets).wait()
        except InputError as error:
            without_file(error)
        assert isinstance(found, Run)
        return found

    def _of_row(self, row: Any, *names: str) -> Tuple[int, ...]:
        """Return numbers in a row of ``points``."""
        try:
            return tuple(int(row[name]) for name in names)
        except (IndexError, KeyError, OverflowError, TypeError, ValueError):
            raise ResultError(f"{self.folder}: {repr_of(row)} is no number of a point and no row of points") from None

    # -- xarray

    def to_xarray(self) -> Any:
        """Return ``points`` as an xarray Dataset over one dimension, ``point``."""
        return self._dataset(self._table(self._points[0]), ("point",), None)

    def _dataset(self, table: Table, dims: Tuple[str, ...], shape: Optional[Tuple[int, ...]],
                 cell: Optional[Array] = None, coords: Optional[Dict[str, Any]] = None) -> Any:
        """Make a Dataset.

        Parameters
        ----------
        table
            Its columns have shape (rows,).
        dims, shape
            Names and lengths of the dimensions of a row; shape None: one dimension of all rows.
        cell
            Shape (rows,): flat index of each row in an array of `shape`. Cells without a row are NaN or "".
        coords
            Arrays by dimension.
        """
        xarray = needed("xarray", "a Dataset")
        size = (len(table),) if shape is None else shape

        def placed(values: Array) -> Array:
            if cell is None:
                return values.reshape(size)
            whole = len(cell) == int(np.prod(size))
            if values.dtype.kind == "O":
                result: Array = np.full(int(np.prod(size)), "", dtype=object)
            elif values.dtype.kind == "i" and whole:
                result = np.zeros(int(np.prod(size)), dtype=np.int64)
            else:
                result = np.full(int(np.prod(size)), np.nan)
            result[cell] = values
            return result.reshape(size)

        names = [name for name in table.columns if name not in dims or (name == "point" and "point" not in dims)]
        variables: Dict[str, Any] = {}
        planets = self._planets_of(names)
        done = set()
        for name in names:
            if name in done:
                continue
            attrs: Dict[str, str] = {}
            if name in table.units:
                attrs["units"] = table.units[name]
            if name in table.meanings:
                attrs["long_name"] = table.meanings[name]
            family = _family(name, names, planets)
            if family is None:
                variables[name] = (dims, placed(table.columns[name]), attrs)
                continue
            base, members = family
            done.update(members)
            stacked = np.stack([placed(table.columns[member]) for member in members], axis=-1)
            if "long_name" in attrs:
                attrs["long_name"] = re.sub(r"(mesh|planet) 1\b", r"\1 i", attrs["long_name"])
            variables[base] = (dims + ("planet",), stacked, attrs)
        all_coords: Dict[str, Any] = {}
        if any("planet" in variable[0] for variable in variables.values()):
            all_coords["planet"] = ("planet", np.arange(1, planets + 1), {"long_name": "number of the planet"})
        if "point" in dims and "point" in table.columns:
            all_coords["point"] = ("point", table.columns["point"], {"long_name": "number of the point"})
        for dim, values in (coords or {}).items():
            all_coords[dim] = values
        about = {"kind": self.kind, "title": self.name, "source": str(self.folder)}
        return xarray.Dataset(variables, all_coords, about)

    # -- figures

    def plot(
        self,
        quantity: Optional[str] = None,
        ax: Optional[Any] = None,
        direction: Optional[str] = None,
        label: Optional[str] = None,
    ) -> Any:
        """Draw a quantity.

        Parameters
        ----------
        quantity
            Name of a column; the main figure of the kind if it is None.
        ax
            matplotlib Axes to draw in; new ones if it is None.
        direction
            ``"up"`` or ``"down"``, for sweeps and maps. Sweeps draw both if it is None, maps the first.
        label
            Name of this result in the legend. Of several results in the same axes it is the name of the folder if it
            is None, and each has colours of its own.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        ResultError
            If there is no such quantity, or this kind has no figure.
        """
        from . import _plots

        return _plots.plot(self, quantity, ax, direction, label)

    # -- notebooks

    def _facts(self) -> List[Tuple[str, str]]:
        facts = [("folder", str(self.folder)), ("study", self.name), ("kind", self.kind)]
        if self.parameter is not None:
            facts.append(("parameter", self.parameter))
        if self._points[0] in self.tables:
            facts.append((f"{self._points[0]}.csv", f"{len(self._table(self._points[0]))} rows"))
            columns = self._table(self._points[0]).columns
            if "regime" in columns:
                regimes, counts = np.unique(columns["regime"].astype(str), return_counts=True)
                facts.append(("regimes", ", ".join(f"{c} {r or 'unknown'}" for r, c in zip(regimes, counts))))
        facts.append(("tables", ", ".join(self.tables)))
        facts.append(("program", f"epicyclic {self.run.get('version', '')}"))
        return facts

    def __repr__(self) -> str:
        """Return some lines: class, folder, study, numbers of points, warnings."""
        lines = [f"epicyclic.{type(self).__name__}"]
        lines += [f"  {key}: {_plain(value)}" for key, value in self._facts()]
        lines += [f"  warning: {_plain(text)}" for text in self.warnings]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        """Return a table for notebooks. Texts of the folder are escaped."""
        rows = "".join(
            f"<tr><th style='text-align:left'>{html.escape(key)}</th>"
            f"<td style='text-align:left'>{html.escape(_plain(value))}</td></tr>"
            for key, value in self._facts() + [("warning", text) for text in self.warnings]
        )
        return f"<table><caption>epicyclic.{type(self).__name__}</caption>{rows}</table>"


def _plain(text: str) -> str:
    """Replace control characters, so that a name cannot change a terminal."""
    return "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in text)


def _family(name: str, names: List[str], planets: int) -> Optional[Tuple[str, List[str]]]:
    """Find the columns that differ from `name` in the number of the planet.

    Returns
    -------
    (str, list of str) or None
        The common name, with i in place of the number, and the columns of planets 1, 2, ...
    """
    if planets < 2:
        return None
    for match in re.finditer(r"_(?:p|planet_)?(1)(?=_|$)", name):
        start, end = match.span(1)
        members = [f"{name[:start]}{planet}{name[end:]}" for planet in range(1, planets + 1)]
        if all(member in names for member in members):
            return f"{name[:start]}i{name[end:]}", members
    return None


class Sweep(Result):
    """A sweep of one parameter."""

    @property
    def directions(self) -> List[str]:
        """Directions in the order of the study."""
        return list(dict.fromkeys(self._table("points").columns["direction"]))

    def to_xarray(self) -> Any:
        """Return the points as an xarray Dataset.

        Returns
        -------
        xarray.Dataset
            Dimensions ``direction``, ``value`` (ascending) and, for columns of each planet, ``planet``:
            ``force_sp_1_max``, ``force_sp_2_max``, ... become ``force_sp_i_max``. Attributes of a
            variable: ``units`` and ``long_name``.
        """
        table = self._table("points")
        directions = self.directions
        values = np.unique(table.columns["value"])
        cell = _index(table.columns["direction"], directions) * len(values) + np.searchsorted(
            values, table.columns["value"]
        )
        coords = {"direction": directions, "value": ("value", values, {"long_name": self.parameter or "value"})}
        return self._dataset(table, ("direction", "value"), (len(directions), len(values)), cell, coords)


class Map(Result):
    """A map of two parameters."""

    def to_xarray(self) -> Any:
        """Return the cells as an xarray Dataset over direction, second_value, value and planet."""
        table = self._table("points")
        directions = list(dict.fromkeys(table.columns["direction"]))
        first = np.unique(table.columns["value"])
        second = np.unique(table.columns["second_value"])
        cell = (
            _index(table.columns["direction"], directions) * len(second)
            + np.searchsorted(second, table.columns["second_value"])
        ) * len(first) + np.searchsorted(first, table.columns["value"])
        coords = {
            "direction": directions,
            "second_value": ("second_value", second, {"long_name": self.axis_names[1]}),
            "value": ("value", first, {"long_name": self.axis_names[0]}),
        }
        shape = (len(directions), len(second), len(first))
        return self._dataset(table, ("direction", "second_value", "value"), shape, cell, coords)

    @property
    def axis_names(self) -> Tuple[str, str]:
        """Names of the first and the second parameter or component."""
        names = []
        for place in ("first", "second"):
            axis = self.study.get(place, {})
            names.append(str(axis.get("parameter", axis.get("component", place))))
        return names[0], names[1]


class Basins(Map):
    """Attractors over a plane of initial states."""

    @property
    def attractors(self) -> Any:
        """The table ``attractors`` as a DataFrame: one row for each attractor."""
        return self.table("attractors")


class Run(Result):
    """One operating point with all its quantities."""

    @property
    def history(self) -> Any:
        """States, deflections and forces over time: DataFrame with one row for each sample."""
        return self.table("history")

    @property
    def spectrum(self) -> Any:
        """Amplitude spectra: DataFrame with one row for each line of each signal."""
        return self.table("spectrum")

    def section(self, point: Any = 0) -> Any:
        """Return the Poincaré points: DataFrame of shape (Poincaré points, columns)."""
        return super().section(point)

    def to_xarray(self) -> Any:
        """Return the history as an xarray Dataset over ``time`` (samples) and ``planet``.

        The coordinates along ``time`` are ``periods`` (mesh periods), ``tau`` and ``time_s`` (s).
        """
        table = self._table("history")
        dataset = self._dataset(table, ("time",), None)
        return dataset.set_coords([name for name in ("periods", "tau", "time_s") if name in dataset])


class Branches(Result):
    """Branches of periodic orbits from ``continue``."""

    _points = ("branch", "branches")
    # branches.csv has one row for each branch; the group of this name has the orbits.
    _csv_only = ("branches",)

    @property
    def special(self) -> Any:
        """Special points (bifurcations, grazing) with error bounds: DataFrame, one row for each."""
        return self.table("special")

    @property
    def branches(self) -> Any:
        """One row for each branch: DataFrame."""
        return self.table("branches")

    @property
    def loci(self) -> Any:
        """Curves of special points in two parameters: DataFrame, one row for each of their points."""
        return self.table("loci")

    @property
    def multipliers(self) -> Array:
        """Floquet multipliers: complex array of shape (orbits, multipliers), by falling modulus."""
        real, imaginary = self._hdf5.array("multipliers/real"), self._hdf5.array("multipliers/imaginary")
        if real is None or imaginary is None:
            raise ResultError(f"{self.folder}: the multipliers are in results.h5 only, which needs h5py")
        result: Array = real + 1j * imaginary
        return result

    def section(self, point: Any) -> Any:
        """Return the Poincaré points of one orbit.

        Parameters
        ----------
        point
            Number of the row of ``points``, or such a row.

        Returns
        -------
        pandas.DataFrame
            Shape (period, columns): states and deflections in b_c, rates in b_c per τ.
        """
        points = self._table("branch").columns
        if not isinstance(point, (int, np.integer)):
            branch, orbit = self._of_row(point, "branch", "index")
        else:
            number = int(point)
            if not 0 <= number < len(points["branch"]):
                raise ResultError(f"{self.folder}: there is no orbit {number} of {len(points['branch'])}")
            branch, orbit = int(points["branch"][number]), int(points["index"][number])
        table = self._table("poincare")
        rows = (table.columns["branch"] == branch) & (table.columns["index"] == orbit)
        return table.rows(np.flatnonzero(rows)).frame()

    def to_xarray(self) -> Any:
        """Return the orbits as an xarray Dataset over ``orbit`` and ``planet``.

        The coordinates along ``orbit`` are ``branch``, ``index`` on the branch, and ``value``.
        """
        dataset = self._dataset(self._table("branch"), ("orbit",), None)
        return dataset.set_coords(["branch", "index", "value"])


class Tolerance(Result):
    """Error bars by ``tolerance``."""

    @property
    def quantities(self) -> Any:
        """Quantities with their error bars: DataFrame, one row for each point and quantity."""
        return self.table("quantities")


class Crosscheck(Result):
    """The same points by several methods."""

    @property
    def comparisons(self) -> Any:
        """One row for each point and variant: DataFrame with the verdicts."""
        return self.table("crosscheck")


class Ramp(Result):
    """Windows of a run-up and run-down by ``ramp``."""

    _points = ("ramp", "ramp")

    @property
    def orders(self) -> Any:
        """Amplitudes over window and order: DataFrame."""
        return self.table("orders")

    def section(self, point: Any) -> Any:
        """Refuse: a response at a changing speed has no Poincaré points."""
        raise ResultError(f"{self.folder}: a ramp has no Poincaré points")


class Gear(Result):
    """Geometry, stiffness, friction and modes of a stage."""

    _points = ("geometry", "geometry")

    def section(self, point: Any) -> Any:
        """Refuse: a stage has no Poincaré points."""
        raise ResultError(f"{self.folder}: a gear folder has no Poincaré points")

    def near(self, value: float, direction: Optional[str] = None, by: Optional[str] = None) -> Any:
        """Refuse: a stage has no points."""
        raise ResultError(f"{self.folder}: a gear folder has no points; its tables are {', '.join(self.tables)}")

    def to_xarray(self) -> Any:
        """Return the mesh stiffness as an xarray Dataset over ``phase`` (mesh periods), in N/m."""
        table = self._table("stiffness")
        for name in table.columns:
            table.units.setdefault(name, "mesh periods" if name == "phase" else "N/m")
        coords = {"phase": ("phase", table.columns["phase"], {"units": "mesh periods"})}
        return self._dataset(table, ("phase",), None, None, coords)


class Scorecard(Result):
    """Verdicts on the claims of a publication by ``reproduce``."""

    _points = ("scorecard", "scorecard")


class Calibration(Result):
    """Candidates by ``calibrate``."""

    _points = ("candidates", "candidates")


class Robustness(Result):
    """Draws by ``robustness``."""

    _points = ("draws", "draws")


_CLASSES: Dict[str, Type[Result]] = {
    "sweep": Sweep,
    "map": Map,
    "basins": Basins,
    "run": Run,
    "ramp": Ramp,
    "continue": Branches,
    "tolerance": Tolerance,
    "crosscheck": Crosscheck,
}

#: Commands on claims have one kind of study; their main table tells them apart.
_CLAIMS: Tuple[Tuple[str, str, Type[Result]], ...] = (
    ("candidates.csv", "calibrate", Calibration),
    ("draws.csv", "robustness", Robustness),
    ("scorecard.csv", "reproduce", Scorecard),
)


def _index(values: Array, among: List[str]) -> Array:
    """Return the place of each value in a list: int array of shape (rows,)."""
    place = {value: k for k, value in enumerate(among)}
    return np.array([place[value] for value in values], dtype=np.int64)


def _json(file: Path) -> Dict[str, Any]:
    try:
        read = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, ValueError, RecursionError) as error:
        raise ResultError(f"{file}: is damaged: {error}") from error
    if not isinstance(read, dict):
        raise ResultError(f"{file}: is damaged: it is no JSON object")
    return read


def open(folder: Union[str, Path]) -> Result:  # noqa: A001
    """Open a result folder.

    Parameters
    ----------
    folder
        Path of a folder that the program has finished.

    Returns
    -------
    Result
        An object of the kind of its study: ``Sweep``, ``Map``, ``Basins``, ``Run``, ``Ramp``,
        ``Branches``, ``Tolerance``, ``Crosscheck``, ``Gear``, ``Scorecard``, ``Calibration`` or ``Robustness``.

    Raises
    ------
    ResultError
        If it is no folder of this program, is not finished, or is damaged.
    """
    path = Path(folder)
    try:
        known = path.is_dir()
        reason = "is a file, not a result folder" if path.exists() else "no such folder"
    except OSError as error:  # such as a name that is too long
        raise ResultError(f"{path}: {error.strerror}") from error
    if not known:
        raise ResultError(f"{path}: {reason}")
    if not (path / "run.json").is_file():
        raise ResultError(f"{path}: is not a result folder of epicyclic: it has no run.json")
    run = _json(path / "run.json")
    if run.get("program") != "epicyclic":
        raise ResultError(f"{path}: run.json is not from epicyclic")
    if run.get("state") != "complete":
        raise ResultError(
            f"{path}: the study is not finished (state: {run.get('state', 'unknown')}); "
            "repeat its command, which resumes it"
        )
    missing = [name for name in sorted(run.get("files", {})) if name.endswith(".csv") and not (path / name).is_file()]
    if missing or not (path / "input.resolved.json").is_file():
        name = (missing or ["input.resolved.json"])[0]
        raise ResultError(f"{path}: {name} is missing; repeat the command of the folder to restore it")
    resolved = _json(path / "input.resolved.json")
    study = resolved.get("study")
    if not isinstance(study, dict) or (path / "geometry.csv").is_file():
        return Gear(path, "gear", resolved, run)
    kind = str(study.get("kind", ""))
    if kind in _CLASSES:
        return _CLASSES[kind](path, kind, resolved, run)
    for name, command, cls in _CLAIMS:
        if (path / name).is_file():
            return cls(path, command, resolved, run)
    return Result(path, kind, resolved, run)
