#!/usr/bin/env python3
"""Reports in a real browser: report_in_browser.py PROGRAM SCENES. Exit code 77, skipped, where Debian's chromium is missing."""

import json
import math
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent))
from browser import Browser, available  # noqa: E402

PROGRAM, SCENES = Path(sys.argv[1]) if len(sys.argv) > 1 else None, Path(sys.argv[2]) if len(sys.argv) > 2 else None

PLOTTED = """
  const plots = () => [...document.querySelectorAll('.time-plot')];
  while (plots().length === 0 || !plots().every((p) => p.querySelector('canvas'))) await new Promise((r) => setTimeout(r, 10));
  return performance.now();
"""


def trammel(*words):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=True).stdout


def pendulum(**parts):
    scene = {
        "trammel": 1, "space": "planar", "gravity": [0, -9.81], "title": "A pendulum <b>strikes</b> a floor",
        "bodies": {"rod": {"type": "rigid_body", "mass": 1, "inertia": 0.1, "position": [0.5, 0],
                           "markers": {"hinge": [-0.5, 0], "tip": [0.5, 0], "side": [0, 0.1]}}},
        "joints": {"hinge": {"type": "revolute", "between": ["ground", "rod.hinge"]}},
        "contacts": {"floor": {"type": "constraint_method", "restitution": 0.5,
                               "between": ["rod.tip", {"plane": {"point": [0, -0.6], "normal": [0, 1]}}]}},
        "simulate": {"until": 1}, "record": {"every": 0.01, "observe": {"angle": "rod.angle", "tip": "rod.tip.y"}},
    }
    return scene | parts


