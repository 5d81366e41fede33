"""Lines led to their joints: exact end points, ways on into a neighbour, vertices where these end.

main line   ----o----------t---------o----     t   the point of it nearest to m
                           |
            .........edge..m..............     m   middle of the shared edge, in both lines
                           |
                           |  side line
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib.curves.outlines import Outline
from midrib.kernels.paths import Beads, join_points
from midrib.layout import Scale
from midrib.types import Floats

__all__ = ["ROUNDING", "Chain", "Way", "way_to_chain"]

ROUNDING = 2.0**-46  # of the coordinates: so near, two points are one but for rounding
SAME_VERTEX = 2.0**-4  # of the way there: so near to a vertex of the main line, the way ends in it

SHARP = np.cos(np.radians(40.0))  # a hook turns by more


class Way(NamedTuple):
    """A way from a point of an area's boundary to a line inside it."""

    points: Floats  # (k, 2), the first one the point itself; only that if the line passes it
    segment: int  # of the line, where the way ends
    share: float  # of the segment

    def length(self, scale: Scale) -> float:
        """Return how long it is."""
        return float(np.hypot(*(np.diff(self.points, axis=0) * scale).T).sum())


@dataclass
class Chain:
    """A line that joints are added to."""

    points: Floats  # (n, 2 or 3)
    ways: dict[int, Floats] = field(default_factory=dict)  # from end 0 or 1 on, without the end
    passed: list[tuple[int, float, Floats]] = field(default_factory=list)

    @classmethod
    def of(cls, line: LineString) -> "Chain":
        """Chain of a line."""
        return cls(shapely.get_coordinates(line, include_z=line.has_z))

    def put_end(self, end: int, point: Floats) -> None:
        """Move an end to a point, which it is but for rounding."""
        self.points[-end, : point.size] = point

    def unhook(self, end: int, area: Polygon, edge: Floats, scale: Scale) -> None:
        """Straighten a line that turns sharply near an end, if the area allows it.

        Where an edge is a part of a cap, the last radius crosses in the middle of the cap. Near is
        within half the edge as the line sees it that arrives there: a long edge that runs
        obliquely across the area is wider than the area.
        """
        points = self.points if end == 0 else self.points[::-1]
        plane, edge = points[:, :2] * scale, edge * scale
        far = np.hypot(*(plane - plane[0]).T)
        k = int(np.argmax(far > np.hypot(*(edge - plane[0]).T).max()))
        if k:
            x, y = (plane[k] - plane[0]) / far[k]
            k = int(np.argmax(far > np.ptp(edge @ (y, -x)) / 2.0))
        if k < 2:
            return
        steps = np.diff(plane[: k + 1], axis=0)
        steps /= np.hypot(*steps.T)[:, None]
        is_sharp = (steps[1:] * steps[:-1]).sum(axis=1) < SHARP
        if is_sharp.any() and area.covers(LineString(points[[0, k], :2])):
            points = np.delete(points, np.arange(1, k), axis=0)
            if LineString(points).is_simple:
                self.points = points if end == 0 else points[::-1]

    def point_at(self, way: Way) -> Floats:
        """Return the point in which a way ends, with Z if there is one."""
        a, b = self.points[way.segment], self.points[way.segment + 1]
        if way.share in (0.0, 1.0):
            vertex: Floats = b if way.share else a
            return vertex
        point: Floats = a + way.share * (b - a)
        point[:2] = way.points[-1]
        return point

    def pass_through(self, way: Way, point: Floats) -> None:
        """Make the point in which a way ends a vertex."""
        if way.share not in (0.0, 1.0):
            self.passed.append((way.segment, way.share, point))

    def go_on(self, end: int, way: Way, last: Floats, scale: Scale) -> None:
        """Go on from an end by a way to the point ``last``, rising evenly."""
        if len(way.points) == 1:
            self.put_end(end, last[:2])
            return
        points = way.points[1:].copy()
        points[-1] = last[:2]
        if self.points.shape[1] > 2:
            steps = np.cumsum(np.hypot(*(np.diff(way.points, axis=0) * scale).T))
            to = last[2] if last.size > 2 else np.nan
            z = self.points[-end, 2]
            points = np.column_stack([points, z + (to - z) * steps / steps[-1]])
        self.ways[end] = points

    def line(self) -> LineString:
        """Line with all its joints."""
        self.passed.sort(key=lambda passed: (passed[0], passed[1], *passed[2]))
        at = np.array([segment + 1 for segment, _, _ in self.passed], dtype=np.intp)
        new = np.array([point for _, _, point in self.passed]).reshape(-1, self.points.shape[1])
        middle = np.insert(self.points, at, new, axis=0)
        before, after = (self.ways.get(end, middle[:0]) for end in (0, 1))
        return LineString(distinct(np.concatenate([before[::-1], middle, after])))


