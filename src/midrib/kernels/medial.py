r"""The medial axis: a disc rolls through an area from a convex corner, and goes every way it can.

It rolls between two sites (see ``bisectors``) until its contact runs off one of them, and goes on
with the next one of that bank; or until it touches a third site, ahead. There the axis forks: the
disc goes between left and ahead, later between ahead and right.

    \   left   /           A way that is still to be gone is a *branch*. Only holes make ways
     \        / ahead      that come back. Where a loop of walls is touched for the first time,
      o -----<             the branch on its right is *open*: the way round that loop comes back
     /        \            through it, whatever else there is in between, for of all loops that
    /  right   \           the way back might surround this one had not been seen before.

How far the disc can roll is asked of the disc at the end of its way: what reaches over that is met
before, at the place where the disc touches it, and the question is asked again there. Two discs
and the two banks between them close in a pocket, so nothing but a whole loop can be missed: a
point of each loop that has not been touched yet is held against the discs in between.

Of four sites that one disc touches, two are met in turn at the same place. Several loops that meet
in such ties, as in a lattice of equal holes, may end in a failure, which is reported.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.bisectors import (
    BETWEEN_WALLS,
    PARABOLA,
    Bisector,
    bisector,
    centre,
    contact,
    leaves,
    meets_point,
    meets_wall,
)
from midrib.kernels.clearance import nearest_of
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh
from midrib.kernels.walls import NO_CORNER, Walls, sharpest, walls_of
from midrib.types import Floats, Ints

__all__ = ["medial_axis"]

DEPTH = 2.0**-41  # of the extent: what reaches less far into a disc only touches it
CLOSE = 2.0**-50  # of the extent: discs this near to a wall touch it
SAME = 2.0**-36  # of the extent: points that are not told apart
BACK = 2.0**-28  # of the extent: as far from where it set out a way that comes back may end
PARTS = 12  # of pieces, nodes and branches for each wall; it takes eight at most
TURNS = 64  # of the question what a disc meets
MOST_CHORDS = 10_000.0  # of an arc
MET_NOTHING = -1


class Axis(NamedTuple):
    """What has been found so far; ``numbers``: how many nodes, pieces, branches, open ones.

    node        (., 3) x, y, radius
    tip         vertex of the mesh that a node is at, or -1
    piece       (., 4) its nodes, and for an arc the wall and the site of the corner, else -1
    arc         (., 2) where an arc starts and ends, as t of the bisector with the wall on the left
    branch      (., 3) stack: node, left site, right site; the node is -1 if it is gone already
    disc        (., 3) of each branch
    open        branches that a way may come back through
    unseen      loops that have not been touched
    """

    node: Floats
    tip: Ints
    piece: Ints
    arc: Floats
    branch: Ints
    disc: Floats
    open: Ints
    unseen: Ints
    numbers: Ints


NODES, PIECES, BRANCHES, OPEN, UNSEEN = 0, 1, 2, 3, 4


@njit(borrows=True)
def put_node(a: Axis, x: float, y: float, radius: float, last: int, same: float) -> int:
    """Return the node at a place: the last one if that is there, else a new one."""
    if last >= 0 and length(a.node[last, 0] - x, a.node[last, 1] - y) <= same:
        return last
    i = a.numbers[NODES]
    a.node[i, 0], a.node[i, 1], a.node[i, 2], a.tip[i] = x, y, radius, -1
    a.numbers[NODES] = i + 1
    return i


@njit(borrows=True)
def put_tip(a: Axis, w: Walls, wall: int) -> int:
    """Return a new node, at the convex corner where a wall starts."""
    i = put_node(a, w.x[wall], w.y[wall], 0.0, -1, 0.0)
    a.tip[i] = w.vertex[wall]
    return i


@njit(borrows=True)
def put_piece(a: Axis, b: Bisector, sites: tuple[int, int], ends: tuple[int, int],
              stop: float) -> None:  # fmt: skip
    """Join two nodes."""
    if ends[0] == ends[1]:
        return
    i = a.numbers[PIECES]
    a.piece[i, 0], a.piece[i, 1], a.piece[i, 2], a.piece[i, 3] = ends[0], ends[1], -1, -1
    if b.kind == PARABOLA:  # seen with its wall on the left, t runs the other way
        left, right = sites
        a.piece[i, 2], a.piece[i, 3] = (right, left) if b.g > 0.0 else (left, right)
        a.arc[i, 0], a.arc[i, 1] = -b.g * b.t, -b.g * stop
    a.numbers[PIECES] = i + 1


@njit(borrows=True)
def put_branch(a: Axis, node: int, left: int, right: int, x: float, y: float, radius: float) -> int:
    """Remember a way that is to be gone."""
    i = a.numbers[BRANCHES]
    a.branch[i, 0], a.branch[i, 1], a.branch[i, 2] = node, left, right
    a.disc[i, 0], a.disc[i, 1], a.disc[i, 2] = x, y, radius
    a.numbers[BRANCHES] = i + 1
    return i


@njit(borrows=True)
def first_met(
    w: Walls, a: Axis, b: Bisector, hint: int, stop: float, extent: float
) -> tuple[float, int]:
    """Return where the disc meets a third wall, and that wall; ``stop`` if it meets nothing.

    MET_NOTHING - 1 if that cannot be said.
    """
    depth, met = DEPTH * extent, MET_NOTHING
    for _ in range(TURNS):
        x, y, radius = centre(b, stop)
        wall, _, squared = nearest_of(x, y, w.x, w.y, w.is_wall, w.boxes, hint, w.stack)
        if np.sqrt(squared) < radius - depth:
            met, stop = wall, meets_wall(w, b, wall, stop, CLOSE * extent)
            if stop > b.t:
                continue
        before = np.inf
        for i in range(a.numbers[UNSEEN]):
            k = w.first[a.unseen[i]]
            before = min(before, meets_point(b, w.x[k], w.y[k], stop, depth))
        if before == np.inf:
            return stop, met
        stop = before
    return stop, MET_NOTHING - 1


@njit(borrows=True)
def ahead_of(w: Walls, place: int, x: float, y: float) -> float:
    """How far (x, y) is ahead of where a wall starts, in the wall's direction."""
    return (x - w.x[place]) * w.ux[place] + (y - w.y[place]) * w.uy[place]


