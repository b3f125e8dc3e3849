"""The studies of a system, scenes/SYSTEM/studies/*.json: run by `trammel study`, their cases' results read as arrays."""
import csv
import json
import os
import pathlib
import subprocess
import sys
from typing import NamedTuple

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]

def trammel(*words):
    """Runs a command. Exit code 1 is no error here: a run has failed, and is judged later."""
    ended = subprocess.run([os.environ["TRAMMEL"], *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if ended.returncode not in (0, 1):
        raise SystemExit(f"tools/reproduce: trammel {' '.join(map(str, words))}\n{ended.stderr}")

class Case(NamedTuple):  # the case of a study that has these values
    study: str
    values: tuple
    may_fail: bool  # a claim says that this run breaks down

def case(study, may_fail=False, **values):
    """case("table_1", scene="table_1_hht", parameters__N=5): dots of a path are written as two underscores."""
    if "scene" in values:
        values["scene"] = f"../{values['scene']}.json"
    return Case(study, tuple((path.replace("__", "."), json.dumps(value)) for path, value in values.items()), may_fail)

def same(cell, value):
    """Compares a cell of study.csv, in which texts have no quotes, with a value as JSON."""
    try:
        return json.loads(cell) == json.loads(value)
    except json.JSONDecodeError:
        return cell == json.loads(value)

class Result:
    """The results of a case: columns of series.csv (`result["theta"]`), events, and result.json in `info`."""

    def __init__(self, folder):
        self.folder = folder
        self.info = json.loads((folder / "result.json").read_text())
        self.cpu, self.counts = self.info["cpu_time_s"], self.info.get("counts", {})
        self.done = self.info["status"] == "done"
        self.columns = np.atleast_1d(np.genfromtxt(folder / "series.csv", delimiter=",", names=True))
        self.t = self.columns["t"]
        with open(folder / "events.csv") as file:
            self.events = [(float(row["t"]), row["kind"], {name: text for name, text in row.items() if text}) for row in csv.DictReader(file)]

    def __getitem__(self, name):
        return self.columns[name]

    def at(self, t, column):
        """The column's value at the record nearest to t."""
        return self[column][np.argmin(abs(self.t - t))]

class Results:
    """The results of all studies, by case. `rows`: the rows of each study's study.csv."""

    def __init__(self, system, out, jobs, alone):
        """Runs one study after the other. alone: those whose times are compared, one case at a time."""
        self.out, self.rows, self.titles, self.used = out, {}, {}, {}
        for file in sorted((ROOT / "scenes" / system / "studies").glob("*.json")):
            print(f"  {file.stem}", file=sys.stderr, flush=True)
            trammel("study", file, "--quiet", "--out", out / file.stem, "--jobs", 1 if file.stem in alone else jobs)
            trammel("report", out / file.stem)
            self.titles[file.stem] = json.loads((out / file.stem / "study.json").read_text())["page"]["title"]
            with open(out / file.stem / "study.csv") as table:
                self.rows[file.stem] = list(csv.DictReader(table))

    def __getitem__(self, wanted):
        if wanted not in self.used:
            self.used[wanted] = Result(self.out / wanted.study / "cases" / self.row(wanted)["case"])
        return self.used[wanted]

    def row(self, wanted):
        rows = [row for row in self.rows[wanted.study] if all(same(row.get(path, ""), value) for path, value in wanted.values)]
        if len(rows) != 1:
            raise SystemExit(f"tools/reproduce: {len(rows)} cases of {wanted.study} have {dict(wanted.values)}, expected one")
        return rows[0]

    def failures(self):
        """The failures of cases that no claim expects to fail."""
        expected = {(one.study, self.row(one)["case"]) for one in self.used if one.may_fail}
        return [f"{study}, case {row['case']}: {row['reason']}" for study, rows in self.rows.items() for row in rows
                if row["status"] != "done" and (study, row["case"]) not in expected]

def listed(numbers, digits=3):
    return ", ".join(f"{x:.{digits}g}" for x in numbers)

def significant(x, digits=3):
    return listed([x], digits)
