"""Results of the program as the Python package reads them: the folders of EPICYCLIC_RESULTS."""

import json
import os
import shutil
import tempfile
import unittest
import warnings
from pathlib import Path
from unittest import mock

import h5py
import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pandas
import xarray

import epicyclic as ep
from epicyclic import _tables

matplotlib.use("agg")
RESULTS = Path(os.environ["EPICYCLIC_RESULTS"])
KINDS = {
    "speed": ep.Sweep,
    "rpm": ep.Sweep,
    "map": ep.Map,
    "basins": ep.Basins,
    "run": ep.Run,
    "branches": ep.Branches,
    "tolerance": ep.Tolerance,
    "crosscheck": ep.Crosscheck,
    "gear": ep.Gear,
}


def same(first, second):
    """Whether two columns have the same values; unknown ones are NaN, or empty where all cells are."""
    if first.dtype.kind in "if" and second.dtype.kind in "if":
        return np.array_equal(first.astype(float), second.astype(float), equal_nan=True)
    text = [["" if v is None or v != v else str(v) for v in column] for column in (first, second)]
    return text[0] == text[1]


class Copy:
    """A folder of its own with a copy of a result."""

    def __init__(self, name):
        self.name = name

    def __enter__(self):
        self.folder = Path(tempfile.mkdtemp())
        shutil.copytree(RESULTS / self.name, self.folder / "copy")
        return self.folder / "copy"

    def __exit__(self, *error):
        shutil.rmtree(self.folder)


class Tables(unittest.TestCase):
    def test_each_kind_has_its_class_and_all_its_tables(self):
        for name, cls in KINDS.items():
            with self.subTest(name):
                result = ep.open(RESULTS / name)
                self.assertIs(type(result), cls)
                self.assertGreater(len(result.points), 0)
                for table in result.tables:
                    self.assertGreater(len(result.table(table).columns), 0)
                self.assertEqual(result.input, json.loads((RESULTS / name / "input.resolved.json").read_text()))
                self.assertIn(type(result).__name__, repr(result))
                self.assertIn(str(result.folder), result._repr_html_())
                result.verify()

    def test_summaries_are_those_of_the_program(self):
        names = {"speed": "sweep.md", "run": "summary.md", "branches": "continue.md", "gear": "gear.md"}
        for name, file in names.items():
            self.assertEqual(ep.open(RESULTS / name).summary, (RESULTS / name / file).read_text(encoding="utf-8"))
        with self.assertRaisesRegex(ep.ResultError, "no results in words"):
            ep.open(RESULTS / "map").summary

    def test_results_h5_csv_and_pandas_agree(self):
        for name in KINDS:
            result, again = ep.open(RESULTS / name), ep.open(RESULTS / name)
            again._hdf5._h5py = None
            for table in result.tables:
                one, two = result._table(table), again._table(table)
                frame = pandas.read_csv(RESULTS / name / f"{table}.csv")  # without options
                self.assertEqual(list(one.columns), list(two.columns))
                self.assertEqual(list(one.columns), list(frame.columns))
                for column in one.columns:
                    with self.subTest(name=name, table=table, column=column):
                        self.assertTrue(same(one.columns[column], two.columns[column]))
                        # pandas reads the last digit of some numbers differently by default.
                        if frame[column].dtype.kind == "f" and one.columns[column].dtype.kind in "if":
                            known = np.isfinite(one.columns[column].astype(float))
                            np.testing.assert_allclose(frame[column][known], one.columns[column][known], rtol=1e-12)
                        else:
                            self.assertTrue(same(one.columns[column], frame[column].to_numpy()))

    def test_units_of_each_number(self):
        for name in ("speed", "map", "basins", "run", "branches"):
            points = ep.open(RESULTS / name).points
            for column in points:
                if points[column].dtype.kind in "if":
                    self.assertIn(column, points.attrs["units"], name)
                self.assertIn(column, points.attrs["meaning"], name)
        self.assertEqual(ep.open(RESULTS / "speed").units["force_sp_max"], "N")
        history = ep.open(RESULTS / "run").history
        self.assertEqual(set(history.columns), set(history.attrs["units"]))
        section = ep.open(RESULTS / "speed").table("poincare")
        self.assertEqual(section.attrs["units"]["x_s_rate"], "b_c per tau")
        self.assertEqual(set(section.columns), set(section.attrs["units"]))

    def test_without_h5py_it_says_so(self):
        result = ep.open(RESULTS / "speed")
        result._hdf5._h5py = None
        self.assertTrue(any("h5py" in text for text in result.warnings))
        self.assertEqual(result.units, {})

    def test_warnings_count_points(self):
        undecided = int((ep.open(RESULTS / "speed").points.regime == "undecided").sum())
        self.assertGreater(undecided, 0)
        self.assertTrue(any(text.startswith(f"{undecided} points have the regime") for text in
                            ep.open(RESULTS / "speed").warnings))


