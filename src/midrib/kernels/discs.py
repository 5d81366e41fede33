r"""Discs: whether those of an axis just touch the boundary, as their radii say.

      _____            A piece of the axis is between two sites. If the discs at both of its ends
    .'  |  '.          touch both sites and are empty, those between are covered by these two, but
    |   p---|--q       for what lies between a site and the two.
    '.__|__.'
-----------------      That they are empty was asked when they were found: the last disc on a way
                       is searched for what reaches into it (see ``bisectors.first_met``). What they
touch is asked here, and of a middle that the two hardly cover whether it is empty.
"""

import numpy as np

from midrib.kernels.bisectors import BETWEEN_WALLS, PARABOLA, bisector, centre
from midrib.kernels.clearance import nearest_of, nearest_on_segment
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.pieces import PIECES, Pieces, chief_of
from midrib.kernels.walls import Walls

__all__ = ["worst_disc"]

MIDDLE = 2  # of a piece; 0 and 1 are its ends


@njit(inline=True, borrows=True)
def reach_to(w: Walls, x: float, y: float, site: int) -> float:
    """Return the distance from a point to a wall, or to the corner where a wall starts."""
    n = w.x.size
    if site >= n:
        return length(x - w.x[site - n], y - w.y[site - n])
    _, squared = nearest_on_segment(x, y, w.x[site], w.y[site], w.x[site + 1], w.y[site + 1])
    return np.sqrt(squared)


@njit(inline=True, borrows=True)
def middle_of(w: Walls, a: Pieces, i: int) -> tuple[float, float, float]:
    """Centre and radius of the disc in the middle of a piece."""
    left, right = a.piece[i, 2], a.piece[i, 3]
    if a.piece[i, 4] == PARABOLA:
        b = bisector(w, left, right, 0.0, 0.0)
        return centre(b, (a.arc[i, 0] + a.arc[i, 1]) / 2.0)
    p, q = chief_of(a, a.piece[i, 0]), chief_of(a, a.piece[i, 1])
    x, y = (a.node[p, 0] + a.node[q, 0]) / 2.0, (a.node[p, 1] + a.node[q, 1]) / 2.0
    if a.piece[i, 4] == BETWEEN_WALLS:
        return x, y, (a.node[p, 2] + a.node[q, 2]) / 2.0
    return x, y, reach_to(w, x, y, left)


@njit(inline=True, borrows=True)
def off_site(w: Walls, x: float, y: float, radius: float, site: int) -> float:
    """How far a disc is from touching a site."""
    return abs(reach_to(w, x, y, site) - radius)


@njit(inline=True, borrows=True)
def reach_into(w: Walls, x: float, y: float, radius: float, site: int) -> float:
    """How far the boundary reaches into a disc that touches a site."""
    hint = site if site < w.x.size else site - w.x.size
    _, _, squared = nearest_of(x, y, w.x, w.y, w.is_wall, w.boxes, hint, w.stack)
    return radius - np.sqrt(squared)


@njit(inline=True, borrows=True)
def is_wide_apart(a: Pieces, i: int) -> bool:
    """Whether the ends of a piece, none in a convex corner, are farther apart than a radius."""
    p, q = chief_of(a, a.piece[i, 0]), chief_of(a, a.piece[i, 1])
    apart = length(a.node[q, 0] - a.node[p, 0], a.node[q, 1] - a.node[p, 1])
    return a.tip[p] < 0 and a.tip[q] < 0 and apart > min(a.node[p, 2], a.node[q, 2])


@njit(borrows=True)
def worst_disc(w: Walls, a: Pieces) -> tuple[float, float, float]:
    """Return how far a disc is from just touching the boundary at most, and where its centre is.

    Asked at both ends of all pieces, and in the middle where these are far apart; O(n log n).
    """
    worst, at_x, at_y = 0.0, 0.0, 0.0
    for i in range(a.numbers[PIECES]):
        if a.piece[i, 0] < 0:
            continue
        left, right = a.piece[i, 2], a.piece[i, 3]
        for k in range(3 if is_wide_apart(a, i) else 2):
            if k == MIDDLE:
                x, y, radius = middle_of(w, a, i)
            else:
                node = chief_of(a, a.piece[i, k])
                x, y, radius = a.node[node, 0], a.node[node, 1], a.node[node, 2]
            miss = max(off_site(w, x, y, radius, left), off_site(w, x, y, radius, right))
            if k == MIDDLE:
                miss = max(miss, reach_into(w, x, y, radius, left))
            if np.isnan(miss):
                return np.inf, x, y
            if miss > worst:
                worst, at_x, at_y = miss, x, y
    return worst, at_x, at_y
