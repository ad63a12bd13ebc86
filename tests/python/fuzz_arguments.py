"""fuzz_arguments.py [CALLS [SEED]]: calls of the package with arguments of wrong types, shapes and values.

Each call may return, or raise an exception of the package, TypeError or ValueError. Everything else is a finding: another
exception, a call of more than 20 seconds, and the end of the process. A finding is printed with its call; the same SEED
repeats it. The variables EPICYCLIC_INPUTS (folder of the inputs) and EPICYCLIC_DUFFING (library of duffing.cpp) are needed.
"""

import ctypes
import faulthandler
import os
import random
import shutil
import signal
import sys
import tempfile
import traceback
import warnings
from pathlib import Path

import numpy as np

import epicyclic as ep
from epicyclic import _core

CALLS = int(sys.argv[1]) if len(sys.argv) > 1 else 2000
SEED = int(sys.argv[2]) if len(sys.argv) > 2 else 1
LONGEST = 20.0  # seconds; a call that is not stopped by its arguments takes less than one

pick = random.Random(SEED)
inputs = Path(os.environ["EPICYCLIC_INPUTS"])
folder = Path(tempfile.mkdtemp(prefix="fuzz-", dir="."))
library = ctypes.CDLL(os.environ["EPICYCLIC_DUFFING"])


class OfTheUser(Exception):
    """An exception of an object of the user passes through the package."""


#: What a call may raise. ValueError has InputError and errors of characters in it.
ALLOWED = (OfTheUser, ep.NumericalError, ep.OutputError, ep.ResultError, TypeError, ValueError)


class Unwilling:
    """Raises when it is read as a number or an array."""

    def _raise(self, *_, **__):
        raise OfTheUser

    __array__ = __float__ = __index__ = __len__ = __iter__ = _raise


def endless():
    """Return a list that contains itself."""
    values = [1.0]
    values.append(values)
    return values


def deep():
    """Return lists in lists."""
    values = []
    for _ in range(5000):
        values = [values]
    return values


START = np.array([1.0, 0.0])
ODD = [
    None, True, False, 0, 1, 2, -1, 3.5, -0.0, 1e308, 5e-324, float("nan"), float("inf"), 2**31 - 1, 2**31, 2**63, -(2**63),
    10**400, 2**64, 2**70, -(2**70), 1j, "", "a", "\0", "\ud800", "sweep", "/", "/stage", "/study/points/0/x", "~2", "é" * 300, b"", b"\xff",
    [], (), {}, [[]], [1.0], [1.0, 0.0], [float("nan"), 0.0], [1.0, "a"], [[1.0], [1.0, 2.0]], {"a": 1}, {1: 2}, {"": None},
    {"from": float("nan")}, {"origin": 3}, object(), int, len, lambda *_: None, range(3), iter(()), slice(None), Ellipsis,
    NotImplemented, Path("/"), Path("no"), set(), bytearray(b"xy"), memoryview(b"xyz"), Unwilling(), endless(), deep(),
    np.float64("nan"), np.int8(-1), np.uint64(2**64 - 1), np.bool_(True), np.str_("a"), np.datetime64("nat"), np.array(1.0),
    np.array([]), np.zeros((2, 0)), np.zeros((0, 2)), np.zeros((2, 2, 2)), np.full(2, np.nan), np.full((2, 3), np.inf), START,
    START[::-1], START.astype(">f8"), START.astype(np.float16), START.astype(np.longdouble), START.astype(complex),
    START.astype(bool), START.astype(object), np.array([None, 1.0]), np.array(["a", "b"]), np.array([b"a", b"b"]), START.reshape(2, 1),
    np.broadcast_to(1.0, (2,)), np.broadcast_to(1.0, (2, 2**40)), np.zeros(1000)[::500], np.asfortranarray(np.ones((2, 3))),
    np.ma.masked_array(START, [True, False]), np.zeros(2, dtype=[("x", "f8"), ("y", "f8")]), np.array([2**64, 1], dtype=object),
]  # fmt: skip
READ_ONLY = START.copy()
READ_ONLY.flags.writeable = False
ODD.append(READ_ONLY)

