"""One's own oscillator: sections, regimes, exponents, orbits and branches of dy/dt = f(t, y; p), periodic in t."""

from __future__ import annotations

import ctypes
import warnings
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._errors import InputError, core, repr_of

Array = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]


@dataclass(frozen=True)
class Section:
    """Poincaré points, one a period.

    Attributes
    ----------
    states
        Shape (periods, n).
    period
        Number of periods of the forcing after which the points repeat to 1e-6; 0 if they do not.
    error
        Largest difference after that many periods.
    """

    states: Array
    period: int
    error: float


@dataclass(frozen=True)
class Regime:
    """The regime of an attractor, with its evidence.

    Attributes
    ----------
    regime
        ``"periodic"``, ``"quasiperiodic"``, ``"chaotic"`` or ``"undecided"``.
    period
        In periods of the forcing, if periodic; else 0.
    state
        A point of the orbit, or the last state: shape (n,).
    largest_multiplier, multiplier_error
        Modulus of the largest Floquet multiplier and its error; NaN unless periodic.
    exponent
        Largest Lyapunov exponent per unit of t.
    exponent_interval
        Its interval at 95 %: low, high.
    zero_one
        Result of the 0-1 test; NaN if it was not needed.
    periods
        Periods of the forcing that were integrated for it.
    note
        What else was seen, in words.
    """

    regime: str
    period: int
    state: Array
    largest_multiplier: float
    multiplier_error: float
    exponent: float
    exponent_interval: Tuple[float, float]
    zero_one: float
    periods: int
    note: str


@dataclass(frozen=True)
class Exponents:
    """Lyapunov exponents per unit of t.

    Attributes
    ----------
    values, half_widths
        The exponents and half widths of their intervals at 95 %: shape (n,).
    sum, sum_half_width
        Sum of the exponents: the mean divergence.
    """

    values: Array
    half_widths: Array
    sum: float
    sum_half_width: float


@dataclass(frozen=True)
class Orbit:
    """A periodic orbit.

    Attributes
    ----------
    state
        Its state at t = 0: shape (n,).
    error
        How far the state may be from the orbit.
    multipliers
        Floquet multipliers by falling modulus: complex, shape (n,).
    multiplier_errors
        Their errors: shape (n,).
    stable
        Whether all are inside the unit circle by more than their errors.
    """

    state: Array
    error: float
    multipliers: ComplexArray
    multiplier_errors: Array
    stable: bool


@dataclass(frozen=True)
class SpecialPoint:
    """A bifurcation on a branch.

    Attributes
    ----------
    kind
        ``"fold"``, ``"flip"`` (period doubling), ``"neimark_sacker"``, ``"branch_point"`` or ``"unresolved"``.
    value
        Value of the parameter.
    error_bound
        Bound of its error.
    multiplier
        The multiplier that reaches the unit circle.
    state
        State of the orbit there at t = 0: shape (n,).
    note
        What was not as usual, in words.
    """

    kind: str
    value: float
    error_bound: float
    multiplier: complex
    state: Array
    note: str


@dataclass(frozen=True)
class Branch:
    """A branch of periodic orbits.

    Attributes
    ----------
    period
        In periods of the forcing.
    value
        Values of the parameter: shape (orbits,).
    states
        States at the beginning of each period: shape (orbits, period, n).
    multipliers
        Floquet multipliers: complex, shape (orbits, n).
    special
        Bifurcations, in the order in which they were found.
    ends
        Messages on both ends; empty at an end of the range.
    """

    period: int
    value: Array
    states: Array
    multipliers: ComplexArray
    special: Tuple[SpecialPoint, ...]
    ends: Tuple[str, str]


