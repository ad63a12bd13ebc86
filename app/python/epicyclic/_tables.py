"""Tables of a result folder: groups of results.h5, or CSV files."""

from __future__ import annotations

import csv
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Dict, List, Optional

import numpy as np
import numpy.typing as npt

from ._errors import ResultError, needed

Array = npt.NDArray[Any]


@dataclass
class Table:
    """Columns of equal length.

    Attributes
    ----------
    columns
        Arrays of shape (rows,) by name. Numbers are float64 or int64, texts are str objects. An
        unknown number is NaN, and so is a column of a CSV file without any cell filled.
    units
        Unit of each column with a known one, such as ``"N"``; ``"1"`` stands for no dimension.
    meanings
        A line for each column with a known meaning.
    """

    columns: Dict[str, Array]
    units: Dict[str, str] = field(default_factory=dict)
    meanings: Dict[str, str] = field(default_factory=dict)

    def __len__(self) -> int:
        """Count the rows."""
        return 0 if not self.columns else len(next(iter(self.columns.values())))

    def frame(self) -> Any:
        """Return a pandas DataFrame with ``units`` and ``meaning`` in its ``attrs``."""
        pandas = needed("pandas", "a DataFrame")
        frame = pandas.DataFrame({name: values.copy() for name, values in self.columns.items()})
        frame.attrs["units"] = dict(self.units)
        frame.attrs["meaning"] = dict(self.meanings)
        return frame

    def rows(self, which: Array) -> Table:
        """Return the rows of a mask or an index array of shape (k,)."""
        return Table(
            {name: values[which] for name, values in self.columns.items()}, self.units, self.meanings
        )


def _as_text(value: Any) -> str:
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def _column(cells: List[str]) -> Array:
    """Return int64 if all cells are whole numbers, float64 if all are numbers or empty, else str."""
    if any("_" in cell for cell in cells):  # Python would take 1_2 for a number
        return np.array(cells, dtype=object)
    try:
        if cells:
            return np.array([int(cell) for cell in cells], dtype=np.int64)
    except (ValueError, OverflowError):
        pass
    try:
        return np.array([float(cell) if cell != "" else np.nan for cell in cells], dtype=np.float64)
    except ValueError:
        return np.array(cells, dtype=object)


def read_csv(file: Path) -> Table:
    """Read a CSV table. Its units are not known.

    Raises
    ------
    ResultError
        If the file cannot be read or is not a table.
    """
    try:
        with file.open(newline="", encoding="utf-8") as stream:
            rows = list(csv.reader(stream))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ResultError(f"{file}: cannot be read: {error}") from error
    if not rows:
        raise ResultError(f"{file}: is empty, so it is damaged; repeat the command of the folder to restore it")
    names = rows[0]
    for number, row in enumerate(rows[1:], start=2):
        if len(row) != len(names):
            raise ResultError(
                f"{file}: line {number} has {len(row)} cells in place of {len(names)}, so it is damaged; "
                "repeat the command of the folder to restore it"
            )
    return Table({name: _column([row[k] for row in rows[1:]]) for k, name in enumerate(names)})


def csv_header(file: Path) -> List[str]:
    """Read the names of the columns; none if there is no such file."""
    try:
        with file.open(newline="", encoding="utf-8") as stream:
            return next(csv.reader(stream), [])
    except (OSError, UnicodeDecodeError, csv.Error):
        return []


class Hdf5:
    """The file results.h5 of a folder, opened for each reading.

    Parameters
    ----------
    file
        Its path. It need not exist.
    """

    def __init__(self, file: Path) -> None:
        self.file = file
        try:
            import h5py

            self._h5py: Optional[Any] = h5py
        except ImportError:
            self._h5py = None

    @property
    def installed(self) -> bool:
        """Whether h5py is installed."""
        return self._h5py is not None

    def groups(self) -> List[str]:
        """List the paths of all groups that have datasets, without the leading slash."""
        found: List[str] = []

        def visit(name: str, item: Any) -> None:
            if self._h5py is not None and isinstance(item, self._h5py.Dataset):
                group = name.rpartition("/")[0]
                if group not in found:
                    found.append(group)

        with self._open() as opened:
            opened.visititems(visit)
        return found

    def table(self, group: str, order: List[str]) -> Optional[Table]:
        """Read the datasets of a group that have one axis and the length of its first axis.

        Parameters
        ----------
        group
            Path of the group, such as ``"points"``.
        order
            Names that come first, in this order.

        Returns
        -------
        Table or None
            None if the file or the group does not exist, or h5py is not installed.
        """
        if self._h5py is None or not self.file.exists():
            return None
        try:
            with self._open() as opened:
                item = opened.get(group)
                if item is None or isinstance(item, self._h5py.Dataset):
                    return None
                return self._read(item, order)
        except (OSError, RuntimeError, KeyError, ValueError) as error:
            raise self._damaged(error) from error

    def array(self, path: str) -> Optional[Array]:
        """Read a dataset of any shape; None if there is no such dataset."""
        if self._h5py is None or not self.file.exists():
            return None
        try:
            with self._open() as opened:
                item = opened.get(path)
                return None if item is None else self._values(item)
        except (OSError, RuntimeError, KeyError, ValueError) as error:
            raise self._damaged(error) from error

    def _open(self) -> Any:
        assert self._h5py is not None
        try:
            return self._h5py.File(self.file, "r")
        except OSError as error:
            raise self._damaged(error) from error

    def _damaged(self, error: Exception) -> ResultError:
        return ResultError(
            f"{self.file}: is damaged ({error}); repeat the command of the folder to restore it"
        )

    @staticmethod
    def _values(item: Any) -> Array:
        values: Array = item[()]
        if values.dtype.kind == "S":
            return np.array([_as_text(text) for text in values.ravel()], dtype=object).reshape(values.shape)
        if values.dtype.kind == "i":
            return values.astype(np.int64)
        return values.astype(np.float64)

    def _read(self, group: Any, order: List[str]) -> Table:
        assert self._h5py is not None
        sets = {
            name: item
            for name, item in group.items()
            if isinstance(item, self._h5py.Dataset) and len(item.shape) == 1
        }
        # A scale that only numbers the rows is no column.
        for name in [n for n in sets if n in ("row", "column") or n.startswith(("row_", "column_"))]:
            if name not in order:
                del sets[name]
        names = [name for name in order if name in sets]
        rest = [name for name in sets if name not in names]
        if not sets:
            return Table({})
        length = sets[(names or rest)[0]].shape[0]
        table = Table({})
        for name in names + rest:
            item = sets[name]
            if item.shape[0] != length:
                continue
            table.columns[name] = self._values(item)
            for attribute, target in (("units", table.units), ("meaning", table.meanings)):
                if attribute in item.attrs:
                    target[name] = _as_text(item.attrs[attribute])
        return table
