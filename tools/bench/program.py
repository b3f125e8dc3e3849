"""Builds bin/trammel, runs a scene pinned to one core, gives back what it cost."""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("TRAMMEL_BUILD_DIR", ROOT / "build"))


def build(*options):
    subprocess.run([ROOT / "tools/build", *options, "trammel_product"], check=True, stdout=sys.stderr)


def pin():
    """What goes before a command that shall stay on one core, the last one."""
    return ["taskset", "-c", str(max(os.sched_getaffinity(0)))] if shutil.which("taskset") else []


def run(scene, values, events=False, series=False):
    """result.json of a run, None if it was refused; `events`: with the time of the last event as "last_event"; `series`: with its rows."""
    overrides = [x for path, value in values.items() for x in ("--set", f"{path}={value}")]
    with tempfile.TemporaryDirectory() as out:
        command = [*pin(), BUILD / "bin/trammel", "run", scene if isinstance(scene, pathlib.Path) else ROOT / f"scenes/{scene}.json", *overrides, "--quiet", "--out", out]
        message = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True).stderr
        path = pathlib.Path(out)
        if not (path / "result.json").exists():
            print(" ".join(map(str, command)) + "\n" + message, file=sys.stderr)
            return None
        result = json.loads((path / "result.json").read_text())
        if events:
            rows = (path / "events.csv").read_text().splitlines()[1:]
            result["last_event"] = float(rows[-1].split(",")[0]) if rows else None
        if series:
            with open(path / "series.csv", newline="") as file:
                result["series"] = [{name: float(x) for name, x in row.items()} for row in csv.DictReader(file)]
        return result


def load():
    return "load average " + " ".join(f"{x:.1f}" for x in os.getloadavg()) + f" on {os.cpu_count()} cores"