@njit(borrows=True)
def site_of(w: Walls, wall: int, x: float, y: float) -> int:
    """Return the site of a wall that a disc about (x, y) touches.

    At an end that is the corner there, or, where rounding has met the one for the other, the other
    wall of this corner.
    """
    if ahead_of(w, wall, x, y) <= 0.0:
        corner = w.corner[wall]
    elif ahead_of(w, wall, x, y) >= ahead_of(w, wall, w.x[wall + 1], w.y[wall + 1]):
        corner = w.corner[wall + 1]
    else:
        return wall
    if corner == NO_CORNER:
        return wall
    if ahead_of(w, corner, x, y) > 0.0:
        return corner
    before = w.preceding[corner]
    past_end = ahead_of(w, before, x, y) - ahead_of(w, before, w.x[corner], w.y[corner])
    return before if past_end < 0.0 else w.x.size + corner


@njit(borrows=True)
def following_site(w: Walls, site: int, is_left: bool) -> tuple[int, bool]:
    """Return the next site of a bank, and whether there is a convex corner in between."""
    n = w.x.size
    if site >= n:
        return (w.preceding[site - n] if is_left else site - n), False
    start = site if is_left else w.following[site]  # the wall that starts from the point between
    beyond = w.preceding[site] if is_left else start
    if w.is_convex[start]:
        return beyond, True
    return (n + start if w.corner[start] == start else beyond), False


