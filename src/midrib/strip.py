"""A strip: an area whose boundary is divided into a main and an auxiliary curve."""

from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib.checks import is_number, shown
from midrib.ends import End, end_at, end_far_from, lay_out_ends, lay_out_proposed
from midrib.errors import GeometryTypeError, InvalidAreaError, ParameterError
from midrib.kernels.rings import Rings
from midrib.layout import Boundary, Layout, Scale, boundary_of
from midrib.ragged import area_of_one, place_text, rings_of_area

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["PLANE", "Position", "Strip", "check_strip", "divide", "pair_of", "split"]

Position: TypeAlias = "shapely.Point | tuple[float, float]"
PLANE: Scale = (1.0, 1.0)
MIN_POINTS, MIN_RING = 2, 3
LEAST_SIDE = 0.25  # of the mean width: the shorter of two curves that a polyline divides
ON_BOUNDARY = 1e-9  # a curve is on the boundary if it is this near, as a share of the extent


class Strip:
    """An area with its main curve and its auxiliary curve.

    Parameters
    ----------
    main, auxiliary : LineString
        The two curves. The auxiliary one may run either way; it is turned to run beside the main
        one. Where they do not share an end, a straight cap joins them. Two closed curves, one
        around the other, bound a ring, such as the slope around a mound.
    area : Polygon, optional
        The area they bound, with holes if it has any. Built from the curves and straight caps if
        it is not given.

    Raises
    ------
    GeometryTypeError
        If a curve is not a LineString, or the area not a Polygon.
    InvalidAreaError
        If the curves do not divide the area's boundary: one is not on it, a part of the boundary
        belongs to both or to neither, a cap is not straight, or curves and caps cross.

    Notes
    -----
    The rules are those of section 3 of the paper: the main and the auxiliary curve are together
    the whole outer boundary, caps apart, and have no segment in common. The curves of a ring that
    is closed by a touch, which run along its hole too, come from ``midrib.split`` only.

    Examples
    --------
    >>> strip = Strip(LineString([(0, 0), (9, 0)]), LineString([(9, 2), (0, 2)]))
    >>> strip.auxiliary.wkt
    'LINESTRING (0 2, 9 2)'
    >>> strip.area.area
    18.0
    """

    main: LineString
    auxiliary: LineString
    area: Polygon

    def __init__(
        self, main: LineString, auxiliary: LineString, area: Polygon | None = None
    ) -> None:
        main, auxiliary = checked_curve(main, "main"), checked_curve(auxiliary, "auxiliary")
        ways = beside(auxiliary, main)
        if main.is_ring and auxiliary.is_ring:
            area = area_between(main, auxiliary, area)
            if shapely.is_ccw(main) != shapely.is_ccw(auxiliary):
                auxiliary = shapely.reverse(auxiliary)
        elif area is None:
            auxiliary, ring = ways[0], ring_of(main, ways[0])
            check_ring(main, auxiliary, ring)
            area = Polygon(ring)
        else:
            area = area_of_one(area, "area")
            auxiliary = check_division(main, ways, area)
        self.main, self.auxiliary, self.area = main, auxiliary, area

    def __repr__(self) -> str:
        """Show the sizes of the two curves."""
        main, auxiliary = len(self.main.coords), len(self.auxiliary.coords)
        holes = len(self.area.interiors)
        return f"<Strip: main {main} vertices, auxiliary {auxiliary}, {holes} holes>"

    @classmethod
    def _of_layout(cls, layout: Layout, area: Polygon) -> "Strip":
        """Strip of an area that has been laid out already."""
        strip = cls.__new__(cls)
        x, y, z = layout.mesh.x, layout.mesh.y, layout.height
        columns = (x, y) if z is None else (x, y, z)
        strip.main, strip.auxiliary = (
            LineString(np.column_stack([c[chain.vertex] for c in columns]))
            for chain in (layout.main, layout.auxiliary)
        )
        strip.area = area
        strip.__dict__["layout"] = layout
        return strip

    @property
    def is_closed(self) -> bool:
        """Whether the two curves are closed, one around the other."""
        return bool(self.main.is_ring and self.auxiliary.is_ring)

    @cached_property
    def layout(self) -> Layout:
        """The strip as the kernels see it.

        Raises
        ------
        InvalidAreaError
            If the curves are closed: then there is no end for a line to start from.
        """
        if self.is_closed:
            msg = (
                "main and auxiliary are closed, expected curves with ends; midrib.hatch takes both"
            )
            raise InvalidAreaError(msg)
        boundary = boundary_of(*rings_of_area(self.area))
        middle = shapely.get_coordinates(self.main.interpolate(0.5, normalized=True))
        corners = shapely.get_coordinates([self.main, self.auxiliary])
        n, count = len(boundary.order), len(self.main.coords)
        near = ON_BOUNDARY * diagonal(self.area)
        first, last, first_beside, last_beside, halfway = (
            end_at(boundary, point, PLANE, near)
            for point in (corners[0], corners[count - 1], corners[count], corners[-1], middle[0])
        )
        for end, other in ((first, first_beside), (last, last_beside)):
            if end != other and (end.share or other.share):
                x, y = corners[count] if other is first_beside else corners[-1]
                msg = f"a cap ends at ({x:.12g}, {y:.12g}), expected a vertex of the area"
                raise InvalidAreaError(msg)
        start = first if first == first_beside else End(first_beside.place, first.place)
        stop = last if last == last_beside else End(last.place, last_beside.place)
        if (halfway.position - first.position) % n < (last.position - first.position) % n:
            return lay_out_ends(boundary, start, stop, PLANE, "with")
        return lay_out_ends(boundary, start.turned(), stop.turned(), PLANE, "against")


