"""Control points: the vertices of a line by how much depends on them.

A run of vertices is replaced by a segment, or else divided at its farthest vertex (Douglas and
Peucker 1973). What that vertex is worth is its distance from the segment, but no more than what the
run before it was divided at: so those worth more than a tolerance are what Douglas and Peucker
keep, for every tolerance at once.
"""

from typing import Any, NamedTuple

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib.checks import check_flag, is_number, shown
from midrib.curves.minimal_radii import Curve
from midrib.errors import InvalidAreaError, ParameterError
from midrib.geodesy import degree_lengths
from midrib.kernels.simplification import farthest_vertices
from midrib.ragged import area_of_one
from midrib.strip import PLANE, checked_curve
from midrib.types import Bools, Floats, Ints

__all__ = ["ControlPoints", "control_points"]

LEAST = 2  # points of a line
ALIKE = 2.0**40  # relative: an importance is the same within one part of that


class ControlPoints(NamedTuple):
    """Vertices of a line that stand for all of them.

    Attributes
    ----------
    line : LineString
        The line through them.
    rows : (k,) array of int
        Which vertices of the whole line they are.
    importance : (k,) array of float
        The tolerance up to which each is needed, in coordinate units, in metres if geographic;
        infinite for the ends.
    """

    line: LineString
    rows: Ints
    importance: Floats

    @property
    def points(self) -> Floats:
        """Coordinates (k, 2), or (k, 3) with Z."""
        points: Floats = shapely.get_coordinates(self.line, include_z=self.line.has_z)
        return points


def control_points(
    line: LineString | Curve,
    *,
    count: int | None = None,
    tolerance: float | None = None,
    area: Polygon | None = None,
    geographic: bool = False,
) -> ControlPoints:
    """Choose the vertices of a line that matter most, each with its importance.

    Parameters
    ----------
    line : LineString or Curve
        A simple line. Z is carried along.
    count : int, optional
        How many, at least 2; fewer only if the line has fewer.
    tolerance : float, optional
        Or: as few as keep all of the line within this distance of the line through them, in
        coordinate units, in metres if geographic; 0 keeps those that are not on straight pieces.
        Without either every vertex is kept.
    area : Polygon, optional
        Covers the line, and is to cover the line through the control points. That of a Curve
        unless given.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude.

    Returns
    -------
    ControlPoints
        ``line``, ``rows``, ``importance`` and ``points``, in the order of the line. More than
        ``count`` only where fewer would leave the area or cross each other. Of vertices with the
        same importance those come first that divide longer runs, then those farther from the
        segment of their run, then those with smaller x, then y. A run
        is divided at the first of its farthest vertices.

    Raises
    ------
    GeometryTypeError
        If the line or the area is of another kind.
    InvalidAreaError
        If the area does not cover the line, or the line crosses itself.
    ParameterError
        If both ``count`` and ``tolerance`` are given, or have a value they cannot have.

    Notes
    -----
    The points for a smaller count, or a larger tolerance, are among those for a larger count. Every
    vertex that is left out is within the next importance below of its segment. O(n log n) time
    for n vertices as a rule, O(n^2) at worst.

    Examples
    --------
    >>> found = control_points(LineString([(0, 0), (2, 1), (4, 0), (8, 5)]), count=3)
    >>> found.line.wkt, found.importance.round(2).tolist()
    ('LINESTRING (0 0, 4 0, 8 5)', [inf, 2.12, inf])
    """
    check_flag(geographic, "geographic")
    if isinstance(line, Curve):
        line, area = line.line, line.strip.area if area is None else area
    own = first_of_repeats(line)
    line = checked_curve(line, "line")
    area = None if area is None else area_of_one(area, "area")
    check_line(line, area)
    least = least_importance(count, tolerance)
    scale = degree_lengths(shapely.bounds(line)) if geographic else PLANE
    points = shapely.get_coordinates(line)
    worth = worths(points, np.array(scale), area)
    order = order_of(worth, points)
    wanted = len(order) if count is None else int(count)
    if tolerance is not None:
        wanted = int(np.count_nonzero(worth.importance > least))
    for n in range(max(wanted, int(np.isinf(worth.importance).sum())), len(order)):
        rows = np.sort(order[:n])
        chosen = LineString(shapely.get_coordinates(line, include_z=line.has_z)[rows])
        is_whole = chosen.is_valid and chosen.is_simple  # a ring needs three
        if is_whole and (area is None or area.covers(chosen)):
            return ControlPoints(chosen, own[rows], worth.importance[rows])
    return ControlPoints(line, own, worth.importance)


