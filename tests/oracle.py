"""The curve of minimal radii by trying everything, written from its definition alone.

For a point P of the main curve the nearest point of one auxiliary segment that P sees is the foot
of the perpendicular, an end of the segment, or where the ray from P past a vertex V of any ring
meets the segment (a graze). Every one of them is tried, nearest first, and the whole closed
segment P E is held against the whole boundary.

Two referees:

``Referee``        floating point. Where a sight misses a corner by less than rounding, it does not
                   decide: ``lower`` is the radius if every doubtful sight is open, ``upper`` if
                   none is. Elsewhere they are equal, but for NUDGE.
``exact_nearest``  fractions. No doubt at all, so for points P whose coordinates are exact.
"""

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, Polygon

__all__ = ["Answer", "Referee", "exact_nearest", "exactly_visible", "run_length", "stations_by"]

Floats = NDArray[np.float64]
Exact = tuple[Fraction, Fraction]

NEAR = 1e-10  # of the size: ends of a sight that are not held against the boundary
TOUCHES = 1e-12  # of the ray: a corner that touches the segment is not beyond it
NUDGES = (0.0, 5e-10, 1e-7, 1e-5)  # of the size: how far a candidate is moved off a doubtful sight


@dataclass(frozen=True)
class Answer:
    """What P sees of the auxiliary curve: bounds of the radius, infinite where it sees nothing."""

    lower: float
    upper: float


class Referee:
    """Nearest visible points of an auxiliary curve in floating point, with doubt."""

    def __init__(self, area: Polygon, auxiliary: LineString) -> None:
        rings = [np.array(r.coords)[:, :2] for r in (area.exterior, *area.interiors)]
        self.area = area
        self.start = np.concatenate([ring[:-1] for ring in rings])
        self.stop = np.concatenate([ring[1:] for ring in rings])
        self.auxiliary = np.array(auxiliary.coords)[:, :2]
        self.curve = LineString(self.auxiliary)
        self.boundary = shapely.multilinestrings(
            shapely.linestrings(np.stack([self.start, self.stop], axis=1))
        )
        self.size = float(np.hypot(*np.ptp(rings[0], axis=0)))
        largest = float(np.abs(np.concatenate(rings)).max())
        self.slack = 2.0**-46 * self.size + 2.0**-50 * largest
        shapely.prepare(self.area)

    # -- what can be seen ----------------------------------------------------------------------

    def surely_blocked(self, p: Floats, ends: Floats) -> NDArray[np.bool_]:
        """Whether some boundary segment crosses P E by more than rounding, for many E."""
        along = ends - p
        length = np.maximum(np.hypot(*along.T), 1e-300)[:, None]
        of_start = cross(along[:, None], self.start - p) / length
        of_stop = cross(along[:, None], self.stop - p) / length
        run = self.stop - self.start
        run_length_ = np.maximum(np.hypot(*run.T), 1e-300)
        of_p = cross(run, p - self.start) / run_length_
        of_end = cross(run, ends[:, None] - self.start) / run_length_
        s = self.slack
        splits = ((of_start > s) & (of_stop < -s)) | ((of_start < -s) & (of_stop > s))
        passes = ((of_p > s) & (of_end < -s)) | ((of_p < -s) & (of_end > s))
        return np.asarray((splits & passes).any(axis=1))

    def maybe_visible(self, p: Floats, end: Floats) -> bool:
        """Whether P E keeps within rounding of the closed area."""
        if self.surely_blocked(p, end[None])[0]:
            return False
        along = end - p
        squared = float(along @ along)
        if squared == 0.0:
            return True
        run = self.stop - self.start
        turn = cross(along, run)
        with np.errstate(divide="ignore", invalid="ignore"):
            meets = cross(self.start - p, run) / turn
        projected = (self.start - p) @ along / squared
        shares = np.concatenate([meets, projected, [0.0, 1.0]])
        shares = np.unique(shares[(shares >= 0.0) & (shares <= 1.0)])
        between = (shares[1:] + shares[:-1]) / 2.0
        places = shapely.points(p + between[:, None] * along)
        return bool((shapely.distance(self.area, places) <= self.slack).all())

    def surely_visible(self, p: Floats, end: Floats) -> bool:
        """Whether P E is clear of the boundary, but for its ends, by more than rounding."""
        along = end - p
        length = float(np.hypot(*along))
        near = NEAR * self.size
        if length < 4.0 * near:
            return False
        for point in (p, end):
            off = point_to_segments(point, self.start, self.stop)
            if ((off > self.slack) & (off <= 2.0 * near)).any():
                return False
        step = along / length * near
        first, last = p + step, end - step
        if not self.area.contains(shapely.Point(first)):
            return False
        return bool(LineString([first, last]).distance(self.boundary) > self.slack)

    def is_next_corner(self, p: Floats, end: Floats) -> bool:
        """Whether E is an end of the boundary segment that P is on, and no ring touches between."""
        own = point_to_segments(p, self.start, self.stop) <= self.slack
        ends = np.concatenate([self.start[own], self.stop[own]])
        if not (ends == end).all(axis=1).any():
            return False
        on_way = point_to_segments_all(self.start, p, end) <= self.slack
        far = np.minimum(np.hypot(*(self.start - p).T), np.hypot(*(self.start - end).T))
        return not bool((on_way & (far > self.slack)).any())

    # -- candidates ------------------------------------------------------------------------------

    def clipped(self, low: float, high: float) -> list[tuple[Floats, Floats]]:
        """Auxiliary segments, cut to the arc lengths from low to high."""
        kept, arc = [], 0.0
        for a, b in pairwise(self.auxiliary):
            length = float(np.hypot(*(b - a)))
            first, last = max(low - arc, 0.0), min(high - arc, length)
            arc += length
            if length > 0.0 and first <= last:
                kept.append((a + (b - a) * (first / length), a + (b - a) * (last / length)))
        return kept

    def candidates(self, p: Floats, low: float, high: float) -> tuple[Floats, list[bool]]:
        """Places to try from P, and whether each has been nudged."""
        places, nudged = [], []
        corners = self.start
        for a, b in self.clipped(low, high):
            run = b - a
            length = float(np.hypot(*run))
            shares = [0.0, 1.0]
            if length > 0.0:
                shares.append(float((p - a) @ run) / length**2)
                shares.extend(grazes(p, corners, a, run))
            inside = [share for share in shares if 0.0 <= share <= 1.0]
            for nudge in NUDGES if length > 0.0 else NUDGES[:1]:
                step = nudge * self.size / length if nudge else 0.0
                for share in inside:
                    for moved in {share - step, share + step}:
                        if 0.0 <= moved <= 1.0:
                            places.append(a + moved * run)
                            nudged.append(nudge > 0.0)
        return np.array(places).reshape(-1, 2), nudged

    def look(self, p: Floats, low: float = -np.inf, high: float = np.inf) -> Answer:
        """Bounds of the minimal radius from P, to points with an arc length from low to high."""
        places, nudged = self.candidates(p, low, high)
        if not nudged:
            return Answer(np.inf, np.inf)
        radii = np.hypot(*(places - p).T)
        order = np.argsort(radii, kind="stable")
        blocked = self.surely_blocked(p, places)
        lower = np.inf
        for k in order:
            if not nudged[k] and not blocked[k] and self.maybe_visible(p, places[k]):
                lower = float(radii[k])
                break
        if lower == np.inf:
            return Answer(np.inf, np.inf)
        for k in order:
            if radii[k] < lower or blocked[k]:
                continue
            if self.is_next_corner(p, places[k]) or self.surely_visible(p, places[k]):
                return Answer(lower, float(radii[k]))
        return Answer(lower, np.inf)


