r"""Where dead ends of a network meet the edge of the area.

      corner
    ----.                   The skeleton of a flat end runs into one of its corners, or stops
         \  wall            on the way there, where a branch was pruned. Its last point before
..before.at.x               that from which the way, led straight on, meets the middle half of
           \                the wall is where the line leaves it, for the wall's middle x.
    --------.
"""

from typing import NamedTuple

import numpy as np
import shapely
from shapely import MultiPolygon, Polygon

from midrib.curves.arms import Stretch
from midrib.layout import Scale
from midrib.types import Floats, Ints

__all__ = ["SIGNIFICANT", "STRAIGHT", "Site", "edge_beyond", "middle_of_end", "site_of"]

BACK, BEYOND = 2.0, 3.0  # radii from which the direction of a dead end is taken, and it is led on
INWARDS = (0.0, 1.0, 4.0, 16.0, 64.0)  # roundings of a coordinate, to come inside
IN_CORNER = 0.5  # of the radius before: a dead end with less has run into a corner
LONGEST_END = 4.0  # radii: ends as skew as 30 degrees; walls of points are longer
MIDDLE_HALF = 0.25  # of the length of a flat end
SHARPEST = 4.0  # radii from a disc in a corner of 30 degrees to that corner
SIGNIFICANT = 2.0  # radii that something reaches that is no corner, a corner reaches 1.41
STRAIGHT = 2.0**-36  # of the extent: a vertex this near to the line between its neighbours goes


class Site(NamedTuple):
    """The area, to be asked what it covers."""

    area: Polygon | MultiPolygon  # prepared
    walls: shapely.STRtree  # segments of its boundary
    segments: Floats  # (m, 2, 2) their ends, in lengths
    following: Ints  # of each wall
    preceding: Ints
    scale: Floats  # (2,)
    extent: float

    @property
    def near(self) -> Floats:
        """How near, in coordinate units, a corner is the same."""
        return STRAIGHT * self.extent / self.scale

    def covers(self, points: Floats) -> bool:
        """Whether a chain is inside."""
        return bool(self.area.covers(shapely.linestrings(points)))


def site_of(area: Polygon | MultiPolygon, scale: Scale) -> Site:
    """Site of an area."""
    area = shapely.force_2d(area)  # a copy, since it will be prepared
    shapely.prepare(area)
    rings = shapely.get_rings(shapely.get_parts(area))
    points, ring = shapely.get_coordinates(rings, return_index=True)
    goes_on = np.flatnonzero(ring[:-1] == ring[1:])
    segments = np.stack([points[goes_on], points[goes_on + 1]], axis=1)
    following = np.arange(1, len(segments) + 1)
    first = np.searchsorted(ring[goes_on], np.arange(len(rings)))
    following[np.append(first[1:], len(segments)) - 1] = first
    preceding = np.empty_like(following)
    preceding[following] = np.arange(len(segments))
    low_x, low_y, high_x, high_y = area.bounds
    extent = float(np.hypot((high_x - low_x) * scale[0], (high_y - low_y) * scale[1]))
    tree = shapely.STRtree(shapely.linestrings(segments))
    return Site(area, tree, segments * scale, following, preceding, np.array(scale), extent)


def flat_wall(wall: int, site: Site) -> tuple[Floats, bool]:
    """Both ends of a wall and of those that go straight on from it; whether there are any."""
    walls = site.segments
    ends = walls[wall].copy()
    way = ends[1] - ends[0]
    for on, end in ((site.following, 1), (site.preceding, 0)):
        k = int(on[wall])
        while k != wall:
            beyond = walls[k, end] - ends[1 - end]
            off = abs(way[0] * beyond[1] - way[1] * beyond[0])
            step = walls[k, 1] - walls[k, 0]
            if off > STRAIGHT * site.extent * np.hypot(*way) or step @ way <= 0.0:
                break
            ends[end] = walls[k, end]
            k = int(on[k])
    return ends, bool((ends != walls[wall]).any())


