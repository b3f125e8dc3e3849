"""Runs of `trammel run`: started in parallel, each combination of scene and overrides once, results read as arrays."""
import concurrent.futures
import csv
import dataclasses
import functools
import hashlib
import json
import math
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
TIMED = 3  # times that a run is repeated whose time is compared
TIME_LIMIT = 900  # [s] of one run; the longest takes half a minute on an idle core
COMMENT_OR_STRING = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.S)


@dataclasses.dataclass(frozen=True)
class Run:
    """A scene (path below scenes/, without .json) with `--set` values. may_fail: a claim says that this run breaks down.
    alone: its time is compared, so that it runs after the others, by itself, and thrice: the least time counts."""

    scene: str
    values: tuple = ()
    may_fail: bool = False
    alone: bool = False

    def command_line(self):
        return [str(ROOT / "scenes" / f"{self.scene}.json"), *(x for path, v in self.values for x in ("--set", f"{path}={v}"))]

    @functools.cache
    def is_static(self):
        content = _load(ROOT / "scenes" / f"{self.scene}.json")
        return "static" in content and "integrator" not in content

    @functools.cache
    def key(self):
        """Equal for runs that compute the same: figures of one paper share many."""
        content = _load(ROOT / "scenes" / f"{self.scene}.json")
        for path, value in self.values:
            *objects, last = path.split(".")
            place = content
            for name in objects:
                place = place.setdefault(name, {})
            place[last] = value
        content.pop("title", None)
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:12]


def run(scene, may_fail=False, alone=False, **values):
    """run("beam_impact/hht", parameters__N=5): dots of a path are written as two underscores."""
    given = {k.replace("__", "."): str(v) if isinstance(v, list) else v for k, v in values.items()}
    return Run(scene, tuple(sorted(given.items())), may_fail, alone)


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
    """What a run left: columns of series.csv (`result["theta"]`), events, and result.json in `info`."""

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
    """The results of all runs, by run."""

    def __init__(self, folder):
        self.folder = folder
        self.of_key = {}
        self.unexpected = []

    def __getitem__(self, wanted):
        return self.of_key[wanted.key()]

    def compute(self, runs, jobs):
        todo = {}
        for wanted in runs:
            todo.setdefault(wanted.key(), wanted)
        start = time.monotonic()
        n = 0
        alone = [item for item in todo.items() if item[1].alone]
        rounds = [(jobs, [item for item in todo.items() if not item[1].alone]), *[(1, alone)] * TIMED]
        count = sum(len(items) for _, items in rounds)
        for workers, items in rounds:
            with concurrent.futures.ThreadPoolExecutor(workers) as pool:
                waiting = [pool.submit(self._one, key, wanted) for key, wanted in items]
                for future in concurrent.futures.as_completed(waiting):
                    future.result()
                    n += 1
                    print(f"  {n}/{count} runs, {time.monotonic() - start:.0f} s", end="\r" if sys.stderr.isatty() else "\n",
                          file=sys.stderr, flush=True)

    def _one(self, key, wanted):
        folder = self.folder / f"{wanted.scene.replace('/', '_')}_{key}"
        folder.mkdir(parents=True, exist_ok=True)
        command = [os.environ["TRAMMEL"], "static" if wanted.is_static() else "run", *wanted.command_line(), "--quiet", "--out", str(folder)]
        (folder / "command").write_text(" ".join(command) + "\n")
        late = False
        child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        try:
            message = child.communicate(timeout=TIME_LIMIT)[1]
        except subprocess.TimeoutExpired:
            late = True  # tells nothing about the method, whatever a claim expects of this run
            child.send_signal(signal.SIGINT)  # keeps the results so far
            message = f"stopped after {TIME_LIMIT} s\n{child.communicate()[1]}"
        if child.returncode not in (0, 1, 130) or not (folder / "result.json").exists():
            raise SystemExit(f"tools/reproduce: {' '.join(command)}\n{message}")
        if late or (child.returncode and not wanted.may_fail):
            self.unexpected.append(f"{' '.join(command)}\n        {message.splitlines()[0]}")
        result, before = Result(folder), self.of_key.get(key)
        result.cpu = min(result.cpu, before.cpu if before else math.inf)
        self.of_key[key] = result


def _load(path):
    text = COMMENT_OR_STRING.sub(lambda m: m[0] if m[0].startswith('"') else " ", path.read_text())
    content = json.loads(text)
    include = content.pop("include", None)
    return _merge(_load(path.parent / include), content) if include else content


def _merge(base, changes):
    if not (isinstance(base, dict) and isinstance(changes, dict)) or changes.get("type", base.get("type")) != base.get("type"):
        return changes
    return {name: _merge(base[name], changes[name]) if name in base and name in changes else changes.get(name, base.get(name))
            for name in {**base, **changes}}


def significant(x, digits=3):
    """4 digits of 0.00123 or 1.8e-7 as people write them."""
    if x == 0 or not math.isfinite(x):
        return f"{x:g}"
    return f"{x:.{digits}g}"
