"""Numbers about a line and its area: length, width along it.

Width is twice the distance from a point of the line to the nearest point of the area's boundary,
holes included: the diameter of the largest disc around the point that fits into the area.

Its mean and maximum are taken along the line, at the vertices and at places between them, so that
they hardly depend on how many vertices a line has:

    o-----.-----.-----o--.--o     no two of them are farther apart than half the mean width
"""

from typing import TYPE_CHECKING, Any

import numpy as np
import shapely

from midrib.measures.chains import (
    Chains,
    Geometries,
    areas_of,
    distances,
    flat_together,
    is_there,
    lines_of,
    one,
    rings,
    shaped,
    step_vectors,
    subdivided,
    unit_lengths,
    vertices,
)

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["largest_width", "length", "mean_width", "mean_widths_of_pieces", "width"]

MOST_INTERVALS = 10_000.0  # of a line: half widths of an area 5000 times as long as wide


def length(lines: Any, *, geographic: bool = False) -> Any:
    """Length of lines.

    Parameters
    ----------
    lines : LineString or MultiLineString, or array_like of them, shape (...)
        Z is ignored.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude. Each segment is then measured
        with the lengths of a degree at its own middle latitude.

    Returns
    -------
    float or ndarray of float64, shape (...)
        In coordinate units, in metres if ``geographic``; NaN where a line is missing or empty.

    Raises
    ------
    GeometryTypeError
        If something is not a line.

    Examples
    --------
    >>> length([LineString([(0, 0), (3, 4)]), None])
    array([ 5., nan])
    """
    array = lines_of(lines, "lines")
    flat = array.ravel()
    chains = vertices(flat)
    total = sums(chains, step_vectors(chains.points, geographic), flat.size)
    return shaped(np.where(is_there(flat), total, np.nan), array)


def width(line: Any, area: Any, *, geographic: bool = False) -> "Floats":
    """Width of an area at the vertices of a line.

    Parameters
    ----------
    line : LineString or MultiLineString
        Usually inside the area; Z is ignored.
    area : Polygon or MultiPolygon
        The area the line belongs to.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude; they are measured in a plane
        that is true to scale at the area's middle latitude.

    Returns
    -------
    ndarray of float64, shape (n,)
        Twice the distance to the boundary, holes included, of each of the n vertices in order; 0
        where a vertex lies on the boundary, as the ends of a line do. In coordinate units, in
        metres if ``geographic``. Without a line, or without an area, empty.

    Raises
    ------
    GeometryTypeError
        If ``line`` is not a line, or ``area`` not an area.

    Notes
    -----
    A tree of boxes over the m segments of the boundary answers for all vertices: O((n + m) log m).

    Examples
    --------
    >>> width(LineString([(0, 1), (1, 1), (9, 1)]), box(0, 0, 9, 2))
    array([0., 2., 0.])
    """
    lines, areas = one(lines_of(line, "line"), "line"), one(areas_of(area, "area"), "area")
    if not (is_there(lines) & is_there(areas)).all():
        return np.empty(0)
    return widths(vertices(lines), areas, geographic)


def mean_width(lines: Any, areas: Any, *, geographic: bool = False) -> Any:
    """Mean width of areas along lines, each stretch counting by its length.

    Parameters
    ----------
    lines : LineString or MultiLineString, or array_like of them, shape (...)
        Z is ignored.
    areas : Polygon or MultiPolygon, or array_like of them, shape (...)
        Broadcast against ``lines``.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude, as in ``width``.

    Returns
    -------
    float or ndarray of float64, shape (...)
        In coordinate units, in metres if ``geographic``; NaN where a line or an area is missing or
        empty, or a line has no length.

    Raises
    ------
    GeometryTypeError
        If something is not a line, or not an area.

    Notes
    -----
    Measured at the vertices and in between, at intervals of at most half the area's mean width
    (its area over its perimeter); or of a 10,000th of the line, if that is more. Between these
    places the width is taken to change evenly. A line that ends on the boundary has width 0 there,
    so the mean of a short line lies below the width of its middle.

    Examples
    --------
    >>> mean_width(LineString([(1, 1), (9, 1)]), box(0, 0, 10, 2))
    2.0
    """
    return mean_and_largest_width(lines, areas, geographic=geographic)[0]


