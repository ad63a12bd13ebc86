"""What the Python package computes: the same bytes as the command, stops, errors, equations, systems of one's own."""

import copy
import ctypes
import gc
import importlib.util
import json
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import epicyclic as ep
import numpy as np

PROGRAM = Path(os.environ["EPICYCLIC"]).resolve()
INPUTS = Path(os.environ["EPICYCLIC_INPUTS"])
FEW = {"transient_periods": 2, "recorded_periods": 8, "classification_periods": 0, "crosscheck": {"points": 0}}


def stage(name="tang2020_speed.json"):
    return ep.Stage.load(INPUTS / name)


def command(*words, code=0):
    """Run the command, and return what it says."""
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
    assert done.returncode == code, (done.returncode, done.stderr)
    return done.stderr


def files_of(folder):
    """Return the bytes of all files but those that hold times."""
    folder = Path(folder)
    return {
        str(f.relative_to(folder)): f.read_bytes()
        for f in sorted(folder.rglob("*"))
        if f.is_file() and f.name not in ("run.json", ".lock")
    }


class Folders(unittest.TestCase):
    """A folder for each test."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory(dir=".")
        self.work = Path(self._folder.name)

    def tearDown(self):
        self._folder.cleanup()


class Studies(Folders):
    def test_a_sweep_has_the_bytes_of_the_command(self):
        result = stage().sweep(out=self.work / "a", points=4, threads=1, **FEW)
        self.assertEqual(len(result.points), 8)
        command("sweep", self.work / "a" / "input.json", "-o", self.work / "b", "--threads", 1)
        left, right = files_of(self.work / "a"), files_of(self.work / "b")
        self.assertEqual(sorted(left), sorted(right))
        self.assertEqual([name for name in left if left[name] != right[name]], [])
        self.assertIn("results.h5", left)
        sets = [f"/study/{k}={json.dumps(v)}" for k, v in {"points": 4, **FEW}.items() if k != "crosscheck"]
        sets.append("/study/crosscheck/points=0")
        words = [w for s in sets for w in ("--set", s)]
        command("sweep", INPUTS / "tang2020_speed.json", "-o", self.work / "c", *words)
        for name in ("points.csv", "poincare.csv"):
            self.assertEqual((self.work / "a" / name).read_bytes(), (self.work / "c" / name).read_bytes())

    def test_a_stage_alone_is_swept(self):
        keys = {"parameter": "mesh_frequency_ratio", "from_": 2.0, "to": 2.2, "points": 2, **FEW}
        result = stage("tang2020.json").sweep(**keys)
        folder = result.folder
        self.assertTrue(folder.is_dir())
        self.assertEqual(list(result.points["value"]), [2.0, 2.2, 2.0, 2.2] if len(result.points) == 4 else [2.0, 2.2])
        del result
        gc.collect()
        self.assertFalse(folder.exists())

    def test_other_kinds(self):
        plane = {"first": {"points": 2}, "second": {"points": 2}, "transient": "fixed"}
        few = {k: v for k, v in FEW.items() if k != "crosscheck"}
        shown = []
        result = stage("tang2020_map.json").map(progress=lambda *state: shown.append(state), **plane, **few)
        self.assertEqual(result.kind, "map")
        self.assertEqual(shown[-1][:3], ("map", len(result.points), len(result.points)))
        self.assertEqual(stage("tang2020_basins.json").basins(**plane, **few).kind, "basins")
        self.assertIsInstance(
            stage("tang2020_run.json").run(recorded_periods=16, exponent_periods=12, spectrum_periods=16), ep.Run
        )

    def test_rows_come_while_it_computes(self):
        rows = list(stage().sweep_stream(points=4, **FEW))
        self.assertEqual(sorted(row["point"] for row in rows), list(range(8)))
        table = stage().sweep(points=4, **FEW).points
        first = min(rows, key=lambda row: row["point"])
        self.assertEqual(first["force_sp_max"], table["force_sp_max"][0])
        stream = stage().sweep_stream(points=400, **FEW)
        next(stream)
        begun = time.monotonic()
        stream.close()
        self.assertLess(time.monotonic() - begun, 10)
        point = stage().point(value=first["value"], **{**FEW, "start": "cold"})
        self.assertEqual(point["value"], first["value"])

    def test_a_run_from_a_point(self):
        result = stage().sweep(out=self.work / "a", points=3, **FEW)
        point = result.near(3.5, direction="down")
        run = result.run_at(point, recorded_periods=16, exponent_periods=12, spectrum_periods=16, threads=1)
        self.assertEqual((run.kind, run.points.value[0]), ("run", 3.5))
        self.assertEqual(run.input["study"]["initial_state"], list(result.section(point)[stage().rhs().names].iloc[-1]))
        self.assertEqual(result.run_at(int(point.point), exponent_periods=12, spectrum_periods=16).points.value[0], 3.5)
        with self.assertRaises(ep.InputError) as caught:
            result.run_at(0, exponent_period=12)
        problem = caught.exception.problems[0]
        self.assertEqual((problem.file, problem.pointer, problem.suggestion), ("", "/study/exponent_period", "exponent_periods"))
        for wrong in (6, -1, None, "0", {}):
            with self.assertRaises(ep.ResultError):
                result.run_at(wrong)

    def test_check_computes_nothing(self):
        few = {k: v for k, v in FEW.items() if k != "crosscheck"}
        found = stage().check("sweep", points=4, transient="fixed", **few)
        self.assertEqual((found["problems"], found["points"], found["mesh_periods"]), ([], 8, 80))
        self.assertEqual(stage().check(), stage().check("sweep"))
        self.assertEqual(stage("tang2020.json").check()["problems"], [])
        problem = stage("tang2020_map.json").check("sweep", poitns=4)["problems"][0]
        self.assertEqual((problem.file, problem.pointer, problem.suggestion), ("", "/study/poitns", "points"))
        drawn = ep.Stage.from_drawing(teeth=(24, 30), module_mm=2.5, width_mm=30, torque_Nm=60)
        self.assertRegex(drawn.check()["warnings"][0], "^/stage/.*the estimate decides the regime")
        self.assertNotIn("points", stage("tang2020_branches.json").check())
        with self.assertRaises(TypeError):
            stage("tang2020.json").check(points=4)
        self.assertTrue(stage().check("swep")["problems"])
        with self.assertRaises(TypeError):
            stage().check([[3]])

    def test_gear(self):
        found = stage("tang2020.json").gear()
        self.assertGreater(len(found["quantities"]), 20)
        written = stage("tang2020.json").gear(out=self.work / "gear")
        self.assertEqual(len(found["modes"]), len(written.table("modes")))
        self.assertAlmostEqual(found["modes"][1]["frequency_Hz"], written.table("modes")["frequency_Hz"][1], 9)

    def test_one_computation_in_a_folder(self):
        stream = stage().sweep_stream(out=self.work / "a", points=400, **FEW)
        next(stream)
        with self.assertRaisesRegex(ep.OutputError, "in use"):
            stage().sweep(out=self.work / "a", points=400, **FEW)
        with self.assertRaisesRegex(ep.OutputError, "another study|in use"):
            stage().sweep(out=self.work / "a", points=5, **FEW)
        stream.close()
        with self.assertRaisesRegex(ep.OutputError, "another study"):
            stage().sweep(out=self.work / "a", points=5, **FEW)

    def test_two_threads_of_python(self):
        found = {}

        def work(points):
            found[points] = list(stage().sweep(points=points, threads=1, **FEW).points["force_sp_max"])

        threads = [threading.Thread(target=work, args=(points,)) for points in (2, 3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found[3], list(stage().sweep(points=3, **FEW).points["force_sp_max"]))

    def interrupt_and_resume(self, sent, exit_code, state):
        """A sweep in Python is ended by a signal; the command computes the rest, with the bytes of one command."""
        script = (
            "import sys, epicyclic as ep\n"
            f"stage = ep.Stage.load({str(INPUTS / 'tang2020_speed.json')!r})\n"
            "try:\n"
            f"    stage.sweep(out={str(self.work / 'a')!r}, points=200, threads=2, **{FEW!r})\n"
            "except KeyboardInterrupt:\n"
            "    sys.exit(33)\n"
        )
        with subprocess.Popen([sys.executable, "-W", "ignore", "-c", script]) as process:
            journals = []
            while process.poll() is None and sum(j.stat().st_size for j in journals) < 20000:
                time.sleep(0.02)
                journals = list((self.work / "a").glob("journal*"))
            process.send_signal(sent)
            self.assertEqual(process.wait(30), exit_code)
        run = json.loads((self.work / "a" / "run.json").read_text())
        self.assertEqual(run["state"], state)
        command("sweep", self.work / "a" / "input.json", "-o", self.work / "a", "--threads", 2)
        run = json.loads((self.work / "a" / "run.json").read_text())
        self.assertEqual(run["state"], "complete")
        self.assertEqual(len(run["earlier_sessions"]), 1)
        command("sweep", self.work / "a" / "input.json", "-o", self.work / "b", "--threads", 2)
        left, right = files_of(self.work / "a"), files_of(self.work / "b")
        for name in ("points.csv", "poincare.csv", "input.resolved.json", "input.json", "sweep.md"):
            self.assertEqual(left[name], right[name], name)

    def test_ctrl_c_is_resumed_by_the_command(self):
        self.interrupt_and_resume(signal.SIGINT, 33, "stopped")

    def test_a_killed_process_is_resumed_by_the_command(self):
        self.interrupt_and_resume(signal.SIGKILL, -signal.SIGKILL, "running")


def call(task):
    """Call a method of a stage with keyword arguments: what processes of a pool are given."""
    stage, method, keys = task
    return getattr(stage, method)(**keys)


class Workers(Folders):
    KEYS = {"first": {"points": 3}, "second": {"points": 2}, "transient": "fixed", "transient_periods": 2, "recorded_periods": 8}

    def setUp(self):
        super().setUp()
        self.map = stage("tang2020_map.json")

    def tasks(self):
        """Return the tasks of both parts of a map, and those of single points."""
        part = {"kind": "map", "of": 2, "out": self.work / "parts", "threads": 1, **self.KEYS}
        parts = [(self.map, "part", {**part, "number": number}) for number in (1, 2)]
        point = {**FEW, "parameter": "mesh_frequency_ratio", "start": "cold"}
        points = [(stage("tang2020.json"), "point", {**point, "value": value}) for value in (2.0, 2.1)]
        return parts + points

    def check(self, found):
        self.assertEqual(found[:2], [None, None])
        self.assertEqual([row["value"] for row in found[2:]], [2.0, 2.1])
        self.assertEqual(found[2]["kv_sp"], call(self.tasks()[2])["kv_sp"])
        self.map.map(out=self.work / "parts", **self.KEYS)
        self.map.map(out=self.work / "whole", **self.KEYS)
        parts, whole = files_of(self.work / "parts"), files_of(self.work / "whole")
        for name in ("points.csv", "input.json", "input.resolved.json"):
            self.assertEqual(parts[name], whole[name], name)

    def test_new_processes(self):
        pool = ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn"))
        with pool:
            self.check(list(pool.map(call, self.tasks())))

    def test_forked_processes_of_one_that_has_computed(self):
        stage("tang2020.json").point(value=2.0, parameter="mesh_frequency_ratio", **FEW)
        with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("fork")) as pool:
            self.check(list(pool.map(call, self.tasks())))

    @unittest.skipUnless(importlib.util.find_spec("distributed"), "dask.distributed is not installed")
    def test_dask(self):
        from distributed import Client, LocalCluster

        with LocalCluster(2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
            self.check(client.gather(client.map(call, self.tasks(), pure=False)))

    def test_parts_that_are_not_there(self):
        for kind, number, of in (("run", 1, 2), ("map", 0, 2), ("map", 3, 2), ("map", 1.0, 2), ("map", True, 2), ("map", 1, 10001)):
            with self.assertRaises(ep.InputError):
                self.map.part(kind, number, of, out=self.work / "none", **self.KEYS)
        self.assertFalse((self.work / "none").exists())


class Stages(unittest.TestCase):
    def test_a_stage_does_not_change(self):
        s = stage("tang2020.json")
        with self.assertRaises(AttributeError):
            s.name = "other"
        d = s.to_dict()
        d["catalogue"].clear()
        self.assertTrue(s.to_dict()["catalogue"])
        other = s.replace({"/stage/catalogue/sun/width_mm": 25})
        self.assertNotEqual(other, s)
        self.assertEqual(other.to_dict()["catalogue"]["sun"]["width_mm"], 25)
        self.assertEqual(s, pickle.loads(pickle.dumps(s)))
        self.assertEqual(hash(s), hash(copy.deepcopy(s)))
        self.assertIn("27/25/81", repr(s))

    def test_a_drawing(self):
        s = ep.Stage.from_drawing(teeth=(21, 28), module_mm=3, torque_Nm=200, speed_rpm=3000)
        self.assertEqual(s.to_dict()["study"]["kind"], "sweep")
        self.assertIn("21/28/77", repr(s))
        with self.assertRaises(ep.InputError):
            ep.Stage.from_drawing(teeth=(21, 28, 5))
        pair = ep.Stage.from_drawing(teeth=(20, 31), module_mm=4, profile_shifts=(0.3, 0.1), torque_Nm=200, pair=True)
        self.assertIn("20/31 teeth, a pair", repr(pair))
        self.assertEqual(pair.check()["problems"], [])
        quantities = pair.gear()["quantities"]
        self.assertGreater(quantities["sun_planet_contact_ratio"]["value"], 1)
        self.assertNotIn("ring_module", quantities)
        self.assertEqual(pair.rhs(mesh_frequency_ratio=0.5).dimension, 2)
        for given in ({"teeth": (20, 31, 82)}, {"teeth": (20, 31), "planets": 3}, {"teeth": (20, 31), "profile_shifts": (0, 0, 0)}):
            with self.assertRaises(ep.InputError):
                ep.Stage.from_drawing(**given, pair=True)
        with self.assertRaises(TypeError):
            ep.Stage.from_drawing(teeth=(21, 28), modul=3)

    def test_errors_come_all_at_once(self):
        with self.assertRaises(ep.InputError) as caught:
            stage("tang2020.json").sweep(parameter="mesh_frequency_ratio", from_=2, to=3, poitns=4, threads=1)
        problems = caught.exception.problems
        meant = [p for p in problems if p.pointer.endswith("poitns")]
        self.assertEqual(len(meant), 1)
        self.assertIn("points", meant[0].suggestion)
        self.assertEqual((meant[0].file, meant[0].line), ("", 0))
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            file.write('{"stage": 3,\n "study": {"kind": "swep"}}')
            file.flush()
            with self.assertRaises(ep.InputError) as caught:
                ep.Stage.load(file.name)
        problem = [p for p in caught.exception.problems if "kind" in p.pointer][0]
        self.assertEqual((problem.file, problem.line), (file.name, 2))
        self.assertIn("sweep", problem.suggestion)
        with tempfile.NamedTemporaryFile("w", suffix=".json", encoding="utf-8") as file:
            file.write(300 * "é")
            file.flush()
            with self.assertRaisesRegex(ep.InputError, "json:1: "):
                ep.Stage.load(file.name)
        again = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual(again.problems, caught.exception.problems)

    def test_warnings_and_logging(self):
        keys = {"parameter": "mesh_frequency_ratio", "from_": 2, "to": 2.1, "points": 2, **FEW}
        with tempfile.TemporaryDirectory(dir=".") as folder:
            narrow = stage("tang2020.json").replace({"/stage/catalogue/sun/width_mm": 25})
            with self.assertWarnsRegex(UserWarning, "width_mm") as caught:
                narrow.sweep(out=folder, **keys)
            self.assertEqual(Path(caught.filename).name, "computing_checks.py")
            with self.assertLogs("epicyclic", "INFO") as logs:
                narrow.sweep(out=folder, **keys)
            self.assertIn("complete already", " ".join(logs.output))


class Equations(unittest.TestCase):
    def test_they_are_those_of_the_program(self):
        from scipy.integrate import solve_ivp

        keys = {**FEW, "transient_periods": 300, "recorded_periods": 16}
        result = stage().sweep(from_=2.8, to=2.8, points=1, directions=["up"], **keys)
        section = result.section(0)
        f = stage().rhs(mesh_frequency_ratio=2.8)
        self.assertEqual(f.dimension, len(f.names))
        states = section[f.names].to_numpy()
        reached = solve_ivp(f, (0, f.period), states[0], method="DOP853", rtol=1e-10, atol=1e-12, vectorized=True)
        self.assertTrue(reached.success)
        self.assertLess(abs(reached.y[:, -1] - states[1]).max(), 1e-6)

    def test_shapes_and_what_is_refused(self):
        f = stage("tang2020.json").rhs(speed=12000)
        y = np.stack([f.start, 1.01 * f.start], axis=1)
        both = f(0.3, y)
        self.assertEqual(both.shape, y.shape)
        np.testing.assert_array_equal(both[:, 1], f(0.3, 1.01 * f.start))
        np.testing.assert_array_equal(both[:, 0], f(0.3, np.asfortranarray(y))[:, 0])
        for wrong in ([1.0], "state", None, f.start[:-1], f.start * np.nan, f.start + 1j, [[[0.0]]], {}):
            with self.assertRaises((ep.InputError, TypeError)):
                f(0.0, wrong)
        with self.assertRaises(ep.InputError):
            f(float("nan"), f.start)
        with self.assertRaises(ep.InputError):
            stage("tang2020.json").rhs(sped=3)

    def test_it_lives_longer_than_its_stage(self):
        s = stage("tang2020.json")
        f = s.rhs(mesh_frequency_ratio=2.1)
        before = f(0.1, f.start)
        del s
        gc.collect()
        np.testing.assert_array_equal(before, f(0.1, f.start))


def compiled():
    """Return Duffing's oscillator and its Jacobian as functions of ctypes."""
    library = ctypes.CDLL(os.environ["EPICYCLIC_DUFFING"])
    return library.duffing, library.jacobian


