"""Trammel from Python: runs scenes with the program `trammel` and reads what it writes. Standard library and NumPy only.

    import trammel
    run = trammel.run("scenes/beam_impact.json", **{"parameters.N": 9, "simulate.until": 0.5})
    run.t, run["tip_y"], run.units["tip_y"], run.events[0], run.info["energy_drift"]
    run                                             # in a notebook: the report

    for e in (0, 0.3, 0.6):
        print(e, trammel.run("scenes/beam_impact.json", parameters__e=e).info["counts"]["impacts"])

    trammel.validate(scene); trammel.study("study.json"); trammel.trade("scenes/beam_impact.json")

A scene is a path, or a dict. Values to set are named by their paths: "parameters.N", or parameters__N as a keyword. An invalid
scene raises a `SceneError`, whose `problems` name file, line, column and path.

The program is the one that TRAMMEL names, else the one beside this file's repository (build/bin/trammel), else the one on the PATH.
"""

import csv
import html
import json
import os
import shutil
import struct
import subprocess
import tempfile
import weakref
import zipfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

__all__ = ["run", "static", "validate", "study", "trade", "Result", "Measured", "TrammelError", "SceneError", "PluginError",
           "RunFailed", "Problem"]


@dataclass(frozen=True)
class Problem:
    """One thing that is wrong: where, and what."""

    file: str
    line: int
    column: int
    path: str  # in the scene: "contacts.tip.restitution"
    message: str

    def __str__(self):
        place = f"{self.file}:{self.line}:{self.column}: " if self.line else ""
        return place + (f"{self.path}: " if self.path else "") + self.message


class TrammelError(Exception):
    """The program refused or failed; `problems` lists the causes that have a place in a file."""

    def __init__(self, message, problems=()):
        super().__init__(message)
        self.problems = list(problems)


class SceneError(TrammelError):
    """Bad input: a scene, a study or an option (exit code 2)."""


class PluginError(TrammelError):
    """A plugin misbehaves (exit code 3)."""


class RunFailed(TrammelError):
    """The run failed; `result` has what was recorded until then, or is None (exit code 1)."""

    def __init__(self, message, problems=(), result=None):
        super().__init__(message, problems)
        self.result = result


def program():
    """The path of the program."""
    beside = Path(__file__).resolve().parent.parent / "build/bin/trammel"
    named = os.environ.get("TRAMMEL")
    found = named or (str(beside) if beside.exists() else shutil.which("trammel"))
    if not found:
        raise TrammelError("there is no program 'trammel': build it (tools/build), or name it in the environment variable TRAMMEL")
    return found


def _call(words, allowed=(0,)):
    """(exit code, the JSON object that the command printed); raises if the exit code is none of `allowed`."""
    done = subprocess.run([program(), *map(str, words), "--json"], capture_output=True, text=True)
    try:
        answer = json.loads(done.stdout) if done.stdout.strip() else {}
    except json.JSONDecodeError:
        answer = {}
    if done.returncode in allowed:
        return done.returncode, answer
    if done.returncode == 130:
        raise KeyboardInterrupt
    problems = [Problem(**problem) for problem in answer.get("problems", [])]
    message = "\n".join(map(str, problems)) or done.stderr.strip() or answer.get("reason", "") or f"exit code {done.returncode}"
    raise {2: SceneError, 3: PluginError}.get(done.returncode, RunFailed)(message, problems)


def _overrides(values):
    for name, value in values.items():
        text = value if isinstance(value, str) else json.dumps(value.tolist() if hasattr(value, "tolist") else value)
        yield "--set"
        yield f"{name.replace('__', '.')}={text}"


def _scene_file(scene, folder):
    """The path of a scene or study; a dict is written into the folder; files that it names are relative to the working folder."""
    if not isinstance(scene, dict):
        return Path(scene)

    def from_here(names):
        return [from_here(name) for name in names] if isinstance(names, list) else str(Path(names).absolute())

    named = {key: from_here(scene[key]) for key in ("include", "scene") if key in scene}
    file = Path(folder) / "scene.json"
    file.write_text(json.dumps(scene | named, indent=1))
    return file


def _run(command, scene, out, values):
    kept = None
    if out is None:
        kept = tempfile.mkdtemp(prefix="trammel_")
        out = Path(kept) / "results"
    out = Path(out)
    with tempfile.TemporaryDirectory(prefix="trammel_") as folder:
        words = [command, _scene_file(scene, folder), "--out", out, *_overrides(values)]
        code, answer = _call(words + ["--format", "npz"], allowed=(0, 1))
    if not (out / "series.csv").exists():
        raise RunFailed(answer.get("reason") or "the run failed before its first record",
                        [Problem(**problem) for problem in answer.get("problems", [])])
    result = Result.load(out)
    if kept:
        weakref.finalize(result, shutil.rmtree, kept, ignore_errors=True)  # the files live as long as the result
    if code != 0:
        raise RunFailed(answer.get("reason", "the run failed"), result=result)
    return result


