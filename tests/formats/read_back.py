#!/usr/bin/env python3
"""Results in formats of other tools, read back by those: read_back.py numpy|vtk|module PROGRAM SOURCE. Exit code 77: skipped."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
TOOL, PROGRAM, SOURCE = sys.argv[1], sys.argv[2], Path(sys.argv[3])
BALL = {
    "trammel": 1, "space": "planar", "gravity": [0, -10], "title": "A ball",
    "bodies": {"ball": {"type": "point_mass", "mass": 0.1, "position": [0, 1]}},
    "contacts": {"floor": {"type": "constraint_method", "restitution": 0.5,
                           "between": ["ball.com", {"plane": {"point": [0, 0], "normal": [0, 1]}}]}},
    "simulate": {"until": 1}, "record": {"every": 0.01, "observe": {"y": "ball.com.y"}},
}
# A mass on a spring of 100 N/m that a load pulls down, 1 N at t = 1.
HANGING = {
    "trammel": 1, "space": "planar", "gravity": [0, 0],
    "bodies": {"mass": {"type": "point_mass", "mass": 0.1, "position": [0, -1]}},
    "joints": {"rail": {"type": "point_on_line", "between": ["ground", "mass.point"], "axis": [0, 1]}},
    "forces": {"spring": {"type": "spring_damper", "between": ["ground", "mass.point"], "stiffness": 100, "length": 1},
               "pull": {"type": "load", "on": "mass.point", "force": {"y": "=-t"}}},
    "simulate": {"until": 1}, "static": {"steps": 4}, "record": {"observe": {"y": "mass.point.y"}},
}

try:
    if TOOL == "vtk":
        import vtk
        from vtk.util.numpy_support import vtk_to_numpy
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)


def trammel(*words):
    subprocess.run([PROGRAM, *map(str, words)], check=True, capture_output=True, text=True)


class InAFolder(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = Path(kept.name)
        self.scene = self.folder / "ball.json"
        self.scene.write_text(json.dumps(BALL))
        self.out = self.folder / "ball"

    def table(self):
        with open(self.out / "series.csv") as lines:
            names = lines.readline().strip().split(",")
            return dict(zip(names, np.loadtxt(lines, delimiter=",").T))


class numpy(InAFolder):
    def test_reads_the_same_columns_as_in_series_csv(self):
        trammel("run", self.scene, "--out", self.out, "--format", "npz", "--quiet")
        npz, table = np.load(self.out / "series.npz"), self.table()
        self.assertEqual(list(npz["columns"]), list(table))
        for name, column in table.items():
            np.testing.assert_array_equal(npz[name], column)
        self.assertEqual(dict(zip(npz["columns"], npz["units"]))["y"], "m")

    def test_reads_events_with_nan_where_there_is_no_figure(self):
        trammel("run", self.scene, "--out", self.out, "--format", "npz", "--quiet")
        events = np.load(self.out / "events.npz")
        impacts = events["kind"] == "impact"
        self.assertGreaterEqual(impacts.sum(), 2)
        np.testing.assert_allclose(events["separation"][impacts][:2], 0.5 * events["approach"][impacts][:2])
        self.assertTrue(np.isnan(events["impulse"][~impacts]).all())

    def test_reads_equilibria_under_growing_loads(self):
        self.scene.write_text(json.dumps(HANGING))
        trammel("static", self.scene, "--out", self.out, "--format", "npz", "--quiet")
        npz = np.load(self.out / "series.npz")
        np.testing.assert_allclose(npz["y"], -1 - 0.01 * npz["t"], atol=1e-12)

    def test_reads_the_matrices_of_a_linearisation(self):
        trammel("modes", self.scene, "--set", "contacts={}", "--out", self.out, "--matrices", self.folder / "m.npz", "--quiet")
        m = np.load(self.folder / "m.npz")
        np.testing.assert_allclose(m["M"], 0.1 * np.eye(2))
        self.assertEqual(m["A"].shape, (4, 4))
        self.assertEqual(list(m["velocities"]), ["ball[0]", "ball[1]"])


class vtk_reads(InAFolder):
    def grid(self, file):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(file))
        reader.Update()
        return reader.GetOutput()

    def test_the_animation(self):
        trammel("run", self.scene, "--out", self.out, "--format", "vtu", "--quiet")
        collection = (self.out / "animation.pvd").read_text()
        self.assertEqual(collection.count("<DataSet"), 101)
        y = self.table()["y"]
        for k in (0, 50, 100):
            grid = self.grid(self.out / f"vtu/animation_{k:06}.vtu")
            self.assertEqual((grid.GetNumberOfPoints(), grid.GetNumberOfCells()), (1, 1))
            self.assertAlmostEqual(grid.GetPoint(0)[1], y[k], delta=1e-5)  # five digits are recorded

    def test_the_fields_of_a_plate(self):
        run = self.folder / "sheet"
        trammel("run", SOURCE / "scenes/plate/pendulum.json", "--set", "simulate.until=0.01", "--set", "record.fields=[0.01]", "--format", "vtu", "--out", run, "--quiet")
        grid = self.grid(run / "vtu/fields_000000.vtu")
        stress = vtk_to_numpy(grid.GetPointData().GetArray("von_mises_top"))
        self.assertEqual(len(stress), grid.GetNumberOfPoints())
        self.assertTrue(np.isfinite(stress).all())


class module(InAFolder):
    def setUp(self):
        super().setUp()
        os.environ["TRAMMEL"] = PROGRAM
        sys.path.insert(0, str(SOURCE / "tools"))
        import trammel as module
        self.trammel = module

    def test_runs_a_scene_with_values_set(self):
        run = self.trammel.run(BALL, **{"contacts.floor.restitution": 0.2}, simulate__until=0.6)
        self.assertEqual(run.t[-1], 0.6)
        self.assertEqual(run.units["y"], "m")
        impact = next(event for event in run.events if event["kind"] == "impact")
        self.assertAlmostEqual(impact["separation"], 0.2 * impact["approach"])
        self.assertEqual(run.info["status"], "done")

    def test_maps_the_columns_into_memory(self):
        run = self.trammel.run(self.scene, out=self.out)
        self.assertIsInstance(run["y"], np.memmap)
        np.testing.assert_array_equal(run["y"], self.table()["y"])

    def test_names_the_place_of_an_error(self):
        self.scene.write_text(json.dumps(BALL, indent=1).replace("restitution", "restitutoin"))
        with self.assertRaises(self.trammel.SceneError) as raised:
            self.trammel.validate(self.scene)
        problem = raised.exception.problems[0]
        self.assertTrue(problem.file.endswith("ball.json"))
        self.assertEqual(problem.path, "contacts.floor.restitutoin")
        self.assertGreater(problem.line, 1)

    def test_finds_equilibria(self):
        hung = self.trammel.static(HANGING)
        np.testing.assert_allclose(hung["y"][-1], -1.01, atol=1e-12)
        self.assertEqual(hung.units["y"], "m")

    def test_studies_many_cases(self):
        study = {"study": 1, "scene": str(self.scene), "vary": {"contacts.floor.restitution": [0, 0.25, 0.5]},
                 "reduce": {"highest": {"observe": "y", "as": "final"}}}
        found = self.trammel.study(study, out=self.folder / "study", jobs=1)
        self.assertEqual((found["done"], found["failed"]), (3, 0))
        with np.load(self.folder / "study/study.npz") as npz:
            self.assertEqual(len(npz["highest"]), 3)
        self.assertTrue(found._repr_html_().startswith("<iframe srcdoc="))

    def test_names_the_place_of_an_error_in_a_study(self):
        study = {"study": 1, "scene": str(self.scene), "vary": {"contacts.flor.restitution": [0]},
                 "reduce": {"highest": {"observe": "y", "as": "final"}}}
        with self.assertRaises(self.trammel.SceneError) as raised:
            self.trammel.study(study, out=self.folder / "study")
        self.assertIn("floor", str(raised.exception))

    def test_trades_speed_for_accuracy(self):
        swinging = {key: value for key, value in HANGING.items() if key != "static"}
        swinging["record"] = {"every": 0.1, "observe": {"y": "mass.point.y"}}
        found = self.trammel.trade(swinging, target=1e-3, budget=10, out=self.folder / "trade")
        self.assertLessEqual(found["choice"]["error"], 1e-3)
        self.assertTrue(found._repr_html_().startswith("<iframe srcdoc="))

    def test_refuses_a_column_that_is_not_there(self):
        with self.assertRaisesRegex(KeyError, "no column 'z'; there are t, y"):
            self.trammel.run(BALL)["z"]

    def test_is_shown_in_a_notebook_as_its_report(self):
        shown = self.trammel.run(BALL)._repr_html_()
        self.assertTrue(shown.startswith("<iframe srcdoc="))
        self.assertIn("A ball", shown)


if __name__ == "__main__":
    name = {"vtk": "vtk_reads"}.get(TOOL, TOOL)
    unittest.main(argv=[sys.argv[0], name], verbosity=2)