def cross(u: Floats, v: Floats) -> Floats:
    """Cross product of plane vectors."""
    return np.asarray(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])


def point_to_segments(p: Floats, start: Floats, stop: Floats) -> Floats:
    """Distances from a point to segments."""
    run = stop - start
    squared = np.maximum((run * run).sum(axis=1), 1e-300)
    share = np.clip(((p - start) * run).sum(axis=1) / squared, 0.0, 1.0)
    return np.asarray(np.hypot(*(start + share[:, None] * run - p).T))


def point_to_segments_all(points: Floats, a: Floats, b: Floats) -> Floats:
    """Distances from points to one segment."""
    run = b - a
    share = np.clip((points - a) @ run / max(float(run @ run), 1e-300), 0.0, 1.0)
    return np.asarray(np.hypot(*(a + share[:, None] * run - points).T))


def grazes(p: Floats, corners: Floats, a: Floats, run: Floats) -> list[float]:
    """Shares of the segment a, a + run at which the rays from P past corners meet it."""
    rays = corners - p
    turn = cross(rays, run)
    with np.errstate(divide="ignore", invalid="ignore"):
        ahead = cross(a - p, run) / turn  # of the ray, 1 at the corner
        share = cross(a - p, rays) / turn
    return [float(s) for s in share[(turn != 0.0) & (ahead >= 1.0 - TOUCHES)]]


# -- stations and clearances --------------------------------------------------------------------


def stations_by(
    main: LineString,
    area: Polygon | None = None,
    *,
    spacing: float | None = None,
    count: int | None = None,
    percent: float | None = None,
    vertices: bool = True,
) -> Floats:
    """Stations that a rule asks for, from the paper's section 4, nearly equal ones merged.

    A vertex of a hole that touches the main curve counts as a vertex of it.
    """
    steps = np.hypot(*np.diff(np.array(main.coords)[:, :2], axis=0).T)
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    length = arc[-1]
    interval = spacing
    if count is not None:
        interval = length / count
    if percent is not None:
        interval = length * percent / 100.0
    found = [0.0] if interval is not None else []
    while interval is not None and len(found) * interval <= length * (1.0 + 1e-12):
        found.append(min(len(found) * interval, length))
    if vertices:
        found.extend(arc)
        found.extend(touched(main, area) if area else [])
    merged: list[float] = []
    for station in sorted(found):
        if not merged or station - merged[-1] > 1e-11 * length:
            merged.append(float(station))
    return np.array(merged)


