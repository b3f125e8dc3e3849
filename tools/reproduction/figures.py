"""Figures: panels, written as one SVG and one CSV for each panel. Here the panels of curves; pictures.py has those of surfaces.

A panel has a name, the runs it needs, draw(axes, results), and table(results): a header and rows for its CSV.
"""
import csv
import dataclasses
from typing import Any, Callable

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of the backend)
import numpy as np  # noqa: E402

from studies import Case  # noqa: E402

plt.rcParams.update({"svg.hashsalt": "trammel", "font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "lines.linewidth": 0.9})
LEGEND_BELOW = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.17)}  # where it would hide what is drawn
COLOURS = len(plt.rcParams["axes.prop_cycle"])


@dataclasses.dataclass
class Curve:
    label: str
    run: Case
    y: str | Callable  # a column of series.csv, or a function of the result


@dataclasses.dataclass
class Panel:
    """Curves over time."""

    name: str
    title: str
    ylabel: str
    curves: list[Curve]
    log: bool = False
    log_t: bool = False
    xlabel: str = "t [s]"
    style: str = "-"
    projection = None

    def cases(self):
        return [curve.run for curve in self.curves]

    def drawn(self, results):
        return [(curve.label, *values(curve, results)) for curve in self.curves]

    def draw(self, ax, results):
        many = len(self.curves) > COLOURS
        if many:
            ax.set_prop_cycle(color=plt.colormaps["tab20"].colors)
        for label, t, y in self.drawn(results):
            if self.log:  # a norm is zero while no constraint is on
                (ax.loglog if self.log_t else ax.semilogy)(t[y > 0], y[y > 0], ".", markersize=2, label=label)
            else:
                ax.plot(t, y, self.style, label=label)
        ax.set(title=self.title, xlabel=self.xlabel, ylabel=self.ylabel)
        ax.legend(fontsize=7, markerscale=3, **(LEGEND_BELOW | {"ncols": 2} if many else {}))

    def table(self, results):
        """One column per curve on the times of all; empty where a run was not recorded or had ended."""
        drawn = self.drawn(results)
        times = np.unique(np.concatenate([t for _, t, _ in drawn]).round(9))
        cells = [dict(zip(t.round(9), y)) for _, t, y in drawn]
        yield ["t", *(label for label, _, _ in drawn)]
        for t in times:
            yield [f"{t:.9g}", *(f"{c[t]:.12g}" if t in c else "" for c in cells)]


@dataclasses.dataclass
class Lines:
    """Curves that are not over time: of(results) gives (label, x, y, format of matplotlib) of each."""

    name: str
    title: str
    xlabel: str
    ylabel: str
    needs: list[Case]
    of: Callable
    equal: bool = False  # one scale for both axes
    projection = None

    def cases(self):
        return self.needs

    def draw(self, ax, results):
        for label, x, y, form in self.of(results):
            ax.plot(x, y, form, markersize=3, label=label)
        ax.set(title=self.title, xlabel=self.xlabel, ylabel=self.ylabel)
        if self.equal:
            ax.set_aspect("equal", "datalim")
        ax.legend(fontsize=7, **(LEGEND_BELOW | {"ncols": 3} if self.equal else {}))

    def table(self, results):
        yield ["curve", self.xlabel, self.ylabel]
        for label, x, y, _ in self.of(results):
            yield from ([label, f"{a:.9g}", f"{b:.9g}"] for a, b in zip(x, y))


@dataclasses.dataclass
class Bars:
    """of(results) gives (label, height, what is written on it) of each."""

    name: str
    title: str
    ylabel: str
    needs: list[Case]
    of: Callable
    projection = None

    def cases(self):
        return self.needs

    def draw(self, ax, results):
        labels, heights, texts = zip(*self.of(results))
        ax.bar_label(ax.bar(labels, heights, width=0.6), texts)
        ax.set(title=self.title, ylabel=self.ylabel)
        ax.margins(y=0.15)
        ax.grid(axis="x", visible=False)

    def table(self, results):
        yield ["", self.ylabel]
        yield from ([label, f"{height:.6g}"] for label, height, _ in self.of(results))


@dataclasses.dataclass
class Figure:
    name: str
    title: str
    panels: list[Any]
    size: tuple = (5.2, 3.1)  # of a panel [in]
    columns: int = 0  # 0: chosen

    def cases(self):
        return [case for panel in self.panels for case in panel.cases()]


def values(curve, results):
    result = results[curve.run]
    return result.t, curve.y(result) if callable(curve.y) else result[curve.y]


def write(figure, results, folder):
    columns = figure.columns or (3 if len(figure.panels) % 3 == 0 else 2 if len(figure.panels) > 1 else 1)
    rows = -(-len(figure.panels) // columns)
    picture = plt.figure(figsize=(figure.size[0] * columns, figure.size[1] * rows), layout="constrained")
    for k, panel in enumerate(figure.panels, 1):
        panel.draw(picture.add_subplot(rows, columns, k, projection=panel.projection), results)
        with open(folder / f"{figure.name}_{panel.name}.csv", "w", newline="") as file:
            csv.writer(file).writerows(panel.table(results))
    picture.suptitle(figure.title)
    picture.savefig(folder / f"{figure.name}.svg", metadata={"Date": None}, dpi=150)
    plt.close(picture)
