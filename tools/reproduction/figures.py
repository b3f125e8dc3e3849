"""Figures: panels of curves, written as one SVG and one CSV for each panel."""
import csv
import dataclasses
from typing import Callable

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of the backend)
import numpy as np  # noqa: E402

from runs import Run  # noqa: E402

plt.rcParams.update({"svg.hashsalt": "trammel", "font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "lines.linewidth": 0.9})


@dataclasses.dataclass
class Curve:
    label: str
    run: Run
    y: str | Callable  # a column of series.csv, or a function of the result


@dataclasses.dataclass
class Panel:
    name: str
    title: str
    ylabel: str
    curves: list[Curve]
    log: bool = False
    log_t: bool = False


@dataclasses.dataclass
class Figure:
    name: str
    title: str
    panels: list[Panel]

    def runs(self):
        return [curve.run for panel in self.panels for curve in panel.curves]


def values(curve, results):
    result = results[curve.run]
    return result.t, curve.y(result) if callable(curve.y) else result[curve.y]


def write(figure, results, folder):
    columns = 3 if len(figure.panels) % 3 == 0 else 2 if len(figure.panels) > 1 else 1
    rows = -(-len(figure.panels) // columns)
    picture, axes = plt.subplots(rows, columns, figsize=(5.2 * columns, 3.1 * rows), squeeze=False, layout="constrained")
    for ax, panel in zip(axes.flat, figure.panels):
        drawn = [(curve.label, *values(curve, results)) for curve in panel.curves]
        for label, t, y in drawn:
            if panel.log:  # a norm is zero while no constraint is on
                (ax.loglog if panel.log_t else ax.semilogy)(t[y > 0], y[y > 0], ".", markersize=2, label=label)
            else:
                ax.plot(t, y, label=label)
        ax.set(title=panel.title, xlabel="t [s]", ylabel=panel.ylabel)
        ax.legend(fontsize=7)
        table(folder / f"{figure.name}_{panel.name}.csv", drawn)
    for ax in axes.flat[len(figure.panels):]:
        ax.remove()
    picture.suptitle(figure.title)
    picture.savefig(folder / f"{figure.name}.svg", metadata={"Date": None})
    plt.close(picture)


def table(path, drawn):
    """One column per curve on the times of all; empty where a run was not recorded or had ended."""
    times = np.unique(np.concatenate([t for _, t, _ in drawn]).round(9))
    cells = [dict(zip(t.round(9), y)) for _, t, y in drawn]
    with open(path, "w", newline="") as file:
        out = csv.writer(file)
        out.writerow(["t", *(label for label, _, _ in drawn)])
        for t in times:
            out.writerow([f"{t:.9g}", *(f"{c[t]:.12g}" if t in c else "" for c in cells)])
