r"""Cuts: discs that join the loops of walls of an area to one, so that its inside has no way round.

The farthest corner of a hole, seen in one direction, is touched by a disc that lies in this very
direction from it. The largest one that is empty touches a second loop, which reaches farther; so
the cuts of all holes hang together like a tree, and the shell is its root.

       .------------.
       |     __     |      A walk along the walls with the inside on its left that crosses every
       |    (  )<---|---.  cut it comes to, and goes on along the other loop, sees the whole
       |    _\/_    | cut  boundary in one round. What lies between two empty discs that touch the
       |   |____|   |      same two walls and no cut in between is empty as well: a hole there
       '------------'      would be cut from something there.

A *place* is where a disc touches the boundary: a site (wall k, or n + k for the corner where wall
k starts, of n) and how far along it: a length from the wall's start, or the angle between the
normal of the wall before the corner and the way to the centre. A cut has two places.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.bisectors import BETWEEN_WALLS, Bisector, centre, first_met
from midrib.kernels.heap import pop, push
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.walls import CONVEX, REFLEX, Walls
from midrib.types import Floats, Ints

__all__ = ["Cuts", "cuts_of", "place_on"]

# Of all directions one that is no side or diagonal of squared paper, so that ties are rare.
SEEN_X, SEEN_Y = np.cos(1.0), np.sin(1.0)


class Cuts(NamedTuple):
    """Discs, and for disc c the places 2 c and 2 c + 1.

    disc    (c, 3) x, y, radius
    site    of each place
    along   how far
    x, y    the point that is touched, or at a corner the direction of the centre
    order   places by site, and by how far along
    rank    how many come before each on its site
    before  how many places are on sites before each site
    """

    disc: Floats
    site: Ints
    along: Floats
    x: Floats
    y: Floats
    order: Ints
    rank: Ints
    before: Ints


@njit(borrows=True)
def ahead_of(w: Walls, wall: int, x: float, y: float) -> float:
    """How far (x, y) is ahead of where a wall starts, in the wall's direction."""
    return (x - w.x[wall]) * w.ux[wall] + (y - w.y[wall]) * w.uy[wall]


@njit(borrows=True)
def along_site(w: Walls, site: int, x: float, y: float) -> float:
    """How far along a site the disc about (x, y) touches it."""
    n = w.x.size
    if site < n:
        return ahead_of(w, site, x, y)
    before = w.preceding[site - n]
    dx, dy = x - w.x[site - n], y - w.y[site - n]
    across = dy * w.ux[before] - dx * w.uy[before]
    return np.arctan2(dx * w.ux[before] + dy * w.uy[before], across)


@njit(borrows=True)
def corner_towards(w: Walls, k: int, x: float, y: float) -> int:
    """Return the corner that (x, y) is seen in from the point where wall k starts.

    Where rings touch there are several; the way to (x, y) is followed clockwise by the wall that
    starts in its own.
    """
    corner, least, j = k, np.inf, k
    for _ in range(w.x.size):
        if w.beside[k] == k:
            break
        dx, dy = x - w.x[j], y - w.y[j]
        angle = np.arctan2(w.ux[j] * dy - w.uy[j] * dx, w.ux[j] * dx + w.uy[j] * dy)
        angle += 2.0 * np.pi if angle < 0.0 else 0.0
        if angle < least:
            corner, least = j, angle
        j = w.beside[j]
        if j == k:
            break
    return corner


@njit(borrows=True)
def place_on(w: Walls, wall: int, x: float, y: float) -> tuple[int, float]:
    """Return the place where a disc about (x, y) touches a wall.

    At an end that is on the corner that the disc is in, or, where rounding has met the one for the
    other, on a wall of this corner.
    """
    along = ahead_of(w, wall, x, y)
    if along <= 0.0:
        corner = corner_towards(w, wall, x, y)
    elif along >= ahead_of(w, wall, w.x[wall + 1], w.y[wall + 1]):
        corner = corner_towards(w, w.following[wall], x, y)
    else:
        return wall, along
    before = w.preceding[corner]
    if w.bend[corner] == CONVEX and wall in (before, corner):
        return wall, along
    past_end = ahead_of(w, before, x, y) - ahead_of(w, before, w.x[corner], w.y[corner])
    site = w.x.size + corner
    if ahead_of(w, corner, x, y) > 0.0 or w.bend[corner] != REFLEX:
        site = corner
    elif past_end < 0.0:
        site = before
    return site, along_site(w, site, x, y)


