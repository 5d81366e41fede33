"""Walls: bands of points thinned to curves.

u, v      coordinates in the plane of a section: across the walls and along them
"""

from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["Thinning", "average_depth", "moving_least_squares", "thinned_wall"]

Thinning: TypeAlias = Literal["average-depth", "moving-least-squares"]
ROUNDS, FAR = 3, 4.0  # times the spread: points farther off a wall do not count
LEAST = 3  # points of a local line
REACH = 3.0  # intervals: as far as a local line looks


def thinned_wall(points: "Floats", thinning: Thinning, interval: float, radius: float) -> "Floats":
    """Curve (m, 2) of u, v through a wall's points (n, 2), in order of v.

    Parameters
    ----------
    points : (n, 2) u and v
    thinning : "average-depth" with ``radius``, or "moving-least-squares" every ``interval``
    """
    if thinning == "average-depth":
        return average_depth(points, radius)
    return moving_least_squares(points, interval)


def average_depth(points: "Floats", radius: float) -> "Floats":
    """Replace points (n, 2) that are near each other by their mean, from the lowest v on.

    Every point that no group has taken begins one, of all free points within ``radius``. O(n log n)
    for points along a curve.

    References
    ----------
    Buczek 2017, section 7: the tool Average Depth of a CAD program, with a radius of 0.01 m.
    """
    order = points[np.argsort(points[:, 1], kind="stable")]
    free = np.ones(len(order), dtype=np.bool_)
    last = np.searchsorted(order[:, 1], order[:, 1] + radius, side="right")
    groups = []
    for i in range(len(order)):
        if free[i]:
            rows = np.arange(i, last[i])[free[i : last[i]]]
            rows = rows[np.hypot(*(order[rows] - order[i]).T) <= radius]
            free[rows] = False
            groups.append(order[rows].mean(axis=0))
    return rising(np.array(groups).reshape(-1, 2))


def moving_least_squares(points: "Floats", interval: float) -> "Floats":
    """Local straight lines through points (n, 2), weighted by distance, at every interval of v.

    Points off the line are left out by and by. Exact for straight walls. Where fewer than three
    points are near, there is no vertex.
    """
    order = points[np.argsort(points[:, 1], kind="stable")]
    if not len(order):
        return order
    v = np.arange(order[0, 1], order[-1, 1] + interval / 2.0, interval)
    first = np.searchsorted(order[:, 1], v - REACH * interval)
    last = np.searchsorted(order[:, 1], v + REACH * interval, side="right")
    vertices = []
    for at, i, j in zip(v, first, last, strict=True):
        near = order[i:j]
        if (np.abs(near[:, 1] - at) <= interval).sum() >= LEAST:
            vertices.append((local_height(near[:, 0], near[:, 1] - at, interval), at))
    return np.array(vertices).reshape(-1, 2)


def local_height(u: "Floats", way: "Floats", interval: float) -> float:
    """Value at 0 of the line through points near it."""
    weight = np.exp(-0.5 * (way / interval) ** 2)
    design = np.column_stack([np.ones(way.size), way])
    keep = np.ones(way.size)
    answer = np.array([np.median(u), 0.0])
    for _ in range(ROUNDS):
        root = np.sqrt(weight * keep)
        answer = np.linalg.lstsq(root[:, None] * design, root * u, rcond=None)[0]
        off = np.abs(u - design @ answer)
        spread = 1.4826 * float(np.median(off))
        keep = (off <= FAR * spread + 1e-300).astype(np.float64)
        if keep.sum() < LEAST:
            break
    return float(answer[0])


def rising(chain: "Floats") -> "Floats":
    """Chain in order of v, each v once."""
    chain = chain[np.argsort(chain[:, 1], kind="stable")]
    distinct = np.diff(chain[:, 1], prepend=-np.inf) > 0.0
    return chain[distinct]
