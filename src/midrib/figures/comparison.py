"""Comparisons drawn: a panel for each method, and one with all lines."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely

from midrib.checks import check_library
from midrib.figures.curves import maker_of
from midrib.figures.draw import AUXILIARY, FILL, LINE, MAIN, OUTLINE, RADIUS, check_figure
from midrib.figures.paper import FONT, INCH, POINT, TEXT, path_of, save
from midrib.geodesy import degree_lengths
from midrib.ragged import normalised, pack_areas
from midrib.strip import PLANE, divide

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    from midrib.comparison import Compared, Comparison
    from midrib.figures.curves import Sketch

__all__ = ["COLOURS", "draw_comparison"]

THIN, THICK, DASH = 0.15, 0.55, 2.4  # millimetres: lines where all are drawn, and their dashes
COLOURS = ("#111111", "#d1495b", "#2e86ab", "#1e9e58", "#e08a00", "#8e44ad", "#00a3b4", "#7a5c3e")
TITLE, GAP, FOOTER = 7.0, 4.0, 6.0  # millimetres
FLAT = 2.2  # width over height from which on panels stand below each other


def draw_comparison(
    comparison: "Comparison", path: str | Path | None = None, *, width: float = 240.0
) -> "Figure":
    """Draw the line of each method in a panel of its own, and all of them in the last.

    Parameters
    ----------
    comparison : Comparison
        As ``midrib.compare`` returns it.
    path : str or Path, optional
        File to write, .svg, .png or .pdf.
    width : float, default 240
        Of the sheet in millimetres.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    MissingDependencyError
        If matplotlib is not installed.
    ParameterError
        If the file has another ending.
    """
    if path is not None:
        check_figure(Path(path))
    check_library("matplotlib", "a figure", "figures")
    from matplotlib.figure import Figure

    rows = comparison.rows
    low, high = np.split(np.array(comparison.area.bounds), 2)
    unit = np.array(degree_lengths(comparison.area.bounds) if comparison.geographic else PLANE)
    extent = (high - low) * unit
    count = len(rows) + 1
    n_columns = columns_for(count, extent[0] / extent[1])
    n_rows = -(-count // n_columns)
    panel = (width - (n_columns + 1) * GAP) / n_columns
    tall = panel * extent[1] / extent[0]
    height = n_rows * (tall + TITLE) + GAP + FOOTER
    figure = Figure(figsize=(width / INCH, height / INCH), facecolor="white")
    for k in range(count):
        left = GAP + k % n_columns * (panel + GAP)
        below = height - (k // n_columns + 1) * (tall + TITLE)
        axes = figure.add_axes(
            (left / width, below / height, panel / width, tall / height), aspect=unit[1] / unit[0]
        )
        axes.set_axis_off()
        margin = 0.01 * (high - low)
        axes.set_xlim(low[0] - margin[0], high[0] + margin[0])
        axes.set_ylim(low[1] - margin[1], high[1] + margin[1])
        fill(axes, comparison)
        if k < len(rows):
            draw_row(axes, comparison, rows[k])
        else:
            draw_all(axes, rows)
    figure.legend(
        handles=keys_of(rows),
        loc="lower left",
        bbox_to_anchor=(GAP / width, 1.0 / height),
        ncols=len(rows),
        frameon=False,
        fontsize=FONT,
        labelcolor=TEXT,
        handlelength=1.4,
        borderpad=0.0,
    )
    if path is not None:
        save(figure, Path(path))
    return figure


def columns_for(count: int, elongation: float) -> int:
    """How many panels stand side by side: few of flat areas, many of tall ones."""
    if elongation > FLAT:
        return 1 if elongation > 2.0 * FLAT else 2
    return min(count, 3 if elongation > 1.0 / FLAT else 4)


def fill(axes: "Axes", comparison: "Comparison") -> None:
    """Fill the area."""
    from matplotlib.patches import PathPatch

    outline = path_of(comparison.area)
    axes.add_patch(PathPatch(outline, facecolor=FILL, edgecolor=OUTLINE, lw=0.1 / POINT))


def draw_row(axes: "Axes", comparison: "Comparison", row: "Compared") -> None:
    """Draw the line of one method with what it is made of."""
    title(axes, row.method, row.reason)
    if row.line is None:
        return
    sketch = sketch_of(comparison, row.method)
    stroke(axes, [*sketch.radii, *sketch.branches], RADIUS, 0.12)
    stroke(axes, [sketch.main], MAIN, 0.25)
    stroke(axes, [sketch.auxiliary], AUXILIARY, 0.25)
    stroke(axes, [shapely.get_coordinates(row.line)], LINE, 0.5)


def draw_all(axes: "Axes", rows: "list[Compared]") -> None:
    """Draw all lines: thin ones, with dashes that take turns.

    Where lines lie on each other the dashes of each are in the gaps of the others.
    """
    title(axes, "all", "")
    keys = keys_of(rows)
    lines = [row.line for row in rows if row.line is not None]
    for k, (line, key) in enumerate(zip(lines, keys, strict=True)):
        points = shapely.get_coordinates(line)
        for width, dashes in ((THIN, False), (THICK, True)):
            on, gap = DASH / width, (len(keys) - 1) * DASH / width  # in line widths
            axes.plot(
                *points.T,
                color=key.get_color(),
                lw=width / POINT,
                ls=(-k * on, (on, gap)) if dashes and gap else "-",
                dash_capstyle="butt",
                zorder=2.0 + dashes,
                scalex=False,
                scaley=False,
            )


def keys_of(rows: "list[Compared]") -> "list[Line2D]":
    """Lines of the legend."""
    from matplotlib.lines import Line2D

    return [
        Line2D([], [], color=colour, lw=THICK / POINT, label=row.method)
        for row, colour in zip(rows, colours_of(rows), strict=True)
        if row.line is not None
    ]


def colours_of(rows: "list[Compared]") -> list[str]:
    """Colour of each method's line where all are drawn."""
    return [COLOURS[k % len(COLOURS)] for k in range(len(rows))]


def title(axes: "Axes", name: str, reason: str) -> None:
    """Name a panel, with the reason why nothing is in it."""
    text = f"{name}: {reason}" if reason else name
    axes.set_title(text, fontsize=FONT + 1.0, color=TEXT, loc="left", pad=2.0, wrap=True)


def stroke(axes: "Axes", chains: list[Any], colour: str, width: float) -> None:
    """Draw chains of points, ``width`` millimetres thick."""
    from matplotlib.collections import LineCollection

    if chains:
        lines = LineCollection(chains, colors=colour, linewidths=width / POINT, capstyle="round")
        axes.add_collection(lines, autolim=False)


def sketch_of(comparison: "Comparison", method: str) -> "Sketch":
    """Sketch of what the line of a method is made of."""
    scale = degree_lengths(np.array(comparison.area.bounds)) if comparison.geographic else PLANE
    packed = pack_areas(np.array([comparison.area], dtype=object)).rings(0)
    layout = divide(*normalised(*packed), scale, along=comparison.along)
    return maker_of(method, {})(*packed, layout)[0]
