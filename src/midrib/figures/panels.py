"""Panels side by side, each with a strip and what is made of it, in the colours of the paper."""

from typing import TYPE_CHECKING, Any

import numpy as np
import shapely

from midrib.checks import check_library
from midrib.figures.draw import AUXILIARY, FILL, LINE, MAIN, OUTLINE, RADIUS
from midrib.figures.paper import FONT, INCH, TEXT, Paper

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapely import Geometry

    from midrib.curves.minimal_radii import Curve
    from midrib.strip import Strip

__all__ = ["draw_line", "draw_points", "draw_radii", "draw_strip", "finish", "panels"]

GAP, TITLE, FOOTER, ROW = 4.0, 10.5, 4.0, 5.0  # millimetres
MARGIN = 0.04  # of the larger extent, around a shape
SIDE, THIN, BOLD, DOT = 0.4, 0.15, 0.6, 1.4  # millimetres
ENTRY = 33.0  # millimetres that an entry of the legend takes, on average


def panels(
    shapes: "Sequence[Geometry]",
    titles: "Sequence[str]" = (),
    *,
    columns: int = 1,
    width: float = 180.0,
) -> list[Paper]:
    """Lay out panels of one size, each as wide as its shape.

    Parameters
    ----------
    shapes : sequence of Geometry
        What each panel must have room for.
    titles : sequence of str, optional
        One for each panel.
    columns : int, default 1
        How many stand side by side.
    width : float, default 180
        Of the figure in millimetres.

    Returns
    -------
    list of Paper
        They share a figure of pyplot, which ``plt.show()`` shows.

    Raises
    ------
    MissingDependencyError
        If matplotlib is not installed.
    """
    check_library("matplotlib", "a figure", "figures")
    import matplotlib.pyplot as plt

    bounds = shapely.bounds(np.array(shapes, dtype=object))
    extents = bounds[:, 2:] - bounds[:, :2]
    extents += 2.0 * MARGIN * extents.max(axis=1, keepdims=True)
    wide = (width - GAP * (columns + 1)) / columns
    high = wide * float((extents[:, 1] / extents[:, 0]).max())
    rows, title = -(-len(shapes) // columns), TITLE if titles else GAP
    height = rows * (high + title) + FOOTER + ROW
    figure = plt.figure(figsize=(width / INCH, height / INCH), facecolor="white")
    sheets = []
    for k, (middle, extent) in enumerate(
        zip((bounds[:, :2] + bounds[:, 2:]) / 2.0, extents, strict=True)
    ):
        left = GAP + k % columns * (wide + GAP)
        below = height - (k // columns + 1) * (high + title)
        place = left / width, below / height, wide / width, high / height
        axes = figure.add_axes(place, label=str(k))
        axes.set_axis_off()
        scale = wide / extent[0]  # the panels are as high as the tallest shape needs
        half = np.array([wide, high]) / scale / 2.0
        axes.set_xlim(middle[0] - half[0], middle[0] + half[0])
        axes.set_ylim(middle[1] - half[1], middle[1] + half[1])
        if titles:
            axes.set_title(titles[k], fontsize=FONT + 1.5, color=TEXT, loc="left", pad=3.0)
        sheets.append(Paper(figure, axes, np.full(2, scale), 1.0, {}))
    return sheets


def draw_strip(paper: Paper, strip: "Strip") -> None:
    """Draw an area with its main and its auxiliary curve."""
    paper.fill(np.array([strip.area], dtype=object), FILL, OUTLINE, "area")
    for curve, colour, name in (
        (strip.main, MAIN, "main curve"),
        (strip.auxiliary, AUXILIARY, "auxiliary curve"),
    ):
        paper.stroke([shapely.get_coordinates(curve)], colour, SIDE, name)


def draw_radii(paper: Paper, curve: "Curve") -> None:
    """Draw the minimal radii of a curve."""
    radii = np.stack([curve.on_main, curve.on_auxiliary], axis=1)
    paper.stroke(list(radii), RADIUS, THIN, "minimal radii")


def draw_line(
    paper: Paper,
    line: "Geometry",
    colour: str = LINE,
    name: str = "curve of minimal radii",
    width: float = BOLD,
) -> None:
    """Draw a line, or each of several, ``width`` millimetres thick."""
    parts = [shapely.get_coordinates(part) for part in shapely.get_parts(line)]
    paper.stroke(parts, colour, width, name)


def draw_points(paper: Paper, points: Any, colour: str, name: str) -> None:
    """Draw dots at points (n, 2)."""
    paper.dot(np.asarray(points, dtype=np.float64).reshape(-1, 2), colour, DOT, name)


def finish(sheets: list[Paper]) -> None:
    """Add one legend of all that is drawn below the panels, as many rows as it takes."""
    legend = {name: handle for paper in sheets for name, handle in paper.legend.items()}
    figure = sheets[0].figure
    width, height = figure.get_size_inches() * INCH
    columns = max(int((width - 2.0 * GAP) / ENTRY), 1)
    rows = -(-len(legend) // columns)
    more = (rows - 1) * ROW  # the panels move up by what the rows take
    for axes in figure.axes:
        box = axes.get_position()
        axes.set_position(
            (
                box.x0,
                (box.y0 * height + more) / (height + more),
                box.width,
                box.height * height / (height + more),
            )
        )
    figure.set_size_inches(width / INCH, (height + more) / INCH)
    figure.legend(
        handles=list(legend.values()),
        loc="lower left",
        bbox_to_anchor=(GAP / width, 1.0 / (height + more)),
        ncols=columns,
        frameon=False,
        fontsize=FONT,
        labelcolor=TEXT,
        handlelength=1.6,
        borderpad=0.0,
        columnspacing=1.6,
    )