def duffing(force, jacobian=True):
    f, j = compiled()
    params = {"force": force, "damping": 0.3, "frequency": 1.2}
    return ep.System(f, 2, params, lambda p: 2 * np.pi / p[2], jacobian=j if jacobian else None)


class Systems(unittest.TestCase):
    #: Published period doublings [docs/theory/continuation.md].
    DOUBLINGS = (0.2655817861, 0.2866931578)

    def check_doublings(self, system):
        branches = system.branches("force", (0.2, 0.3), [1.0, 0.0], largest_period=2)
        self.assertEqual([b.period for b in branches], [1, 2])
        for branch, published in zip(branches, self.DOUBLINGS):
            flips = [s for s in branch.special if s.kind == "flip"]
            at = min(flips, key=lambda s: abs(s.value - published))
            self.assertLess(at.error_bound, 1e-8)
            self.assertLess(abs(at.value - published), 1e-8)
            self.assertEqual(branch.states.shape, (len(branch.value), branch.period, 2))
            self.assertEqual(branch.multipliers.shape, (len(branch.value), 2))

    def test_doublings(self):
        self.check_doublings(duffing(0.2))
        self.assertEqual(duffing(0.2, jacobian=False).derivatives, "differences")
        self.check_doublings(duffing(0.2, jacobian=False))

    @unittest.skipUnless(importlib.util.find_spec("numba"), "numba is not installed")
    def test_doublings_of_functions_of_numba(self):
        from numba import carray, cfunc, types

        doubles = types.CPointer(types.double)
        signature = types.void(types.double, doubles, doubles, doubles)

        @cfunc(signature)
        def f(t, y, p, dydt):
            dydt[0] = y[1]
            dydt[1] = p[0] * np.cos(p[2] * t) - p[1] * y[1] + y[0] - y[0] ** 3

        @cfunc(signature)
        def j(t, y, p, out):
            rows = carray(out, (2, 2))
            rows[0, 0], rows[0, 1], rows[1, 0], rows[1, 1] = 0.0, 1.0, 1.0 - 3.0 * y[0] ** 2, -p[1]

        params = {"force": 0.2, "damping": 0.3, "frequency": 1.2}
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # that of a Python function would be one
            system = ep.System(f, 2, params, lambda p: 2 * np.pi / p[2], jacobian=j)
            of_address = ep.System(f.address, 2, params, 2 * np.pi / 1.2)
        wrong = cfunc(types.void(types.double, doubles, doubles))(lambda t, y, p: None)
        with self.assertRaisesRegex(ep.InputError, "signature"):
            ep.System(wrong, 2, params, 1.0)
        self.check_doublings(system)
        states = [s.section([1.0, 0.0], transient=2, periods=4).states for s in (system, of_address, duffing(0.2))]
        np.testing.assert_allclose(states[0], states[2], atol=1e-9)
        np.testing.assert_allclose(states[1], states[2], atol=1e-9)

    def test_regimes_and_exponents(self):
        system = duffing(0.2)
        periodic = system.regime([1.0, 0.0])
        self.assertEqual((periodic.regime, periodic.period), ("periodic", 1))
        self.assertEqual(system.regime([1.0, 0.0], force=0.28).period, 2)
        chaotic = system.regime([1.0, 0.0], force=0.5)
        self.assertEqual(chaotic.regime, "chaotic")
        low, high = chaotic.exponent_interval
        self.assertTrue(0 < low < chaotic.exponent < high)
        exponents = system.exponents([1.0, 0.0], force=0.5)
        self.assertLess(abs(exponents.sum + 0.3), 1e-6)  # the divergence is minus the damping
        self.assertTrue(low - 0.02 < exponents.values[0] < high + 0.02)

    def test_orbits_and_sections(self):
        system = duffing(0.28)
        section = system.section([1.0, 0.0])
        self.assertEqual((section.states.shape, section.period), ((128, 2), 2))
        orbit = system.orbit(section.states[-1], period=2)
        self.assertTrue(orbit.stable)
        self.assertLess(orbit.error, 1e-8)
        self.assertLess(abs(orbit.state - section.states[-1]).max(), 1e-6)
        self.assertAlmostEqual(np.prod(orbit.multipliers).real, np.exp(-0.3 * 2 * 2 * np.pi / 1.2), 9)
        unstable = system.orbit([0.42, 0.31], period=1)
        self.assertFalse(unstable.stable)
        with self.assertRaises(ep.NumericalError):
            duffing(0.5).orbit([50.0, 90.0], period=1)

    def test_a_function_of_python(self):
        def f(t, y, p):
            return [y[1], p[0] * np.cos(p[2] * t) - p[1] * y[1] + y[0] - y[0] ** 3]

        with self.assertWarnsRegex(UserWarning, "Python function"):
            system = ep.System(f, 2, {"force": 0.2, "damping": 0.3, "frequency": 1.2}, 2 * np.pi / 1.2)
        section = system.section([1.0, 0.0], transient=20, periods=4, tolerance=1e-8)
        with_c = duffing(0.2).section([1.0, 0.0], transient=20, periods=4, tolerance=1e-8)
        np.testing.assert_allclose(section.states, with_c.states, atol=1e-9)

        def fails(t, y, p):
            raise ZeroDivisionError("of the user")

        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            wrong = [ep.System(g, 2, {}, 1.0) for g in (fails, lambda t, y, p: [1.0], lambda t, y, p: "ab")]
        with self.assertRaisesRegex(ZeroDivisionError, "of the user"):
            wrong[0].section([1.0, 0.0])
        for system in wrong[1:]:
            with self.assertRaises(ep.InputError):
                system.section([1.0, 0.0])

    def test_wrong_arguments_raise(self):
        f, _ = compiled()
        params = {"force": 0.2, "damping": 0.3, "frequency": 1.2}
        for arguments in (
            (0, 2, params, 1.0), (4096, 2, params, 1.0), (id(params), 2, params, 1.0), (None, 2, params, 1.0),
            (f, 0, params, 1.0), (f, -2, params, 1.0), (f, 2.0, params, 1.0), (f, True, params, 1.0),
            (f, 2, {"force": "x"}, 1.0), (f, 2, {"force": np.nan}, 1.0), (f, 2, params, 0), (f, 2, params, np.inf),
        ):
            with self.assertRaises(ep.InputError):
                ep.System(*arguments)
        rng = np.random.default_rng(1)
        system = duffing(0.2)
        odd = [None, "a", [], [1.0], [np.nan, 0.0], [1e400, 0.0], -1, 0, 1.5, True, {}, (), object(), 1j, 2**70, [[1.0, 0.0]]]
        for _ in range(2000):
            pick = lambda: odd[rng.integers(len(odd))]  # noqa: E731
            with self.assertRaises((ep.InputError, ep.NumericalError, TypeError)):
                call = rng.integers(5)
                if call == 0:
                    system.section(pick(), periods=2, transient=1)
                elif call == 1:
                    system.regime([1.0, 0.0], budget=pick() if rng.integers(2) else "b", force=pick())
                elif call == 2:
                    system.orbit(pick(), period=pick())
                elif call == 3:
                    system.branches("force", (pick(), 0.3), pick())
                else:
                    system.exponents(pick(), periods=1)


class Memory(unittest.TestCase):
    def test_it_is_flat(self):
        def resident():
            with open("/proc/self/statm", encoding="ascii") as statm:
                return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

        s = stage("tang2020.json")
        f = s.rhs(mesh_frequency_ratio=2.1)

        def make(many):
            for k in range(many):
                duffing(0.2)
                f(0.1 * k, f.start)
                if k % 4 == 0:
                    pickle.loads(pickle.dumps(s))
                if k % 200 == 0:
                    s.rhs(mesh_frequency_ratio=2.0 + 1e-4 * k)
                    s.replace({"/stage/catalogue/sun/width_mm": 30 + 1e-3 * k})
            gc.collect()

        make(1000)
        before = resident()
        make(10000)
        self.assertLess(resident() - before, 8e6)


if __name__ == "__main__":
    unittest.main(verbosity=1, warnings="ignore")
