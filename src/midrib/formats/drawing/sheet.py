"""Sheets: SVG and PDF in true millimetres, at the scale of the map."""

from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import shapely

from midrib.errors import MissingDependencyError, ParameterError

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from midrib.formats.drawing.content import Drawing
    from midrib.types import Floats

__all__ = ["PAPERS", "check_sheet", "write_sheet"]

INCH, POINT = 25.4, 25.4 / 72.0  # millimetres
MARGIN, FOOTER = 10.0, 10.0
ABOVE = np.array([0.0, FOOTER])
SMALLEST = np.array([90.0, 50.0])  # a sheet that is as large as its map needs is no smaller
LARGEST = 5080.0  # PDF goes to 14,400 points
PAPERS = {"A4": 210.0, "A3": 297.0, "A2": 420.0, "A1": 594.0, "A0": 841.0}  # shorter side, ISO 216
HEIGHTS = {"A4": 297.0, "A3": 420.0, "A2": 594.0, "A1": 841.0, "A0": 1189.0}
TEXT, FONT, FINE = "#333333", 2.6, 0.25  # colour, height in millimetres; width of the scale bar
PROBLEM, DOT = "#d73027", 2.0
BAR = 0.25  # of the sheet's width, at the most


class Sheet(NamedTuple):
    """A sheet and its map: millimetres from the lower left corner."""

    figure: "Figure"
    axes: "Axes"
    size: "Floats"  # (2,) width and height
    low: "Floats"  # (2,) map coordinates at the lower left corner
    millimetre: float  # in map units

    def place(self, geometry: Any) -> "Floats":
        """Points of a geometry on the sheet, in millimetres."""
        points: Floats = (shapely.get_coordinates(geometry) - self.low) / self.millimetre
        return points


def check_sheet() -> None:
    """Refuse to draw a sheet without the library for it.

    Raises
    ------
    MissingDependencyError
        If matplotlib is not installed.
    """
    if find_spec("matplotlib") is None:
        msg = "a sheet needs matplotlib: pip install midrib[figures]"
        raise MissingDependencyError(msg)


def write_sheet(path: "Path", drawing: "Drawing", paper: str | None = None) -> None:
    """Write a drawing as a sheet, as large as it needs to be or on paper of ISO 216.

    Raises
    ------
    ParameterError
        If the drawing does not fit, or there is no such paper.
    """
    check_sheet()
    from matplotlib import rc_context

    bounds = drawing.bounds
    size = size_of(drawing, bounds, paper)
    with rc_context({"lines.scale_dashes": False, "svg.hashsalt": "midrib", "pdf.fonttype": 42}):
        sheet = blank(drawing, bounds, size)
        for drawn in drawing.objects:
            draw_object(sheet, drawn.symbols)
        draw_problems(sheet, drawing)
        draw_footer(sheet, drawing)
        stamp = "Date" if path.suffix.lower() == ".svg" else "CreationDate"
        sheet.figure.savefig(path, format=path.suffix.lower()[1:], metadata={stamp: None})


def size_of(drawing: "Drawing", bounds: "Floats", paper: str | None) -> "Floats":
    """Width and height of the sheet in millimetres.

    Raises
    ------
    ParameterError
        If the drawing does not fit, or there is no such paper.
    """
    needed = np.ptp(bounds, axis=0) / drawing.millimetre + 2.0 * MARGIN + ABOVE
    text = f"{needed[0]:,.0f} by {needed[1]:,.0f} mm"
    if paper is None:
        if (needed > LARGEST).any():
            msg = f"a sheet at 1:{drawing.scale:g} takes {text}, expected {LARGEST:,.0f} at most"
            raise ParameterError(msg)
        enough: Floats = np.maximum(needed, SMALLEST)
        return enough
    if paper not in PAPERS:
        msg = f"paper is {paper!r}, expected {', '.join(PAPERS)}"
        raise ParameterError(msg)
    upright = np.array([PAPERS[paper], HEIGHTS[paper]])
    for size in (upright, upright[::-1]):
        if (needed <= size).all():
            return size
    msg = f"paper is {paper}, but a sheet at 1:{drawing.scale:g} takes {text}"
    raise ParameterError(msg)


