# SciPy's solve_ivp on the right-hand side of peer_rhs.cpp, at equal global error; as mesh_period_at_equal_error of
# integrators.cpp, in fifths of a decade. Run by tests/bench/table.
import ctypes
import math
import time

import numpy
from scipy.integrate import solve_ivp

PERIOD = 2 * math.pi
ORBIT_PERIODS = 20


class Problem:
    """The right-hand side between its breakpoints, a state on the orbit, and where 20 mesh periods lead from it."""

    def __init__(self, library, omega):
        doubles = ctypes.c_void_p
        self.library = ctypes.CDLL(library)
        self.library.peer_open.argtypes = [ctypes.c_double]
        self.library.peer_rhs.argtypes = [ctypes.c_int, ctypes.c_double, doubles, doubles]
        self.library.peer_rhs.restype = None
        n = self.library.peer_open(omega)
        if n == 0:
            raise RuntimeError(f"no attracting periodic orbit at {omega}")
        self.start, self.reference = numpy.empty(n), numpy.empty(n)
        stops = numpy.empty(self.library.peer_stops())
        self.library.peer_read(*(doubles(a.ctypes.data) for a in (self.start, self.reference, stops)))
        self.stops = [*stops, PERIOD]

    def piece(self, k):
        rhs, n = self.library.peer_rhs, len(self.start)

        def f(s, y):
            out = numpy.empty(n)
            rhs(k, s, y.ctypes.data, out.ctypes.data)
            return out

        return f


class SciPy:
    def __init__(self, problem, method):
        self.problem, self.method = problem, method
        self.pieces = [problem.piece(k) for k in range(len(problem.stops))]

    def begin(self, tolerance):
        self.tolerance, self.step, self.calls = tolerance, None, 0

    def mesh_period(self, y):
        s = 0.0
        longest = 0.0
        for f, stop in zip(self.pieces, self.problem.stops):
            first = None if self.step is None else min(self.step, stop - s)
            solution = solve_ivp(f, (s, stop), y, self.method, rtol=self.tolerance, atol=1e-2 * self.tolerance,
                                 first_step=first)
            if not solution.success:
                raise RuntimeError(solution.message)
            longest = max(longest, numpy.diff(solution.t).max())
            self.calls += solution.nfev
            y, s = solution.y[:, -1].copy(), stop
        self.step = longest
        return y

    def error(self, tolerance):
        self.begin(tolerance)
        y = self.problem.start
        for _ in range(ORBIT_PERIODS):
            y = self.mesh_period(y)
        reference = self.problem.reference
        return abs(y - reference).max() / abs(reference).max()


def tolerance_for(error, digits):
    """Read from the straight line through the errors within a factor of 10 of the wanted one."""
    points = {}

    def look(k):
        points[k] = math.log10(error(10 ** (k / 5)))
        return points[k] + digits

    k = -5 * digits
    while look(k) < 1 and k < -15:
        k += 1
    k = -5 * digits - 1
    while look(k) > -1 and k > -65:
        k -= 1
    near = [(e, k / 5) for k, e in points.items() if abs(e + digits) <= 1]
    if len(near) < 5:
        raise RuntimeError("too few tolerances give an error near the wanted one")
    slope, offset = numpy.polyfit(*zip(*near), 1)
    return 10 ** (offset - slope * digits)


def measure(library, omega, digits, methods, repetitions, seconds):
    """Rows (method, right-hand sides a period, microseconds a period, tolerance); the least of the repetitions, which
    take turns."""
    problem = Problem(library, omega)
    runs = []
    for method in methods:
        run = SciPy(problem, method)
        tolerance = tolerance_for(run.error, digits)
        run.begin(tolerance)
        runs.append([run, problem.start, math.inf, 0])
    for _ in range(repetitions):
        for row in runs:
            run = row[0]
            began, periods = time.process_time(), 0
            while time.process_time() - began < seconds:
                row[1] = run.mesh_period(row[1])
                periods += 1
            row[2] = min(row[2], (time.process_time() - began) / periods)
            row[3] += periods
    return [(run.method, run.calls / periods, 1e6 * least, run.tolerance) for run, _, least, periods in runs]
