"""Arms of crossings: where a branch has left the discs of a crossing, is narrow, and leads from.

See ``curves.arms``, which says what is asked and why; here is how, for one branch at a time.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.jit import njit
from midrib.types import Floats, Ints

__all__ = ["Reach", "arm_along", "arm_from"]

LOOK = 2.5  # radii within which an arm is looked at for where it is narrow
FARTHEST = 12.0  # radii of the crossing within which an arm comes to be steady, if ever
SAMPLES = 129
STEADY = 0.95  # an arm is steady that does not lose more of its radius within LOOK
NARROW = 1.001  # times the least radius of an arm: 0.01 off already turns it by some 5 degrees
ALONG = 2.0  # radii of an arm over which its direction is taken
WEAK = 0.02  # of its radius is what an arm says that is in the discs all along


class Reach(NamedTuple):
    """Places on an arm: where it is narrow, where it has left the discs, and what is before.

    narrow, outside     arc lengths
    disc                (n, 3) x, y, radius of discs before the cut and one radius on
    """

    narrow: float
    outside: float
    disc: Floats


@njit()
def arm_along(points: Floats, rows: Ints, end: int) -> tuple[Floats, Ints]:
    """Arc lengths (n,) along a branch from its first (0) or last (1) point, and rows from there."""
    way = rows.copy() if end == 0 else rows[::-1].copy()
    arc = np.zeros(way.size)
    for i in range(1, way.size):
        dx = points[way[i], 0] - points[way[i - 1], 0]
        dy = points[way[i], 1] - points[way[i - 1], 1]
        arc[i] = arc[i - 1] + np.hypot(dx, dy)
    return arc, way


@njit(borrows=True)
def disc_at(t: float, arc: Floats, points: Floats, radius: Floats, way: Ints
            ) -> tuple[float, float, float]:  # fmt: skip
    """Point and radius at an arc length; radii are taken to grow evenly between vertices."""
    low, high = 0, arc.size
    while low < high:
        middle = (low + high) // 2
        if arc[middle] <= t:
            low = middle + 1
        else:
            high = middle
    j = max(low - 1, 0)
    a = way[j]
    if j == arc.size - 1 or t <= arc[j]:
        return points[a, 0], points[a, 1], radius[a]
    b, run, off = way[j + 1], arc[j + 1] - arc[j], t - arc[j]
    return (
        (points[b, 0] - points[a, 0]) / run * off + points[a, 0],
        (points[b, 1] - points[a, 1]) / run * off + points[a, 1],
        (radius[b] - radius[a]) / run * off + radius[a],
    )


@njit()
def places_on(arc: Floats, last: float) -> Floats:
    """Evenly spaced arc lengths up to a last one, and those of the vertices before it."""
    place, n, vertex = np.empty(SAMPLES + arc.size), 0, 0
    step = last / (SAMPLES - 1)
    for i in range(SAMPLES):
        at = i * step if i < SAMPLES - 1 else last
        while vertex < arc.size and arc[vertex] < min(at, last):
            if n == 0 or arc[vertex] > place[n - 1]:
                place[n] = arc[vertex]
                n += 1
            vertex += 1
        if n == 0 or at > place[n - 1]:
            place[n] = at
            n += 1
    return place[:n].copy()


@njit()
def least_ahead(arc: Floats, disc: Floats) -> Floats:
    """Least radius from each place on over ``LOOK`` of its radii."""
    least = np.empty(arc.size)
    for i in range(arc.size):
        least[i] = disc[i, 2]
        for j in range(i + 1, arc.size - 1):
            if arc[j] > arc[i] + LOOK * disc[i, 2]:
                break
            least[i] = min(least[i], disc[j, 2])
    return least


@njit()
def reach_of(points: Floats, radius: Floats, arc: Floats, way: Ints, members: Ints) -> Reach:
    """Where an arm is narrow, where it has left the crossing's discs, and where hubs may be."""
    largest = 0.0
    for v in members:
        largest = max(largest, radius[v])
    place = places_on(arc, min(arc[-1] / 2.0, FARTHEST * largest))
    n = place.size
    disc, is_out = np.empty((n, 3)), np.ones(n, np.bool_)
    first, near = n, 0
    for i in range(n):
        disc[i, 0], disc[i, 1], disc[i, 2] = disc_at(place[i], arc, points, radius, way)
        for v in members:
            away = np.hypot(disc[i, 0] - points[v, 0], disc[i, 1] - points[v, 1])
            is_out[i] = is_out[i] and away >= radius[v]
        if is_out[i] and first == n:
            first = i
        near += place[i] <= LOOK * largest
    if first == n:
        return Reach(place[near - 1], place[near - 1], disc)
    ahead, least = least_ahead(place, disc), np.inf
    for i in range(n):
        is_long = place[i] + LOOK * disc[i, 2] <= place[-1]
        if is_out[i] and ahead[i] >= STEADY * disc[i, 2] and is_long:
            least = ahead[i]
            break
    if least == np.inf:
        for i in range(first, max(near, first + 1)):
            least = min(least, disc[i, 2])
    at = first
    for i in range(first, n):
        if disc[i, 2] <= NARROW * least:
            at = i
            break
    narrow = place[at]
    for t in arc:
        if place[at] <= t:
            if t <= place[at] + disc[at, 2] / 2.0 and t <= place[-1]:
                narrow = t
            break
    count = 0
    while count < n and place[count] <= narrow + disc[at, 2]:
        count += 1
    return Reach(narrow, place[first], disc[:count].copy())