def blank(drawing: "Drawing", bounds: "Floats", size: "Floats") -> Sheet:
    """Sheet with nothing on it, the map in its middle above the footer."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=tuple(size / INCH), facecolor="white")
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.set_xlim(0.0, size[0])
    axes.set_ylim(0.0, size[1])
    low = bounds.mean(axis=0) - 0.5 * (size + ABOVE) * drawing.millimetre
    return Sheet(figure, axes, size, low, drawing.millimetre)


def draw_object(sheet: Sheet, symbols: Any) -> None:
    """Draw the symbols of an object."""
    from matplotlib.collections import LineCollection, PolyCollection

    flat, known = symbols.flat(), symbols.standard
    dashes = tuple(length / POINT for length in known.outline_dash)
    for lines, width, style in (
        (flat.edges, known.outline_width, (0.0, dashes or None)),
        (flat.lines, known.stroke_width, "solid"),
    ):
        chains = [sheet.place(line) for line in lines]
        sheet.axes.add_collection(
            LineCollection(
                chains,
                colors=known.colour,
                linewidths=width / POINT,
                linestyles=[style],
                capstyle="butt",
                joinstyle="miter",
            )
        )
    areas = [sheet.place(area) for area in flat.areas]
    sheet.axes.add_collection(PolyCollection(areas, facecolors=known.colour, edgecolors="none"))


def draw_problems(sheet: Sheet, drawing: "Drawing") -> None:
    """Draw a dot where something is not drawn."""
    places = [trouble.where for trouble in drawing.problems if trouble.where is not None]
    x, y = sheet.place(places).T if places else np.empty((2, 0))
    size = DOT / POINT
    sheet.axes.plot(x, y, ls="none", marker="o", ms=size, mfc="none", mec=PROBLEM, mew=0.5)


def draw_footer(sheet: Sheet, drawing: "Drawing") -> None:
    """Draw what the sheet is: scale, standards, a bar."""
    style: dict[str, Any] = {"fontsize": FONT / POINT, "color": TEXT, "va": "center"}
    middle = 0.5 * (MARGIN + FOOTER)
    length = round_length(BAR * sheet.size[0] * sheet.millimetre * drawing.metres_per_unit)
    right = sheet.size[0] - MARGIN
    left = right - length / drawing.metres_per_unit / sheet.millimetre
    x, tick = np.array([left, left, right, right]), 1.0
    y = middle + np.array([tick, 0.0, 0.0, tick])
    sheet.axes.plot(x, y, color=TEXT, lw=FINE / POINT, solid_joinstyle="miter")
    label = f"{length / 1000.0:g} km" if length >= 1000.0 else f"{length:g} m"
    sheet.axes.text(0.5 * (left + right), middle - 2.0, label, ha="center", **style)
    names = ", ".join(drawing.standards)
    text = sheet.axes.text(MARGIN, middle, f"1:{drawing.scale:,g}   {names}", ha="left", **style)
    room = (left - 2.0 * MARGIN) / POINT
    shrink(sheet, text, room)


def shrink(sheet: Sheet, text: Any, room: float) -> None:
    """Make a text smaller if it is wider than its room, in points."""
    width = text.get_window_extent().width * 72.0 / sheet.figure.dpi
    if width > room:
        text.set_fontsize(text.get_fontsize() * room / width)


def round_length(length: float) -> float:
    """Return the largest of 1, 2, 5, 10 … that is not longer."""
    power = 10.0 ** np.floor(np.log10(length))
    return float(power * max(step for step in (1.0, 2.0, 5.0) if step * power <= length))
