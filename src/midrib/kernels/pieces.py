"""Pieces of a medial axis: what has been found of it, and how it is drawn with chords.

A *piece* joins two nodes, straight or along an arc. Nodes of which a cut says that they are one
become one; the *chief* of a node is the one that stands for it.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.bisectors import BETWEEN_WALLS, PARABOLA, Bisector, bisector, centre
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh
from midrib.kernels.walls import Walls
from midrib.types import Floats, Ints

__all__ = [
    "NODES",
    "PIECES",
    "Pieces",
    "chief_of",
    "drawn",
    "join_at_cuts",
    "no_pieces",
    "put_node",
    "put_piece",
    "put_tip",
    "unite",
]

MOST_CHORDS = 10_000.0  # of an arc


class Pieces(NamedTuple):
    """What has been found: ``numbers`` of nodes and of pieces.

    node        (., 3) x, y, radius
    tip         vertex of the mesh that a node is at, or -1
    chief       the same node, or a chief of it
    piece       (., 5) its nodes, -1 where it is no more; the two sites that it is between, for an
                arc the wall first; and its kind
    arc         (., 2) where an arc starts and ends, as t of the bisector with the wall on the left
    """

    node: Floats
    tip: Ints
    chief: Ints
    piece: Ints
    arc: Floats
    numbers: Ints


NODES, PIECES = 0, 1


@njit()
def no_pieces(room: int) -> Pieces:
    """Room for so many nodes and pieces."""
    return Pieces(
        np.empty((room, 3)), np.empty(room, np.intp), np.arange(room), np.empty((room, 5), np.intp),
        np.empty((room, 2)), np.zeros(2, np.intp),
    )  # fmt: skip


@njit(borrows=True)
def put_node(a: Pieces, x: float, y: float, radius: float, last: int, same: float) -> int:
    """Return the node at a place: the last one if that is there, else a new one."""
    if last >= 0 and length(a.node[last, 0] - x, a.node[last, 1] - y) <= same:
        return last
    i = a.numbers[NODES]
    a.node[i, 0], a.node[i, 1], a.node[i, 2], a.tip[i] = x, y, radius, -1
    a.numbers[NODES] = i + 1
    return i


@njit(borrows=True)
def put_tip(a: Pieces, w: Walls, wall: int) -> int:
    """Return a new node, at the convex corner where a wall starts."""
    i = put_node(a, w.x[wall], w.y[wall], 0.0, -1, 0.0)
    a.tip[i] = w.vertex[wall]
    return i


@njit(borrows=True)
def chief_of(a: Pieces, node: int) -> int:
    """Return the node that stands for one, and shorten the way to it."""
    while a.chief[node] != node:
        a.chief[node] = a.chief[a.chief[node]]
        node = a.chief[node]
    return node


@njit(borrows=True)
def unite(a: Pieces, node: int, other: int) -> None:
    """Make two nodes one."""
    a.chief[chief_of(a, node)] = chief_of(a, other)


@njit(borrows=True)
def put_piece(a: Pieces, b: Bisector, sites: tuple[int, int], ends: tuple[int, int],
              stop: float) -> None:  # fmt: skip
    """Join two nodes along the bisector of the walls or corners on the left and right."""
    if ends[0] == ends[1]:
        return
    i = a.numbers[PIECES]
    left, right = sites
    if right < left:  # a wall comes before a corner
        left, right = right, left
    a.piece[i, 0], a.piece[i, 1], a.piece[i, 4] = ends[0], ends[1], b.kind
    a.piece[i, 2], a.piece[i, 3] = left, right
    a.arc[i, 0], a.arc[i, 1] = -b.g * b.t, -b.g * stop  # seen with the wall on the left
    a.numbers[PIECES] = i + 1


@njit()
def join_at_cuts(a: Pieces, cuts: int) -> None:
    """Make one piece of the two that end in a cut, if they are between the same sites.

    Nodes of cuts are the first ones; both pieces lead to it.
    """
    first = np.full(cuts, -1)
    for i in range(a.numbers[PIECES]):
        cut = a.piece[i, 1]
        if cut >= cuts:
            continue
        k = first[cut]
        if k < 0:
            first[cut] = i
        elif a.piece[i, 2] == a.piece[k, 2] and a.piece[i, 3] == a.piece[k, 3]:
            a.piece[k, 1], a.arc[k, 1] = a.piece[i, 0], a.arc[i, 0]
            a.piece[i, 0] = a.chief[cut] = -1


@njit(borrows=True)
def chords_of(w: Walls, a: Pieces, i: int, tolerance: float) -> tuple[int, Bisector]:
    """How many chords a piece is drawn with, if it is still one; its bisector if it is an arc."""
    if a.piece[i, 0] < 0 or a.piece[i, 4] != PARABOLA:
        chords = 0 if a.piece[i, 0] < 0 else 1
        return chords, Bisector(BETWEEN_WALLS, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    b = bisector(w, a.piece[i, 2], a.piece[i, 3], 0.0, 0.0)
    # A chord over an interval d of t is d^2 / 8 c from its arc.
    chords = np.ceil(abs(a.arc[i, 1] - a.arc[i, 0]) / np.sqrt(8.0 * b.c * tolerance))
    return int(min(max(chords, 1.0), MOST_CHORDS)), b


@njit()
def drawn(
    mesh: Mesh, w: Walls, a: Pieces, tolerance: float, scale_x: float, scale_y: float
) -> tuple[Floats, Floats, Ints]:
    """Points, radii and edges of what has been found: nodes first, then those within arcs."""
    row, n, m = np.empty(a.numbers[NODES], np.intp), 0, 0
    for i in range(a.numbers[NODES]):
        row[i] = n
        n += a.chief[i] == i
    nodes = n
    for i in range(a.numbers[PIECES]):
        chords, _ = chords_of(w, a, i, tolerance)
        n, m = n + max(chords - 1, 0), m + chords
    points, radius, edges = np.empty((n, 2)), np.empty(n), np.empty((m, 2), np.intp)
    for i in range(a.numbers[NODES]):
        if a.chief[i] == i:
            k = row[i]
            points[k, 0], points[k, 1], radius[k] = a.node[i, 0], a.node[i, 1], a.node[i, 2]
    n, m = nodes, 0
    for i in range(a.numbers[PIECES]):
        chords, b = chords_of(w, a, i, tolerance)
        if chords == 0:
            continue
        last, stop = row[chief_of(a, a.piece[i, 0])], row[chief_of(a, a.piece[i, 1])]
        for k in range(1, chords + 1):
            edges[m, 0], edges[m, 1] = last, stop
            if k < chords:
                t = a.arc[i, 0] + k / chords * (a.arc[i, 1] - a.arc[i, 0])
                points[n, 0], points[n, 1], radius[n] = centre(b, t)
                edges[m, 1] = last = n
                n += 1
            m += 1
    for i in range(n):
        points[i, 0] = mesh.x[w.vertex[0]] + points[i, 0] / scale_x
        points[i, 1] = mesh.y[w.vertex[0]] + points[i, 1] / scale_y
    for i in range(a.numbers[NODES]):
        if a.tip[i] >= 0 and a.chief[i] == i:
            points[row[i], 0], points[row[i], 1] = mesh.x[a.tip[i]], mesh.y[a.tip[i]]
    return points, radius, edges
