"""Top and toe: the boundary of an area, divided by what a register says of its top.

start, end    where the top begins and ends
forward       the order in which the register stores the ring, whichever way that turns
near          how far a place may be from the ring: a tenth of the mean width

      start ->-- top ->-- end         The top leads forward from start to end, or along a line.
        |                  |          The toe is the rest of the ring, turned to run beside it.
        +--<--- toe ---<---+
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely
from shapely import LineString, Point, Polygon

from midrib.hatching.slope import SlopeError

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["Doubt", "Edges", "edges_along", "edges_between", "mean_width"]

NEAR = 0.1  # of the mean width
ROUNDING = 1e-9  # of the extent: what a file loses of a place
SAMPLES = np.array([0.25, 0.5, 0.75])  # where it shows which way round the ring a line leads


class Doubt(NamedTuple):
    """Why edges may not be what was meant."""

    kind: str  # one of the checks: "off-ring", "orientation", "pieces", "pairs"
    reason: str
    where: Point


class Edges(NamedTuple):
    """Top and toe of an area."""

    top: LineString
    toe: LineString
    doubts: tuple[Doubt, ...] = ()


@dataclass(frozen=True)
class Place:
    """A place on one ring of an area: ``share`` of the way from a vertex to the next."""

    ring: int  # 0 is the outer one
    vertex: int
    share: float
    off: float  # distance of the point it was found for

    @property
    def position(self) -> float:
        """Vertex and share in one number."""
        return self.vertex + self.share


def edges_between(area: Polygon, start: "Floats", end: "Floats") -> Edges:
    """Divide the boundary of an area where its top starts and ends, forward.

    Start and end in one place of a hole mean the whole of it: a mound, whose toe is the outer ring.

    Raises
    ------
    SlopeError
        If start or end is not on the boundary, they are on two rings, or are one place of an area
        without a hole for its toe.
    """
    rings, near = rings_of(area), NEAR * mean_width(area)
    first, doubts = placed(rings, start, near, "start")
    last, more = placed(rings, end, near, "end")
    if first.ring != last.ring:
        msg = f"start is on ring {first.ring} and end on ring {last.ring}, expected one ring"
        raise SlopeError(msg, start)
    doubts += more
    if first.position == last.position:
        edges = all_round(rings, first)
    elif first.ring > 0:
        edges = all_round(rings, first)
        reason = "start and end are apart on a hole: all of it is taken for the top"
        doubts += (Doubt("orientation", reason, Point(start[:2])),)
    else:
        ring = rings[0]
        edges = Edges(LineString(run(ring, first, last)), LineString(run(ring, last, first)[::-1]))
    return edges._replace(doubts=edges.doubts + doubts)


def edges_along(area: Polygon, line: LineString) -> Edges:
    """Divide the boundary of an area where a line along it starts and ends.

    The top is the part of the boundary beside the line, in the line's direction.

    Raises
    ------
    SlopeError
        If the line is not on one ring of the area.
    """
    rings, near = rings_of(area), NEAR * mean_width(area)
    points = shapely.get_coordinates(line)
    first, doubts = placed(rings, points[0], near, "the top's start")
    along = shapely.get_coordinates(shapely.segmentize(line, near))
    off = shapely.distance(shapely.points(along), LineString(rings[first.ring]))
    worst = int(np.argmax(off))
    if off[worst] > near:
        msg = f"the top is {off[worst]:.3g} off the boundary, expected {near:.3g} at most"
        raise SlopeError(msg, along[worst])
    ring = rings[first.ring]
    last, more = placed([ring], points[-1], near, "the top's end")
    doubts += more
    if first.position == last.position or first.ring > 0:
        edges = all_round(rings, first)
        if first.position != last.position:
            reason = "the top runs along a part of a hole: all of it is taken for the top"
            doubts += (Doubt("orientation", reason, Point(points[0, :2])),)
        return edges._replace(doubts=edges.doubts + doubts)
    ways = LineString(run(ring, first, last)), LineString(run(ring, last, first)[::-1])
    beside = line.interpolate(SAMPLES, normalized=True)
    forward, backward = (shapely.distance(beside, way).sum() for way in ways)
    return Edges(*(ways if forward <= backward else ways[::-1]), doubts)


def all_round(rings: "list[Floats]", place: Place) -> Edges:
    """Take a whole ring for the top, from a place on; the toe is another ring.

    A hole falls to the outer ring, and other holes are islands. The outer ring falls to the hole
    that is larger than all others together; these are islands.

    Raises
    ------
    SlopeError
        If there is no such ring.
    """
    where = point_at(rings[place.ring], place.position)
    below = 0 if place.ring > 0 else largest_hole(rings, where)
    top = run(rings[place.ring], place, place)
    other = rings[below]
    beside = Place(below, int(np.argmin(np.hypot(*(other[:-1] - where).T))), 0.0, 0.0)
    toe = run(other, beside, beside)
    if (turning(top) > 0.0) != (turning(toe) > 0.0):
        toe = toe[::-1]
    doubts: tuple[Doubt, ...] = ()
    if place.ring == 0:
        reason = "start and end of the top are one place of the outer ring, expected one of a hole"
        doubts = (Doubt("orientation", reason, Point(where)),)
    return Edges(LineString(top), LineString(toe), doubts)


def largest_hole(rings: "list[Floats]", where: "Floats") -> int:
    """Hole that is larger than all others together.

    Raises
    ------
    SlopeError
        If there is none.
    """
    sizes = [0.0, *(abs(turning(ring)) for ring in rings[1:])]
    largest = int(np.argmax(sizes))
    if not 2.0 * sizes[largest] > sum(sizes):
        many = f"{len(rings) - 1} holes, none larger than the others together"
        msg = (
            "start and end of the top are one place of the outer ring, of an area with "
            f"{many if len(rings) > 1 else 'no hole'}, expected one hole for its toe"
        )
        raise SlopeError(msg, where)
    return largest


def rings_of(area: Polygon) -> "list[Floats]":
    """Coordinates of the outer ring and of the holes, with heights if they have any."""
    rings = [area.exterior, *area.interiors]
    return [distinct(shapely.get_coordinates(ring, include_z=ring.has_z)) for ring in rings]


def distinct(points: "Floats") -> "Floats":
    """Points without repeats in a row."""
    keep = np.ones(len(points), dtype=np.bool_)
    keep[1:] = (points[1:, :2] != points[:-1, :2]).any(axis=1)
    return points[keep]


def mean_width(area: Polygon) -> float:
    """Width of a long rectangle of the same size and perimeter."""
    return float(2.0 * area.area / area.length)


def placed(
    rings: "list[Floats]", point: "Floats", near: float, name: str
) -> tuple[Place, tuple[Doubt, ...]]:
    """Find the vertex at a point, or the place of a ring nearest to it.

    Raises
    ------
    SlopeError
        If it is farther than ``near``.
    """
    found = [place_on(ring, number, point, near) for number, ring in enumerate(rings)]
    place = min(found, key=lambda place: place.off)
    extent = float(np.ptp(rings[0][:, :2], axis=0).max())
    if not place.off <= near:
        msg = f"{name} is {place.off:.3g} off the boundary, expected {near:.3g} at most"
        raise SlopeError(msg, point)
    if place.off > ROUNDING * extent:
        what = "a vertex" if place.share == 0.0 else "the boundary"
        doubt = Doubt("off-ring", f"{name} is {place.off:.3g} off {what}", Point(point[:2]))
        return place, (doubt,)
    if place.share > 0.0:
        reason = f"{name} is no vertex of the boundary, it lies between two"
        return place, (Doubt("orientation", reason, Point(point[:2])),)
    return place, ()


def place_on(ring: "Floats", number: int, point: "Floats", near: float) -> Place:
    """Find the place of a ring where a point is; off the ring the nearest vertex, if it is near."""
    corners, p = ring[:-1, :2], point[:2]
    from_corners = np.hypot(*(corners - p).T)
    corner = int(np.argmin(from_corners))
    at_corner = Place(number, corner, 0.0, float(from_corners[corner]))
    along = ring[1:, :2] - corners
    share = np.clip(((p - corners) * along).sum(axis=1) / (along**2).sum(axis=1), 0.0, 1.0)
    off = np.hypot(*(corners + share[:, None] * along - p).T)
    k = int(np.argmin(off))
    on_ring = ROUNDING * float(np.ptp(corners, axis=0).max())
    if at_corner.off <= (near if off[k] > on_ring else on_ring):
        return at_corner
    return Place(number, k, float(share[k]), float(off[k]))


def point_at(ring: "Floats", position: float) -> "Floats":
    """Coordinates of a place of a ring."""
    k, share = int(position), position % 1.0
    point: Floats = ring[k] + share * (ring[k + 1] - ring[k]) if share else ring[k]
    return point


def run(ring: "Floats", first: Place, last: Place) -> "Floats":
    """Points of a ring forward from one place to another; all of them if the two are one."""
    n, begin, stop = len(ring) - 1, first.position, last.position
    stop += n * (stop <= begin)
    between = ring[np.arange(int(begin) + 1, int(np.ceil(stop))) % n]
    ends = point_at(ring, begin), point_at(ring, last.position)
    return np.concatenate([ends[:1], between, ends[1:]])


def turning(ring: "Floats") -> float:
    """Twice the area of a closed ring, positive if it turns left."""
    x, y = (ring[:, :2] - ring[0, :2]).T
    return float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))