@njit(borrows=True)
def is_between(w: Walls, a: Axis, i: int, dx: float, dy: float) -> bool:
    """Whether a direction is within a branch: from its right contact leftwards to its left one."""
    x, y, radius = a.disc[i, 0], a.disc[i, 1], a.disc[i, 2]
    lx, ly = contact(w, a.branch[i, 1], x, y, radius)
    rx, ry = contact(w, a.branch[i, 2], x, y, radius)
    whole = np.arctan2(rx * ly - ry * lx, rx * lx + ry * ly) % (2.0 * np.pi)
    return np.arctan2(rx * dy - ry * dx, rx * dx + ry * dy) % (2.0 * np.pi) <= whole


@njit(borrows=True)
def open_branch(
    w: Walls, a: Axis, sites: tuple[int, int], x: float, y: float, radius: float, back: float
) -> int:
    """Return the place among the open branches of the one that a way comes back through, or -1."""
    for place in range(a.numbers[OPEN]):
        i = a.open[place]
        if length(a.disc[i, 0] - x, a.disc[i, 1] - y) <= back:
            lx, ly = contact(w, sites[0], x, y, radius)
            rx, ry = contact(w, sites[1], x, y, radius)
            if is_between(w, a, i, ry - ly, lx - rx):
                return place
    return -1


@njit(borrows=True)
def touches_there(w: Walls, a: Axis, i: int, site: int, other: int, back: float) -> bool:
    """Whether two sites touch the disc of a branch in the same point."""
    x, y, radius = a.disc[i, 0], a.disc[i, 1], a.disc[i, 2]
    ax, ay = contact(w, site, x, y, radius)
    bx, by = contact(w, other, x, y, radius)
    return length(ax - bx, ay - by) <= back


@njit(borrows=True)
def make_room(a: Axis, j: int) -> None:
    """Move the branches from place j on up by one: they are to be gone before the new one."""
    for k in range(a.numbers[BRANCHES], j, -1):
        for c in range(3):
            a.branch[k, c], a.disc[k, c] = a.branch[k - 1, c], a.disc[k - 1, c]
    for place in range(a.numbers[OPEN]):
        a.open[place] += a.open[place] >= j
    a.numbers[BRANCHES] += 1


@njit(borrows=True)
def close(a: Axis, i: int) -> None:
    """Take branch i off the open ones, now that it is gone itself."""
    for place in range(a.numbers[OPEN]):
        if a.open[place] == i:
            a.numbers[OPEN] -= 1
            a.open[place] = a.open[a.numbers[OPEN]]
            break


@njit(borrows=True)
def come_back(w: Walls, a: Axis, place: int, sites: tuple[int, int], back: float) -> int:
    """Take a way off an open branch that it comes back through; what is beside it stays open."""
    i = a.open[place]
    node, left, right = a.branch[i, 0], a.branch[i, 1], a.branch[i, 2]
    a.branch[i, 0] = -1
    a.numbers[OPEN] -= 1
    a.open[place] = a.open[a.numbers[OPEN]]
    x, y, radius = a.disc[i, 0], a.disc[i, 1], a.disc[i, 2]
    for one, other in ((left, sites[1]), (sites[0], right)):
        if not touches_there(w, a, i, one, other, back):
            j = i
            if a.branch[i, 0] < 0:
                a.branch[i, 0], a.branch[i, 1], a.branch[i, 2] = node, one, other
            else:
                j = i + 1
                make_room(a, j)
                a.branch[j, 0], a.branch[j, 1], a.branch[j, 2] = node, one, other
                a.disc[j, 0], a.disc[j, 1], a.disc[j, 2] = x, y, radius
            a.open[a.numbers[OPEN]] = j
            a.numbers[OPEN] += 1
    return node