FEW = {"transient_periods": 2, "recorded_periods": 8, "classification_periods": 0, "crosscheck": {"points": 0}}
STAGES = [ep.Stage.load(inputs / name) for name in ("tang2020.json", "tang2020_speed.json", "tang2020_run.json")]
STAGES.append(ep.Stage.from_drawing(teeth=(21, 28), module_mm=3, torque_Nm=200, speed_rpm=3000))
RATES = STAGES[0].rhs(mesh_frequency_ratio=2.0)
PARAMS = {"force": 0.2, "damping": 0.3, "frequency": 1.2}
SWEEP = STAGES[1].sweep(points=3, threads=1, out=folder / "sweep", **FEW)
STUDIES = ("run", "sweep", "map", "basins", "branches", "tolerance", "crosscheck")
KEYS = (
    "parameter from_ from to points value start directions transient transient_periods recorded_periods crosscheck starts first "
    "second methods tolerances period_max branches orbits search loci out threads progress grow against origins poitns"
).split()
COLUMNS = list(SWEEP.points.columns)


def odd():
    return pick.choice(ODD)


def mostly(value, part=0.7):
    """Return the value, or an odd one."""
    return value if pick.random() < part else odd()


def mutated(document):
    """Return a document with some places changed, removed or added."""
    for _ in range(pick.randint(1, 3)):
        at = document
        while isinstance(at, dict) and at:
            key = pick.choice(sorted(at))
            if not isinstance(at[key], dict) or pick.random() < 0.3:
                kind = pick.randrange(4)
                if kind == 0:
                    del at[key]
                elif kind == 1:
                    at[key[:-1] or "x"] = at[key]
                elif kind == 2:
                    at[key] = [at[key]] * pick.randint(0, 3)
                else:
                    at[key] = odd()
                break
            at = at[key]
    return document


def pointer():
    """Return a JSON pointer of a value, or something like one."""
    at, words = STAGES[1].to_dict(), []
    while isinstance(at, dict) and at and pick.random() < 0.9:
        words.append(pick.choice(sorted(at)))
        at = at[words[-1]]
    text = "/" + "/".join(words)
    return text if pick.random() < 0.8 else mostly(text[: pick.randint(0, len(text))], 0.5)


def names(most):
    """Return some keyword arguments with odd values."""
    return {pick.choice(KEYS): odd() for _ in range(pick.randint(1, most))}


def refused(f, *arguments, **keys):
    """Call a computation whose arguments are wrong in at least one place: none that works may be long."""
    return f(*arguments, **{"poitns" if pick.random() < 0.5 else "threads": "many", **keys})


# Stages


def load():
    return ep.Stage.load(mutated(pick.choice(STAGES).to_dict()) if pick.random() < 0.7 else odd())


def drawing():
    given = {"teeth": mostly((21, 28)), "module_mm": mostly(3.0)}
    more = ("pressure_angle_deg profile_shifts width_mm planets angles_deg torque_Nm speed_rpm name modul").split()
    return ep.Stage.from_drawing(**given, **{pick.choice(more): odd() for _ in range(pick.randint(0, 2))})


def replace():
    return pick.choice(STAGES).replace({pointer(): odd() for _ in range(pick.randint(1, 2))} if pick.random() < 0.9 else odd())


def gear():
    return ep.Stage.load(mutated(pick.choice(STAGES).to_dict())).gear()


def study():
    return pick.choice(STAGES).study(mostly("sweep"), **names(3))


def check():
    return pick.choice(STAGES).check(mostly("sweep"), **names(3))


def wrong_study():
    if pick.random() < 0.1:
        return refused(STAGES[1].part, mostly("sweep"), mostly(1), mostly(2), out=mostly(folder / "part"))
    return refused(getattr(pick.choice(STAGES), pick.choice(STUDIES)), **names(3))


