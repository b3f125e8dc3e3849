"""tools/reproduce SYSTEM: runs the studies of a system's paper, writes their reports, fills its tables, judges its claims.

A system is a module of this folder with TITLE, CLAIMS (claims.py), TABLES, a list of (name, title, rows of the results), and, if
its scenes' folder has another name, SCENES; ALONE names studies whose times are compared; PICTURES, a list of (title, case), the
runs whose report shows surfaces.
"""
import argparse
import csv
import importlib
import os
import pathlib
import shutil
import sys
import time

from studies import Results, trammel

def markdown(rows):
    header, *rows = rows
    return "\n".join("| " + " | ".join(str(c).replace("|", "\\|") for c in row) + " |" for row in [header, ["---"] * len(header), *rows])

def main():
    parser = argparse.ArgumentParser(prog="tools/reproduce", description="Redraws a paper's figures and checks its claims.")
    parser.add_argument("system", choices=["beam", "free_standing", "plate", "truss"])
    parser.add_argument("--out", type=pathlib.Path, help="results folder; default out/reproduce/SYSTEM")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="cases at a time; default one per core")
    options = parser.parse_args()
    system = importlib.import_module(options.system)
    out = options.out or pathlib.Path("out/reproduce") / options.system
    shutil.rmtree(out / "studies", ignore_errors=True)
    out.mkdir(parents=True, exist_ok=True)

    start = time.monotonic()
    results = Results(getattr(system, "SCENES", options.system), out / "studies", options.jobs, getattr(system, "ALONE", set()))
    text = [f"# {system.TITLE}", "", f"Written by `tools/reproduce {options.system}`; every number of Trammel's was computed by the "
            "studies of the scenes, whose results are in `studies/`.", "", "## Figures", ""]
    text += [f"- [{title}](studies/{name}/report.html)" for name, title in results.titles.items()]
    for title, case in getattr(system, "PICTURES", []):
        trammel("report", results[case].folder)
        text.append(f"- [{title}]({(results[case].folder / 'report.html').relative_to(out)})")
    for name, title, rows_of in system.TABLES:
        rows = list(rows_of(results))
        with open(out / f"{name}.csv", "w", newline="") as file:
            csv.writer(file).writerows(rows)
        text += ["", f"## {title}", "", markdown(rows)]
    for claim in system.CLAIMS:
        claim.decide(results)
    text += ["", "## Claims", "", markdown(system.CLAIMS.table()), ""]
    surprises = [line for claim in system.CLAIMS if (line := claim.surprise())]
    for title, lines in (("Claims judged otherwise than expected", surprises), ("Cases that failed", failed := results.failures())):
        if lines:
            text += [f"## {title}", "", *("    " + line for line in lines), ""]
    (out / "claims.md").write_text("\n".join(text))

    print("\n".join(text))
    print(f"{sum(map(len, results.rows.values()))} runs, {time.monotonic() - start:.0f} s. Reports and claims.md are in {out}")
    return 1 if failed or surprises else 0

if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