def first_of_repeats(line: Any) -> Ints:
    """Rows of the vertices of a line without those that repeat the one before."""
    points = shapely.get_coordinates(line)
    return np.flatnonzero(np.append(True, (points[1:] != points[:-1]).any(axis=1)))


def check_line(line: LineString, area: Polygon | None) -> None:
    """Refuse a line that crosses itself or leaves its area."""
    if not line.is_simple:
        msg = "the line crosses itself, expected a simple one"
        raise InvalidAreaError(msg)
    if area is not None and not area.covers(line):
        msg = "area does not cover the line, expected that it does"
        raise InvalidAreaError(msg)


def least_importance(count: int | None, tolerance: float | None) -> float:
    """Check how many are wanted, and return the importance that all kept ones are above."""
    if count is not None and tolerance is not None:
        msg = "count and tolerance exclude each other, give one or the other"
        raise ParameterError(msg)
    if count is not None and (
        isinstance(count, bool) or not isinstance(count, int | np.integer) or count < LEAST
    ):
        msg = f"count is {shown(count)}, expected a whole number of 2 or more"
        raise ParameterError(msg)
    if tolerance is None:
        return -np.inf
    if not is_number(tolerance) or not 0.0 <= tolerance < np.inf:
        msg = f"tolerance is {shown(tolerance)}, expected a number of 0 or more"
        raise ParameterError(msg)
    return float(tolerance)


class Worth(NamedTuple):
    """What each vertex is worth."""

    importance: Floats  # (n,) tolerance up to which it is needed
    depth: Ints  # how many runs it is in before it divides one
    off: Floats  # how far it is from the segment of the run that it divides


def order_of(worth: Worth, points: Floats) -> Ints:
    """Rows of vertices, those that matter most first.

    Of several with the same importance those go first that divide longer runs, since others
    depend on these; then those farther off; then those to the west, and to the south. None of
    these rules depends on which way the line runs.
    """
    x, y = points.T
    off, importance = rounded(worth.off), rounded(worth.importance)
    order: Ints = np.lexsort([y, x, -off, worth.depth, -importance])
    return order


def rounded(values: Floats) -> Floats:
    """Values without the digits in which the two ways along a line differ."""
    mantissa, exponent = np.frexp(values)
    found: Floats = np.ldexp(np.round(mantissa * ALIKE) / ALIKE, exponent)
    return found


def worths(points: Floats, scale: Floats, area: Polygon | None) -> Worth:
    """Find what each vertex is worth; of runs that leave the area, any importance."""
    x, y = (points * scale).T.copy()
    n = len(points)
    worth = Worth(np.full(n, np.inf), np.zeros(n, dtype=np.intp), np.full(n, np.inf))
    first, last = np.array([0]), np.array([n - 1])
    limit, depth = np.array([np.inf]), 0
    if area is not None:
        area = shapely.force_2d(area)  # a copy, since it will be prepared
        shapely.prepare(area)
    while first.size:
        far, off = farthest_vertices(x, y, first, last)
        open_ones = far >= 0
        first, last, far = first[open_ones], last[open_ones], far[open_ones]
        off, limit, depth = off[open_ones], limit[open_ones], depth + 1
        if area is not None and first.size:
            segments = shapely.linestrings(np.stack([points[first], points[last]], axis=1))
            is_out: Bools = ~shapely.covers(area, segments)
            off = np.where(is_out, np.inf, off)
        limit = np.minimum(off, limit)
        worth.importance[far], worth.off[far], worth.depth[far] = limit, off, depth
        first, last = np.concatenate([first, far]), np.concatenate([far, last])
        limit = np.concatenate([limit, limit])
    return worth
