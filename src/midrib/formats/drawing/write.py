"""Drawings to files: the ending chooses the format; files appear whole or not at all."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from midrib.checks import check_library
from midrib.errors import ParameterError
from midrib.formats.contents import column_names
from midrib.formats.drawing.cad import write_dxf
from midrib.formats.drawing.cartographic import write_cartographic
from midrib.formats.drawing.content import AREAS, EDGES, LINES, PROBLEMS, Drawing, layers_of
from midrib.formats.drawing.qgis import add_styles
from midrib.formats.drawing.sheet import PAPERS, write_sheet
from midrib.formats.endings import format_of
from midrib.formats.writing import check_free, staged, write_layer

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["check_places", "places_of", "write_drawing"]

SHEETS = (".svg", ".pdf")
CAD, CARTOGRAPHIC, STYLED = ".dxf", ".gml", ".gpkg"
KEY = "area"  # a column of every layer of ours


def places_of(path: Path) -> list[Path]:
    """Files that a drawing may be written to, OUT first.

    Raises
    ------
    ParameterError
        If no format has the ending.
    """
    ending = path.suffix.lower()
    if ending in (*SHEETS, CAD, CARTOGRAPHIC):
        return [path]
    if format_of(path, more=(CAD, *SHEETS, CARTOGRAPHIC)).has_layers:
        return [path]
    return [path, *(beside(path, layer) for layer in (AREAS, EDGES, PROBLEMS))]


def beside(path: Path, layer: str) -> Path:
    """File of a layer of a format without layers."""
    return path if layer == LINES else path.with_name(f"{path.stem}_{layer}{path.suffix}")


def check_places(
    path: Path, sources: "Sequence[Path]" = (), *, overwrite: bool = False, paper: str | None = None
) -> None:
    """Refuse places that cannot be written to, before any work is done.

    Raises
    ------
    ParameterError
        If OUT has an unknown ending, is IN, or exists and is not to be overwritten; if a file
        beside it is in the way that is not of an earlier run; if there is no such paper.
    MissingDependencyError
        If a library is needed that is not installed.
    """
    places = places_of(path)
    for place in places:
        if any(source.exists() and place.exists() and source.samefile(place) for source in sources):
            msg = f"OUT {str(place)!r} is IN, expected another file"
            raise ParameterError(msg)
    check_free(places, "OUT", overwrite=overwrite)
    for place in places[1:]:
        if place.exists() and KEY not in column_names(place):
            msg = (
                f"{str(place)!r}, the place for a layer of the drawing, has no column {KEY!r} and "
                "so is no output of an earlier run, expected it elsewhere"
            )
            raise ParameterError(msg)
    if path.suffix.lower() in SHEETS:
        check_library("matplotlib", "a sheet", "figures")
    elif path.suffix.lower() == CAD:
        check_library("ezdxf", "writing DXF", "dxf")
    if paper is not None and (paper not in PAPERS or path.suffix.lower() not in SHEETS):
        msg = f"paper is {paper!r}, expected {', '.join(PAPERS)}, with OUT {' or '.join(SHEETS)}"
        raise ParameterError(msg)


def write_drawing(
    path: str | Path, drawing: Drawing, *, paper: str | None = None, marks: bool = True
) -> list[str]:
    """Write a drawing: GPKG with a style for QGIS, DXF, SVG, PDF, GML, or any other vector file.

    Parameters
    ----------
    path : str or Path
        The ending chooses the format. What is there is replaced. Formats without layers get files
        beside, ``…_symbols``, ``…_outlines``, ``…_problems``.
    drawing : Drawing
    paper : {"A4", "A3", "A2", "A1", "A0"}, optional
        Size of a sheet; as large as it needs to be unless given.
    marks : bool, default True
        Mark problems on sheets and in DXF. Formats of layers have a layer of them in any case.

    Returns
    -------
    list of str
        What the format could not keep; how many pages a sheet takes, if several; that no sheet is
        written, for want of anything to draw.

    Raises
    ------
    ParameterError
        If the drawing does not fit the format or the paper.
    MissingDependencyError
        If a library is needed that is not installed.
    """
    path = Path(path)
    places, ending = places_of(path), path.suffix.lower()
    shown = drawing if marks else replace(drawing, problems=[])
    is_blank_sheet = ending in SHEETS and shown.is_blank
    with staged(path.parent, stale=places if is_blank_sheet else places[1:]) as stage:
        if is_blank_sheet:
            return ["there is nothing to draw, no sheet is written"]
        new = stage / path.name
        if ending not in (*SHEETS, CAD, CARTOGRAPHIC):
            return write_layers(new, drawing)
        if ending in SHEETS:
            return write_sheet(new, shown, paper)
        (write_dxf if ending == CAD else write_cartographic)(new, shown)
    return []


def write_layers(path: Path, drawing: Drawing) -> list[str]:
    """Write the layers of a drawing, into one file if its format has layers."""
    notes: list[str] = []
    if 0 < drawing.n_raised < len(drawing.objects):
        unknown = len(drawing.objects) - drawing.n_raised
        notes.append(f"heights of {unknown:,} of {len(drawing.objects):,} objects are unknown: 0")
    layers = layers_of(drawing)
    for features in layers:
        place = path if format_of(path).has_layers else beside(path, features.layer)
        notes += write_layer(place, features)
    if path.suffix.lower() == STYLED:
        add_styles(path, drawing, [features.layer for features in layers])
    return list(dict.fromkeys(notes))