@njit(borrows=True)
def fork(w: Walls, a: Axis, node: int, sites: tuple[int, int], ahead: int, x: float, y: float,
         radius: float) -> None:  # fmt: skip
    """Remember the two ways at a disc that touches a third site; the left one will be gone next."""
    n = w.x.size
    loop = w.loop[ahead if ahead < n else ahead - n]
    right = put_branch(a, node, ahead, sites[1], x, y, radius)
    put_branch(a, node, sites[0], ahead, x, y, radius)
    for i in range(a.numbers[UNSEEN]):
        if a.unseen[i] == loop:
            a.numbers[UNSEEN] -= 1
            a.unseen[i] = a.unseen[a.numbers[UNSEEN]]
            a.open[a.numbers[OPEN]] = right
            a.numbers[OPEN] += 1
            break


@njit(borrows=True)
def roll(w: Walls, a: Axis, i: int, extent: float) -> bool:
    """Go branch i to its end: a tip, a fork, or an open branch; False if that is not found."""
    n = w.x.size
    node, left, right = a.branch[i, 0], a.branch[i, 1], a.branch[i, 2]
    x, y, radius = a.disc[i, 0], a.disc[i, 1], a.disc[i, 2]
    a.branch[i, 0] = -1
    for _ in range(4 * n):
        b = bisector(w, left, right, x, y, radius)
        if b.kind != 0 and not b.c > 0.0:
            return False
        farthest = 2.0 * extent if b.kind != PARABOLA else 2.0 * np.sqrt(b.c * extent)
        is_tip = left < n and right < n and w.following[right] == left and w.is_convex[left]
        if is_tip:
            off_left = off_right = length(w.x[left] - x, w.y[left] - y)
        else:
            off_left = leaves(w, b, left, True, farthest)
            off_right = leaves(w, b, right, False, farthest)
        off = min(off_left, off_right, farthest)
        stop, ahead = first_met(w, a, b, left if left < n else left - n, off, extent)
        if ahead < MET_NOTHING:
            return False
        x, y, radius = centre(b, stop)
        is_tip = is_tip and ahead == MET_NOTHING
        if is_tip:
            x, y, radius = w.x[left], w.y[left], 0.0
        site, is_left = -1, False
        if ahead >= 0:
            ahead = site_of(w, ahead, x, y)
        elif not is_tip:
            if off_left > off and off_right > off:
                return False
            is_left = off_left <= off_right
            site, is_fork = following_site(w, left if is_left else right, is_left)
            ahead = site if is_fork else MET_NOTHING
        sites, back = (left, right), BACK * extent
        if ahead >= 0:
            place = open_branch(w, a, sites, x, y, radius, back)
            if place >= 0:
                put_piece(a, b, sites, (node, come_back(w, a, place, sites, back)), stop)
                return True
        last = node
        node = put_tip(a, w, left) if is_tip else put_node(a, x, y, radius, last, SAME * extent)
        put_piece(a, b, sites, (last, node), stop)
        if is_tip:
            return True
        if ahead >= 0:
            fork(w, a, node, sites, ahead, x, y, radius)
            return True
        left, right = (site, right) if is_left else (left, site)
    return False


