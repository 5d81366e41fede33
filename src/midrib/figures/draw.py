"""The picture of a collapse, in the colours of the paper: sides, radii and the curve.

Everything is judged by its size on paper: where an area is too thin to show its two sides apart,
only its line is drawn, and radii are thinned out where they would run together.
"""

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely
from shapely import LineString, MultiPolygon, Polygon

from midrib.checks import check_library
from midrib.curves.collapse import check_connect
from midrib.curves.taking import as_array
from midrib.errors import ParameterError
from midrib.figures.curves import Sketch, curves_of
from midrib.figures.paper import Paper, sheet_for

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from midrib.formats.reading import Geometries
    from midrib.types import Floats

__all__ = ["check_figure", "draw_collapse"]

ENDINGS = (".svg", ".png", ".pdf")
FILL, OUTLINE, REFUSED = "#eef1ea", "#b9c0b0", "#f6dfc9"
MAIN, AUXILIARY, RADIUS, LINE = "#d62728", "#1f5fbf", "#8e44ad", "#000000"
JOINT = "#1e9e58"
# Sizes on paper in millimetres.
TWO_SIDES = 0.7  # narrowest area whose sides are told apart
RADII = 1.5  # shortest radii worth drawing
APART = 0.45  # between neighbouring radii
LINE_WIDTH = (0.08, 0.4)  # a seventh of the area's width, between these
DOT = 2.5  # a joint's diameter, in widths of the widest line


@dataclass
class Strokes:
    """Chains of coordinates to draw, by what they are."""

    main: "list[Floats]" = field(default_factory=list)
    auxiliary: "list[Floats]" = field(default_factory=list)
    radii: "list[Floats]" = field(default_factory=list)
    branches: "list[Floats]" = field(default_factory=list)
    line: "list[Floats]" = field(default_factory=list)
    widths: list[float] = field(default_factory=list)  # of the areas the lines are in, on paper


def draw_collapse(
    areas: Any,
    path: str | Path | None = None,
    *,
    along: Any = None,
    geographic: bool = False,
    unit: str | None = None,
    width: float = 240.0,
    **options: Any,
) -> "Figure":
    """Draw areas with their main and auxiliary curves, radii and lines.

    Of methods that have branches, all of them are drawn. Where lines are connected, joints are
    dots.

    Parameters
    ----------
    areas : Polygon, MultiPolygon or array_like of them
        Missing and empty ones are passed over, and so is what is no area or has a coordinate that
        is not finite; those that are refused for other reasons have a colour of their own.
    path : str or Path, optional
        File to write, .svg, .png or .pdf.
    along : LineString or array_like of them, optional
        Directional polylines, one for each area or None, as in ``midrib.collapse``.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude; the scale bar is in metres then.
    unit : str, optional
        Name of the coordinate unit, for the scale bar.
    width : float, default 240
        Width of the sheet in millimetres, or its height where the areas extend further in y.
    **options
        Those of ``midrib.collapse``, ``method`` and ``connect`` among them.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    MissingDependencyError
        If matplotlib is not installed.
    ParameterError
        If the file has another ending, or options exclude each other.
    """
    if path is not None:
        check_figure(Path(path))
    check_connect(options.get("connect", False), along, options.get("ends", "caps"))
    areas = drawable(as_array(areas).ravel())
    guides = None if along is None else as_array(along).ravel()
    paper = sheet_for(areas, geographic, width)
    strokes, drawn = Strokes(), np.zeros(areas.size, dtype=np.bool_)
    curves, joints = curves_of(areas, guides, geographic, options)
    for index, sketch, line in curves:
        drawn[index] = True
        add_strokes(strokes, sketch, line, paper)
    paper.fill(areas[drawn], FILL, OUTLINE, "area")
    paper.fill(areas[~drawn], REFUSED, OUTLINE, "refused")
    paper.stroke(strokes.radii, RADIUS, 0.12, "radii")
    paper.stroke(strokes.branches, RADIUS, 0.12, "branches")
    paper.stroke(strokes.main, MAIN, 0.25, "main curve")
    paper.stroke(strokes.auxiliary, AUXILIARY, 0.25, "auxiliary curve")
    bold = np.clip(0.15 * np.array(strokes.widths), *LINE_WIDTH)
    paper.stroke(strokes.line, LINE, bold, "line")
    dots = np.array([joint.point.coords[0] for joint in joints]).reshape(-1, 2)
    paper.dot(dots, JOINT, DOT * bold.max(initial=LINE_WIDTH[0]), "joint")
    paper.finish(unit)
    if path is not None:
        paper.save(Path(path))
    return paper.figure


def drawable(features: "Geometries") -> "Geometries":
    """Areas at known places; None for anything else."""
    areas = features.copy()
    for i, area in enumerate(features):
        is_area = isinstance(area, Polygon | MultiPolygon)
        if not is_area or not np.isfinite(shapely.get_coordinates(area)).all():
            areas[i] = None
    return areas


def add_strokes(strokes: Strokes, sketch: Sketch, line: LineString, paper: Paper) -> None:
    """Add what of a sketch and its line can be told apart on paper."""
    strokes.line.append(shapely.get_coordinates(line))
    across_middle = float(np.median(paper.millimetres(sketch.across)))
    strokes.widths.append(across_middle)
    if across_middle < TWO_SIDES:
        return
    strokes.main.append(sketch.main)
    strokes.auxiliary.append(sketch.auxiliary)
    strokes.branches.extend(sketch.branches)
    if across_middle >= RADII and len(sketch.radii):
        apart = paper.millimetres(np.diff(sketch.middles, axis=0))
        strokes.radii.extend(sketch.radii[spread(apart)])


def spread(steps: "Floats") -> "Floats":
    """Which of a row of radii to draw, so that they do not run together: mask, one longer."""
    along = np.concatenate([[0.0], np.cumsum(steps)])
    cell = np.floor(along / APART)
    return np.concatenate([[True], cell[1:] > cell[:-1]])


def check_figure(path: Path) -> None:
    """Refuse a figure that cannot be drawn.

    Raises
    ------
    ParameterError
        If the ending is not that of a kind of picture.
    MissingDependencyError
        If matplotlib is not installed.
    """
    if path.suffix.lower() not in ENDINGS:
        msg = f"--figure {str(path)!r} ends in {path.suffix!r}, expected {', '.join(ENDINGS)}"
        raise ParameterError(msg)
    check_library("matplotlib", "a figure", "figures")