def touched(main: LineString, area: Polygon) -> list[float]:
    """Stations at which holes touch the main curve, exactly."""
    corners = {corner for ring in area.interiors for corner in exact_points(ring)}
    on_main = [
        shapely.Point(float(corner[0]), float(corner[1]))
        for a, b in pairwise(exact_points(main))
        for corner in corners
        if turn_of(a, b, corner) == 0 and 0 <= share_along(a, b, corner) <= 1
    ]
    return [float(main.project(point)) for point in on_main]


def run_length(curve: LineString, *, backwards: bool = False) -> float:
    """Length of the first straight run of a curve, or of the last one."""
    points = np.array(curve.coords)[:, :2]
    if backwards:
        points = points[::-1]
    first = points[1] - points[0]
    for k in range(2, len(points)):
        bend = abs(float(cross(points[k] - points[0], first)))
        if bend > 1e-7 * float(np.hypot(*first)) * float(np.hypot(*(points[k] - points[0]))):
            return float(np.hypot(*np.diff(points[:k], axis=0).T).sum())
    return float(curve.length)


# -- exact ----------------------------------------------------------------------------------------


def exact_nearest(area: Polygon, auxiliary: LineString, p: Exact) -> list[Exact]:
    """All nearest points of the auxiliary curve that P sees; none where it sees nothing."""
    rings = [exact_points(ring) for ring in (area.exterior, *area.interiors)]
    sides = [pair for ring in rings for pair in pairwise(ring)]
    corners = [corner for ring in rings for corner in ring[:-1]]
    found: set[Exact] = set()
    for a, b in pairwise(exact_points(auxiliary)):
        found.update(exact_candidates(p, a, b, corners))
    nearest: list[Exact] = []
    best: Fraction | None = None
    for end in sorted(found, key=lambda end: squared_length(p, end)):
        if best is not None and squared_length(p, end) > best:
            break
        if exactly_visible(p, end, sides):
            best = squared_length(p, end)
            nearest.append(end)
    return nearest


def exact_points(line: LineString) -> list[Exact]:
    """Coordinates as fractions."""
    return [(Fraction(x), Fraction(y)) for x, y, *_ in line.coords]


def squared_length(p: Exact, q: Exact) -> Fraction:
    """Squared length of a segment."""
    return (q[0] - p[0]) ** 2 + (q[1] - p[1]) ** 2


def turn_of(a: Exact, b: Exact, c: Exact) -> Fraction:
    """Twice the signed area of a triangle."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def between(a: Exact, b: Exact, share: Fraction) -> Exact:
    """The point at a share of a segment."""
    return a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])


def exact_candidates(p: Exact, a: Exact, b: Exact, corners: list[Exact]) -> list[Exact]:
    """Ends, foot and grazes on one segment."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    shares = [Fraction(0), Fraction(1)]
    shares.append(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy))
    for corner in corners:
        ray_x, ray_y = corner[0] - p[0], corner[1] - p[1]
        turn = ray_x * dy - ray_y * dx
        if turn == 0:
            continue
        ahead = ((a[0] - p[0]) * dy - (a[1] - p[1]) * dx) / turn
        if ahead >= 1:
            shares.append(((a[0] - p[0]) * ray_y - (a[1] - p[1]) * ray_x) / turn)
    return [between(a, b, share) for share in shares if 0 <= share <= 1]


def exactly_visible(p: Exact, q: Exact, sides: list[tuple[Exact, Exact]]) -> bool:
    """Whether the closed segment p q lies in the closed area inside ``sides``."""
    if p == q:
        return True
    shares = {Fraction(0), Fraction(1)}
    for a, b in sides:
        side_a, side_b = turn_of(p, q, a), turn_of(p, q, b)
        for corner, side in ((a, side_a), (b, side_b)):
            if side == 0:
                shares.add(share_along(p, q, corner))
        if (side_a > 0) != (side_b > 0) and side_a != 0 and side_b != 0:
            shares.add(share_along(p, q, between(a, b, side_a / (side_a - side_b))))
    ordered = sorted(share for share in shares if 0 <= share <= 1)
    return all(in_closed(between(p, q, (s + t) / 2), sides) for s, t in pairwise(ordered))


def share_along(p: Exact, q: Exact, r: Exact) -> Fraction:
    """The share of p q at which r, a point of its line, lies."""
    if p[0] != q[0]:
        return (r[0] - p[0]) / (q[0] - p[0])
    return (r[1] - p[1]) / (q[1] - p[1])


def in_closed(r: Exact, sides: list[tuple[Exact, Exact]]) -> bool:
    """Whether r is on a side, or an odd number of sides is to the right of it."""
    inside = False
    for a, b in sides:
        turn = turn_of(a, b, r)
        within_x = min(a[0], b[0]) <= r[0] <= max(a[0], b[0])
        if turn == 0 and within_x and min(a[1], b[1]) <= r[1] <= max(a[1], b[1]):
            return True
        if (a[1] > r[1]) != (b[1] > r[1]) and (turn > 0) == (b[1] > a[1]):
            inside = not inside
    return inside
