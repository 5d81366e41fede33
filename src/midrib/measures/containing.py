"""How a line lies in its area: how far outside, how long against another, how crooked."""

from typing import Any

import numpy as np
import shapely
from shapely import MultiPolygon, Polygon

from midrib.errors import InvalidAreaError
from midrib.measures.chains import (
    Geometries,
    areas_of,
    flat_together,
    is_there,
    lines_of,
    shaped,
    unit_lengths,
    vertices,
)
from midrib.measures.widths import length, mean_width

__all__ = ["length_ratio", "outside_length", "turning"]


def outside_length(lines: Any, areas: Any, *, geographic: bool = False) -> Any:
    """Length of the parts of lines that are outside their areas.

    Exactly 0 where the area covers the line; every line of ``midrib.collapse`` has 0.

    Parameters
    ----------
    lines : LineString or MultiLineString, or array_like of them, shape (...)
        Z is ignored.
    areas : Polygon or MultiPolygon, or array_like of them, shape (...)
        Valid areas, broadcast against ``lines``. The boundary belongs to the area.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude, as in ``length``.

    Returns
    -------
    float or ndarray of float64, shape (...)
        In coordinate units, in metres if ``geographic``; NaN where a line or an area is missing or
        empty.

    Raises
    ------
    GeometryTypeError
        If something is not a line, or not an area.
    InvalidAreaError
        If an area is not valid.

    Notes
    -----
    Whether a line is covered is decided by exact predicates. Where it is not, the points where it
    leaves are rounded. A stretch that is travelled twice counts twice.

    Examples
    --------
    >>> outside_length(LineString([(-1, 1), (9, 1)]), [box(0, 0, 9, 2), box(-2, 0, 9, 2)])
    array([1., 0.])
    """
    flat_lines, flat_areas, like = flat_together(lines_of(lines, "lines"), areas_of(areas, "areas"))
    there = is_there(flat_lines) & is_there(flat_areas)
    invalid = np.flatnonzero(there & ~shapely.is_valid(flat_areas))
    if invalid.size:
        first = int(invalid[0])
        where = f"areas[{first}]" if like.ndim else "areas"
        msg = f"{where} is not valid: {shapely.is_valid_reason(flat_areas[first])}"
        raise InvalidAreaError(msg)
    total = np.where(there, 0.0, np.nan)
    for i in np.flatnonzero(there & ~shapely.covers(flat_areas, flat_lines)):
        total[i] = length_outside(flat_lines[i : i + 1], flat_areas[i], geographic)
    return shaped(total, like)


def length_outside(line: Geometries, area: Polygon | MultiPolygon, geographic: bool) -> float:
    """Length of one line outside an area, segment by segment: what is travelled twice counts so."""
    points, _, goes_on = vertices(line)
    moves = goes_on & (points[:-1] != points[1:]).any(axis=1)
    segments = shapely.linestrings(np.stack([points[:-1], points[1:]], axis=1)[moves])
    area = shapely.force_2d(area)  # a copy: callers may share theirs among threads
    shapely.prepare(area)
    segments = segments[~shapely.covers(area, segments)]
    crosses = shapely.intersects(area, segments)
    cut = shapely.difference(segments[crosses], area)
    return float(length(np.append(segments[~crosses], cut), geographic=geographic).sum())


def length_ratio(lines: Any, references: Any, *, geographic: bool = False) -> Any:
    """Length of lines over the length of references.

    Above 1 a line makes detours, far above it zigzags; below 1 it cuts corners or is too short.

    Parameters
    ----------
    lines : LineString or MultiLineString, or array_like of them, shape (...)
        Z is ignored.
    references : LineString or MultiLineString, or array_like of them, shape (...)
        What the lines should be as long as, broadcast against ``lines``.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude, as in ``length``.

    Returns
    -------
    float or ndarray of float64, shape (...)
        NaN where a line or a reference is missing or empty, or a reference has no length.

    Raises
    ------
    GeometryTypeError
        If something is not a line.

    Examples
    --------
    >>> length_ratio(LineString([(0, 0), (5, 5), (10, 0)]), LineString([(0, 0), (10, 0)]))
    1.4142135623730951
    """
    flat_lines, flat_references, like = flat_together(
        lines_of(lines, "lines"), lines_of(references, "references")
    )
    above = length(flat_lines, geographic=geographic)
    below = length(flat_references, geographic=geographic)
    with np.errstate(invalid="ignore", divide="ignore"):
        return shaped(np.where(below > 0.0, above / below, np.nan), like)


def turning(lines: Any, areas: Any, *, geographic: bool = False) -> Any:
    """Degrees by which lines turn on a stretch as long as their area is wide.

    All turns count, left and right, so that zigzags add up where bends of a road hardly do: a
    line along a circle of radius r in an area of width w has w / r radians, as have its chords.

    Parameters
    ----------
    lines : LineString or MultiLineString, or array_like of them, shape (...)
        Z is ignored.
    areas : Polygon or MultiPolygon, or array_like of them, shape (...)
        The areas the lines belong to, broadcast against ``lines``; they give the mean width.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude, as in ``width``.

    Returns
    -------
    float or ndarray of float64, shape (...)
        In degrees per mean width; NaN where a line or an area is missing or empty, or a line has
        no length.

    Raises
    ------
    GeometryTypeError
        If something is not a line, or not an area.

    Notes
    -----
    The sum of the angles between segments that follow one another, times ``mean_width``, over the
    length. It does not change with the scale, nor where vertices are put on straight segments.
    Parts of a MultiLineString are not joined.

    Examples
    --------
    >>> turning(LineString([(2, 2), (6, 2), (6, 6)]), box(0, 0, 8, 8))
    45.0
    """
    flat_lines, flat_areas, like = flat_together(lines_of(lines, "lines"), areas_of(areas, "areas"))
    points, owner, goes_on = vertices(flat_lines)
    steps = np.diff(points * unit_lengths(flat_lines, geographic)[owner], axis=0)
    moves = np.flatnonzero(goes_on & (steps != 0.0).any(axis=1))  # repeated vertices do not turn
    u, v = steps[moves[:-1]], steps[moves[1:]]
    angle = np.abs(np.arctan2(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], (u * v).sum(axis=1)))
    # A vertex from which no segment leads on lies between the parts of two steps.
    part = np.cumsum(np.append(False, ~goes_on))[moves]
    joined = part[:-1] == part[1:]
    total = np.bincount(owner[moves[1:]][joined], angle[joined], minlength=flat_lines.size)
    across = mean_width(flat_lines, flat_areas, geographic=geographic)
    along = length(flat_lines, geographic=geographic)
    with np.errstate(invalid="ignore", divide="ignore"):
        return shaped(np.degrees(total) * across / along, like)