class Points(unittest.TestCase):
    def test_near_by_value_speed_and_direction(self):
        result = ep.open(RESULTS / "rpm")
        points = result.points
        down = result.near(17001, direction="down")
        self.assertEqual(down.direction, "down")
        self.assertAlmostEqual(down.sun_speed_rpm, 17000)
        self.assertEqual(result.near(17001, "up", by="rpm").point, 1)
        self.assertEqual(result.near(points.value[2], "up", by="value").point, 2)
        self.assertEqual(result.near(points.mesh_frequency_Hz[0], "up", by="Hz").point, 0)
        self.assertEqual(ep.open(RESULTS / "speed").near(0.2, "up").point, 0)
        for bad in (lambda: result.near(1, by="no_such"), lambda: result.near(1, "sideways"),
                    lambda: result.near(1, by="regime")):
            with self.assertRaises(ep.ResultError):
                bad()
        with self.assertRaisesRegex(ep.ResultError, 'outside of mesh_frequency_ratio|outside of value'):
            ep.open(RESULTS / "speed").near(17001)

    def test_section_has_the_points_of_the_csv_file(self):
        result = ep.open(RESULTS / "speed")
        rows = pandas.read_csv(RESULTS / "speed" / "poincare.csv")
        for point in (0, result.points.iloc[5]):
            number = point if isinstance(point, int) else point.point
            section = result.section(point)
            self.assertEqual(len(section), 8)  # recorded_periods
            np.testing.assert_allclose(section.delta_sp_1, rows[rows.point == number].delta_sp_1, rtol=1e-12)
        with self.assertRaises(ep.ResultError):
            result.section(99)
        with self.assertRaisesRegex(ep.ResultError, "no Poincaré points"):
            ep.open(RESULTS / "map").section(0)
        self.assertEqual(len(ep.open(RESULTS / "run").section()), 16)

    def test_sections_and_multipliers_of_orbits(self):
        result = ep.open(RESULTS / "branches")
        for number in (0, len(result.points) - 1):
            orbit = result.points.iloc[number]
            self.assertEqual(len(result.section(number)), orbit.period)
            self.assertTrue(result.section(orbit).equals(result.section(number)))
        self.assertEqual(result.multipliers.shape[0], len(result.points))
        np.testing.assert_allclose(np.abs(result.multipliers[:, 0]), result.points.multiplier_max)
        self.assertGreater(len(result.special), 0)
        with self.assertRaises(ep.ResultError):
            result.section(10**6)


class Xarray(unittest.TestCase):
    def test_sweep_has_direction_value_and_planet(self):
        result = ep.open(RESULTS / "speed")
        data = result.to_xarray()
        self.assertEqual(dict(data.sizes), {"direction": 2, "value": 4, "planet": 3})
        points = result.points
        for row in points.itertuples():
            cell = data.sel(direction=row.direction, value=row.value)
            self.assertEqual(int(cell.point), row.point)
            self.assertEqual(float(cell.delta_sp_max), row.delta_sp_max)
            self.assertEqual(float(cell.force_sp_i_max.sel(planet=2)), row.force_sp_2_max)
        self.assertEqual(data.force_sp_i_max.attrs["units"], "N")
        self.assertNotIn("planet", data.force_sp_max.dims)

    def test_map_has_both_values(self):
        result = ep.open(RESULTS / "map")
        data = result.to_xarray()
        self.assertEqual(dict(data.sizes), {"direction": 2, "second_value": 2, "value": 3, "planet": 3})
        for row in result.points.itertuples():
            cell = data.sel(direction=row.direction, second_value=row.second_value, value=row.value)
            self.assertEqual(int(cell.point), row.point)
        self.assertEqual(data.second_value.attrs["long_name"], "damping_ratio")

    def test_other_kinds(self):
        self.assertEqual(set(ep.open(RESULTS / "run").to_xarray().dims), {"time", "planet"})
        orbits = ep.open(RESULTS / "branches").to_xarray()
        self.assertEqual(orbits.sizes["orbit"], len(ep.open(RESULTS / "branches").points))
        self.assertIn("value", orbits.coords)
        self.assertEqual(set(ep.open(RESULTS / "gear").to_xarray().dims), {"phase"})
        for name in ("tolerance", "crosscheck"):
            self.assertEqual(set(ep.open(RESULTS / name).to_xarray().dims), {"point", "planet"})

    def test_a_point_that_is_missing_is_unknown(self):
        with Copy("speed") as folder:
            (folder / "results.h5").unlink()
            lines = (folder / "points.csv").read_text().splitlines(keepends=True)
            (folder / "points.csv").write_text("".join(lines[:1] + lines[2:]))
            data = ep.open(folder).to_xarray()
            self.assertEqual(dict(data.sizes), {"direction": 2, "value": 4, "planet": 3})
            self.assertTrue(np.isnan(data.delta_sp_max.isel(direction=0, value=0)))

    def test_every_group_opens_in_xarray_itself(self):
        for name in KINDS:
            file = RESULTS / name / "results.h5"
            if not file.exists():
                continue
            groups = []
            with h5py.File(file) as opened:
                self.assertEqual(opened.attrs["format_version"], 2)
                opened.visititems(lambda path, item: groups.append(path) if isinstance(item, h5py.Group) else None)

                def has_scales(path, item):
                    if isinstance(item, h5py.Dataset) and not h5py.h5ds.is_scale(item.id):
                        for length, axis in zip(item.shape, item.dims):
                            self.assertEqual(len(axis), 1, path)
                            self.assertTrue(h5py.h5ds.is_scale(axis[0].id))
                            self.assertEqual(axis[0].shape, (length,))

                opened.visititems(has_scales)
            for group in groups:
                with self.subTest(name=name, group=group), warnings.catch_warnings():
                    warnings.simplefilter("error")
                    with xarray.open_dataset(file, group=group, engine="h5netcdf") as data:
                        data.load()
            with xarray.open_dataset(file, group="poincare" if "poincare" in groups else "points",
                                     engine="h5netcdf") as data:
                self.assertTrue(all(isinstance(data[v].attrs["units"], str) for v in data if "units" in data[v].attrs))


