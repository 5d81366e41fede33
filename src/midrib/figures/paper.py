"""A sheet of paper to draw a map on: true to scale, with a legend and a scale bar below it."""

from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import shapely

from midrib.checks import check_library
from midrib.geodesy import lengths_at

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from midrib.formats.reading import Geometries
    from midrib.types import Floats

__all__ = ["FONT", "INCH", "POINT", "TEXT", "Paper", "save", "sheet_for"]

INCH, POINT = 25.4, 25.4 / 72.0  # millimetres
FOOTER, MARGIN, ROW = 9.0, 4.0, 5.0  # millimetres
NARROW = 165.0  # millimetres: on a sheet less wide the scale bar stands above the legend
MOST_ELONGATED = 0.45  # the map's shorter side over its longer one, at the least
DPI = 200
BAR_SHARE = 0.2  # of the sheet's width, at the most
TEXT, FONT, NARROW_COLUMNS = "#333333", 7.5, 3


class Paper(NamedTuple):
    """The sheet, its map and what a coordinate unit is on it."""

    figure: "Figure"
    axes: "Axes"
    scale: "Floats"  # millimetres on paper of a unit of x and of y
    unit_length: float  # length of a unit of x: 1, or metres in a degree
    legend: "dict[str, Artist]"

    def millimetres(self, vectors: "Floats") -> "Floats":
        """Lengths on paper of vectors (n, 2) in coordinate units."""
        lengths: Floats = np.hypot(*(vectors * self.scale).T)
        return lengths

    def fill(self, areas: "Geometries", face: str, edge: str, name: str) -> None:
        """Fill areas, holes left out."""
        from matplotlib.collections import PathCollection
        from matplotlib.patches import Patch

        rings = [area for area in areas if area is not None and not area.is_empty]
        if rings:
            paths = [path_of(area) for area in rings]
            self.axes.add_collection(
                PathCollection(paths, facecolor=face, edgecolor=edge, lw=0.1 / POINT)
            )
            self.legend[name] = Patch(facecolor=face, edgecolor=edge, lw=0.5, label=name)

    def stroke(self, chains: "list[Floats]", colour: str, width: Any, name: str) -> None:
        """Draw chains of points, ``width`` millimetres thick."""
        from matplotlib.collections import LineCollection
        from matplotlib.lines import Line2D

        if chains:
            points = np.asarray(width) / POINT
            lines = LineCollection(
                chains, colors=colour, linewidths=points, capstyle="round", joinstyle="round"
            )
            self.axes.add_collection(lines)
            self.legend[name] = Line2D([], [], color=colour, lw=np.max(points), label=name)

    def dot(self, points: "Floats", colour: str, diameter: float, name: str) -> None:
        """Draw dots at points (n, 2), ``diameter`` in millimetres."""
        if len(points):
            style: dict[str, Any] = {"color": colour, "marker": "o", "ls": "none", "mew": 0.0}
            style["ms"] = diameter / POINT
            (dots,) = self.axes.plot(*points.T, scalex=False, scaley=False, label=name, **style)
            self.legend[name] = dots

    def finish(self, unit: str | None) -> None:
        """Add the legend and the scale bar."""
        width, height = self.figure.get_size_inches() * INCH
        is_narrow = width < NARROW
        self.figure.legend(
            handles=list(self.legend.values()),
            loc="lower left",
            bbox_to_anchor=(MARGIN / width, 1.5 / height),
            ncols=NARROW_COLUMNS if is_narrow else len(self.legend) or 1,
            frameon=False,
            fontsize=FONT,
            labelcolor=TEXT,
            handlelength=1.6,
            borderpad=0.0,
            columnspacing=1.6,
        )
        self.draw_bar(width, height, 3.0 + is_narrow * 2.0 * ROW, unit)

    def draw_bar(self, width: float, height: float, level: float, unit: str | None) -> None:
        """Draw a scale bar on the right, ``level`` millimetres above the lower edge."""
        from matplotlib.lines import Line2D

        length = round_length(BAR_SHARE * width / self.scale[0] * self.unit_length)
        right = width - MARGIN
        left = right - length / self.unit_length * self.scale[0]
        x = np.array([left, left, right, right]) / width
        y = np.array([level + 1.0, level, level, level + 1.0]) / height
        self.figure.add_artist(Line2D(x, y, color=TEXT, lw=0.8))
        self.figure.text(
            (left + right) / 2.0 / width,
            (level + 0.8) / height,
            length_label(length, unit),
            ha="center",
            va="bottom",
            fontsize=FONT,
            color=TEXT,
        )

    def save(self, path: Path) -> None:
        """Write the sheet."""
        save(self.figure, path)


