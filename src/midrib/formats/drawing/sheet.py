"""Sheets: SVG and PDF in true millimetres, at the scale of the map.

A map that is larger than its paper takes several pages of a PDF.

+-------------------+   margin around
|  map, clipped     |
+-------------------+
|  footer           |   scale, standards, number of the page, scale bar
+-------------------+
"""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import shapely

from midrib.checks import check_library
from midrib.errors import ParameterError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from midrib.formats.drawing.content import Drawing
    from midrib.types import Floats

__all__ = ["PAPERS", "write_sheet"]

INCH, POINT = 25.4, 25.4 / 72.0  # millimetres
MARGIN, FOOTER = 5.0, 10.0
AROUND = np.array([2.0 * MARGIN, 2.0 * MARGIN + FOOTER])  # what a page has beside the map
SMALLEST = np.array([90.0, 50.0])  # a page that is as large as its map needs is no smaller
LARGEST = 5080.0  # PDF goes to 14,400 points
PAPERS = {"A4": (210, 297), "A3": (297, 420), "A2": (420, 594), "A1": (594, 841), "A0": (841, 1189)}
TEXT, FONT, FINE = "#333333", 2.6, 0.25  # colour, height in millimetres; width of the scale bar
PROBLEM, DOT = "#d73027", 2.0
NEARLY = 1e-9  # of a page, that rounding may add
BAR = 60.0  # millimetres, at the most, and a third of the page's width
STYLE: dict[Any, Any] = {
    "path.simplify": False,
    "lines.scale_dashes": False,
    "svg.hashsalt": "midrib",
    "pdf.fonttype": 42,
}


class Page(NamedTuple):
    """A page and the part of the map on it."""

    size: "Floats"  # (2,) width and height, millimetres
    low: "Floats"  # (2,) map coordinates at the lower left corner of its map
    high: "Floats"
    name: str
    is_alone: bool


def write_sheet(path: "Path", drawing: "Drawing", paper: str | None = None) -> list[str]:
    """Write a drawing as a sheet as large as it needs to be, or on pages of paper of ISO 216.

    Returns
    -------
    list of str
        How many pages there are, if there are several.

    Raises
    ------
    ParameterError
        If the drawing does not fit, or there is no such paper.
    """
    check_library("matplotlib", "a sheet", "figures")
    from matplotlib import rc_context
    from matplotlib.backends.backend_pdf import PdfPages

    pages = pages_of(drawing, paper)
    with rc_context(STYLE):
        if path.suffix.lower() != ".pdf":
            if len(pages) > 1:
                msg = f"the drawing takes {len(pages)} pages of {paper}, expected OUT .pdf for them"
                raise ParameterError(msg)
            figure_of(drawing, pages[0]).savefig(path, format="svg", metadata={"Date": None})
            return []
        with PdfPages(path, metadata={"CreationDate": None}) as file:
            for page in pages:
                file.savefig(figure_of(drawing, page))
    return [f"{len(pages)} pages of {paper}"] if len(pages) > 1 else []


def pages_of(drawing: "Drawing", paper: str | None) -> list[Page]:
    """Divide the map into pages, from the upper left corner on; those with nothing are left out.

    Raises
    ------
    ParameterError
        If the drawing does not fit, or there is no such paper.
    """
    bounds = drawing.bounds
    map_size = np.ptp(bounds, axis=0) / drawing.millimetre
    if paper is None:
        size = np.maximum(map_size + AROUND, SMALLEST)
        if (size > LARGEST).any():
            text = f"{size[0]:,.0f} by {size[1]:,.0f} mm"
            msg = f"a sheet at 1:{drawing.scale:g} takes {text}, expected pages of a paper: A0"
            raise ParameterError(msg)
        counts = np.ones(2, dtype=np.intp)
    elif paper in PAPERS:
        upright = np.array(PAPERS[paper], dtype=np.float64)
        both = [
            (upright, needed(map_size, upright)),
            (upright[::-1], needed(map_size, upright[::-1])),
        ]
        size, counts = min(both, key=lambda way: way[1].prod())
    else:
        msg = f"paper is {paper!r}, expected {', '.join(PAPERS)}"
        raise ParameterError(msg)
    room = (size - AROUND) * drawing.millimetre
    corner = bounds.mean(axis=0) + 0.5 * counts * room * [-1.0, 1.0]  # upper left
    pages, is_alone = [], bool(counts.prod() == 1)
    for row in range(counts[1]):
        for column in range(counts[0]):
            low = corner + room * [column, -row - 1]
            pages.append(
                Page(size, low, low + room, f"row {row + 1}, column {column + 1}", is_alone)
            )
    return [page for page in pages if is_alone or has_something(drawing, page)]


def needed(map_size: "Floats", paper: "Floats") -> Any:
    """Count the pages beside and below each other."""
    return np.maximum(np.ceil(map_size / (paper - AROUND) - NEARLY), 1.0).astype(np.intp)