class System:
    """A system dy/dt = f(t, y; p) that is periodic in t.

    Parameters
    ----------
    f
        A C function ``void f(double t, const double* y, const double* p, double* dydt)``: a ``numba.cfunc``, a
        function of ctypes, or its address. Or a Python function ``f(t, y, p)`` that returns n numbers: it is slow.
    n
        Dimension of y.
    params
        Parameters by name, in the order in which f receives them.
    period
        Period of f in t, or a function of the array of parameters that returns it.
    jacobian
        A second function of the same kind. It gives the n x n derivatives of f by y, row by row. Without it they are
        differences of f.

    Notes
    -----
    The signature of a ``numba.cfunc`` is checked. That of any other C function cannot be: a wrong one ends the process.
    """

    def __init__(
        self,
        f: Any,
        n: int,
        params: Mapping[str, float],
        period: Union[float, Callable[[Array], float]],
        jacobian: Any = None,
    ) -> None:
        if isinstance(n, bool) or not isinstance(n, (int, np.integer)) or not 1 <= n <= 10000:
            raise InputError(f"n is {repr_of(n)}, must be an integer from 1 to 10000")
        if not callable(period):
            period = _finite(period, "period")
            if period <= 0:
                raise InputError(f"period is {period}, must be > 0")
        if not isinstance(params, Mapping):
            raise InputError(f"params is {repr_of(params)}, must be a mapping of names to numbers")
        self.n = int(n)
        self.params: Dict[str, float] = {str(k): _finite(v, f"params[{k!r}]") for k, v in params.items()}
        self.period = period
        address, function = _function(f, "f")
        jacobian_address, jacobian_function = (0, None) if jacobian is None else _function(jacobian, "jacobian")
        #: "function", or "differences" of f: whence derivatives by the state are.
        self.derivatives = "differences" if jacobian is None else "function"
        self._kept = (f, jacobian)  # C code lives as long as they do
        self._core = core().System(
            self.n, len(self.params), address, function, jacobian_address, jacobian_function, period
        )
        if function is not None:
            warnings.warn(
                "f is a Python function: a call takes some 10 us, that of a C function (numba.cfunc) a hundredth",
                stacklevel=2,
            )

    def __repr__(self) -> str:
        """Name dimension, parameters and the source of derivatives."""
        parameters = ", ".join(f"{key}={value:g}" for key, value in self.params.items())
        return f"<System n={self.n}, {parameters}, derivatives by {self.derivatives}>"

    def section(
        self,
        start: Sequence[float],
        *,
        transient: int = 300,
        periods: int = 128,
        longest: int = 32,
        tolerance: float = 1e-10,
        **params: float,
    ) -> Section:
        """Integrate, and record the state after each period.

        Parameters
        ----------
        start
            Initial state: shape (n,).
        transient, periods
            Periods before the record, and recorded ones.
        longest
            Longest period of the response that is sought.
        tolerance
            Relative and absolute tolerance of the integration.
        **params
            Other values of parameters.
        """
        states, period, error = self._core.section(
            start, self._values(params), _count(transient, "transient", 0), _count(periods, "periods", 1), tolerance,
            _count(longest, "longest", 1),
        )
        return Section(states, period, error)

    def regime(
        self,
        start: Sequence[float],
        *,
        transient: int = 100,
        budget: int = 8192,
        longest: int = 16,
        tolerance: float = 1e-8,
        **params: float,
    ) -> Regime:
        """Determine the regime of the attractor that a trajectory reaches, with exponent and interval.

        Parameters
        ----------
        start
            Initial state: shape (n,).
        transient
            Periods before the first window.
        budget
            Periods of all windows together.
        longest
            Longest period of an orbit that is sought.
        tolerance
            Relative and absolute tolerance of the integration.
        **params
            Other values of parameters.
        """
        r = self._core.regime(
            start, self._values(params), _count(transient, "transient", 0), _count(budget, "budget", 1),
            _count(longest, "longest", 1), tolerance,
        )
        interval = (r.pop("exponent_low"), r.pop("exponent_high"))
        return Regime(exponent_interval=interval, **r)

    def exponents(
        self,
        start: Sequence[float],
        *,
        transient: int = 300,
        aligning: int = 50,
        periods: int = 500,
        tolerance: float = 1e-9,
        **params: float,
    ) -> Exponents:
        """Compute all Lyapunov exponents.

        Parameters
        ----------
        start
            Initial state: shape (n,).
        transient, aligning, periods
            Periods before the vectors start, before growth is counted, and counted ones.
        tolerance
            Relative and absolute tolerance of the integration.
        **params
            Other values of parameters.
        """
        return Exponents(
            *self._core.exponents(
                start, self._values(params), _count(transient, "transient", 0), _count(aligning, "aligning", 0),
                _count(periods, "periods", 1), tolerance,
            )
        )

    def orbit(
        self,
        start: Sequence[float],
        *,
        period: int = 1,
        transient: int = 0,
        tolerance: float = 1e-11,
        **params: float,
    ) -> Orbit:
        """Find a periodic orbit by shooting; it may be unstable.

        Parameters
        ----------
        start
            A state near it: shape (n,).
        period
            In periods of the forcing.
        transient
            Periods that are integrated first, towards a stable orbit.
        tolerance
            Relative and absolute tolerance of the integration.
        **params
            Other values of parameters.

        Raises
        ------
        NumericalError
            If none is found.
        """
        o = self._core.orbit(
            start, self._values(params), _count(transient, "transient", 0), _count(period, "period", 1), tolerance
        )
        o["multipliers"] = np.array(o["multipliers"], dtype=np.complex128)
        return Orbit(**o)

    def branches(
        self,
        parameter: str,
        bounds: Tuple[float, float],
        start: Sequence[float],
        *,
        period: int = 1,
        largest_period: int = 2,
        transient: int = 300,
        max_step: float = 0.1,
        most: int = 100,
        tolerance: float = 1e-11,
        **params: float,
    ) -> List[Branch]:
        """Continue the branch of periodic orbits through an orbit, and those that leave it.

        Parameters
        ----------
        parameter
            Name of the parameter. The branch starts at its present value.
        bounds
            Range of the parameter: low, high.
        start
            State from which a stable orbit is reached, or near an orbit with ``transient=0``: shape (n,).
        period
            Period of that orbit in periods of the forcing.
        largest_period
            Largest period of branches that leave at period doublings.
        transient
            Periods that are integrated first.
        max_step
            Longest step. The range counts as 1 / 0.3, the largest component of the start as 1.
        most
            Most branches.
        tolerance
            Relative and absolute tolerance of the integration. Special points use a tenth of it.
        **params
            Other values of parameters.

        Raises
        ------
        NumericalError
            If there is no orbit to start from.
        """
        if parameter not in self.params:
            raise InputError(f"no parameter {repr_of(parameter)}; there are: {', '.join(self.params)}")
        low, high = (_finite(bound, "bounds") for bound in bounds)
        step = _finite(max_step, "max_step")
        if step <= 0:
            raise InputError(f"max_step is {step}, must be > 0")
        values = self._values(params)
        which = list(self.params).index(parameter)
        if not low <= values[which] <= high or low >= high:
            raise InputError(f"{parameter} is {values[which]}, must be within the bounds {low} and {high}")
        found = self._core.branches(
            start, values, which, low, high, _count(transient, "transient", 0), _count(period, "period", 1),
            _count(largest_period, "largest_period", 1), step, _count(most, "most", 1), tolerance,
        )
        return [
            Branch(
                b["period"],
                b["value"],
                b["states"],
                np.array(b["multipliers"], dtype=np.complex128).reshape(len(b["value"]), -1),
                tuple(SpecialPoint(**s) for s in b["special"]),
                b["ends"],
            )
            for b in found
        ]

    def _values(self, other: Mapping[str, float]) -> Array:
        unknown = [name for name in other if name not in self.params]
        if unknown:
            raise InputError(f"no parameter {repr_of(unknown[0])}; there are: {', '.join(self.params)}")
        both = {**self.params, **{k: _finite(v, k) for k, v in other.items()}}
        return np.array(list(both.values()), dtype=np.float64)


