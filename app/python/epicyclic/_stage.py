"""A gear stage, and its studies computed from Python."""

from __future__ import annotations

import copy
import csv
import io
import json
from pathlib import Path
from typing import Any, Dict, Iterator, List, Mapping, NoReturn, Optional, Sequence, Tuple, Union, cast

import numpy as np

from ._errors import InputError, core, repr_of
from ._jobs import Job, ProgressFunction
from ._results import Basins, Branches, Crosscheck, Gear, Map, Ramp, Run, Sweep, Tolerance

#: What a study is given by.
Document = Dict[str, Any]
Folder = Union[None, str, Path]
Progress = Union[None, bool, ProgressFunction]

#: Name of a document, which no message keeps: values of Python have no file.
_NAME = "python"


#: More points than any study has.
_ALL = 2**62

#: Levels and elements of a value of an input: more than any has.
_DEEPEST = 50
_LARGEST = 10**6


class Stage:
    """A stage with its operating point and, if it was loaded from one, a study. It does not change.

    ``Stage.load`` and ``Stage.from_drawing`` make one. Computations take the keys of the study as keyword arguments
    (``epicyclic keys study`` lists them); ``from_`` stands for the key ``from``.
    """

    __slots__ = ("_text", "__weakref__")
    _text: str

    def __init__(self) -> None:
        raise TypeError("use Stage.load(...) or Stage.from_drawing(...)")

    def __setattr__(self, name: str, value: Any) -> None:
        """Refuse: use ``replace``."""
        raise AttributeError("a Stage does not change; replace() gives another one")

    @classmethod
    def _of(cls, text: str) -> Stage:
        stage = object.__new__(cls)
        object.__setattr__(stage, "_text", text)
        return stage

    @classmethod
    def load(cls, source: Union[str, Path, Mapping[str, Any]]) -> Stage:
        """Read a stage or study.

        Parameters
        ----------
        source
            A file of a stage or a study, or its JSON value.

        Raises
        ------
        InputError
            With all errors of the input in ``problems``.
        """
        if isinstance(source, Mapping):
            return cls._of(_parsed(_plain(source)).resolved)
        if not isinstance(source, (str, Path)):
            raise TypeError(f"the source is {type(source).__name__}, must be a path or a mapping")
        return cls._of(core().Input.read(str(source), []).resolved)

    @classmethod
    def from_drawing(
        cls,
        *,
        teeth: Sequence[int],
        module_mm: Optional[float] = None,
        pressure_angle_deg: Optional[float] = None,
        profile_shifts: Sequence[float] = (),
        width_mm: Optional[float] = None,
        planets: Optional[int] = None,
        angles_deg: Sequence[float] = (),
        torque_Nm: Optional[float] = None,
        speed_rpm: Optional[float] = None,
        name: str = "stage",
        pair: bool = False,
    ) -> Stage:
        """Make a stage or a lone pair from the numbers of a drawing, as ``epicyclic init`` does.

        Parameters
        ----------
        teeth
            Of sun, planet and ring; without the ring's: sun + 2 planet. Of a pair: gear 1 and gear 2.
        module_mm, pressure_angle_deg, width_mm
            Module [mm], pressure angle [deg], face width [mm].
        profile_shifts
            Of sun, planet and ring [-]. Of a pair: gear 1 and gear 2.
        planets
            Their number.
        angles_deg
            Angles of the planets [deg]; default: as equally spaced as assembly allows.
        torque_Nm
            On the sun or gear 1 [N m]; default: an estimate from module and face width.
        speed_rpm
            Rated speed of the sun or gear 1 [rpm]; ``sweep()`` is then over 0.2 to 1.5 of it.
        name
            Name of the stage.
        pair
            Whether it is a lone pair of gears, which only rotate. It has no planets and no angles.
        """
        if not isinstance(pair, bool):
            raise TypeError(f"pair is {repr_of(pair)}, must be True or False")
        if not isinstance(name, str):
            raise TypeError(f"name is {repr_of(name)}, must be a text")
        drawing = core().Drawing()
        drawing.teeth = [int(z) for z in _numbers(teeth, "teeth")]
        drawing.pair = pair
        gears = "gear 1 and gear 2" if pair else "sun, planet and, if given, ring"
        if len(drawing.teeth) not in ((2,) if pair else (2, 3)):
            raise InputError(f"teeth has {len(drawing.teeth)} numbers, must be of {gears}")
        drawing.profile_shifts = _numbers(profile_shifts, "profile_shifts")
        if len(drawing.profile_shifts) not in (0, 2 if pair else 3):
            raise InputError(
                "profile_shifts must have two numbers: of gear 1 and gear 2"
                if pair
                else "profile_shifts must have three numbers: of sun, planet and ring"
            )
        drawing.angles_deg = _numbers(angles_deg, "angles_deg")
        drawing.planets = None if planets is None else int(_numbers([planets], "planets")[0])
        for key, value in (
            ("module_mm", module_mm),
            ("pressure_angle_deg", pressure_angle_deg),
            ("width_mm", width_mm),
            ("torque_Nm", torque_Nm),
            ("speed_rpm", speed_rpm),
        ):
            setattr(drawing, key, None if value is None else _numbers([value], key)[0])
        return cls._of(_parsed(json.loads(drawing.study(name))).resolved)

    def replace(self, values: Mapping[str, Any]) -> Stage:
        """Return a stage with other values.

        Parameters
        ----------
        values
            Values by JSON pointer, such as ``{"/stage/catalogue/sun/width_mm": 25}``. None removes a value.

        Raises
        ------
        InputError
            If a pointer is not known, or the stage is not valid with these values.
        """
        if not isinstance(values, Mapping):
            raise TypeError(f"the values are {type(values).__name__}, must be a mapping of JSON pointers to values")
        document = self.to_dict()
        for pointer in values:
            if not isinstance(pointer, str):
                raise TypeError(f"{repr_of(pointer)} is no JSON pointer")
        if "stage" not in document and any(not p.startswith("/stage") for p in values):
            document = {"stage": document, "study": {"kind": "run"}}
        return Stage._of(_parsed(document, [assignment(p, v) for p, v in values.items()]).resolved)

    def to_dict(self) -> Document:
        """Return the complete input with all defaults, and the origin of each value."""
        return cast(Document, json.loads(self._text))

    def study(self, kind: str, **keys: Any) -> Document:
        """Return a study of this stage: what a computation computes, and what the command takes as a file.

        Parameters
        ----------
        kind
            Such as ``"sweep"``.
        **keys
            Keys of the study. If the stage was loaded with a study of that kind, its keys are the defaults.
        """
        document = self.to_dict()
        if "stage" not in document:
            document = {"stage": document}
        study = document.get("study", {})
        study = _given(study) if study.get("kind") == kind else {"kind": kind}
        for key, value in keys.items():
            _put(study, key[:-1] if key.endswith("_") else key, _plain(value))
        document["study"] = study
        return document

    def check(self, kind: Optional[str] = None, **keys: Any) -> Dict[str, Any]:
        """Validate a study of this stage and compute nothing, as ``epicyclic check --no-time``.

        Parameters
        ----------
        kind
            Such as ``"sweep"``. Default: that of the study with which the stage was loaded, else the stage alone.
        **keys
            Keys of the study.

        Returns
        -------
        dict
            ``problems`` (tuples of ``Problem``; empty: the study is valid) and ``warnings`` (sentences). A valid study
            that is computed point by point has also ``points`` and ``mesh_periods``, the numbers of both without what
            classifies the regimes.
        """
        document = self.to_dict()
        if kind is None:
            kind = document.get("study", {}).get("kind")
        if kind is None and keys:
            raise TypeError("keys of a study need its kind: check('sweep', ...)")
        if not (kind is None or isinstance(kind, str)):
            raise TypeError(f"kind is {repr_of(kind)}, must be a text")
        try:
            found = _parsed(document if kind is None else self.study(kind, **keys))
            texts = [text.removeprefix("warning: ") for text in found.warnings()]
            return {"problems": [], "warnings": texts, **found.points()}
        except InputError as error:
            if not error.problems:
                raise
            return {"problems": list(error.problems), "warnings": []}

    def gear(self, out: Folder = None) -> Any:
        """Compute teeth, contact, stiffness and modes.

        Parameters
        ----------
        out
            Folder for the tables and figures of ``epicyclic gear``. Without it nothing is written.

        Returns
        -------
        dict or Gear
            Without a folder ``quantities`` (value, unit, symbol, formula and group by name), ``modes`` (a list of
            rows), ``verdicts`` and ``warnings`` (sentences).
        """
        if out is not None:
            return cast(Gear, Job("gear", self.to_dict(), out, 1).wait())
        found = _parsed(self.to_dict()).gear()
        found["modes"] = [
            {key: _number(cell) for key, cell in row.items()} for row in csv.DictReader(io.StringIO(found["modes"]))
        ]
        return found

    def rhs(self, speed: Optional[float] = None, **operation: float) -> Any:
        """Return the equations of motion at an operating point.

        Parameters
        ----------
        speed
            Speed of the sun [rpm].
        **operation
            In its place another key of ``operation``, such as ``mesh_frequency_ratio`` [-]. Without any the operating
            point is that of the stage.

        Returns
        -------
        RightHandSide
            ``f(tau, y)`` gives dy/dtau, an array of the shape of y: (dimension,) or (dimension, k). States are in b_c
            and b_c per unit of tau, the time is tau = omega_sn t. ``names`` has the names of the states, ``period`` the
            period of the equations in tau, ``start`` the default initial state, ``omega_sn`` is in rad/s.
        """
        document = self.to_dict()
        if "stage" not in document:
            document = {"stage": document}
        document["study"] = {"kind": "run"}
        if speed is not None:
            operation["sun_speed_rpm"] = speed
        if operation:
            document["operation"] = {key: _plain(value) for key, value in operation.items()}
        return _parsed(document).right_hand_side()

    def run(self, *, out: Folder = None, threads: Optional[int] = None, progress: Progress = None, **keys: Any) -> Run:
        """Compute one operating point with all results; see ``sweep`` for the arguments."""
        return cast(Run, self._compute("run", out, threads, progress, keys))

    def ramp(
        self, *, out: Folder = None, threads: Optional[int] = None, progress: Progress = None, **keys: Any
    ) -> Ramp:
        """Run the speed up and down at a given rate; see ``sweep`` for the arguments."""
        return cast(Ramp, self._compute("ramp", out, threads, progress, keys))

    def sweep(
        self,
        *,
        out: Folder = None,
        threads: Optional[int] = None,
        progress: Progress = None,
        grow: Folder = None,
        **keys: Any,
    ) -> Sweep:
        """Compute a bifurcation diagram along one parameter.

        Parameters
        ----------
        out
            Folder for the results, as ``-o`` of the command: the same bytes for the same study, and repeating an
            interrupted call resumes it. Default: a temporary folder that lives as long as the result.
        threads
            Number of threads; default: all cores. The results do not depend on it.
        progress
            A function of (part, done, total or None, failed), or True for a bar by tqdm.
        grow
            Folder of a finished smaller study whose points are used again.
        **keys
            Keys of the study, such as ``parameter="mesh_frequency_ratio", from_=1.8, to=2.2, points=41``.

        Raises
        ------
        InputError
            With all errors of the study in ``problems``.
        OutputError
            If the folder is in use, holds another study, or cannot be written.
        KeyboardInterrupt
            After Ctrl-C, when the folder is in order: the same call, or the command, resumes it.
        """
        return cast(Sweep, self._compute("sweep", out, threads, progress, keys, grow=grow))

    def sweep_stream(
        self, *, out: Folder = None, threads: Optional[int] = None, progress: Progress = None, **keys: Any
    ) -> Iterator[Dict[str, Any]]:
        """Yield the points of a sweep as they are computed: dicts with the columns of ``points.csv``.

        The order is that of the computation; ``point`` is the row of the table. Leaving the loop stops the computation.
        Arguments as of ``sweep``. Points that an earlier call has left in the folder are not repeated.
        """
        return self._job("sweep", out, threads, progress, keys, rows=_ALL).rows()

    def point(self, *, threads: int = 1, **keys: Any) -> Dict[str, Any]:
        """Compute one point of a sweep, and nothing else.

        A pure function of the stage and the keys, for dask and other engines.

        Parameters
        ----------
        threads
            Number of threads.
        **keys
            Keys of a sweep, and ``value`` in place of ``from_``, ``to`` and ``points``.

        Returns
        -------
        dict
            The columns of ``points.csv``.
        """
        if "value" in keys:
            value = keys.pop("value")
            keys.update({"from": value, "to": value, "points": 1})
        keys.setdefault("directions", ["up"])
        keys.setdefault("crosscheck", {"points": 0})
        rows = cast(Any, self._job("sweep", None, threads, None, keys, rows=1).rows())
        try:
            return cast(Dict[str, Any], next(rows))
        except StopIteration:
            raise InputError("the study has no point") from None
        finally:
            rows.close()

    def part(
        self, kind: str, number: int, of: int, *, out: Union[str, Path], threads: Optional[int] = None, **keys: Any
    ) -> None:
        """Compute a part of a sweep, map or basins, as ``--part NUMBER/OF`` of the command.

        Other processes compute the other parts, at the same time or later. Afterwards ``sweep``, ``map`` or ``basins``
        with the same folder and keys computes what is missing, and gives the results: those of one process.

        Parameters
        ----------
        kind
            ``"sweep"``, ``"map"`` or ``"basins"``.
        number, of
            Number of the part, from 1, and of all parts.
        out
            Folder of all parts.
        threads, **keys
            As of ``sweep``.

        Raises
        ------
        OutputError
            If another process computes this part, or as of ``sweep``.
        """
        if kind not in ("sweep", "map", "basins"):
            raise InputError(f"a study of kind {repr_of(kind)} has no parts; those of sweep, map and basins have")
        if not all(isinstance(k, int) and not isinstance(k, bool) for k in (number, of)) or not 1 <= number <= of <= 10000:
            raise InputError(f"part {repr_of(number)} of {repr_of(of)}: must be integers, 1 <= number <= of <= 10000")
        self._job(kind, out, threads, None, keys, part=(number, of)).wait_for_part()

    def map(
        self,
        *,
        out: Folder = None,
        threads: Optional[int] = None,
        progress: Progress = None,
        grow: Folder = None,
        **keys: Any,
    ) -> Map:
        """Classify regimes over two parameters; see ``sweep`` for the arguments."""
        return cast(Map, self._compute("map", out, threads, progress, keys, grow=grow))

    def basins(
        self,
        *,
        out: Folder = None,
        threads: Optional[int] = None,
        progress: Progress = None,
        grow: Folder = None,
        **keys: Any,
    ) -> Basins:
        """Find coexisting attractors over a plane of initial states; see ``sweep`` for the arguments."""
        return cast(Basins, self._compute("basins", out, threads, progress, keys, grow=grow))

    def branches(
        self,
        *,
        out: Folder = None,
        progress: Progress = None,
        origins: Sequence[str] = (),
        against: Folder = None,
        **keys: Any,
    ) -> Branches:
        """Continue branches of periodic orbits, and locate their bifurcations.

        Parameters
        ----------
        out, progress
            As of ``sweep``.
        origins
            Finished studies to start from, as ``--from`` of ``epicyclic continue``: ``"FOLDER"`` or
            ``"FOLDER:up=VALUE"``.
        against
            Folder of a complete sweep whose changes the branches are to explain.
        **keys
            Keys of the study.
        """
        return cast(Branches, self._compute("continue", out, 1, progress, keys, origins=origins, against=against))

    def tolerance(
        self, *, out: Folder = None, threads: Optional[int] = None, progress: Progress = None, **keys: Any
    ) -> Tolerance:
        """Compute error bars; see ``sweep`` for the arguments."""
        return cast(Tolerance, self._compute("tolerance", out, threads, progress, keys))

    def crosscheck(
        self, *, out: Folder = None, threads: Optional[int] = None, progress: Progress = None, **keys: Any
    ) -> Crosscheck:
        """Compute the same points by several methods; see ``sweep`` for the arguments."""
        return cast(Crosscheck, self._compute("crosscheck", out, threads, progress, keys))

    def _compute(
        self, kind: str, out: Folder, threads: Optional[int], progress: Progress, keys: Document, **options: Any
    ) -> Any:
        return self._job(kind, out, threads, progress, keys, **options).wait()

    def _job(
        self, kind: str, out: Folder, threads: Optional[int], progress: Progress, keys: Document, **options: Any
    ) -> Job:
        document = self.study(kind, **keys)
        _parsed(document)  # its errors are those of these values, not of a file
        return Job(kind, document, out, threads, progress, **options)

    def __reduce__(self) -> Tuple[Any, Tuple[str]]:
        """Pickle the complete input."""
        return (Stage._of, (self._text,))

    def __copy__(self) -> Stage:
        """Return the stage itself."""
        return self

    def __deepcopy__(self, memo: Any) -> Stage:
        """Return the stage itself."""
        return self

    def __eq__(self, other: object) -> bool:
        """Compare the complete inputs."""
        return isinstance(other, Stage) and self._text == other._text

    def __hash__(self) -> int:
        """Hash the complete input."""
        return hash(self._text)

    def __repr__(self) -> str:
        """Name the stage, its teeth and its study."""
        document = self.to_dict()
        stage = document.get("stage", document)
        gears = stage.get("catalogue", {})
        parts = [repr(str(document.get("name") or stage.get("name") or "stage"))]
        pair = stage.get("boundary") == "pair"
        members = ("sun", "planet") if pair else ("sun", "planet", "ring")
        if all("teeth" in gears.get(part, {}) for part in members):
            parts.append("/".join(str(gears[part]["teeth"]) for part in members) + " teeth")
        if pair:
            parts.append("a pair")
        elif isinstance(stage.get("planets"), dict) and "count" in stage["planets"]:
            parts.append(f"{stage['planets']['count']} planets")
        if "study" in document:
            parts.append(f"study: {document['study']['kind']}")
        return f"<Stage {', '.join(parts)}>"