class Reports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name)
        cls.report = cls.run_scene(pendulum(), "pendulum")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def run_scene(cls, scene, name, *options):
        file = cls.path / f"{name}.json"
        file.write_text(json.dumps(scene))
        trammel("run", file, "--out", cls.path / name, "--quiet", "--report", *options)
        return cls.path / name / "report.html"

    def test_opens_without_errors_and_asks_for_nothing_but_itself(self):
        with Browser() as browser:
            browser.open(self.report)
            browser.wait(PLOTTED)
            self.assertEqual(browser.log(), [])
            self.assertEqual([r for r in browser.requests() if not r.startswith("data:")], [self.report.resolve().as_uri()])
            self.assertEqual(browser.text("h1"), "A pendulum <b>strikes</b> a floor")
            self.assertIsNone(browser.text(".error-box"))

    def test_draws_the_mechanism_and_plays_it(self):
        painted = """
          const c = document.querySelector('canvas.stage'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
          let sum = 0; for (let i = 3; i < d.length; i += 4) sum = (sum * 31 + d[i] * (i % 1009)) % 1000003; return sum;"""
        with Browser() as browser:
            browser.open(self.report)
            browser.wait(PLOTTED)
            before, at_start = browser.script(painted), browser.text("#reading")
            self.assertGreater(before, 0)
            browser.click("#play")
            browser.wait("await new Promise((r) => setTimeout(r, 700))")
            self.assertEqual(browser.text("#play"), "Pause")
            browser.click("#play")
            self.assertNotEqual(browser.text("#reading"), at_start)
            self.assertNotEqual(browser.script(painted), before)

    def test_is_used_by_keyboard(self):
        with Browser() as browser:
            browser.open(self.report)
            browser.wait(PLOTTED)
            browser.keys("canvas.stage", "End")
            self.assertEqual(browser.text("#reading"), "t = 1 s")
            browser.keys("canvas.stage", "ArrowLeft")
            self.assertEqual(browser.text("#reading"), "t = 0.99 s")
            browser.keys("#time", "Home")
            self.assertEqual(browser.text("#reading"), "t = 0 s")
            browser.keys("#events tbody tr:nth-child(1)", "Enter")
            t = browser.script("return trammel_report.clock.t")
            # Events and records have their own times: the row's, to six digits.
            self.assertAlmostEqual(t, float(browser.text("#events tbody tr:nth-child(1) td")), places=5)

    def test_plots_show_the_values_at_the_time_of_the_animation(self):
        rows = [line.split(",") for line in (self.report.parent / "series.csv").read_text().splitlines()]
        tip = float(rows[1 + 50][rows[0].index("tip")])
        with Browser() as browser:
            browser.open(self.report)
            browser.wait(PLOTTED)
            browser.script("trammel_report.clock.set(0.5)")
            shown = browser.script("""return [...document.querySelectorAll('.legend.values button')]
              .find((b) => b.textContent.startsWith('tip')).querySelector('.value').textContent""")
            self.assertAlmostEqual(float(shown), tip, delta=1e-4 * abs(tip) + 1e-9)  # five digits are shown

    def test_fits_a_telephone_and_follows_dark_mode(self):
        with Browser(width=360, height=740, dark=True) as browser:
            browser.open(self.report)
            browser.wait(PLOTTED)
            self.assertLessEqual(browser.script("return document.documentElement.scrollWidth"), 360)
            background = browser.script("return getComputedStyle(document.body).backgroundColor")
            self.assertLess(sum(map(int, re.findall(r"\d+", background)[:3])), 150)

    def test_shows_an_error_in_the_data(self):
        damaged = self.path / "damaged.html"
        text = self.report.read_text()
        place = text.index('"points":"') + len('"points":"')
        damaged.write_text(text[:place] + text[place + 400:])
        with Browser() as browser:
            browser.open(damaged)
            browser.wait(PLOTTED)
            self.assertIn("coordinates", browser.text(".error-box") or "")

    def test_overlays_runs_and_shows_their_differences(self):
        self.run_scene(pendulum(), "softer", "--set", "contacts.floor.restitution=0.1")
        both = self.path / "both.html"
        trammel("report", self.path / "pendulum", self.path / "softer", "--out", both)
        with Browser() as browser:
            browser.open(both)
            browser.wait(PLOTTED)
            self.assertEqual(browser.script("return trammel_report.stage.actors.length"), 2)
            browser.click("#differences")
            browser.wait(PLOTTED)
            titles = browser.script("return [...document.querySelectorAll('#difference-plots h2')].map((h) => h.textContent)")
            self.assertEqual(len(titles), 2)
            self.assertIn("difference from pendulum", titles[0])

    def test_draws_a_page_whose_points_tell_their_notes(self):
        curve = {"name": "hht_alpha", "mark": "line and points", "points": [[1e-4, 1e-6, "fine"], [1e-3, 1e-4, "coarse"]],
                 "failures": [[1e-2, 0, "diverged at t = 0.3 s"]]}
        page = {"title": "Trade", "sentences": ["hht_alpha is the cheapest."], "tables": [
                    {"title": "Runs", "columns": [{"name": "step", "unit": "s"}], "rows": [["1e-4"]]}],
                "figures": [{"title": "Error", "caption": "", "x": {"label": "step [s]", "scale": "logarithmic"},
                             "y": {"label": "error [m]", "scale": "logarithmic"}, "curves": [curve]}]}
        (self.path / "trade.json").write_text(json.dumps({"page": page}))
        trammel("report", self.path / "trade.json")
        with Browser() as browser:
            browser.open(self.path / "trade.html")
            browser.wait("while (!document.querySelector('svg.plot')) await new Promise((r) => setTimeout(r, 10))")
            notes = []
            for _ in range(3):
                browser.keys("svg.plot", "ArrowRight")
                notes.append(browser.text(".note"))
            self.assertIn("fine", notes[0])
            self.assertIn("1e-6", notes[0])
            self.assertIn("coarse", notes[1])
            self.assertIn("diverged at t = 0.3 s", notes[2])
            self.assertIn("1 run without a value", browser.text("figcaption"))
            self.assertEqual(browser.log(), [])

    def test_moves_the_shapes_of_modes(self):
        modes = self.path / "modes"
        trammel("modes", SCENES / "tour/04_spring_damper.json", "--out", modes, "--quiet")
        trammel("report", modes)
        drawn = "return [...document.querySelector('canvas.stage').toDataURL()].reduce((h, c) => (h * 31 + c.charCodeAt(0)) % 1000003, 0)"
        with Browser() as browser:
            browser.open(modes / "report.html")
            browser.wait("await new Promise((r) => setTimeout(r, 300))")
            first = browser.script(drawn)
            browser.wait("await new Promise((r) => setTimeout(r, 400))")
            self.assertNotEqual(browser.script(drawn), first)
            self.assertEqual(browser.log(), [])

    def test_draws_a_thousand_bodies_in_ten_milliseconds_of_script(self):
        corner = 0.1
        markers = {f"c{k}": [corner * (1 if k & 1 else -1), corner * (1 if k & 2 else -1), corner * (1 if k & 4 else -1)] for k in range(8)}
        bodies = {f"box_{k}": {"type": "rigid_body", "mass": 1, "inertia": [0.1, 0.1, 0.1], "markers": markers,
                               "position": [0.5 * (k % 10), 0.5 * (k // 10 % 10), 0.5 * (k // 100)],
                               "angular_velocity": [0.1 * (k % 7), 1, 0]} for k in range(1000)}
        scene = {"trammel": 1, "space": "spatial", "gravity": [0, 0, -9.81], "bodies": bodies, "simulate": {"until": 0.05},
                 "record": {"every": 0.01}, "integrator": {"type": "runge_kutta_4", "step": 0.01}}
        report = self.run_scene(scene, "boxes")
        self.assertLess(report.stat().st_size, 5e6)
        with Browser() as browser:
            browser.open(report)
            browser.wait("while (!window.trammel_report?.stage?.draw_time) await new Promise((r) => setTimeout(r, 20))")
            times = browser.script("""const s = trammel_report.stage;
              return Array.from({length: 40}, (_, k) => (s.camera.orbit(3, 0), s.draw(0.001 * k), s.draw_time))""")
            # The least: other processes on this machine take their share of any single one.
            self.assertLess(min(times), 10)

    def test_opens_a_million_rows_in_a_second_and_keeps_their_extremes(self):
        folder = self.path / "long"
        folder.mkdir()
        rows = [f"{k * 1e-3:.6g},{math.sin(k * 1e-4) + (7 if k == 654321 else 0):.9g}" for k in range(1000000)]
        (folder / "series.csv").write_text("t,x\n" + "\n".join(rows) + "\n")
        trammel("report", folder)
        report = folder / "report.html"
        self.assertLess(report.stat().st_size, 5e6)
        with Browser() as browser:
            times = []
            for _ in range(3):
                browser.open(report)
                times.append(browser.wait(PLOTTED))
            self.assertLess(min(times), 1000)
            self.assertIn("1,000,000 rows", browser.text("#report"))
            top = browser.script("return Math.max(...[...document.querySelectorAll('.dygraph-axis-label-y')].map((l) => Number(l.textContent)))")
            self.assertGreaterEqual(top, 6)  # the axis reaches the one row above 7; all others are below 1


if __name__ == "__main__":
    if not available():
        print("skipped: chromium and chromedriver are missing (apt-get install chromium chromium-driver)")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
