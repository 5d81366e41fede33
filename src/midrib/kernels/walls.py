r"""Walls: the boundary of an area as its inside sees it, one segment after the other.

Walls follow each other around the inside, which is on their left. Where rings touch, the inside
may see one loop of walls where there are two rings, and several corners where there is one point.
Vertices so near each other that rounding says where the way between them leads are one.

                  following
                  \  inside        corner of wall k: the point where it starts. If the inside
    inside         \               has more than half a turn there, it is reflex: it may be
    ----------------.              what a point of the inside is nearest to
      k
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.boxtree import DEPTH, box_tree
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh, next_boundary_side
from midrib.kernels.predicates import orient
from midrib.types import Bools, Floats, Ints

__all__ = ["CONVEX", "REFLEX", "Walls", "sharpest", "walls_of"]

CONVEX, FLAT, REFLEX = 1, 0, -1


class Walls(NamedTuple):
    """Walls of all loops, in places 0 .. n - 1; after each loop one place has its first point.

    x, y        where each starts, as lengths from the very first one
    ux, uy      direction
    vertex      of the mesh, where each starts
    following, preceding
    beside      the next wall that starts from the same point, round and round all of them
    bend        of the corner where it starts: CONVEX, FLAT or REFLEX
    loop        its loop
    first       the first wall of each loop
    is_wall     not a place after a loop
    boxes       tree of boxes over all of them
    stack       room for a search in the tree
    extent      length of the diagonal of the box around all
    """

    x: Floats
    y: Floats
    ux: Floats
    uy: Floats
    vertex: Ints
    following: Ints
    preceding: Ints
    beside: Ints
    bend: Ints
    loop: Ints
    first: Ints
    is_wall: Bools
    boxes: Floats
    stack: Ints
    extent: float


@njit()
def sides_in_loops(mesh: Mesh) -> tuple[Ints, Ints]:
    """Boundary sides, loop by loop, and where each loop starts."""
    count, loops = 0, 0
    for e in range(mesh.tri.size):
        count += mesh.twin[e] < 0
    side, starts = np.empty(count, np.intp), np.zeros(count + 1, np.intp)
    is_seen = np.zeros(mesh.tri.size, np.bool_)
    count = 0
    for first in range(mesh.tri.size):
        if mesh.twin[first] >= 0 or is_seen[first]:
            continue
        e = first
        for _ in range(side.size):
            side[count], is_seen[e] = e, True
            count += 1
            e = next_boundary_side(mesh, e)
            if e == first:
                break
        loops += 1
        starts[loops] = count
    return side, starts[: loops + 1]


@njit()
def sides_apart(
    mesh: Mesh, side: Ints, starts: Ints, scale_x: float, scale_y: float, apart: float
) -> tuple[Ints, Ints]:
    """Leave out sides that start no farther than ``apart`` from the one kept before, in its loop.

    What starts where rings touch is kept, and so is a loop of which no three sides would be left.
    """
    ways, kept, kept_starts = np.zeros(mesh.x.size, np.intp), side.copy(), starts.copy()
    for e in side:
        ways[mesh.tri[e]] += 1
    count = 0
    for ring in range(starts.size - 1):
        first = count
        for i in range(starts[ring], starts[ring + 1] + 1):
            is_closed = i == starts[ring + 1]  # the first one kept follows the last one
            v = mesh.tri[kept[first] if is_closed else side[i]]
            if count > first + is_closed:
                u = mesh.tri[kept[count - 1]]
                x, y = (mesh.x[v] - mesh.x[u]) * scale_x, (mesh.y[v] - mesh.y[u]) * scale_y
                if length(x, y) <= apart:
                    if ways[v] == 1 and not is_closed:
                        continue
                    if ways[u] == 1:
                        count -= 1
            if not is_closed:
                kept[count] = side[i]
                count += 1
        if count - first < 3:
            count = first
            for i in range(starts[ring], starts[ring + 1]):
                kept[count] = side[i]
                count += 1
        kept_starts[ring + 1] = count
    return kept[:count], kept_starts


@njit()
def walls_of(mesh: Mesh, scale_x: float, scale_y: float, apart: float) -> Walls:
    """Walls of an area; O(n).

    ``scale_x`` and ``scale_y`` are lengths of one unit of x and of y; vertices that follow each
    other no farther ``apart``, of the extent, are one.
    """
    side, starts = sides_in_loops(mesh)
    wide, high = np.ptp(mesh.x) * scale_x, np.ptp(mesh.y) * scale_y
    side, starts = sides_apart(mesh, side, starts, scale_x, scale_y, apart * length(wide, high))
    loops = starts.size - 1
    n = side.size + loops
    x, y, ux, uy = np.empty(n), np.empty(n), np.zeros(n), np.zeros(n)
    vertex, following, preceding = np.empty(n, np.intp), np.empty(n, np.intp), np.empty(n, np.intp)
    beside, loop, first = np.arange(n), np.empty(n, np.intp), np.empty(loops, np.intp)
    is_wall, bend = np.ones(n, np.bool_), np.zeros(n, np.intp)
    origin = mesh.tri[side[0]]
    for ring in range(loops):
        first[ring], last = starts[ring] + ring, starts[ring + 1] + ring - 1
        for k in range(first[ring], last + 2):
            e = side[starts[ring] if k > last else k - ring]
            vertex[k], loop[k] = mesh.tri[e], ring
            x[k] = (mesh.x[vertex[k]] - mesh.x[origin]) * scale_x
            y[k] = (mesh.y[vertex[k]] - mesh.y[origin]) * scale_y
            following[k], preceding[k] = k + 1, k - 1
        following[last], preceding[first[ring]], is_wall[last + 1] = first[ring], last, False
        for k in range(first[ring], last + 1):
            dx, dy = x[k + 1] - x[k], y[k + 1] - y[k]
            size = length(dx, dy)
            ux[k], uy[k] = dx / size, dy / size
    start_of = np.full(mesh.x.size, -1)
    for k in range(n):
        if is_wall[k]:
            a, b, c = vertex[preceding[k]], vertex[k], vertex[k + 1]
            turn = orient(mesh.x[a], mesh.y[a], mesh.x[b], mesh.y[b], mesh.x[c], mesh.y[c])
            bend[k] = CONVEX if turn > 0.0 else (REFLEX if turn < 0.0 else FLAT)
            other = start_of[b]
            if other >= 0:
                beside[k], beside[other] = beside[other], k
            start_of[b] = k
    boxes = box_tree(x, y)
    extent = length(boxes[1, 2] - boxes[1, 0], boxes[1, 3] - boxes[1, 1])
    return Walls(
        x, y, ux, uy, vertex, following, preceding, beside, bend, loop, first, is_wall,
        boxes, np.empty(DEPTH, np.intp), extent,
    )  # fmt: skip


@njit(borrows=True)
def sharpest(walls: Walls) -> int:
    """Wall that starts from the convex corner of the sharpest angle; every area has three."""
    best, at = np.inf, -1
    for k in range(walls.x.size):
        if walls.is_wall[k] and walls.bend[k] == CONVEX:
            p = walls.preceding[k]
            along = walls.ux[p] * walls.ux[k] + walls.uy[p] * walls.uy[k]
            if along < best:
                best, at = along, k
    return at