def save(figure: "Figure", path: Path) -> None:
    """Write a figure; the same drawing gives the same bytes."""
    from matplotlib import rc_context

    kind = path.suffix.lower().removeprefix(".")
    extra: dict[str, dict[str, Any]] = {
        "svg": {"metadata": {"Date": None}},
        "pdf": {"metadata": {"CreationDate": None}},
        "png": {"pil_kwargs": {"optimize": True}},
    }
    with rc_context({"svg.hashsalt": "midrib"}):
        figure.savefig(path, format=kind, dpi=DPI, **extra[kind])


def sheet_for(areas: "Geometries", geographic: bool, longest: float) -> Paper:
    """Return a sheet on which all areas find room, ``longest`` millimetres long.

    Raises
    ------
    MissingDependencyError
        If matplotlib is not installed.
    """
    check_library("matplotlib", "a figure", "figures")
    from matplotlib.figure import Figure

    bounds = shapely.total_bounds([*areas, None])  # NaN where there is nothing
    low, high = (bounds[:2], bounds[2:]) if np.isfinite(bounds).all() else (np.zeros(2), np.ones(2))
    unit = np.ones(2)
    if geographic:
        unit = np.array(lengths_at((low[1] + high[1]) / 2.0))
    extent = np.maximum((high - low) * unit, 1e-9 * np.abs(high * unit).max() + 1e-300)
    extent = np.maximum(extent, MOST_ELONGATED * extent.max())
    per_length = (longest - 2.0 * MARGIN) / extent.max()
    size = extent * per_length + 2.0 * MARGIN
    footer = FOOTER + (size[0] < NARROW) * 2.0 * ROW
    sheet = size + np.array([0.0, footer])
    figure = Figure(figsize=tuple(sheet / INCH), facecolor="white")
    axes = figure.add_axes((0.0, footer / sheet[1], 1.0, size[1] / sheet[1]))
    axes.set_axis_off()
    middle, half = (low + high) / 2.0, size / per_length / unit / 2.0
    axes.set_xlim(middle[0] - half[0], middle[0] + half[0])
    axes.set_ylim(middle[1] - half[1], middle[1] + half[1])
    return Paper(figure, axes, per_length * unit, float(unit[0]), {})


def path_of(area: Any) -> Any:
    """Matplotlib path of an area; holes turn the other way, or they would be filled."""
    from matplotlib.path import Path as Outline

    parts = shapely.orient_polygons(shapely.get_parts(area))
    rings = [shapely.get_coordinates(ring) for ring in shapely.get_rings(parts)]
    codes = [
        [Outline.MOVETO] + [Outline.LINETO] * (len(ring) - 2) + [Outline.CLOSEPOLY]
        for ring in rings
    ]
    return Outline(np.concatenate(rings), np.concatenate(codes))


def round_length(length: float) -> float:
    """Return the largest of 1, 2, 5, 10 … that is not longer."""
    power = 10.0 ** np.floor(np.log10(length))
    return float(power * max(step for step in (1.0, 2.0, 5.0) if step * power <= length))


def length_label(length: float, unit: str | None) -> str:
    """Text of a scale bar."""
    if unit == "m" and length >= 1000.0:
        return f"{length / 1000.0:,.0f} km"
    return f"{length:,g} {unit or 'units'}"