def largest_width(lines: Any, areas: Any, *, geographic: bool = False) -> Any:
    """Largest width of areas along lines.

    Parameters
    ----------
    lines : LineString or MultiLineString, or array_like of them, shape (...)
        Z is ignored.
    areas : Polygon or MultiPolygon, or array_like of them, shape (...)
        Broadcast against ``lines``.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude, as in ``width``.

    Returns
    -------
    float or ndarray of float64, shape (...)
        In coordinate units, in metres if ``geographic``; NaN where a line or an area is missing or
        empty.

    Raises
    ------
    GeometryTypeError
        If something is not a line, or not an area.

    Notes
    -----
    Measured at the same places as ``mean_width``. Width changes by at most twice the way along a
    line, so that no width is larger by more than half the area's mean width.

    Examples
    --------
    >>> largest_width([LineString([(0, 1), (9, 1)]), None], box(0, 0, 9, 2))
    array([ 2., nan])
    """
    return mean_and_largest_width(lines, areas, geographic=geographic)[1]


def mean_and_largest_width(lines: Any, areas: Any, *, geographic: bool) -> tuple[Any, Any]:
    """``mean_width`` and ``largest_width``, for the work of one."""
    flat_lines, flat_areas, like = flat_together(lines_of(lines, "lines"), areas_of(areas, "areas"))
    chains = places_along(flat_lines, flat_areas, geographic)
    points, owner, goes_on = chains
    across = widths(chains, flat_areas, geographic)
    steps = np.hypot(*step_vectors(points, geographic).T)[goes_on]
    middle = ((across[:-1] + across[1:]) / 2.0)[goes_on]
    feature = owner[:-1][goes_on]
    total = np.bincount(feature, steps, minlength=flat_lines.size)
    with np.errstate(invalid="ignore"):
        mean = np.bincount(feature, steps * middle, minlength=flat_lines.size) / total
    largest = np.full(flat_lines.size, np.nan)
    np.fmax.at(largest, owner, across)
    return shaped(np.where(is_there(flat_areas), mean, np.nan), like), shaped(largest, like)


def mean_widths_of_pieces(lines: Geometries, areas: Geometries, *, geographic: bool) -> "Floats":
    """``mean_width`` along each piece of many-pieced lines, one after the other."""
    chains = places_along(lines, areas, geographic)
    across = widths(chains, areas, geographic)
    piece = np.concatenate([[0], np.cumsum(~chains.goes_on)])[:-1][chains.goes_on]
    steps = np.hypot(*step_vectors(chains.points, geographic).T)[chains.goes_on]
    middle = ((across[:-1] + across[1:]) / 2.0)[chains.goes_on]
    with np.errstate(invalid="ignore"):
        means: Floats = np.bincount(piece, steps * middle) / np.bincount(piece, steps)
    return means


def widths(chains: Chains, areas: Geometries, geographic: bool) -> "Floats":
    """Twice the distance of each vertex to the boundary of its owner's area, NaN without one."""
    unit = unit_lengths(areas, geographic)
    return 2.0 * distances(chains.points, chains.owner, rings(areas), unit)


def places_along(lines: Geometries, areas: Geometries, geographic: bool) -> Chains:
    """Vertices of lines, and places between that are half the mean width of areas apart."""
    chains = vertices(lines)
    total = sums(chains, step_vectors(chains.points, geographic), lines.size)
    with np.errstate(invalid="ignore"):
        interval = np.fmax(half_mean_widths(areas, geographic), total / MOST_INTERVALS)
    return subdivided(chains, interval, geographic)


def half_mean_widths(areas: Geometries, geographic: bool) -> "Floats":
    """Area over perimeter of each area, half the width of a long strip; NaN without one."""
    unit = unit_lengths(areas, geographic)
    boundary = rings(areas)
    steps = np.diff(boundary.points, axis=0) * unit[boundary.owner[:-1]]
    with np.errstate(invalid="ignore"):
        halves: Floats = shapely.area(areas) * unit.prod(axis=1) / sums(boundary, steps, areas.size)
    return halves


def sums(chains: Chains, steps: "Floats", count: int) -> "Floats":
    """Length of the chains of each owner."""
    owner, along = chains.owner[:-1][chains.goes_on], np.hypot(*steps.T)[chains.goes_on]
    return np.asarray(np.bincount(owner, along, minlength=count), dtype=np.float64)
