r"""The medial axis: a disc rolls through an area from a convex corner, and goes every way it can.

It rolls between two sites (see ``bisectors``) until its contact runs off one of them, and goes on
with the next one of that bank; or until it touches a third site, ahead. There the axis forks: the
disc goes between left and ahead, later between ahead and right.

    \   left   /           A way that is still to be gone is a *branch*: a node, and the sites on
     \        / ahead      its right and left. What it may meet are the sites between them on one
      o -----<             walk along the whole boundary (see ``sites``), and what it ends in are
     /        \            the tips between them. A fork divides them in two, and where there is
    /  right   \           no tip on one side there is no fork, but a bank that goes on.

So the axis of the area with its cuts is a tree that ends in every tip once, in whatever order
rounding lets a disc meet what it touches at once; and where the two tips of every cut become one
node, there is one way round every hole.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.bisectors import (
    BETWEEN_WALLS,
    DEPTH,
    MET_NOTHING,
    PARABOLA,
    Bisector,
    bisector,
    centre,
    first_met,
    leaves,
)
from midrib.kernels.cuts import Cuts, cuts_of
from midrib.kernels.discs import worst_disc
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh
from midrib.kernels.pieces import (
    NODES,
    Pieces,
    drawn,
    join_at_cuts,
    no_pieces,
    put_node,
    put_piece,
    put_tip,
    unite,
)
from midrib.kernels.sites import NOWHERE, SMOOTH, Sites, site_ahead, sites_of
from midrib.kernels.walls import Walls, sharpest, walls_of
from midrib.types import Floats, Ints

__all__ = ["medial_axis"]

SAME = 2.0**-36  # of the extent: points that are not told apart
MISS = 2.0**-31  # of the extent: how far a disc may be from just touching the boundary


class Fault(NamedTuple):
    """How far the worst disc is from just touching the boundary, and the place."""

    miss: float
    x: float
    y: float


class Branches(NamedTuple):
    """Ways that are to be gone, the next one last: ``number[0]`` of them.

    way     (., 3) node, sites on the right and on the left
    at      (., 2) x, y
    """

    way: Ints
    at: Floats
    number: Ints


@njit(borrows=True)
def put_branch(todo: Branches, node: int, right: int, left: int, x: float, y: float) -> None:
    """Remember a way that is to be gone."""
    i = todo.number[0]
    todo.way[i, 0], todo.way[i, 1], todo.way[i, 2] = node, right, left
    todo.at[i, 0], todo.at[i, 1] = x, y
    todo.number[0] = i + 1


@njit(borrows=True)
def end_in_tip(w: Walls, c: Cuts, q: Sites, a: Pieces, node: int, right: int, x: float, y: float,
               same: float) -> None:  # fmt: skip
    """Go from a node on to the tip after a site: a convex corner, or the disc of a cut."""
    joint = q.joint[right]
    sites = q.of[right + 1], q.of[right]
    if joint > SMOOTH:
        straight = Bisector(BETWEEN_WALLS, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        put_piece(a, straight, sites, (node, put_tip(a, w, joint - 1)), 0.0)
        return
    cut = -1 - joint
    cx, cy = c.disc[cut, 0], c.disc[cut, 1]
    if length(cx - x, cy - y) <= same:
        unite(a, node, cut)
        return
    b = bisector(w, sites[0], sites[1], x, y)
    put_piece(a, b, sites, (node, cut), (cx - b.ax) * b.dx + (cy - b.ay) * b.dy)


@njit(borrows=True)
def next_site(w: Walls, c: Cuts, q: Sites, b: Bisector, right: int, left: int) -> tuple[float, int]:
    """Return the t up to which a disc rolls between two sites, and which one is next then.

    NOWHERE if that cannot be said.
    """
    if b.dx == 0.0 and b.dy == 0.0:  # two corners that rounding has put into one point
        return b.t, right + 1
    on_left, on_right = q.of[left], q.of[right]
    farthest = 2.0 * w.extent if b.kind != PARABOLA else 2.0 * np.sqrt(b.c * w.extent)
    limit = q.start[left, 0], q.start[left, 1]
    off_left = leaves(w, b, on_left, True, limit, farthest)
    limit = q.end[right, 0], q.end[right, 1]
    off_right = leaves(w, b, on_right, False, limit, farthest)
    off = min(off_left, off_right, farthest)
    stop, wall = first_met(w, b, on_left % w.x.size, off)
    following = left - 1 if off_left <= off_right else right + 1
    if wall == MET_NOTHING:
        return stop, following if off < farthest else NOWHERE
    x, y, radius = centre(b, stop)
    ahead = site_ahead(w, c, q, wall, x, y, (right, left))
    # In a gap as narrow as rounding the way out may seem to lead back.
    return stop, following if ahead == NOWHERE and radius < DEPTH * w.extent else ahead


@njit(borrows=True)
def roll(w: Walls, c: Cuts, q: Sites, a: Pieces, todo: Branches) -> bool:
    """Go the next branch to its end: keep left at forks until there is a tip; False if it is lost.

    At a fork the way on the right is left for later.
    """
    same = SAME * w.extent
    todo.number[0] -= 1
    i = todo.number[0]
    node, right, left = todo.way[i, 0], todo.way[i, 1], todo.way[i, 2]
    x, y = todo.at[i, 0], todo.at[i, 1]
    while right + 1 < left:
        b = bisector(w, q.of[left], q.of[right], x, y)
        stop, ahead = next_site(w, c, q, b, right, left)
        if ahead == NOWHERE:
            return False
        x, y, radius = centre(b, stop)
        last = node
        node = put_node(a, x, y, radius, last, same)
        put_piece(a, b, (q.of[left], q.of[right]), (last, node), stop)
        if q.tips[ahead] == q.tips[right]:
            right = ahead
        elif q.tips[ahead] == q.tips[left]:
            left = ahead
        else:
            put_branch(todo, node, right, ahead, x, y)
            right = ahead
    end_in_tip(w, c, q, a, node, right, x, y, same)
    return True


@njit(entry=True)
def medial_axis(
    mesh: Mesh, scale_x: float, scale_y: float, tolerance: float, apart: float
) -> tuple[bool, Floats, Floats, Ints, Fault]:
    """Medial axis of an area as a graph.

    Parameters
    ----------
    mesh : the area
    scale_x, scale_y : lengths of one unit of x and of y
    tolerance : length, how far the chords of an arc may be from it
    apart : share of the extent; vertices that follow each other no farther apart are one

    Returns
    -------
    is_done : whether it was found, and every radius is the distance to the boundary
    points : (n, 2)
    radius : (n,) lengths to the nearest point of the boundary
    edges : (m, 2) rows of points
    fault : where a radius is most wrong, or the search was lost

    Notes
    -----
    Every convex corner is a tip. O(n log n) where the disc is near the walls that it meets: each
    of some six n questions goes up and down a tree of boxes from the wall it is asked at.

    References
    ----------
    Blum, A transformation for extracting new descriptors of shape, 1967 (the axis); Lee, Medial
    axis transformation of a planar shape, IEEE PAMI 4, 1982 (its straight pieces and arcs);
    Aichholzer, Aigner, Aurenhammer, Hackl, Jüttler and Rabl, Medial axis computation for planar
    free-form shapes, CAD 41, 2009 (discs that leave no way round).
    """
    w = walls_of(mesh, scale_x, scale_y, apart)
    start = sharpest(w)
    is_done, c = cuts_of(w)
    a = no_pieces(0)
    miss, x, y = np.inf, w.x[start], w.y[start]
    if is_done:
        is_done, q = sites_of(w, c, start)
        if is_done:
            is_done, a = rolled(w, c, q)
            if is_done:
                miss, x, y = worst_disc(w, a)
            else:
                last = a.numbers[NODES] - 1
                x, y = a.node[last, 0], a.node[last, 1]
    points, radius, edges = drawn(mesh, w, a, tolerance, scale_x, scale_y)
    origin = w.vertex[0]
    fault = Fault(miss, mesh.x[origin] + x / scale_x, mesh.y[origin] + y / scale_y)
    return miss <= MISS * w.extent, points, radius, edges, fault


@njit()
def rolled(w: Walls, c: Cuts, q: Sites) -> tuple[bool, Pieces]:
    """Find all pieces of the axis, first of all the centres of the cuts; False if one is not."""
    last = q.of.size - 1
    tips = q.tips[last] + 1
    a = no_pieces(q.of.size + 3 * tips)
    todo = Branches(np.empty((tips + 1, 3), np.intp), np.empty((tips + 1, 2)), np.zeros(1, np.intp))
    for cut in range(c.disc.shape[0]):
        put_node(a, c.disc[cut, 0], c.disc[cut, 1], c.disc[cut, 2], -1, 0.0)
    start = q.of[0]
    put_branch(todo, put_tip(a, w, start), 0, last, w.x[start], w.y[start])
    while todo.number[0] > 0:
        if not roll(w, c, q, a, todo):
            return False, a
    join_at_cuts(a, c.disc.shape[0])
    return True, a