@njit(borrows=True)
def farthest_corners(w: Walls, corner: Ints) -> int:
    """Find the corner of each loop that is farthest in the one direction; return the shell."""
    farthest, shell = -np.inf, -1
    for loop in range(w.first.size):
        best, k = -np.inf, w.first[loop]
        corner[loop] = -1
        while w.is_wall[k]:
            far = SEEN_X * w.x[k] + SEEN_Y * w.y[k]
            if far > farthest:
                farthest, shell = far, loop
            if w.bend[k] == REFLEX and far > best:
                best, corner[loop] = far, k
            k += 1
    return shell


@njit(borrows=True)
def put_place(w: Walls, c: Cuts, i: int, site: int, along: float) -> None:
    """Set a place of a disc."""
    n, x, y = w.x.size, c.disc[i // 2, 0], c.disc[i // 2, 1]
    c.site[i], c.along[i] = site, along
    if site < n:
        c.x[i], c.y[i] = w.x[site] + along * w.ux[site], w.y[site] + along * w.uy[site]
        return
    dx, dy = x - w.x[site - n], y - w.y[site - n]
    size = length(dx, dy)
    if size > 0.0:
        c.x[i], c.y[i] = dx / size, dy / size
    else:  # a gap that rounding has closed
        c.x[i], c.y[i] = -SEEN_X, -SEEN_Y


@njit(borrows=True)
def sort_places(c: Cuts, heap: Ints, filled: Ints) -> None:
    """Order the places by site, then by how far along; O(n log n)."""
    size = 0
    for i in range(c.site.size):
        size = push(heap, c.along, size, i)
        c.before[c.site[i] + 1] += 1
    for site in range(c.before.size - 1):
        c.before[site + 1] += c.before[site]
    while size > 0:
        i = pop(heap, c.along, size)
        size -= 1
        site = c.site[i]
        c.rank[i] = filled[site]
        c.order[c.before[site] + filled[site]] = i
        filled[site] += 1


@njit()
def cuts_of(w: Walls) -> tuple[bool, Cuts]:
    """Cuts of all holes, and whether they were found; O(h log n) for h holes in practice."""
    n, loops = w.x.size, w.first.size
    places = 2 * (loops - 1)
    c = Cuts(
        np.empty((loops - 1, 3)), np.empty(places, np.intp), np.empty(places), np.empty(places),
        np.empty(places), np.empty(places, np.intp), np.empty(places, np.intp),
        np.zeros(2 * n + 1, np.intp),
    )  # fmt: skip
    corner = np.empty(loops, np.intp)
    shell = farthest_corners(w, corner)
    i = 0
    for loop in range(loops):
        if loop == shell:
            continue
        k = corner[loop]
        if k < 0:
            return False, c
        growing = Bisector(BETWEEN_WALLS, w.x[k], w.y[k], SEEN_X, SEEN_Y, 0.0, 1.0, 0.0)
        stop, met = first_met(w, growing, k, 2.0 * w.extent)
        if met < 0:
            return False, c
        x, y, radius = centre(growing, stop)
        c.disc[i, 0], c.disc[i, 1], c.disc[i, 2] = x, y, radius
        put_place(w, c, 2 * i, n + k, along_site(w, n + k, w.x[k] + SEEN_X, w.y[k] + SEEN_Y))
        c.x[2 * i], c.y[2 * i] = SEEN_X, SEEN_Y
        site, along = place_on(w, met, x, y)
        put_place(w, c, 2 * i + 1, site, along)
        i += 1
    sort_places(c, np.empty(places, np.intp), np.zeros(2 * n, np.intp))
    return True, c
