"""Panels of surfaces, from fields.ndjson: stress maps, meshes and deformed shapes. Element by element, outlines drawn."""
import dataclasses
from typing import Callable

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

from studies import Case

COLOURS = "turbo"


@dataclasses.dataclass
class Colour:
    """What the colour says: a field by name, or a function of the fields; shown times `scale`."""

    of: str | Callable
    label: str  # with the unit
    scale: float = 1
    times: list | None = None  # whose values the colours span; none: those of the moment shown
    bar: bool = True  # false: another panel's tells

    def values(self, fields):
        return self.scale * (fields.values[self.of] if isinstance(self.of, str) else self.of(fields))

    def norm(self, result, moment):
        values = np.concatenate([self.values(result.fields(t)).ravel() for t in self.times or [moment]])
        return plt.Normalize(values.min(), values.max())


def outlines(points):
    """Of each element: its four sides, one closed line."""
    sides = [points[:, 0], points[:, 1:, -1], points[:, -1, -2::-1], points[:, -2::-1, 0]]
    return np.concatenate(sides, axis=1)


@dataclasses.dataclass
class Moment:
    """A run's surface at a time."""

    name: str
    title: str | Callable  # may be a function of the result
    run: Case
    t: float
    colour: Colour | None = None  # none: the mesh alone

    def cases(self):
        return [self.run]

    def fields(self, results):
        return results[self.run].fields(self.t)

    def heading(self, results):
        return self.title(results[self.run]) if callable(self.title) else self.title

    def table(self, results):
        fields = self.fields(results)
        columns = [np.repeat(np.arange(len(fields.points)), fields.points[0, :, :, 0].size)]
        columns += list(fields.points.reshape(-1, 3).T)
        if self.colour:
            columns.append(self.colour.values(fields).ravel())
        yield ["element", "x [m]", "y [m]", "z [m]", *([self.colour.label] if self.colour else [])]
        yield from ([f"{x:.6g}" for x in row] for row in zip(*columns))

    def colour_bar(self, ax, norm):
        if self.colour.bar:
            ax.figure.colorbar(plt.cm.ScalarMappable(norm, COLOURS), ax=ax, label=self.colour.label, shrink=0.8,
                               pad=0.2 if self.projection else 0.03)


@dataclasses.dataclass
class Map(Moment):
    """Seen from above. notes: (x, y, text, angle [deg])."""

    notes: tuple = ()
    projection = None

    def draw(self, ax, results):
        fields = self.fields(results)
        if self.colour:
            values = self.colour.values(fields)
            norm = self.colour.norm(results[self.run], self.t)
            for points, value in zip(fields.points, values):
                ax.pcolormesh(points[..., 0], points[..., 1], value, norm=norm, cmap=COLOURS, shading="gouraud", rasterized=True)
            self.colour_bar(ax, norm)
        ax.add_collection(LineCollection(outlines(fields.points)[..., :2], colors="black", linewidths=0.4))
        for x, y, text, angle in self.notes:
            ax.text(x, y, text, ha="center", va="center", fontsize=8, rotation=angle)
        if self.notes:
            ax.margins(0.12)
        ax.set(title=self.heading(results), xlabel="x [m]", ylabel="y [m]", aspect="equal")
        ax.grid(visible=False)
        ax.autoscale_view()


@dataclasses.dataclass
class Surface(Moment):
    """Seen from the side. box: the least and largest x, y, z drawn; heights are stretched."""

    box: tuple = ()  # none: what the surface fills
    stretch: float = 1
    view: tuple = (25, -60)  # elevation, azimuth [deg]
    projection = "3d"

    def draw(self, ax, results):
        fields = self.fields(results)
        if self.colour:
            values = self.colour.values(fields)
            norm = self.colour.norm(results[self.run], self.t)
            corners = [np.s_[:, :-1, :-1], np.s_[:, :-1, 1:], np.s_[:, 1:, 1:], np.s_[:, 1:, :-1]]
            faces = np.stack([fields.points[c] for c in corners], axis=-2).reshape(-1, 4, 3)
            shades = np.mean([values[c] for c in corners], axis=0).ravel()
            ax.add_collection3d(Poly3DCollection(faces, facecolors=plt.get_cmap(COLOURS)(norm(shades)), linewidths=0, rasterized=True))
            self.colour_bar(ax, norm)
        ax.add_collection3d(Line3DCollection(outlines(fields.points), colors="black", linewidths=0.3))
        low, high = np.array(self.box or (fields.points.min(axis=(0, 1, 2)), fields.points.max(axis=(0, 1, 2))))
        ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]), title=self.heading(results),
               xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")
        ax.set_box_aspect((high - low) * (1, 1, self.stretch))
        ax.view_init(*self.view)
        ax.tick_params(labelsize=6)
        ax.locator_params(nbins=3)