def middle_of_end(stretch: Stretch, site: Site) -> tuple[Floats, int] | None:
    """Middle of the flat end that a dead end runs into a corner of, and its last point before.

    The last sides of a triangulation, or a bisector, lead from there into one corner, or are pruned
    on the way. The wall from that corner on is the end if it is no longer than one and the way
    before, led straight on, meets its middle half.
    """
    tip, radius = stretch.points[0], stretch.radius
    near = site.near + SHARPEST * radius[0] / site.scale
    around = shapely.box(*(tip / site.scale - near), *(tip / site.scale + near))
    ends = [flat_wall(int(wall), site) for wall in site.walls.query(around, "intersects")]
    for at in range(1, len(radius) - 1):
        if radius[at] < radius[at - 1]:
            break
        longest = LONGEST_END * radius[at : at + 2].max()
        for wall, is_long in ends if radius[0] <= IN_CORNER * radius[at] else ():
            if np.hypot(*(wall - tip).T).min() < SIGNIFICANT * radius[0]:
                continue  # the corner is none that hides where the way leads
            middle = middle_ahead(stretch.points[at : at + 2], wall, longest)
            if middle is None:
                continue
            if is_long:  # its pieces are straight but for rounding
                place = shapely.Point(middle / site.scale)
                piece = site.walls.geometries[site.walls.nearest(place)]
                line = shapely.shortest_line(piece, place)
                middle = shapely.get_coordinates(line)[0] * site.scale
            there = inside_of(middle, stretch.points[at], site)
            if there is not None:
                return there, at
    return None


def middle_ahead(way: Floats, wall: Floats, longest: float) -> Floats | None:
    """Middle of a wall if its middle half is straight on from the first of two points of a way."""
    (start, before), (one, other) = way, wall
    step, across = start - before, other - one
    turn = step[0] * across[1] - step[1] * across[0]
    if turn == 0.0 or np.hypot(*across) > longest:
        return None
    ahead = ((one - start)[0] * across[1] - (one - start)[1] * across[0]) / turn
    share = ((one - start)[0] * step[1] - (one - start)[1] * step[0]) / turn
    middle: Floats = (one + other) / 2.0
    return None if ahead <= 0.0 or abs(share - 0.5) > MIDDLE_HALF else middle


def inside_of(edge: Floats, start: Floats, site: Site) -> Floats | None:
    """Point of the edge, or next to it, to which a line leads from a start inside; or None."""
    rounding = np.spacing(np.abs(np.stack([start, edge])).max())
    if (start == edge).all():
        return None  # no direction leads there
    back = (start - edge) / np.hypot(*(start - edge))
    for inwards in INWARDS:
        there: Floats = (edge + inwards * rounding * back) / site.scale
        if site.covers(np.stack([there, start / site.scale])):
            return there
    return None


def edge_beyond(stretch: Stretch, inside: float, radius: float, site: Site) -> Floats | None:
    """Point of the edge straight on from a place on a dead end, None if there is none nearby."""
    free = stretch.length - float(stretch.radius[-1])  # of the junction that it leads to
    back = min(inside + BACK * radius, max(free, (3.0 * inside + stretch.length) / 4.0))
    (start, before), _ = stretch.at(np.array([inside, back]))
    step = start - before
    length = np.hypot(*step)
    if length == 0.0:
        return None
    reach = (inside + BEYOND * radius) * step / length
    ray = shapely.linestrings(np.stack([start, start + reach]) / site.scale)
    walls = site.walls.geometries[site.walls.query(ray, predicate="intersects")]
    met = shapely.get_coordinates(shapely.intersection(walls, ray)) * site.scale
    if len(met) == 0:
        return None
    edge = met[np.argmin(np.hypot(*(met - start).T))]
    return inside_of(edge, start, site)
