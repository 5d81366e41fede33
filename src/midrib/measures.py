"""Numbers about a line and its area: length, width along it.

Width is twice the distance from a point of the line to the nearest point of the area's boundary,
holes included: the diameter of the largest disc around the point that fits into the area.
"""

from typing import TYPE_CHECKING, Any

import numpy as np
import shapely
from shapely import LineString, MultiLineString, MultiPolygon, Polygon

from midrib.errors import GeometryTypeError
from midrib.geodesy import lengths_at
from midrib.kernels.clearance import clearances

if TYPE_CHECKING:
    from midrib.types import Bools, Floats, Ints

    Geometries = np.ndarray[tuple[int], np.dtype[np.object_]]

__all__ = ["largest_width", "length", "mean_width", "width"]


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
    array = checked(lines, (LineString, MultiLineString), "lines")
    flat = array.ravel()
    points, owner, goes_on = vertices(flat)
    steps = np.hypot(*step_vectors(points, geographic).T)[goes_on]
    total = np.bincount(owner[:-1][goes_on], steps, minlength=flat.size)
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
    lines, areas = paired(line, area)
    if not (is_there(lines) & is_there(areas)).all():
        return np.empty(0)
    points, owner, _ = vertices(lines)
    return widths(points, owner, areas, geographic)


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
    Between two vertices the width is taken to change evenly. A line that ends on the boundary has
    width 0 there, so the mean of a short line lies below the width of its middle.

    Examples
    --------
    >>> mean_width(LineString([(1, 1), (9, 1)]), box(0, 0, 10, 2))
    2.0
    """
    flat_lines, flat_areas, shape = broadcast(lines, areas)
    points, owner, goes_on = vertices(flat_lines)
    across = widths(points, owner, flat_areas, geographic)
    steps = np.hypot(*step_vectors(points, geographic).T)[goes_on]
    middle = ((across[:-1] + across[1:]) / 2.0)[goes_on]
    feature = owner[:-1][goes_on]
    total = np.bincount(feature, steps, minlength=flat_lines.size)
    with np.errstate(invalid="ignore"):
        mean = np.bincount(feature, steps * middle, minlength=flat_lines.size) / total
    return shaped(np.where(is_there(flat_areas), mean, np.nan), shape)


def largest_width(lines: Any, areas: Any, *, geographic: bool = False) -> Any:
    """Largest width of areas at the vertices of lines.

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

    Examples
    --------
    >>> largest_width([LineString([(0, 1), (5, 1), (9, 1)]), None], box(0, 0, 9, 2))
    array([ 2., nan])
    """
    flat_lines, flat_areas, shape = broadcast(lines, areas)
    points, owner, _ = vertices(flat_lines)
    largest = np.full(flat_lines.size, np.nan)
    np.fmax.at(largest, owner, widths(points, owner, flat_areas, geographic))
    return shaped(largest, shape)


def widths(points: "Floats", owner: "Ints", areas: "Geometries", geographic: bool) -> "Floats":
    """Twice the distance of each point to the boundary of its owner's area, NaN without one."""
    parts, area_of_part = shapely.get_parts(areas, return_index=True)
    rings, part_of_ring = shapely.get_rings(parts, return_index=True)
    boundary, ring = shapely.get_coordinates(rings, return_index=True)
    area = area_of_part[part_of_ring[ring]]
    goes_on = np.zeros(ring.size, dtype=np.bool_)
    goes_on[:-1] = ring[:-1] == ring[1:]
    if geographic:
        bounds = shapely.bounds(areas)
        scale = np.column_stack(lengths_at((bounds[:, 1] + bounds[:, 3]) / 2.0))
        points, boundary = points * scale[owner], boundary * scale[area]
    first = np.arange(areas.size + 1)
    distance = clearances(
        *columns(points),
        np.searchsorted(owner, first),
        *columns(boundary),
        goes_on,
        np.searchsorted(area, first),
    )
    return 2.0 * np.where(np.isfinite(distance), distance, np.nan)


def columns(points: "Floats") -> tuple["Floats", "Floats"]:
    """X and y of points, each in one piece of memory."""
    return points[:, 0].copy(), points[:, 1].copy()


def vertices(lines: "Geometries") -> tuple["Floats", "Ints", "Bools"]:
    """Vertices, the line each is of, and whether the line goes on from each to the next."""
    parts, line_of_part = shapely.get_parts(lines, return_index=True)
    points, part = shapely.get_coordinates(parts, return_index=True)
    return points, line_of_part[part], part[:-1] == part[1:]


def step_vectors(points: "Floats", geographic: bool) -> "Floats":
    """Vectors from each point to the next, in metres if ``geographic``."""
    steps = np.diff(points, axis=0)
    if geographic:
        middle = (points[:-1, 1] + points[1:, 1]) / 2.0
        steps = steps * np.column_stack(lengths_at(middle))
    return steps


def checked(geometries: Any, kinds: tuple[type, ...], name: str) -> "Geometries":
    """Geometries as an object array, all of the right kind or missing."""
    array = np.asarray(geometries, dtype=object)
    for i, geometry in enumerate(array.ravel()):
        if geometry is not None and not isinstance(geometry, kinds):
            found = getattr(geometry, "geom_type", type(geometry).__name__)
            wanted = " or ".join(kind.__name__ for kind in kinds)
            msg = f"{name}{f'[{i}]' if array.ndim else ''} is a {found}, expected {wanted}"
            raise GeometryTypeError(msg)
    return array


def paired(line: Any, area: Any) -> tuple["Geometries", "Geometries"]:
    """One line and one area as arrays of one."""
    lines = checked(line, (LineString, MultiLineString), "line")
    areas = checked(area, (Polygon, MultiPolygon), "area")
    for array, name in ((lines, "line"), (areas, "area")):
        if array.ndim:
            msg = f"{name} is an array, expected one geometry"
            raise GeometryTypeError(msg)
    return lines.reshape(1), areas.reshape(1)


def broadcast(lines: Any, areas: Any) -> tuple["Geometries", "Geometries", "Geometries"]:
    """Lines and areas, flat and as many, and an array of the shape they have together."""
    both = np.broadcast_arrays(
        checked(lines, (LineString, MultiLineString), "lines"),
        checked(areas, (Polygon, MultiPolygon), "areas"),
    )
    return both[0].ravel(), both[1].ravel(), both[0]


def is_there(geometries: "Geometries") -> "Bools":
    """Which geometries are neither missing nor empty."""
    there: Bools = ~(shapely.is_missing(geometries) | shapely.is_empty(geometries))
    return there


def shaped(numbers: "Floats", like: "Geometries") -> Any:
    """Numbers in the shape of an array, a float where that has no axis."""
    return numbers.reshape(like.shape) if like.ndim else float(numbers[0])