def assignment(pointer: str, value: Any) -> str:
    """Return the text of ``--set``."""
    return f"{pointer}={json.dumps(_plain(value))}"


def _parsed(document: Document, sets: Sequence[str] = ()) -> Any:
    """Read a document of Python."""
    try:
        return core().Input.parse(json.dumps(document), _NAME, list(sets))
    except InputError as error:
        without_file(error)


def without_file(error: InputError) -> NoReturn:
    """Raise the error with problems that name no file: there is none."""
    kept = [p._replace(file="", line=0) for p in error.problems]
    raise InputError("\n".join(p.text() for p in kept) if kept else str(error), kept) from None


def _numbers(values: Any, name: str) -> List[float]:
    """Return numbers of a drawing."""
    try:
        numbers = [float(value) for value in values]
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} is {repr_of(values)}, which is no list of numbers") from None
    if name in ("teeth", "planets") and not all(abs(z) < 10**6 and z == int(z) for z in numbers):
        raise InputError(f"{name} is {repr_of(values)}, must be integers")
    if not all(abs(x) < float("inf") for x in numbers):
        raise InputError(f"{name} has numbers that are not finite")
    return numbers


def _plain(value: Any, depth: int = 0) -> Any:
    """Return a value as JSON has it: arrays as lists, numbers of numpy as numbers."""
    if depth > _DEEPEST:
        raise InputError(f"a value has more than {_DEEPEST} levels of lists and mappings")
    if isinstance(value, Mapping):
        return {str(key): _plain(item, depth + 1) for key, item in value.items()}
    if isinstance(value, np.ndarray) and value.size > _LARGEST:
        raise InputError(f"an array has the shape {value.shape}, must have at most {_LARGEST} elements")
    if isinstance(value, (np.ndarray, np.generic)):
        plain = value.tolist()
        if isinstance(plain, (np.ndarray, np.generic)):  # a type that Python does not have
            raise TypeError(f"{repr_of(value)} is no value of an input: {type(value).__name__}")
        return _plain(plain, depth + 1)
    if isinstance(value, (list, tuple)):
        return [_plain(item, depth + 1) for item in value]
    if isinstance(value, Path):
        return str(value)
    if value is None or isinstance(value, (str, bool, int)):
        return value
    if isinstance(value, float):
        if value != value or value in (float("inf"), float("-inf")):
            raise InputError(f"{value} is not a finite number")
        return value
    raise TypeError(f"{repr_of(value)} is no value of an input: {type(value).__name__}")


def _given(values: Document) -> Document:
    """Return the values of an object that are no defaults: those follow from the others."""
    origins = values.get("origin", {})
    kept = {key: value for key, value in values.items() if origins.get(key) != "default"}
    kept = {key: _given(value) if isinstance(value, dict) and key != "origin" else value for key, value in kept.items()}
    if "origin" in kept:
        kept["origin"] = {key: origin for key, origin in origins.items() if key in kept}
    return kept


def _put(into: Document, key: str, value: Any) -> None:
    """Set a key, and keys of an object in it, as values that were given."""
    origins = into.get("origin")
    if isinstance(value, dict) and isinstance(into.get(key), dict):
        inner = copy.deepcopy(into[key])
        for name, item in value.items():
            _put(inner, name, item)
        into[key] = inner
        return
    into[key] = value
    if isinstance(origins, dict):
        origins.pop(key, None)


def _number(cell: str) -> Union[str, int, float, None]:
    try:
        return int(cell)
    except ValueError:
        pass
    try:
        return float(cell)
    except ValueError:
        return cell or None


__all__: List[str] = ["Stage"]