@njit(entry=True)
def arm_from(points: Floats, radius: Floats, rows: Ints, end: int, members: Ints
             ) -> tuple[Floats, Ints, Floats]:  # fmt: skip
    """One arm of a crossing.

    Parameters
    ----------
    points, radius : (n, 2) and (n,), of the graph
    rows : the points of a branch
    end : 0 if it leaves the crossing with its first point, 1 if with its last
    members : the points that are the crossing

    Returns
    -------
    said : (12,) arc length of the cut; cut x, y; direction x, y; second difference x, y over places
        so far apart; that length; radius; weight; the next best cut x, y
    kept : (2,) points that are kept beyond either cut
    disc : (m, 3) x, y, radius of discs before the cut and one radius on
    """
    arc, way = arm_along(points, rows, end)
    reach = reach_of(points, radius, arc, way, members)
    at = reach.narrow
    size = disc_at(at, arc, points, radius, way)[2]
    far = min(at + ALONG * size, arc[-1])
    weight = (far - at) / ALONG
    if far == at:  # the whole branch is in the discs, or they are points
        at, far = 0.0, at if at > 0.0 else arc[-1]
        weight = WEAK * (size if size > 0.0 else far)
    ax, ay, _ = disc_at(at, arc, points, radius, way)
    bx, by, _ = disc_at((at + far) / 2.0, arc, points, radius, way)
    cx, cy, _ = disc_at(far, arc, points, radius, way)
    # Of the parabola through three points: inwards the sign of its first derivative turns.
    half = (far - at) / 2.0
    dx = (3.0 * ax - 4.0 * bx + cx) / (2.0 * half)
    dy = (3.0 * ay - 4.0 * by + cy) / (2.0 * half)
    ex, ey = ax - 2.0 * bx + cx, ay - 2.0 * by + cy
    length = max(np.hypot(dx, dy), np.finfo(np.float64).tiny)
    sx, sy, _ = disc_at(reach.outside, arc, points, radius, way)
    said = np.array([at, ax, ay, dx / length, dy / length, ex, ey, half, size, weight, sx, sy])
    kept = np.array([np.count_nonzero(arc > at), np.count_nonzero(arc > reach.outside)])
    return said, kept, reach.disc