def point():
    keys = {"parameter": mostly("mesh_frequency_ratio", 0.9), "value": mostly(2.0, 0.5), **FEW, "start": mostly("cold")}
    return pick.choice(STAGES[:2]).point(**keys)


def closed_stream():
    stream = STAGES[1].sweep_stream(points=3, threads=1, **FEW)
    if pick.random() < 0.5:
        next(stream)
    stream.close()
    assert next(stream, None) is None


def rates():
    if pick.random() < 0.2:
        keys = ("speed", "sun_speed_rpm", "mesh_frequency_ratio", "mesh_frequency_Hz", "sped")
        return pick.choice(STAGES).rhs(**{pick.choice(keys): odd()})
    y = RATES.start if pick.random() < 0.3 else odd()
    return RATES(mostly(0.3), y)


# Systems


def system():
    """Return a system that computes, made of good arguments."""
    kind = pick.randrange(4)
    f = library.duffing if kind else (lambda t, y, p: odd())
    period = (lambda p: odd()) if kind == 1 else 5.2
    jacobian = (lambda t, y, p: odd()) if kind == 2 else library.jacobian
    return ep.System(f, 2, PARAMS, period, jacobian)


def make_system():
    f = odd()
    n = mostly(2)
    # A good function with another n would read beyond its state: what is called is never a C function with that.
    if pick.random() < 0.3 and isinstance(n, int) and n == 2 and n is not True:
        f = library.duffing
    return ep.System(f, n, mostly(PARAMS), mostly(5.2), mostly(None))


COUNTS = [1, 2, 3, 0, -1, 1.5, None, "a", True, 2**31 - 1, 2**31, 2**70, np.int8(2), float("nan"), [1]]
TOLERANCES = [1e-6, 1e-8, 0, -1e-8, 1e-300, 1e300, float("nan"), float("inf"), None, "a", [1e-6], True]


def analyse():
    keys = {}
    for key in ("transient", "periods", "longest", "period", "aligning", "budget", "largest_period", "most"):
        keys[key] = pick.choice(COUNTS[:3]) if pick.random() < 0.8 else pick.choice(COUNTS)
    keys["tolerance"] = pick.choice(TOLERANCES[:2]) if pick.random() < 0.7 else pick.choice(TOLERANCES)
    keys["max_step"] = mostly(0.1, 0.8)
    if pick.random() < 0.1:
        keys[pick.choice(["force", "damping", "forc"])] = odd()
    start = mostly([1.0, 0.0], 0.5)
    s = system()
    call = pick.choice(["section", "regime", "exponents", "orbit", "branches"])
    known = {
        "section": ("transient", "periods", "longest", "tolerance"),
        "regime": ("transient", "longest", "tolerance"),
        "exponents": ("transient", "aligning", "periods", "tolerance"),
        "orbit": ("transient", "period", "tolerance"),
        "branches": ("transient", "period", "largest_period", "most", "max_step", "tolerance"),
    }[call]
    given = {k: v for k, v in keys.items() if k in known or k in ("force", "damping", "forc")}
    if call == "regime":
        given["budget"] = pick.choice([1, 64, -1, None, "a", 2**31])
    if call == "branches":
        bounds = (mostly(0.19, 0.9), mostly(0.201, 0.9)) if pick.random() < 0.9 else odd()
        return s.branches(mostly("force", 0.9), bounds, start, **given)
    return getattr(s, call)(start, **given)


# Results


def results():
    kind = pick.randrange(6)
    if kind == 0:
        return ep.open(odd())
    if kind == 1:
        return SWEEP.near(odd(), mostly("up"), mostly("rpm", 0.5))
    if kind == 2:
        return SWEEP.section(odd())
    if kind == 3:
        return SWEEP.table(odd())
    if kind == 4 and pick.random() < 0.5:
        return SWEEP.run_at(odd(), **{pick.choice(KEYS): odd(), "poitns": 3})
    if kind == 4 and pick.random() < 0.04:
        return SWEEP.plot(mostly(pick.choice(COLUMNS)), mostly(None), mostly(None))
    return repr(SWEEP)