class Errors(unittest.TestCase):
    def refused(self, folder, words):
        with self.assertRaisesRegex(ep.ResultError, words) as raised:
            result = ep.open(folder)
            result.points
        self.assertIn(str(folder), str(raised.exception))

    def test_folders_that_are_none(self):
        with tempfile.TemporaryDirectory() as folder:
            self.refused(Path(folder), "is not a result folder")
            self.refused(Path(folder) / "none", "no such folder")
            (Path(folder) / "run.json").write_text("{}")
            self.refused(Path(folder), "not from epicyclic")
            for text in ("", "[1", "[]", "\xff", "[" * 100000):
                (Path(folder) / "run.json").write_text(text, encoding="latin-1")
                self.refused(Path(folder), "damaged")
            self.refused(Path(folder) / "run.json", "is a file")

    def test_unfinished_and_incomplete(self):
        with Copy("speed") as folder:
            run = json.loads((folder / "run.json").read_text())
            (folder / "run.json").write_text(json.dumps({**run, "state": "running"}))
            self.refused(folder, "not finished .*running.*resumes")
        with Copy("speed") as folder:
            (folder / "points.csv").unlink()
            self.refused(folder, "points.csv is missing")

    def test_damaged_tables(self):
        with Copy("speed") as folder:
            whole = (folder / "results.h5").read_bytes()
            for size in (0, 100, len(whole) // 2):
                (folder / "results.h5").write_bytes(whole[:size])
                self.refused(folder, "results.h5: is damaged")
            with self.assertRaisesRegex(ep.ResultError, "results.h5 differs"):
                ep.open(folder).verify()
            (folder / "results.h5").unlink()
            lines = (folder / "points.csv").read_text()
            for text, words in ((lines[: len(lines) // 2], "line 5 has|line 4 has|line 6 has"), ("", "is empty")):
                (folder / "points.csv").write_text(text)
                self.refused(folder, words)
            self.assertTrue(any("points.csv has 0 bytes" in text for text in ep.Result.warnings.fget(
                mock.Mock(spec=ep.Result, _changed=lambda: [("points.csv", 0)], run={}, tables=[], _points=("points", ""),
                          _hdf5=mock.Mock(installed=True)))))

    def test_a_table_that_is_not_there(self):
        with self.assertRaisesRegex(ep.ResultError, "has no table no_such; it has"):
            ep.open(RESULTS / "speed").table("no_such")

    def test_a_module_that_is_not_there(self):
        with mock.patch.dict("sys.modules", {"pandas": None}):
            with self.assertRaisesRegex(ep.ResultError, "needs pandas.*python3-pandas"):
                ep.open(RESULTS / "speed").points

    def test_hostile_names_are_escaped(self):
        with Copy("speed") as folder:
            resolved = json.loads((folder / "input.resolved.json").read_text())
            resolved["name"] = "<script>alert('$x_{')</script>\x1b[31m$"
            (folder / "input.resolved.json").write_text(json.dumps(resolved))
            result = ep.open(folder)
            self.assertNotIn("<script>", result._repr_html_())
            self.assertIn("&lt;script&gt;", result._repr_html_())
            self.assertNotIn("\x1b", repr(result) + result._repr_html_())
            axes = result.plot()
            axes.figure.canvas.draw()
            plt.close(axes.figure)


class Figures(unittest.TestCase):
    def draw(self, result, *arguments, **named):
        axes = result.plot(*arguments, **named)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            axes.figure.canvas.draw()
        self.addCleanup(plt.close, axes.figure)
        return axes

    def test_each_kind_is_drawn(self):
        for name in KINDS:
            with self.subTest(name):
                axes = self.draw(ep.open(RESULTS / name))
                self.assertTrue(axes.get_xlabel() and axes.get_ylabel())
                self.assertTrue(axes.lines or axes.collections)

    def test_quantities_and_directions(self):
        sweep = ep.open(RESULTS / "speed")
        self.draw(sweep, "delta_sp_rms")
        one = self.draw(sweep, "delta_rp_1", direction="down")
        drawn = np.concatenate([line.get_ydata() for line in one.lines])
        rows = sweep.table("poincare")
        down = rows.point.isin(sweep.points.point[sweep.points.direction == "down"])
        np.testing.assert_array_equal(np.sort(drawn), np.sort(rows.delta_rp_1[down]))
        self.draw(ep.open(RESULTS / "map"), "delta_sp_rms", direction="down")
        self.draw(ep.open(RESULTS / "branches"), "delta_sp_rms")
        self.draw(ep.open(RESULTS / "run"), "force_sp_2")
        _, axes = plt.subplots()
        self.assertIs(self.draw(sweep, ax=axes), axes)

    def test_several_results_in_the_same_axes(self):
        speed, rpm, branches = (ep.open(RESULTS / name) for name in ("speed", "rpm", "branches"))

        def legend(axes):
            return [text.get_text() for text in axes.get_legend().get_texts()]

        axes = self.draw(speed, "kv_sp")
        self.assertIn("up", legend(axes))
        first = {line.get_color() for line in axes.lines}
        self.draw(rpm, "kv_sp", ax=axes)
        second = {line.get_color() for line in axes.lines} - first
        self.assertEqual((len(first), len(second)), (2, 2))
        self.assertTrue({"speed: up", "rpm: up"} <= set(legend(axes)), legend(axes))
        # Two columns of one result; names of one's own; axes that were cleared.
        axes = self.draw(speed, "kv_sp", direction="up")
        self.draw(speed, "kv_rp", ax=axes, direction="up")
        self.assertTrue({"kv_sp: up", "kv_rp: up"} <= set(legend(axes)), legend(axes))
        self.assertEqual(axes.get_ylabel(), "kv_sp, kv_rp")
        axes.clear()
        self.draw(speed, "kv_sp", ax=axes, direction="up", label="60 N m")
        self.assertIn("60 N m: up", legend(axes))
        # The curves of branches have other colours than the points of the sweep; special points keep theirs.
        axes = self.draw(speed, direction="up")
        colours = {line.get_color() for line in axes.lines}
        self.draw(branches, ax=axes)
        self.assertTrue(colours.isdisjoint(line.get_color() for line in axes.lines if line.get_linestyle() != "None"))
        with self.assertRaisesRegex(TypeError, "label"):
            speed.plot(label=3)

    def test_what_cannot_be_drawn_is_refused(self):
        for name in KINDS:
            with self.subTest(name), self.assertRaisesRegex(ep.ResultError, "no column no_such"):
                ep.open(RESULTS / name).plot("no_such")
        with self.assertRaisesRegex(ep.ResultError, "did you mean .*force_sp_max"):
            ep.open(RESULTS / "speed").plot("force_sp_maximum")
        with self.assertRaisesRegex(ep.ResultError, "has texts"):
            ep.open(RESULTS / "speed").plot("status")
        with self.assertRaisesRegex(ep.ResultError, "no direction"):
            ep.open(RESULTS / "speed").plot(direction="left")
        plt.close("all")


class Csv(unittest.TestCase):
    def test_quotes_and_empty_cells(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "a.csv"
            file.write_text('a,b,c,d\n1,"x, ""y""",,\n2,,1e400,\n', encoding="utf-8")
            table = _tables.read_csv(file)
            self.assertEqual(table.columns["a"].dtype, np.int64)
            self.assertEqual(list(table.columns["b"]), ['x, "y"', ""])
            self.assertTrue(np.isnan(table.columns["c"][0]) and np.isinf(table.columns["c"][1]))
            self.assertTrue(np.isnan(table.columns["d"]).all())


if __name__ == "__main__":
    unittest.main()
