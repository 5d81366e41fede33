r"""Sites: the walls and reflex corners of an area in the order of one walk along all of them.

The walk keeps the inside on its left and goes on across every cut (see ``cuts``), so that holes
are on it too; cuts divide the sites that they touch. Two sites that follow each other meet in a
*joint*: smooth, where the point that a disc touches goes on from one to the other; or a *tip* of
the axis, a convex corner, or one side of a cut.

    1   2   3      Sites 1, 3, 5 and 7 of a triangle without holes, and three tips. The walk
    .-------.      starts at a convex corner.
     \     /
    7 \   / 5      What a disc has ahead of it that touches two sites i < j, i on its right, are
       \ /         the sites and tips between them: from there its axis is a tree.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.cuts import Cuts, place_on
from midrib.kernels.jit import njit
from midrib.kernels.walls import CONVEX, REFLEX, Walls
from midrib.types import Floats, Ints

__all__ = ["SMOOTH", "Sites", "site_ahead", "sites_of"]

SMOOTH = 0
NOWHERE = -1


class Sites(NamedTuple):
    """The sites of a walk.

    of          which wall or corner each is a piece of: wall k, or n + k for where wall k starts
    start, end  (., 2) for a wall its ends; at a corner the normals that a disc goes round between
    joint       after each site: SMOOTH, k + 1 for the convex corner where wall k starts, -1 - c
                for cut c
    tips        how many tips come before each
    at          of piece r of wall or corner s which site it is: at[s + before[s] + r]
    """

    of: Ints
    start: Floats
    end: Floats
    joint: Ints
    tips: Ints
    at: Ints


@njit(borrows=True)
def put_ends(w: Walls, c: Cuts, q: Sites, s: int, piece: int) -> None:
    """Set where a site starts and ends."""
    n, i = w.x.size, q.of[s]
    if i < n:
        q.start[s, 0], q.start[s, 1] = w.x[i], w.y[i]
        q.end[s, 0], q.end[s, 1] = w.x[i + 1], w.y[i + 1]
    else:
        before = w.preceding[i - n]
        q.start[s, 0], q.start[s, 1] = -w.uy[before], w.ux[before]
        q.end[s, 0], q.end[s, 1] = -w.uy[i - n], w.ux[i - n]
    first = c.before[i]
    if piece > 0:
        place = c.order[first + piece - 1]
        q.start[s, 0], q.start[s, 1] = c.x[place], c.y[place]
    if first + piece < c.before[i + 1]:
        place = c.order[first + piece]
        q.end[s, 0], q.end[s, 1] = c.x[place], c.y[place]


@njit()
def sites_of(w: Walls, c: Cuts, first: int) -> tuple[bool, Sites]:
    """Walk along all walls, from a convex corner where a wall starts; O(n).

    False if a walk across the cuts does not come to all of them.
    """
    n = w.x.size
    count = c.site.size
    for k in range(n):
        if w.is_wall[k]:
            count += 2 if w.bend[k] == REFLEX else 1
    q = Sites(
        np.empty(count, np.intp), np.empty((count, 2)), np.empty((count, 2)),
        np.zeros(count, np.intp), np.zeros(count, np.intp),
        np.full(2 * n + c.site.size, NOWHERE),
    )  # fmt: skip
    i, piece, tips = first, 0, 0
    for s in range(count):
        q.of[s], q.tips[s] = i, tips
        q.at[i + c.before[i] + piece] = s
        put_ends(w, c, q, s, piece)
        if c.before[i] + piece < c.before[i + 1]:
            place = c.order[c.before[i] + piece]
            q.joint[s] = -1 - place // 2
            i, piece = c.site[place ^ 1], c.rank[place ^ 1] + 1
        elif i >= n:
            i, piece = i - n, 0
        else:
            k = w.following[i]
            q.joint[s] = k + 1 if w.bend[k] == CONVEX else SMOOTH
            i, piece = n + k if w.bend[k] == REFLEX else k, 0
        tips += q.joint[s] != SMOOTH
        if i == first and piece == 0:
            return s == count - 1, q
    return False, q


@njit(borrows=True)
def piece_ahead(c: Cuts, q: Sites, i: int, along: float, right: int, left: int) -> int:
    """Return the piece of a wall or corner at a place, if it is between two sites, or NOWHERE."""
    low, high = c.before[i], c.before[i + 1]
    while low < high:
        middle = (low + high) // 2
        if c.along[c.order[middle]] < along:
            low = middle + 1
        else:
            high = middle
    last = c.before[i + 1] - c.before[i]
    piece = low - c.before[i]
    for near in (piece, piece + 1, piece - 1):  # the neighbours, where rounding decides
        if 0 <= near <= last:
            s = q.at[i + c.before[i] + near]
            if right < s < left:
                return s
    return NOWHERE


@njit(borrows=True)
def site_ahead(w: Walls, c: Cuts, q: Sites, wall: int, x: float, y: float, sites: tuple[int, int]
               ) -> int:  # fmt: skip
    """Return the site between two others where a disc about (x, y) touches a wall, or NOWHERE."""
    right, left = sites
    i, along = place_on(w, wall, x, y)
    s = piece_ahead(c, q, i, along, right, left)
    if s == NOWHERE and i != wall:
        s = piece_ahead(c, q, wall, along, right, left)
    return s