# The compiled module itself


def raw():
    kind = pick.randrange(7)
    if kind == 0:
        return _core.Input.parse(mostly("{}"), mostly("x"), mostly(["/study/points=3"]))
    if kind == 1:
        return _core.Input.read(mostly("no"), odd())
    if kind == 2:
        drawn = _core.Drawing()
        setattr(drawn, pick.choice(["teeth", "profile_shifts", "module_mm", "planets", "angles_deg", "torque_Nm"]), odd())
        return drawn.study(mostly("x"))
    if kind == 3:  # never with the address of something
        return _core.System(mostly(2), mostly(0), 0, odd(), 0, odd(), odd()).section(odd(), odd(), odd(), odd(), odd(), odd())
    if kind == 4:
        known = pick.choice(["sweep", "map", None, 3])
        return _core.Job(known, mostly("no"), mostly("x"), mostly(1), mostly([]), mostly(""), mostly(""), mostly(0), odd(), odd())
    if kind == 5:
        job = _core.Job(pick.choice(["sweep", "gear", "run"]), str(folder / "none.json"), str(folder / "x"), 1, [], "", "", 0, 0, 0)
        for _ in range(pick.randint(1, 6)):
            pick.choice([job.stop, lambda: job.wait(0.001), job.messages, job.progress, job.rows, job.result])()
        return None
    s = _core.System(2, 3, ctypes.cast(library.duffing, ctypes.c_void_p).value, None, 0, None, 5.2)
    start, params = [1.0, 0.0], [0.2, 0.3, 1.2]
    small = lambda: pick.choice([1, 2, 3, 0, -1, -(2**31)])  # noqa: E731
    call = pick.randrange(5)
    if call == 0:
        return s.section(start, params, small(), small(), pick.choice(TOLERANCES[:3]), small())
    if call == 1:
        return s.regime(start, params, small(), small(), small(), 1e-6)
    if call == 2:
        return s.exponents(start, params, small(), small(), small(), 1e-6)
    if call == 3:
        return s.orbit(start, params, small(), small(), 1e-8)
    return s.branches(start, params, mostly(0, 0.8), 0.19, 0.201, small(), small(), small(), 0.1, small(), 1e-8)


#: Functions that make one call, and how often they are chosen.
TARGETS = {
    load: 12, drawing: 8, replace: 12, gear: 4, study: 8, check: 6, wrong_study: 8, point: 0.3, closed_stream: 0.1, rates: 14, make_system: 10,
    analyse: 8, results: 8, raw: 8,
}  # fmt: skip


def too_long(*_):
    raise TimeoutError(f"more than {LONGEST:g} s")


def main():
    faulthandler.enable()
    warnings.simplefilter("ignore")
    signal.signal(signal.SIGALRM, too_long)
    raised, found = {}, 0
    for call in range(CALLS):
        target = pick.choices(list(TARGETS), list(TARGETS.values()))[0]
        signal.setitimer(signal.ITIMER_REAL, LONGEST)
        try:
            target()
            name = "no exception"
        except ALLOWED as error:
            name = type(error).__name__
        except BaseException as error:  # a KeyboardInterrupt of the package is a finding, too
            name = type(error).__name__
            found += 1
            if found <= 20:
                print(f"call {call} of seed {SEED}: {target.__name__}: {name}: {str(error)[:200]}")
                traceback.print_exc(limit=-4)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
        raised[name] = raised.get(name, 0) + 1
    print(f"{CALLS} calls of seed {SEED}: " + ", ".join(f"{count} {name}" for name, count in sorted(raised.items())))
    return 1 if found else 0


if __name__ == "__main__":
    try:
        code = main()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    sys.exit(code)
