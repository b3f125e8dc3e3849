"""The studies of a system, scenes/SYSTEM/studies/*.json: run by `trammel study`, their cases' results read as arrays."""
import csv
import dataclasses
import functools
import json
import os
import pathlib
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]


@dataclasses.dataclass(frozen=True)
class Case:
    """The one case of a study that has these values. may_fail: a claim says that this run breaks down."""

    study: str
    values: tuple
    may_fail: bool = False


def case(study, may_fail=False, **values):
    """case("table_1", scene="table_1_hht", parameters__N=5): dots of a path are written as two underscores."""
    if "scene" in values:
        values["scene"] = f"../{values['scene']}.json"
    return Case(study, tuple((path.replace("__", "."), json.dumps(value)) for path, value in values.items()), may_fail)


class Fields:
    """What a scene's one plate shows at a time t: points[element, row, column, axis] and values[name][element, row, column]."""

    def __init__(self, line):
        content = json.loads(line)
        (body,) = content["bodies"].values()
        grid = (len(body["patches"]), -1, body["patches"][0]["along"])
        self.t = content["t"]
        self.points = np.array([patch["points"] for patch in body["patches"]]).reshape(*grid, 3)
        values = np.array([patch["values"] for patch in body["patches"]])
        self.values = {name: values[:, k].reshape(grid) for k, name in enumerate(body["fields"])}


class Result:
    """What a case left: columns of series.csv (`result["theta"]`), events, and result.json in `info`."""

    def __init__(self, folder):
        self.folder = folder
        self.info = json.loads((folder / "result.json").read_text())
        self.cpu = self.info["cpu_time_s"]
        with open(folder / "series.csv") as file:
            names = file.readline().strip().split(",")
        table = np.loadtxt(folder / "series.csv", delimiter=",", skiprows=1, ndmin=2)
        self.columns = dict(zip(names, table.T))
        with open(folder / "events.csv") as file:
            self.events = [
                (float(row["t"]), row["kind"], {name: figure for name, figure in row.items() if figure and name not in ("t", "kind", "component")})
                for row in csv.DictReader(file)
            ]

    def __getitem__(self, name):
        return self.columns[name]

    @functools.cached_property
    def moments(self):
        return [Fields(line) for line in (self.folder / "fields.ndjson").read_text().splitlines()]

    def fields(self, t):
        """At the time of fields.ndjson nearest to t."""
        return min(self.moments, key=lambda fields: abs(fields.t - t))

    @property
    def t(self):
        return self.columns["t"]

    @property
    def counts(self):
        return self.info["counts"]

    @property
    def done(self):
        return self.info["status"] == "done"


class Results:
    """Of all studies, by case."""

    def __init__(self, system, out):
        self.files = sorted((ROOT / "scenes" / system / "studies").glob("*.json"))
        self.out = out
        self.cases = {}  # of a study, by name: rows of study.csv
        self.used = {}

    def compute(self, jobs, alone):
        """One study after the other. alone: those whose times are compared, one case at a time."""
        for k, file in enumerate(self.files, 1):
            print(f"  {k}/{len(self.files)} {file.stem}", file=sys.stderr, flush=True)
            folder = self.out / file.stem
            command = [os.environ["TRAMMEL"], "study", str(file), "--quiet", "--out", str(folder),
                       "--jobs", str(1 if file.stem in alone else jobs)]
            ended = subprocess.run(command, stderr=subprocess.PIPE, text=True)
            if ended.returncode not in (0, 1) or not (folder / "study.csv").exists():
                raise SystemExit(f"tools/reproduce: {' '.join(command)}\n{ended.stderr}")
            with open(folder / "study.csv") as table:
                self.cases[file.stem] = list(csv.DictReader(table))

    def __getitem__(self, wanted):
        if wanted not in self.used:
            row = self._row(wanted)
            self.used[wanted] = Result(self.out / wanted.study / "cases" / row["case"])
        return self.used[wanted]

    def _row(self, wanted):
        rows = [row for row in self.cases[wanted.study] if all(_same(row.get(path, ""), value) for path, value in wanted.values)]
        if len(rows) != 1:
            raise SystemExit(f"tools/reproduce: {len(rows)} cases of {wanted.study} have {dict(wanted.values)}, expected one")
        return rows[0]

    def unexpected(self, wanted):
        """Of the wanted cases that may not fail, those that did, and why."""
        rows = {(one.study, row["case"]): row for one in wanted if not one.may_fail and (row := self._row(one))["status"] != "done"}
        return [f"{study}, case {number}: {row['reason']}" for (study, number), row in rows.items()]

    def count(self):
        return sum(len(rows) for rows in self.cases.values())


def _same(cell, value):
    """A cell of study.csv, in which texts have no quotes, and a value's JSON."""
    try:
        return json.loads(cell) == json.loads(value)
    except json.JSONDecodeError:
        return cell == json.loads(value)


def significant(x, digits=3):
    """4 digits of 0.00123 or 1.8e-7 as people write them."""
    if x == 0 or not np.isfinite(x):
        return f"{x:g}"
    return f"{x:.{digits}g}"