def split(
    area: Polygon,
    *,
    along: LineString | None = None,
    start: "Position | None" = None,
    end: "Position | None" = None,
) -> Strip:
    """Divide an area into a main and an auxiliary curve.

    Without further options the ends are what a person would call the ends: sharp tips, the middle
    of flat or round ends. A flat end becomes a cap, which belongs to neither curve. The longer
    curve becomes the main one: it sees more of the area.

    Parameters
    ----------
    area : Polygon
        The area, with holes if it has any.
    along : LineString, optional
        A directional polyline on or near the boundary: the curves divide where it starts and ends,
        and the part beside it becomes the main curve, in its direction. Along the boundary, these
        places are at least a quarter of the mean width apart. A closed one divides nothing: the
        strip of a top all round a hole is ``Strip(top, toe, area)``.
    start, end : Point or pair of float, optional
        Where the curves divide: the nearest points of the outer boundary. With only one of them
        given, the other is the end farthest from it.

    Returns
    -------
    Strip
        With the main curve running from start to end. Where the proposed ends are on either side
        of a hole that touches the outer boundary in a vertex, the area is a ring closed by the
        touch: the hole's boundary then belongs to the curves too.

    Raises
    ------
    GeometryTypeError
        If ``area`` is not a Polygon, or ``along`` not a LineString.
    InvalidAreaError
        If the area is not valid, start and end are one point of the boundary, those of ``along``
        are too near each other, or it is closed.
    ParameterError
        If ``along`` is given together with ``start`` or ``end``.

    Notes
    -----
    The ends are those of the longest way through the triangles of the constrained Delaunay
    triangulation; near each of them the shape of the boundary decides between tip, flat cap and
    round end. O(n log n).

    Examples
    --------
    >>> split(box(0, 0, 9, 2)).main.wkt
    'LINESTRING (0 0, 9 0)'
    """
    area = area_of_one(area, "area")
    layout = divide(*rings_of_area(area), PLANE, along=along, start=start, end=end)
    return Strip._of_layout(layout, area)


def check_strip(strip: object) -> None:
    """Refuse what is no strip.

    Raises
    ------
    GeometryTypeError
        If so.
    """
    if not isinstance(strip, Strip):
        kind = getattr(strip, "geom_type", type(strip).__name__)
        msg = f"strip is a {kind}, expected a Strip; midrib.split makes one of an area"
        raise GeometryTypeError(msg)


def divide(
    rings: Rings,
    height: "Floats | None",
    scale: Scale,
    *,
    along: LineString | None = None,
    start: "Position | None" = None,
    end: "Position | None" = None,
    ends: tuple[End, End] | None = None,
) -> Layout:
    """Divide an area by whatever hint there is; see ``split``."""
    if ends is not None:
        return lay_out_ends(boundary_of(rings, height), *ends, scale)
    if along is None and start is None and end is None:
        return lay_out_proposed(rings, height, scale)
    boundary = boundary_of(rings, height)
    if along is not None:
        if start is not None or end is not None:
            msg = "along excludes start and end, give one or the other"
            raise ParameterError(msg)
        return divide_along(boundary, checked_curve(along, "along"), scale)
    if start is not None and end is not None:
        first, last = (
            end_at(boundary, position(p, n), scale) for p, n in ((start, "start"), (end, "end"))
        )
        return lay_out_ends(boundary, first, last, scale)
    value, name = (end, "end") if start is None else (start, "start")
    given = end_at(boundary, position(value, name), scale)
    other = end_far_from(boundary, given, scale)
    return lay_out_ends(boundary, *((other, given) if start is None else (given, other)), scale)


