"""The curve of minimal radii between two curves in space.

There is no area and nothing to see through: Q is the nearest of all points of the auxiliary curve.

P         point of the main curve at a station
Q         nearest point of the auxiliary curve
S         (P + Q) / 2, vertex of the curve
"""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np
import shapely
from shapely import LineString

from midrib.checks import shown
from midrib.curves.stations import SAME_STATION, Skip, StationRule
from midrib.errors import GeometryTypeError, InvalidAreaError, ParameterError
from midrib.kernels.spacetree import nearest_in_space
from midrib.kernels.stations import place_stations

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from midrib.types import Floats, Ints

__all__ = ["SpaceCurve", "minimal_radii_3d"]

RULES = ("main", "caps")
SPACE, MIN_POINTS = 3, 2


@dataclass(frozen=True, eq=False)
class SpaceCurve:
    """A curve of minimal radii in space and the radii it was made from.

    The arrays have one row for each radius, in order of travel; a station whose radii tie has
    several.
    """

    main: LineString
    auxiliary: LineString  # turned to run beside the main curve
    stations: "Floats"  # (n,) arc length of each P along the main curve
    on_main: "Floats"  # (n, 3) the points P
    on_auxiliary: "Floats"  # (n, 3) the points Q
    radii: "Floats"  # (n,) the minimal radii, lengths of PQ
    _ends: "Floats"  # (0 or 2, 3)

    @cached_property
    def points(self) -> "Floats":
        """(n, 3) the points S halfway between P and Q."""
        return (self.on_main + self.on_auxiliary) / 2.0

    @cached_property
    def line(self) -> LineString:
        """The curve, a LineString Z: ends and points S, joined straight.

        Raises
        ------
        InvalidAreaError
            If it is one point.
        """
        chain = distinct(np.concatenate([self._ends[:1], self.points, self._ends[1:]]))
        if len(chain) < MIN_POINTS:
            x, y, z = chain[0]
            msg = f"the curve is one point, ({x:.12g}, {y:.12g}, {z:.12g}); a line needs two"
            raise InvalidAreaError(msg)
        return LineString(chain)

    def __repr__(self) -> str:
        """Show what there is of it."""
        return f"<SpaceCurve: {self.radii.size} radii>"


def minimal_radii_3d(
    main: LineString,
    auxiliary: LineString,
    *,
    spacing: float | None = None,
    count: int | None = None,
    percent: float | None = None,
    vertices: bool = True,
    stations: "ArrayLike | None" = None,
    skip: Skip | None = None,
    ends: Literal["main", "caps"] | None = "main",
) -> SpaceCurve:
    """Curve of minimal radii between two curves in space.

    From each station P on the main curve goes the shortest segment to a point Q of the auxiliary
    curve; the curve joins the middles of these segments. Between parallel rails it is the line
    halfway between them.

    Parameters
    ----------
    main, auxiliary : LineString
        The two curves, with Z, in a planar CRS whose unit is that of Z too. The auxiliary curve may
        run either way; it is turned to run beside the main one.
    spacing, count, percent, vertices, stations : optional
        Where the stations are, as in ``midrib.minimal_radii``; lengths along the main curve are
        those in space.
    skip : int, slice, Polygon, function or list of them, optional
        Stations to drop, as in ``midrib.minimal_radii``; a function gets points (n, 3), a Polygon
        is looked at from above. ``"bays"`` needs an area.
    ends : {"main", "caps"} or None, default "main"
        How the curve ends: at the ends of the main curve, halfway between corresponding ends of
        the two curves, or with its first and last middle.

    Returns
    -------
    SpaceCurve
        ``line``, and for each radius ``stations``, ``on_main`` (P), ``on_auxiliary`` (Q),
        ``points`` (S) and ``radii``. Several radii of one station that tie are in order of travel
        along the auxiliary curve. Without any of spacing, count, percent and stations the interval
        is L / count for the smallest count that makes it at most the mean radius at the main
        curve's vertices, but for no more than 256 stations and four for each vertex.

    Raises
    ------
    GeometryTypeError
        If a curve is not a LineString, or has no Z.
    InvalidAreaError
        If a curve has fewer than two distinct points, or a coordinate that is not finite.
    ParameterError
        If an option has a value it cannot have.

    Notes
    -----
    A tree of boxes over the m segments of the auxiliary curve answers for all n stations:
    O((n + m) log m), more where many radii tie. Curves with the same number of stations, reversed
    both, give the reversed curve. The curve may cross itself where Q travels back: no area tells
    which way round would be inside. Radii collapse into an end that both curves share.

    References
    ----------
    Buczek, Area collapse algorithm computing new curve of 2D geometric objects, Geodesy and
    Cartography 66(1), 2017, 23-44: its outlook on curves in space.

    Examples
    --------
    >>> rail = LineString([(0, 0, 0), (8, 0, 4)])
    >>> other = LineString([(0, 2, 0), (8, 2, 4)])
    >>> minimal_radii_3d(rail, other, ends="caps", count=2).line.wkt
    'LINESTRING Z (0 1 0, 4 1 2, 8 1 4)'
    """
    if ends is not None and not (isinstance(ends, str) and ends in RULES):
        msg = f"ends is {shown(ends)}, expected 'main', 'caps' or None"
        raise ParameterError(msg)
    rule = StationRule(spacing, count, percent, vertices, stations, skip)
    if rule.skip_bays:
        msg = "skip is 'bays', which needs an area, expected stations to drop"
        raise ParameterError(msg)
    m, a = space_chain(main, "main"), space_chain(auxiliary, "auxiliary")
    if end_gaps(m, a[::-1]) < end_gaps(m, a):
        a = a[::-1]
    arc = lengths_along(a)
    at, p = place(rule, m, a, arc)
    found, index = nearest_in_space(p, np.ascontiguousarray(a), arc)
    return SpaceCurve(
        LineString(m),
        LineString(a),
        at[index],
        p[index],
        found[:, :SPACE],
        found[:, 4],
        end_points(m, a, ends),
    )