def has_something(drawing: "Drawing", page: Page) -> bool:
    """Whether there is anything on a page."""
    box = shapely.box(*page.low, *page.high)
    places = [trouble.where for trouble in drawing.problems]
    return bool(shapely.intersects(box, places).any()) or any(drawn_on(drawing, page))


def drawn_on(drawing: "Drawing", page: Page) -> "Iterator[Any]":
    """Symbols of the objects that reach onto a page."""
    box = shapely.box(*page.low, *page.high)
    shapely.prepare(box)
    for drawn in drawing.objects:
        flat = drawn.symbols.flat()
        if any(shapely.intersects(box, ink).any() for ink in (flat.edges, flat.lines, flat.areas)):
            yield flat


def figure_of(drawing: "Drawing", page: Page) -> "Figure":
    """Draw a page."""
    from matplotlib.figure import Figure

    width, height = page.size
    figure = Figure(figsize=(width / INCH, height / INCH), facecolor="white")
    low = MARGIN + FOOTER
    sides = (
        MARGIN / width,
        low / height,
        1.0 - 2.0 * MARGIN / width,
        1.0 - (MARGIN + low) / height,
    )
    axes = figure.add_axes(sides)
    axes.set_axis_off()
    room = (page.high - page.low) / drawing.millimetre
    axes.set_xlim(0.0, room[0])
    axes.set_ylim(0.0, room[1])
    for symbols in drawn_on(drawing, page):
        draw_object(axes, symbols, page, drawing.millimetre)
    draw_problems(axes, drawing, page)
    footer = figure.add_axes((0.0, 0.0, 1.0, low / height))
    footer.set_axis_off()
    footer.set_xlim(0.0, width)
    footer.set_ylim(0.0, low)
    draw_footer(footer, drawing, page)
    return figure


def draw_object(axes: "Axes", symbols: Any, page: Page, millimetre: float) -> None:
    """Draw the symbols of an object; on the only page nothing is clipped, half a line neither."""
    from matplotlib.collections import LineCollection, PolyCollection

    def placed(geometries: Any) -> "list[Floats]":
        return [(shapely.get_coordinates(g) - page.low) / millimetre for g in geometries]

    known = symbols.standard
    dashes = tuple(length / POINT for length in known.outline_dash)
    clips = not page.is_alone
    for lines, width, style in (
        (symbols.edges, known.outline_width, (0.0, dashes or None)),
        (symbols.lines, known.stroke_width, "solid"),
    ):
        ends: dict[str, Any] = {"capstyle": "butt", "joinstyle": "miter", "linestyles": [style]}
        ends["clip_on"] = clips
        axes.add_collection(
            LineCollection(placed(lines), colors=known.colour, linewidths=width / POINT, **ends)
        )
    areas = PolyCollection(placed(symbols.areas), fc=known.colour, ec="none", clip_on=clips)
    axes.add_collection(areas)


def draw_problems(axes: "Axes", drawing: "Drawing", page: Page) -> None:
    """Draw a circle where something is not as it should be."""
    places = [trouble.where for trouble in drawing.problems if trouble.where is not None]
    x, y = ((shapely.get_coordinates(places) - page.low) / drawing.millimetre).T
    style: dict[str, Any] = {"ls": "none", "marker": "o", "mfc": "none", "mec": PROBLEM, "mew": 0.5}
    style["clip_on"] = not page.is_alone
    axes.plot(x, y, ms=DOT / POINT, **style)


def draw_footer(axes: "Axes", drawing: "Drawing", page: Page) -> None:
    """Draw what the page is: scale, standards, number, a bar."""
    style: dict[str, Any] = {"fontsize": FONT / POINT, "color": TEXT, "va": "center"}
    middle, right = 0.5 * (MARGIN + FOOTER), page.size[0] - MARGIN
    unit = drawing.millimetre * drawing.metres_per_unit  # metres in a millimetre
    length = round_length(min(BAR, page.size[0] / 3.0) * unit)
    left = right - length / unit
    x, y = np.array([left, left, right, right]), middle + np.array([1.0, 0.0, 0.0, 1.0])
    axes.plot(x, y, color=TEXT, lw=FINE / POINT, solid_joinstyle="miter")
    label = f"{length / 1000.0:g} km" if length >= 1000.0 else f"{length:g} m"
    axes.text(0.5 * (left + right), middle - 2.5, label, ha="center", **style)
    names = ", ".join(drawing.standards)
    number = "" if page.is_alone else f"{page.name}   "
    told = f"1:{drawing.scale:,g}   {number}{names}"
    text = axes.text(MARGIN, middle, told, ha="left", **style)
    room = (left - 2.0 * MARGIN) / POINT
    width = text.get_window_extent().width * 72.0 / axes.figure.dpi
    text.set_fontsize(text.get_fontsize() * min(1.0, room / width))


def round_length(length: float) -> float:
    """Return the largest of 1, 2, 5, 10 … that is not longer."""
    power = 10.0 ** np.floor(np.log10(length))
    return float(power * max(step for step in (1.0, 2.0, 5.0) if step * power <= length))
