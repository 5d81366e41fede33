"""Drawn: lines, filled areas, and figures that stand in a place."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib.hatching.standard import Standard

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from midrib.types import Floats, Ints

__all__ = ["CIRCLE", "HEAD", "Figure", "Pen", "Placed", "Symbols", "drawing", "edges_of"]

SIDES = 96  # of a polygon drawn for a circle


class Figure(NamedTuple):
    """A drawing in units of its size, around the origin."""

    name: str
    lines: tuple["Floats", ...]
    is_filled: bool = False
    is_round: bool = False  # its one line stands for a circle of diameter 1


def circle_points() -> "Floats":
    """Ring of points on a circle of diameter 1."""
    angle = np.linspace(0.0, 2.0 * np.pi, SIDES + 1)
    angle[-1] = 0.0
    return 0.5 * np.column_stack([np.cos(angle), np.sin(angle)])


CIRCLE = Figure("circle", (circle_points(),), is_round=True)
HEAD = Figure("head", (circle_points(),), is_filled=True, is_round=True)


class Placed(NamedTuple):
    """A figure in some places."""

    figure: Figure
    at: "Floats"  # (n, 2)
    size: "Floats"  # (n,) what a unit of the figure is
    angle: "Floats"  # (n,) degrees from east, counter-clockwise
    stroke: "Ints"  # (n,) number of the stroke, or of the place

    def chains(self) -> "list[tuple[int, Floats]]":
        """Lines of the figures where they stand, with the number of the stroke."""
        c, s = np.cos(np.radians(self.angle)), np.sin(np.radians(self.angle))
        turned = self.size[:, None, None] * np.stack(
            [np.column_stack([c, s]), np.column_stack([-s, c])], axis=1
        )
        return [
            (int(stroke), line @ turn + at)
            for at, turn, stroke in zip(self.at, turned, self.stroke, strict=True)
            for line in self.figure.lines
        ]


@dataclass(frozen=True)
class Symbols:
    """What is drawn of one object.

    Attributes
    ----------
    lines : ndarray of LineString, shape (n,)
        Drawn with the standard's stroke width.
    line_stroke : ndarray of int, shape (n,)
        Number of the stroke that each belongs to.
    areas : ndarray of Polygon, shape (m,)
        Filled.
    area_stroke : ndarray of int, shape (m,)
        Number of the stroke that each belongs to.
    placed : tuple of Placed
        Figures besides: heads, circles, templates.
    edges : ndarray of LineString
        The outline, drawn with the standard's outline width and dashes.
    standard : Standard
        With the figures of the scale.
    """

    lines: "NDArray[np.object_]"
    line_stroke: "Ints"
    areas: "NDArray[np.object_]"
    area_stroke: "Ints"
    placed: tuple[Placed, ...]
    edges: "NDArray[np.object_]"
    standard: Standard

    @property
    def count(self) -> int:
        """How many lines, areas and figures there are, the outline apart."""
        return self.lines.size + self.areas.size + sum(p.size.size for p in self.placed)

    def flat(self) -> "Symbols":
        """Return the same drawing with figures made lines and areas."""
        lines, areas = Pen(), Pen()
        lines.take(self.lines, self.line_stroke)
        areas.take(self.areas, self.area_stroke)
        for placed in self.placed:
            pen, shape = (areas, Polygon) if placed.figure.is_filled else (lines, LineString)
            for stroke, chain in placed.chains():
                pen.add(shape(chain), stroke)
        return drawing(lines, areas, (), self.edges, self.standard)


class Pen:
    """Collects geometries and the numbers of their strokes."""

    def __init__(self) -> None:
        self.drawn: list[LineString | Polygon] = []
        self.stroke: list[int] = []

    def add(self, geometry: LineString | Polygon, stroke: int) -> None:
        """Add one."""
        self.drawn.append(geometry)
        self.stroke.append(stroke)

    def take(self, geometries: "NDArray[np.object_]", strokes: "Ints") -> None:
        """Add some."""
        self.drawn.extend(geometries)
        self.stroke.extend(strokes.tolist())

    def arrays(self) -> "tuple[NDArray[np.object_], Ints]":
        """Geometries, and the numbers of their strokes."""
        drawn = np.empty(len(self.drawn), dtype=object)
        drawn[:] = self.drawn
        return drawn, np.array(self.stroke, dtype=np.intp)


def drawing(
    lines: Pen,
    areas: Pen,
    placed: tuple[Placed, ...],
    edges: "NDArray[np.object_]",
    known: Standard,
) -> Symbols:
    """Symbols of what the pens have collected."""
    return Symbols(*lines.arrays(), *areas.arrays(), placed, edges, known)


def edges_of(area: Polygon, top: LineString, known: Standard) -> "NDArray[np.object_]":
    """Lines of the outline of an area: all rings, the top, or none."""
    edges = {"all": [LineString(r) for r in shapely.get_rings(area)], "top": [top], "none": []}
    lines = np.empty(len(edges[known.outline]), dtype=object)
    lines[:] = [shapely.force_2d(line) for line in edges[known.outline]]
    return lines