def divide_along(boundary: Boundary, along: LineString, scale: Scale) -> Layout:
    """Divide where a directional polyline starts and ends; main is the part beside it.

    Raises
    ------
    InvalidAreaError
        If it is closed, or its two ends are so near each other along the boundary that one curve
        is next to nothing.
    """
    if along.is_closed:
        msg = (
            "along is closed, expected a line that ends elsewhere than it starts; where a closed "
            "top and toe bound the area, midrib.Strip(top, toe, area) has both"
        )
        raise InvalidAreaError(msg)
    points = shapely.get_coordinates(along)
    first, last = end_at(boundary, points[0], scale), end_at(boundary, points[-1], scale)
    middle = shapely.get_coordinates(along.interpolate(0.5, normalized=True))[0]
    layout = lay_out_ends(boundary, first, last, scale, "with")
    share = min(layout.main.length, layout.auxiliary.length) / layout.mean_width
    if share < LEAST_SIDE:
        start, end = place_text(layout.middle.point[0]), place_text(layout.middle.point[1])
        msg = (
            f"along leads from {start} to {end}, which are {share:.2g} of the mean width apart on "
            f"the boundary, expected {LEAST_SIDE} or more"
        )
        raise InvalidAreaError(msg)
    distance = [
        LineString(np.column_stack([layout.mesh.x[c.vertex], layout.mesh.y[c.vertex]])).distance(
            shapely.Point(middle)
        )
        for c in (layout.main, layout.auxiliary)
    ]
    if distance[0] <= distance[1]:
        return layout
    return lay_out_ends(boundary, first, last, scale, "against")


def position(value: object, name: str) -> "Floats":
    """Coordinates of a Point or of a pair of numbers."""
    pair = pair_of(value)
    if pair is None:
        msg = f"{name} is {shown(value)}, expected a Point or a pair of finite numbers"
        raise ParameterError(msg)
    return pair


def pair_of(value: object) -> "Floats | None":
    """Coordinates of a Point or of a pair of finite numbers, None if it is neither."""
    if isinstance(value, shapely.Point) and not value.is_empty:
        value = (value.x, value.y)
    is_row = isinstance(value, tuple | list | np.ndarray) and len(value) == 2
    if not is_row or not all(is_number(part) for part in value):  # type: ignore[attr-defined]
        return None
    pair = np.array(value, dtype=np.float64)
    return pair if np.isfinite(pair).all() else None


def checked_curve(curve: object, name: str) -> LineString:
    """Return a LineString with at least two distinct points, without repeats in a row."""
    if not isinstance(curve, LineString):
        kind = getattr(curve, "geom_type", type(curve).__name__)
        msg = f"{name} is a {kind}, expected a LineString"
        raise GeometryTypeError(msg)
    points = shapely.get_coordinates(curve, include_z=curve.has_z)
    if not np.isfinite(points[:, :2]).all():
        msg = f"{name} has a coordinate that is not finite"
        raise InvalidAreaError(msg)
    distinct = np.ones(points.shape[0], dtype=np.bool_)
    distinct[1:] = (points[1:, :2] != points[:-1, :2]).any(axis=1)
    if np.count_nonzero(distinct) < MIN_POINTS:
        msg = f"{name} has fewer than two distinct points"
        raise InvalidAreaError(msg)
    return LineString(points[distinct])


def beside(auxiliary: LineString, main: LineString) -> tuple[LineString, LineString]:
    """Return the auxiliary curve both ways, first the one whose ends are nearer to main's."""
    a, m = shapely.get_coordinates(auxiliary)[[0, -1]], shapely.get_coordinates(main)[[0, -1]]
    as_is = np.hypot(*(a - m).T).sum()
    turned = np.hypot(*(a[::-1] - m).T).sum()
    ways = auxiliary, shapely.reverse(auxiliary)
    return ways if as_is <= turned else ways[::-1]


def ring_of(main: LineString, auxiliary: LineString) -> "Floats":
    """Return the closed ring main, cap, auxiliary backwards, cap."""
    has_z = main.has_z and auxiliary.has_z
    m = shapely.get_coordinates(main, include_z=has_z)
    a = shapely.get_coordinates(auxiliary, include_z=has_z)[::-1]
    ring = np.concatenate([m, a, m[:1]])
    distinct = np.ones(ring.shape[0], dtype=np.bool_)
    distinct[1:] = (ring[1:, :2] != ring[:-1, :2]).any(axis=1)
    return ring[distinct]


