"""Comparisons drawn: a panel for each method, and one with all lines."""

from itertools import cycle
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import shapely

from midrib.checks import check_library
from midrib.curves.variants import variant_of
from midrib.figures.curves import maker_of
from midrib.figures.draw import AUXILIARY, FILL, LINE, MAIN, OUTLINE, RADIUS, check_figure
from midrib.figures.paper import FONT, INCH, POINT, TEXT, path_of, save
from midrib.figures.sheet import GAP, Sheet, sheet_of
from midrib.geodesy import degree_lengths
from midrib.ragged import normalised, pack_areas
from midrib.strip import PLANE, divide

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    from midrib.comparison import Compared, Comparison
    from midrib.figures.curves import Sketch
    from midrib.types import Floats

__all__ = ["colours_of", "draw_comparison"]

THIN, THICK, DASH = 0.15, 0.55, 2.4  # millimetres: lines where all are drawn, and their dashes
COLOURS = {  # as in Fig. 9 of the paper
    "minimal-radii": "#111111",
    "medial-axis": "#1e9e58",
    "straight-skeleton": "#b8742a",
    "mean-curve": "#8e44ad",
}
MORE_COLOURS = ("#d1495b", "#2e86ab", "#e6b800", "#00b8c4", "#7a7a7a", "#f07ab0")
EDGE, ENTRY, NORTH = 2.0, 4.2, 4.0  # millimetres: below the legend, its rows, the arrow's size
LETTER, SAMPLE = 1.45, 7.5  # millimetres: an entry of the legend, for a letter and beside them


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
    handles = keys_of(rows)
    n_columns = legend_columns(rows, width)
    footer = 2.0 * EDGE + -(-len(handles) // n_columns) * ENTRY
    frame = frame_of(comparison)
    west, south, east, north = frame.bounds
    extent = np.array([east - west, north - south])
    sheet = sheet_of(len(rows) + 1, extent, width, footer)
    if sheet.is_turned:
        frame = frame_of(comparison, is_turned=True)
    figure = Figure(figsize=(width / INCH, sheet.height / INCH), facecolor="white")
    panels = [figure.add_axes(sheet.place(k)) for k in range(len(rows) + 1)]
    for axes in panels:
        open_panel(axes, frame, sheet)
    for axes, row in zip(panels, rows, strict=False):
        draw_row(axes, comparison, row, frame)
    draw_all(panels[-1], rows, frame)
    if sheet.is_turned:
        draw_north(figure, sheet)
    figure.legend(
        handles=handles,
        loc="lower left",
        bbox_to_anchor=(GAP / width, EDGE / 2.0 / sheet.height),
        ncols=n_columns,
        frameon=False,
        fontsize=FONT,
        labelcolor=TEXT,
        handlelength=1.4,
        borderpad=0.0,
        columnspacing=1.4,
    )
    if path is not None:
        save(figure, Path(path))
    return figure


class Frame(NamedTuple):
    """The area as it lies on the sheet: in lengths, and turned by a quarter if it is tall."""

    unit: "Floats"  # (2,) lengths of one unit of x and of y
    is_turned: bool
    area: Any
    bounds: tuple[float, float, float, float]

    def place(self, points: "Floats") -> "Floats":
        """Place points (n, 2) on the sheet; clockwise if turned, so that north is on the right."""
        return placed(points, self.unit, self.is_turned)


def placed(points: "Floats", unit: "Floats", is_turned: bool) -> "Floats":
    """Points (n, 2) in lengths, turned clockwise by a quarter if asked to."""
    x, y = (points[:, :2] * unit).T
    return np.column_stack([y, -x] if is_turned else [x, y])


def frame_of(comparison: "Comparison", *, is_turned: bool = False) -> Frame:
    """Return how the area of a comparison lies on the sheet."""
    unit = np.array(degree_lengths(comparison.area.bounds) if comparison.geographic else PLANE)
    area = shapely.transform(comparison.area, lambda points: placed(points, unit, is_turned))
    return Frame(unit, is_turned, area, area.bounds)


def open_panel(axes: "Axes", frame: Frame, sheet: Sheet) -> None:
    """Show the area in the middle of a panel, true to scale."""
    from matplotlib.patches import PathPatch

    axes.set_axis_off()
    west, south, east, north = frame.bounds
    half = sheet.panel / sheet.scale / 2.0
    axes.set_xlim((west + east) / 2.0 - half[0], (west + east) / 2.0 + half[0])
    axes.set_ylim((south + north) / 2.0 - half[1], (south + north) / 2.0 + half[1])
    outline = path_of(frame.area)
    axes.add_patch(PathPatch(outline, facecolor=FILL, edgecolor=OUTLINE, lw=0.1 / POINT))


def draw_north(figure: "Figure", sheet: Sheet) -> None:
    """Draw an arrow to the north, which is on the right, above the first row of panels."""
    size = np.array([sheet.width, sheet.height])
    head = np.array([sheet.width - GAP - NORTH, sheet.height - NORTH]) / size
    figure.text(head[0], head[1], " N", fontsize=FONT, color=TEXT, ha="left", va="center")
    axes = figure.axes[0]
    axes.annotate(
        "",
        xy=tuple(head),
        xytext=(float(head[0] - 2.0 * NORTH / sheet.width), float(head[1])),
        xycoords="figure fraction",
        arrowprops={"arrowstyle": "-|>", "color": TEXT, "lw": 0.8, "shrinkA": 0, "shrinkB": 0},
        annotation_clip=False,
    )


def legend_columns(rows: "list[Compared]", width: float) -> int:
    """How many entries of the legend find room beside each other."""
    longest = max(len(row.method) for row in rows)
    return max(int((width - GAP) / (longest * LETTER + SAMPLE)), 1)


def draw_row(axes: "Axes", comparison: "Comparison", row: "Compared", frame: Frame) -> None:
    """Draw the line of one method with what it is made of."""
    title(axes, row.method, row.reason)
    if row.line is None:
        return
    sketch = sketch_of(comparison, row.method)
    for chains, colour, width in (
        ([*sketch.radii, *sketch.branches], RADIUS, 0.12),
        ([sketch.main], MAIN, 0.25),
        ([sketch.auxiliary], AUXILIARY, 0.25),
        ([shapely.get_coordinates(row.line)], LINE, 0.5),
    ):
        stroke(axes, [frame.place(chain) for chain in chains], colour, width)


def draw_all(axes: "Axes", rows: "list[Compared]", frame: Frame) -> None:
    """Draw all lines: thin ones, with dashes that take turns.

    Where lines lie on each other the dashes of each are in the gaps of the others.
    """
    title(axes, "all")
    keys = keys_of(rows)
    lines = [row.line for row in rows if row.line is not None]
    for k, (line, key) in enumerate(zip(lines, keys, strict=True)):
        points = frame.place(shapely.get_coordinates(line))
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
    """Colour of each method's line where all are drawn: its own, or one that no method has."""
    more = cycle(MORE_COLOURS)
    return [COLOURS.get(row.method) or next(more) for row in rows]


def title(axes: "Axes", name: str, reason: str = "") -> None:
    """Name a panel, and say in it why it has no line."""
    axes.set_title(name, fontsize=FONT + 1.0, color=TEXT, loc="left", pad=2.0)
    if reason:
        panel = axes.get_window_extent().width / axes.figure.dpi * INCH
        lines = fill(reason, max(int(panel / LETTER), 1))
        axes.text(
            0.0, 1.0, lines, transform=axes.transAxes, va="top", fontsize=FONT, color=TEXT, zorder=3
        )


def stroke(axes: "Axes", chains: list[Any], colour: str, width: float) -> None:
    """Draw chains of points, ``width`` millimetres thick."""
    from matplotlib.collections import LineCollection

    if chains:
        lines = LineCollection(chains, colors=colour, linewidths=width / POINT, capstyle="round")
        axes.add_collection(lines, autolim=False)


def sketch_of(comparison: "Comparison", name: str) -> "Sketch":
    """Sketch of what the line of a method, or of a variant of it, is made of."""
    scale = degree_lengths(np.array(comparison.area.bounds)) if comparison.geographic else PLANE
    packed = pack_areas(np.array([comparison.area], dtype=object)).rings(0)
    layout = divide(*normalised(*packed), scale, along=comparison.along)
    return maker_of(*variant_of(name))(*packed, layout)[0]