def distinct(points: Floats) -> Floats:
    """Points without repeats in a row."""
    keep = np.ones(len(points), dtype=np.bool_)
    keep[1:] = (points[1:, :2] != points[:-1, :2]).any(axis=1)
    return points[keep]


def way_to_chain(outline: Outline, start: Floats, points: Floats) -> Way | None:
    """Find the shortest way inside an area to the nearest point of its line.

    Parameters
    ----------
    outline : the area
    start : (2,) a point of its boundary, but for rounding
    points : (n, 2) its line
    """
    segment, share = nearest_on(points, start, np.array(outline.scale))
    goal = points[segment] + share * (points[segment + 1] - points[segment])
    to_goal = np.hypot(*((goal - start) * outline.scale))
    rounding = ROUNDING * np.abs(start).max()
    for corner in (0.0, 1.0):
        vertex = points[segment + int(corner)]
        if np.hypot(*((goal - vertex) * outline.scale)) <= SAME_VERTEX * to_goal:
            share, goal = corner, vertex
    if np.abs(goal - start).max() <= rounding:
        return Way(start[None], segment, share)
    path = shortest_path(outline, start, goal)
    if path is None:
        return None
    if len(path) == 2:
        return Way(path, segment, share)
    return up_to_line(path, points)


def up_to_line(path: Floats, points: Floats) -> Way:
    """Cut a path with bends where it first meets the line."""
    line = LineString(points)
    for k in range(1, len(path)):
        met = shapely.intersection(LineString(path[k - 1 : k + 1]), line)
        if not met.is_empty:
            there = shapely.get_coordinates(met)
            first = there[np.argmin(np.hypot(*(there - path[k - 1]).T))]
            segment, share = nearest_on(points, first, np.ones(2))
            return Way(np.vstack([path[:k], first]), segment, share)
    segment, share = nearest_on(points, path[-1], np.ones(2))
    return Way(path, segment, share)


def nearest_on(points: Floats, start: Floats, scale: Floats) -> tuple[int, float]:
    """Segment of a chain and the share of it that are nearest to a point: 0 or 1 at a vertex."""
    a, b = points[:-1] * scale, points[1:] * scale
    along, to = b - a, start * scale - a
    share = np.clip((to * along).sum(axis=1) / (along * along).sum(axis=1), 0.0, 1.0)
    k = int(np.argmin(((to - share[:, None] * along) ** 2).sum(axis=1)))
    nearest = points[k] + share[k] * (points[k + 1] - points[k])
    for corner in (0, 1):
        if np.abs(nearest - points[k + corner]).max() <= ROUNDING * np.abs(nearest).max():
            return k, float(corner)
    return k, float(share[k])


def shortest_path(outline: Outline, start: Floats, goal: Floats) -> Floats | None:
    """Shortest path inside an area from a point of its boundary to a point of its inside."""
    mesh = outline.boundary.mesh
    sides = np.flatnonzero(mesh.twin < 0)
    after = sides - sides % 3 + (sides + 1) % 3  # next_side of each
    corners = np.stack([mesh.tri[sides], mesh.tri[after]], axis=1)
    a, b = (np.column_stack([mesh.x[v], mesh.y[v]]) for v in corners.T)
    along, to = b - a, start - a
    share = np.clip((to * along).sum(axis=1) / (along * along).sum(axis=1), 0.0, 1.0)
    k = int(np.argmin(((to - share[:, None] * along) ** 2).sum(axis=1)))
    vertex = int(corners[k, int(share[k])]) if share[k] in (0.0, 1.0) else -1
    origin = np.array([start, start])
    side, at = np.full(2, sides[k]), np.full(2, vertex)
    beads = Beads(np.array([start, goal]), origin, side, at)
    path, source = join_points(mesh, beads, *outline.scale)
    if source.size < 2 or source[0] != 0 or source[-1] != 1:
        return None
    path[0] = start
    return path