def _finite(value: Any, name: str) -> float:
    try:
        number = float(value)
    except (OverflowError, TypeError, ValueError):
        raise InputError(f"{name} is {repr_of(value)}, must be a number") from None
    if not np.isfinite(number):
        raise InputError(f"{name} is {number}, must be finite")
    return number


#: Largest number of periods.
_MOST = 10**9


def _count(value: Any, name: str, least: int) -> int:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not least <= value <= _MOST:
        raise InputError(f"{name} is {repr_of(value)}, must be an integer from {least} to {_MOST}")
    return int(value)


def _is_code(address: int) -> bool:
    """Tell whether an address is in memory that can be executed; True where the system does not say."""
    try:
        with open("/proc/self/maps", encoding="utf-8", errors="replace") as maps:
            lines = maps.read().splitlines()
    except OSError:
        return address > 0
    for line in lines:
        place, rights = line.split()[:2]
        low, high = (int(number, 16) for number in place.split("-"))
        if low <= address < high:
            return "x" in rights
    return False


#: Of a function of numba.
_SIGNATURE = "(float64, float64*, float64*, float64*) -> none"


def _function(f: Any, name: str) -> Tuple[int, Optional[Any]]:
    """Return the address of a C function and None, or 0 and a Python function."""
    address = getattr(f, "address", None)  # numba
    signature = getattr(f, "_sig", None)
    if signature is not None and str(signature) != _SIGNATURE:
        raise InputError(f"{name} has the signature {signature}, must have {_SIGNATURE}")
    if isinstance(f, getattr(ctypes, "_CFuncPtr")):
        address = ctypes.cast(f, ctypes.c_void_p).value
    elif isinstance(f, int) and not isinstance(f, bool):
        if not _is_code(f):
            raise InputError(f"{name} is {f:#x}, which is no address of a function in this process")
        address = f
    if isinstance(address, int) and address > 0:
        return address, None
    if callable(f):
        return 0, f
    raise InputError(f"{name} is {repr_of(f)}, must be a function, or the address of one")