def run(scene, *, out=None, **values):
    """Runs a scene with some of its values set and returns the Result. Without `out` its files are deleted with it."""
    return _run("run", scene, out, values)


def static(scene, *, out=None, **values):
    """Equilibria under growing loads (`trammel static`)."""
    return _run("static", scene, out, values)


def validate(scene, **values):
    """The warnings about a scene; raises SceneError with all of its problems."""
    with tempfile.TemporaryDirectory(prefix="trammel_") as folder:
        return _call(["validate", _scene_file(scene, folder), *_overrides(values)])[1].get("warnings", [])


def _measured(command, what, options):
    words = [command]
    with tempfile.TemporaryDirectory(prefix="trammel_") as folder:
        words.append(_scene_file(what, folder))
        for name, value in options.items():
            words.append("--" + name.replace("_", "-"))
            if value is not True:
                words.append(value)
        return Measured(_call(words)[1])


def study(file, **options):
    """A study of many cases in one process (`trammel study`); options as those of the command: study(file, out="results")."""
    return _measured("study", file, options)


def trade(scene, **options):
    """Accuracy against cost of the methods on a scene (`trammel trade`)."""
    return _measured("trade", scene, options)


class _Shown:
    """Shown in a notebook as its report."""

    def report(self):
        """The report as HTML text."""
        with tempfile.TemporaryDirectory(prefix="trammel_") as folder:
            file = Path(folder) / "report.html"
            _call(["report", self._reported(Path(folder)), "--out", file])
            return file.read_text()

    def _repr_html_(self):
        return (f'<iframe srcdoc="{html.escape(self.report())}" width="100%" height="720" '
                'style="border:0" title="Trammel report"></iframe>')


class Measured(_Shown):
    """What `trammel study` or `trammel trade` found: its JSON in `info`."""

    def __init__(self, info):
        self.info = info

    def __getitem__(self, name):
        return self.info[name]

    def _reported(self, folder):
        file = folder / "measured.json"
        file.write_text(json.dumps(self.info))
        return file


class Result(_Shown):
    """A results folder: columns as arrays, `events` as dicts, result.json in `info`, `units` by column."""

    def __init__(self, folder, series, events, info):
        self.folder, self.events, self.info = Path(folder), events, info
        self._series = series
        columns = info.get("columns", {}).get("series", [])
        self.units = {column["name"]: column["unit"] for column in columns}
        self.meanings = {column["name"]: column["meaning"] for column in columns}

    @classmethod
    def load(cls, folder):
        """Reads a results folder; series.npz (`trammel run --format npz`) is mapped into memory, series.csv is read."""
        folder = Path(folder)
        if not (folder / "series.csv").exists():
            raise FileNotFoundError(f"{folder} holds no results: there is no series.csv")
        info = json.loads((folder / "result.json").read_text()) if (folder / "result.json").exists() else {}
        npz = folder / "series.npz"
        series = _mapped(npz) if npz.exists() else _read_series(folder / "series.csv")
        return cls(folder, series, _read_events(folder / "events.csv"), info)

    @property
    def t(self):
        return self._series["t"]

    @property
    def columns(self):
        return list(self._series)

    def __getitem__(self, name):
        try:
            return self._series[name]
        except KeyError:
            raise KeyError(f"no column {name!r}; there are {', '.join(self._series)}") from None

    def __len__(self):
        return len(self.t)

    def __repr__(self):
        title = self.info.get("title") or self.info.get("scene", self.folder.name)
        return f"<Result {title!r}: {len(self)} records, {len(self.events)} events, {self.info.get('status', 'not ended')}>"

    def _reported(self, _):
        return self.folder


def _read_series(file):
    with open(file) as lines:
        names = lines.readline().rstrip("\n").split(",")
        table = np.loadtxt(lines, delimiter=",", ndmin=2)
    return {name: table[:, i] if len(table) else np.empty(0) for i, name in enumerate(names)}


def _number(text):
    try:
        return float(text)
    except ValueError:
        return text


def _read_events(file):
    if not file.exists():
        return []
    with open(file, newline="") as lines:
        return [{name: _number(text) for name, text in row.items() if text} for row in csv.DictReader(lines)]


def _mapped(file):
    """The arrays of numbers in an .npz of stored members, mapped into memory: only what is used is read."""
    arrays = {}
    with zipfile.ZipFile(file) as archive, open(file, "rb") as raw:
        for member in archive.infolist():
            raw.seek(member.header_offset + 26)
            name_length, extra_length = struct.unpack("<HH", raw.read(4))
            raw.seek(name_length + extra_length, os.SEEK_CUR)
            np.lib.format.read_magic(raw)
            shape, fortran, dtype = np.lib.format.read_array_header_1_0(raw)
            if dtype.kind == "f":
                order = "F" if fortran else "C"
                arrays[member.filename.removesuffix(".npy")] = np.memmap(file, dtype, "r", raw.tell(), shape, order)
    return arrays
