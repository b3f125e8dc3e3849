"""tools/reproduce SYSTEM: runs the studies of a system's paper, draws its figures, fills its tables, judges its claims.

A system is a module of this folder with TITLE, FIGURES (a list of Figure), CLAIMS (a list of Claim), and TABLES, a list of
(name, title, cases, rows of the results): beam.py is one.
"""
import argparse
import csv
import importlib
import os
import pathlib
import shutil
import sys
import time

import claims
import figures
from studies import Results

HERE = pathlib.Path(__file__).resolve().parent
PARTS = {"main", "studies", "figures", "pictures", "claims", "beam_table_1"}


def main():
    systems = sorted(p.stem for p in HERE.glob("*.py") if p.stem not in PARTS)
    parser = argparse.ArgumentParser(prog="tools/reproduce", description="Redraws a paper's figures and checks its claims.")
    parser.add_argument("system", choices=systems)
    parser.add_argument("--out", type=pathlib.Path, help="results folder; default out/reproduce/SYSTEM")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="cases at a time; default one per core")
    options = parser.parse_args()
    system = importlib.import_module(options.system)
    out = options.out or pathlib.Path("out/reproduce") / options.system
    shutil.rmtree(out / "studies", ignore_errors=True)
    out.mkdir(parents=True, exist_ok=True)

    start = time.monotonic()
    results = Results(getattr(system, "SCENES", options.system), out / "studies")
    results.compute(options.jobs, getattr(system, "ALONE", set()))
    cases = {case for figure in system.FIGURES for case in figure.cases()}
    cases |= {case for _, _, cases_of, _ in system.TABLES for case in cases_of} | {case for claim in system.CLAIMS for case in claim.cases}
    unexpected = results.unexpected(cases)
    for figure in system.FIGURES:
        figures.write(figure, results, out)
    text = [f"# {system.TITLE}", "", "Written by `tools/reproduce " + options.system + "`; every number of Trammel's was computed"
            " by the studies of the scenes, whose results are in `studies/`.", ""]
    for name, title, _, rows_of in system.TABLES:
        header, *rows = rows_of(results)
        with open(out / f"{name}.csv", "w", newline="") as file:
            csv.writer(file).writerows([header, *rows])
        text += [f"## {title}", "", claims.markdown(header, rows), ""]
    verdicts = [(claim, claim.judge(results)) for claim in system.CLAIMS]
    table = claims.markdown(["claim", "paper", "Trammel", "holds", "why"], [claim.row(verdict) for claim, verdict in verdicts])
    text += ["## Claims", "", table, ""]
    surprises = [line for claim, verdict in verdicts if (line := claim.surprise(verdict))]
    if surprises:
        text += ["## Claims judged otherwise than expected", "", *("    " + line for line in surprises), ""]
    if unexpected:
        text += ["## Cases that failed", "", *("    " + line for line in unexpected), ""]
    (out / "claims.md").write_text("\n".join(text))

    print("\n".join(text))
    print(f"{results.count()} runs, {len(system.FIGURES)} figures, {time.monotonic() - start:.0f} s. Figures (SVG, CSV) and "
          f"claims.md are in {out}")
    return 1 if unexpected or surprises else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
