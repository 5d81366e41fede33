"""The picture of a check: slopes with their tops and toes, and dots where something is wrong."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import shapely

from midrib.figures.draw import AUXILIARY, FILL, MAIN, OUTLINE
from midrib.figures.paper import sheet_for
from midrib.hatching.finding import CHECKS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.figure import Figure

    from midrib.hatching.finding import Finding
    from midrib.hatching.slope import Slope

__all__ = ["draw_checks"]

# Of CHECKS in turn.
COLOURS = (
    *("#555555", "#8e44ad", "#e08a00", "#1e9e58"),
    *("#8a6d3b", "#d6428c", "#111111", "#f0b400", "#00a3b4", "#a4c400"),
)
EDGE, DOT = 0.2, 1.8  # millimetres


def draw_checks(
    slopes: "Sequence[Slope]",
    findings: "Sequence[Finding]",
    path: str | Path | None = None,
    *,
    unit: str | None = None,
    width: float = 240.0,
) -> "Figure":
    """Draw slopes, the top of each red and its toe blue, with a dot for each finding.

    Parameters
    ----------
    slopes : sequence of Slope
    findings : sequence of Finding
        Those without a place are not drawn.
    path : str or Path, optional
        File to write, .svg, .png or .pdf.
    unit : str, optional
        Name of the coordinate unit, for the scale bar.
    width : float, default 240
        Longer side of the sheet in millimetres.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    MissingDependencyError
        If matplotlib is not installed.
    """
    areas = np.array([*(slope.area for slope in slopes), None], dtype=object)
    places = np.array([*(f.where for f in findings if f.where is not None), None], dtype=object)
    paper = sheet_for(np.concatenate([areas, places]), False, width)
    paper.fill(areas, FILL, OUTLINE, "slope")
    for name, colour in (("toe", AUXILIARY), ("top", MAIN)):
        edges = [shapely.get_coordinates(getattr(slope, name)) for slope in slopes]
        paper.stroke(edges, colour, EDGE, name)
    for check, colour in zip(CHECKS, COLOURS, strict=True):
        there = [f.where.coords[0][:2] for f in findings if f.check == check and f.where]
        paper.dot(np.array(there).reshape(-1, 2), colour, DOT, check)
    paper.finish(unit)
    if path is not None:
        paper.save(Path(path))
    return paper.figure