def space_chain(curve: object, name: str) -> "Floats":
    """Vertices (n, 3) of a curve in space, without repeats in a row."""
    if not isinstance(curve, LineString) or (not curve.has_z and not curve.is_empty):
        kind = getattr(curve, "geom_type", type(curve).__name__)
        without = " without Z" if isinstance(curve, LineString) else ""
        msg = f"{name} is a {kind}{without}, expected a LineString with Z"
        raise GeometryTypeError(msg)
    points = shapely.get_coordinates(curve, include_z=True)
    if not np.isfinite(points).all():
        msg = f"{name} has a coordinate that is not finite"
        raise InvalidAreaError(msg)
    chain = distinct(points)
    if len(chain) < MIN_POINTS:
        msg = f"{name} has fewer than two distinct points"
        raise InvalidAreaError(msg)
    return chain


def distinct(points: "Floats") -> "Floats":
    """Points without repeats in a row."""
    is_new = np.ones(len(points), dtype=np.bool_)
    is_new[1:] = (points[1:] != points[:-1]).any(axis=1)
    return points[is_new]


def lengths_along(chain: "Floats") -> "Floats":
    """Arc lengths (n,) of the vertices of a chain."""
    steps = np.sqrt((np.diff(chain, axis=0) ** 2).sum(axis=1))
    return np.concatenate([[0.0], np.cumsum(steps)])


def end_gaps(main: "Floats", auxiliary: "Floats") -> float:
    """Distance between the starts of two chains and that between their ends, together."""
    return float(np.sqrt(((main[[0, -1]] - auxiliary[[0, -1]]) ** 2).sum(axis=1)).sum())


def place(
    rule: StationRule, main: "Floats", auxiliary: "Floats", arc: "Floats"
) -> tuple["Floats", "Floats"]:
    """Stations on the main curve and their points (n, 3)."""
    along = lengths_along(main)
    found, _ = nearest_in_space(main, np.ascontiguousarray(auxiliary), arc)
    own = rule.own(along[-1], float(found[:, 4].mean()), len(main) + len(auxiliary))
    x, y, z = main.T.copy()
    at, plan, segment, vertex = place_stations(
        own, rule.vertices, SAME_STATION * along[-1], along, np.arange(along.size), x, y
    )
    points = np.column_stack([plan, heights(z, along, at, segment, vertex)])
    keep = rule.kept(at, points)
    if not keep.any():
        msg = "no station is left on the main curve, expected at least one"
        raise ParameterError(msg)
    return at[keep], points[keep]


def heights(
    z: "Floats", along: "Floats", at: "Floats", segment: "Ints", vertex: "Ints"
) -> "Floats":
    """Z of stations; exactly that of a vertex where a station is one."""
    share = (at - along[segment]) / (along[segment + 1] - along[segment])
    between = z[segment] + share * (z[segment + 1] - z[segment])
    return np.where(vertex < 0, between, z[vertex])


def end_points(main: "Floats", auxiliary: "Floats", ends: str | None) -> "Floats":
    """Two end points (2, 3) by a rule, or none."""
    if ends is None:
        return np.empty((0, SPACE))
    if ends == "main":
        return main[[0, -1]]
    return (main[[0, -1]] + auxiliary[[0, -1]]) / 2.0