@njit(entry=True)
def medial_axis(
    mesh: Mesh, scale_x: float, scale_y: float, tolerance: float
) -> tuple[bool, Floats, Floats, Ints]:
    """Medial axis of an area as a graph.

    Parameters
    ----------
    mesh : the area
    scale_x, scale_y : lengths of one unit of x and of y
    tolerance : length, how far the chords of an arc may be from it

    Returns
    -------
    is_done : bool
    points : (n, 2)
    radius : (n,) lengths to the nearest point of the boundary
    edges : (m, 2) rows of points

    Notes
    -----
    Every convex corner is a tip. O(n log n) where the disc is near the walls that it meets: each
    of some six n questions goes up and down a tree of boxes from the wall it is asked at.

    References
    ----------
    Blum, A transformation for extracting new descriptors of shape, 1967 (the axis); Lee, Medial
    axis transformation of a planar shape, IEEE PAMI 4, 1982 (its straight pieces and arcs).
    """
    w = walls_of(mesh, scale_x, scale_y)
    loops, room = w.first.size, PARTS * w.x.size + 64
    a = Axis(
        np.empty((room, 3)), np.empty(room, np.intp), np.empty((room, 4), np.intp),
        np.empty((room, 2)), np.empty((room, 3), np.intp), np.empty((room, 3)),
        np.empty(room, np.intp), np.arange(loops), np.zeros(5, np.intp),
    )  # fmt: skip
    low_x, low_y, high_x, high_y = w.boxes[1, 0], w.boxes[1, 1], w.boxes[1, 2], w.boxes[1, 3]
    extent = length(high_x - low_x, high_y - low_y)
    start = sharpest(w)
    a.numbers[UNSEEN] = loops - 1
    a.unseen[w.loop[start]] = loops - 1
    node = put_tip(a, w, start)
    put_branch(a, node, w.preceding[start], start, w.x[start], w.y[start], 0.0)
    is_done = True
    for _ in range(room):
        if not is_done or a.numbers[BRANCHES] == 0:
            break
        a.numbers[BRANCHES] -= 1
        i = a.numbers[BRANCHES]
        if a.branch[i, 0] >= 0:
            close(a, i)
            is_done = has_room(a) and roll(w, a, i, extent)
    is_done = is_done and a.numbers[BRANCHES] == 0
    is_done = is_done and a.numbers[UNSEEN] == 0 and a.numbers[OPEN] == 0
    points, radius, edges = drawn(w, a, tolerance)
    for i in range(points.shape[0]):
        points[i, 0] = mesh.x[w.vertex[0]] + points[i, 0] / scale_x
        points[i, 1] = mesh.y[w.vertex[0]] + points[i, 1] / scale_y
        if i < a.numbers[NODES] and a.tip[i] >= 0:
            points[i, 0], points[i, 1] = mesh.x[a.tip[i]], mesh.y[a.tip[i]]
    return is_done, points, radius, edges


@njit(borrows=True)
def has_room(a: Axis) -> bool:
    """Whether the longest way and a fork fit in."""
    return max(a.numbers[NODES], a.numbers[PIECES], a.numbers[BRANCHES]) + 8 < a.node.shape[0]


@njit(borrows=True)
def parts_of(w: Walls, a: Axis, i: int, tolerance: float) -> tuple[int, Bisector]:
    """How many chords a piece is drawn with, and its bisector if it is an arc."""
    wall, site = a.piece[i, 2], a.piece[i, 3]
    if wall < 0:
        return 1, Bisector(BETWEEN_WALLS, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    b = bisector(w, wall, site, 0.0, 0.0, 0.0)
    # A chord over an interval d of t is d^2 / 8 c from its arc.
    chords = np.ceil(abs(a.arc[i, 1] - a.arc[i, 0]) / np.sqrt(8.0 * b.c * tolerance))
    return int(min(max(chords, 1.0), MOST_CHORDS)), b


@njit()
def drawn(w: Walls, a: Axis, tolerance: float) -> tuple[Floats, Floats, Ints]:
    """Points, radii and edges of what has been found: nodes first, then those within arcs."""
    n, m = a.numbers[NODES], 0
    more = 0
    for i in range(a.numbers[PIECES]):
        chords, _ = parts_of(w, a, i, tolerance)
        more, m = more + chords - 1, m + chords
    points, radius, edges = np.empty((n + more, 2)), np.empty(n + more), np.empty((m, 2), np.intp)
    for i in range(n):
        points[i, 0], points[i, 1], radius[i] = a.node[i, 0], a.node[i, 1], a.node[i, 2]
    m = 0
    for i in range(a.numbers[PIECES]):
        chords, b = parts_of(w, a, i, tolerance)
        last = a.piece[i, 0]
        for k in range(1, chords + 1):
            edges[m, 0], edges[m, 1] = last, a.piece[i, 1]
            if k < chords:
                t = a.arc[i, 0] + k / chords * (a.arc[i, 1] - a.arc[i, 0])
                points[n, 0], points[n, 1], radius[n] = centre(b, t)
                edges[m, 1] = last = n
                n += 1
            m += 1
    return points, radius, edges