def area_between(main: LineString, auxiliary: LineString, area: Polygon | None) -> Polygon:
    """Return the area between two closed curves, one around the other.

    Raises
    ------
    InvalidAreaError
        If neither is around the other, or they are not the outer ring and a hole of the area that
        is given; its other holes are islands.
    """
    inner, outer = sorted((main, auxiliary), key=lambda curve: Polygon(curve).area)
    between = Polygon(outer.coords, [inner.coords])
    if not between.is_valid:
        reason = shapely.is_valid_reason(between)
        msg = f"main and auxiliary are closed, but neither is around the other: {reason}"
        raise InvalidAreaError(msg)
    if area is None:
        return between
    area = area_of_one(area, "area")
    near = ON_BOUNDARY * diagonal(area)
    holes = [LineString(ring) for ring in area.interiors]
    if not holes:
        msg = "area has no hole, expected one between two closed curves"
        raise InvalidAreaError(msg)
    hole = min(holes, key=lambda hole: float(shapely.hausdorff_distance(hole, inner)))
    for curve, ring in ((outer, LineString(area.exterior)), (inner, hole)):
        place = far_from(curve, ring, near)
        place = far_from(ring, curve, near) if place is None else place
        if place is not None:
            name = "main" if curve is main else "auxiliary"
            msg = f"{name} and the boundary of area part at {place_text(place)}"
            raise InvalidAreaError(msg)
    return area


def check_ring(main: LineString, auxiliary: LineString, ring: "Floats") -> None:
    """Refuse curves that bound no area, with the rule that is broken."""
    shared = main.intersection(auxiliary)
    if shared.length > 0.0:
        where = place_text(shapely.get_coordinates(shared)[0])
        msg = f"a segment belongs to main and auxiliary both, at {where}, expected to one of them"
        raise InvalidAreaError(msg)
    for curve, name in ((main, "main"), (auxiliary, "auxiliary")):
        if not curve.is_simple:
            msg = f"the {name} curve crosses itself, expected a simple chain"
            raise InvalidAreaError(msg)
    polygon = Polygon(ring) if ring.shape[0] > MIN_RING else Polygon()
    if not polygon.is_valid or polygon.area == 0.0:
        reason = shapely.is_valid_reason(polygon) if polygon.area else "they enclose nothing"
        msg = f"main, auxiliary and their straight caps bound no area: {reason}"
        raise InvalidAreaError(msg)


def check_division(
    main: LineString, ways: tuple[LineString, LineString], area: Polygon
) -> LineString:
    """Return the way of the auxiliary curve that divides the boundary of ``area`` with main.

    Raises
    ------
    InvalidAreaError
        If there is none, with the rule that is broken.
    """
    shell = shapely.LineString(area.exterior.coords)
    near = ON_BOUNDARY * diagonal(area)
    for curve, name in ((main, "main"), (ways[0], "auxiliary")):
        place = far_from(curve, shell, near)
        if place is not None:
            msg = f"{name} leaves the outer boundary of area at {place_text(place)}"
            raise InvalidAreaError(msg)
    for auxiliary in ways:
        ring = shapely.LineString(ring_of(main, auxiliary))
        if far_from(ring, shell, near) is None and far_from(shell, ring, near) is None:
            check_ring(main, auxiliary, ring_of(main, auxiliary))
            return auxiliary
    ring = shapely.LineString(ring_of(main, ways[0]))
    check_ring(main, ways[0], ring_of(main, ways[0]))
    places = [far_from(shell, ring, near), far_from(ring, shell, near)]
    place = next(place for place in places if place is not None)
    msg = (
        f"the boundary of area at {place_text(place)} belongs to neither curve and to no "
        "straight cap"
    )
    raise InvalidAreaError(msg)


def diagonal(area: Polygon) -> float:
    """Length of the diagonal of an area's bounds."""
    x_low, y_low, x_high, y_high = area.bounds
    return float(np.hypot(x_high - x_low, y_high - y_low))


def far_from(line: LineString, other: LineString, near: float) -> "Floats | None":
    """Return the vertex or middle of a segment of a line that is farthest from another line.

    None if even that is not farther than ``near``. Distances are not told by an index, but whether
    they are within ``near`` is: they are for what is not.
    """
    vertices = shapely.get_coordinates(line)
    points = np.concatenate([vertices, (vertices[1:] + vertices[:-1]) / 2.0])
    other = shapely.force_2d(other)  # a copy: callers may share theirs among threads
    shapely.prepare(other)
    apart = points[~shapely.dwithin(other, shapely.points(points), near)]
    if not len(apart):
        return None
    worst: Floats = apart[np.argmax(shapely.distance(shapely.points(apart), other))]
    return worst
