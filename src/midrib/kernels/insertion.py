"""Delaunay triangulation of vertices, one inserted after the other along their rings.

Each starts its way from a ring neighbour that is already there; edges that are no longer Delaunay
are flipped, see ``stars``. Most need not look far, see ``constraints``.
"""

import numpy as np

from midrib.kernels.constraints import (
    COARSE,
    constrain,
    is_outline,
    locate_beside,
    ring_neighbours,
)  # fmt: skip
from midrib.kernels.jit import njit
from midrib.kernels.places import place
from midrib.kernels.stars import (
    FACE,
    TWIN,
    across,
    after,
    before,
    corner_at,
    first_of,
    join,
    legalise,
    side_between,
    split_edge,
    split_triangle,
    turn,
    write_triangle,
)  # fmt: skip
from midrib.types import Floats, Ints, Places

__all__ = ["BLOCK", "coarse_to_fine", "insert_all"]

BLOCK = 1024  # vertices; the triangles of a block fit into the cache
FEW = 64  # vertices, among which to look for the rings is not worth while


@njit(borrows=True)
def locate(px: float, py: float, e: int, xy: Floats, face: Places) -> tuple[int, bool]:
    """Return a half-edge of the triangle that holds p: the side p lies on, or the first one.

    And whether p lies on it.

    The walk leaves each triangle through a side that has p beyond it; the caller starts it near
    p. Which side is tried first is drawn anew in every triangle: in a fixed order the walk can
    go round in circles where flat triangles are Delaunay only up to rounding.
    Source: O. Devillers, S. Pion, M. Teillaud, Walking in a Triangulation, 2002.
    """
    e = first_of(place(e))
    a, b, c = place(face[e]), place(face[e + 1]), place(face[e + 2])
    side, on = -1, -1
    for k in range(3):
        by = turn(a, b, px, py, xy)
        if by < 0.0:
            side = e + k
            break
        if by == 0.0:
            on = e + k
        a, b, c = b, c, a
    draw = 1
    for _ in range(face.size):
        if side < 0:
            return (on, True) if on >= 0 else (e, False)
        # Through the side b-a into the triangle a b c: is p beyond b-c, or beyond c-a?
        f = across(place(side), face)
        e, a, b, c = first_of(f), b, a, place(face[before(f)])
        side, on = -1, -1
        draw = (draw * 1103515245 + 12345) & 0x7FFFFFFF
        for k in range(2):
            is_last = (draw >> 16 & 1) == k
            u, v = (c, a) if is_last else (b, c)
            at = before(f) if is_last else after(f)
            by = turn(u, v, px, py, xy)
            if by < 0.0:
                side, a, b = at, u, v
                break
            if by == 0.0:
                on = at
    return -1, False


@njit()
def coarse_to_fine(n: int) -> tuple[Ints, int]:
    """Order in which to insert the vertices 0..n-1, and the stride of the first ones.

    Every 2^k-th vertex comes before those between: in plain order a bend of growing curvature
    makes every new vertex flip all the old ones. The last few halvings are done block by block,
    so that the triangles there stay in the cache: a sixth of the time for 100,000 vertices.
    """
    order, count, stride = np.empty(n, np.intp), 0, 1
    while stride * 4 < n:
        stride *= 2
    for p in range(0, n, stride):
        order[count] = p
        count += 1
    for size, most, least in ((n, stride // 2, COARSE), (BLOCK, COARSE // 2, 1)):
        for start in range(0, n, size):
            step = min(most, stride // 2)
            while step >= least:
                for p in range(start + step, min(start + size, n), 2 * step):
                    order[count] = p
                    count += 1
                step //= 2
    return order, stride


@njit()
def insert_all(
    n: int, xy: Floats, ring_next: Ints, may_constrain: bool, face: Places, out: Places, same: Ints
) -> tuple[int, bool]:
    """Insert the vertices 0..n-1 into the triangle of the next three.

    Return the number of triangles, -1 on failure, and whether there are constraints: then triangles
    outside of the rings are not Delaunay, and failure means no more than to try without.
    ``out`` becomes a half-edge that leaves each vertex, ``same`` the first vertex that is there.
    Each starts from the nearest one before it along the ring that is there already.

    Each step is called in one place only, so that it becomes part of the loop: handing tables
    over took a tenth of the time.
    """
    stack = np.empty(6 * n + 16, np.uint32)
    write_triangle(0, n, n + 1, n + 2, face)
    out[n], out[n + 1], out[n + 2] = 0, 1, 2
    face[TWIN] = face[TWIN + 1] = face[TWIN + 2] = ~(face.size - FACE)
    count, near, is_constrained = 1, 0, False
    order, stride = coarse_to_fine(n)
    n_coarse = (n + COARSE - 1) // COARSE
    for k in range(n):
        same[k] = -1
    for k in range(n):
        if k == n_coarse and n > FEW and may_constrain:
            is_constrained = is_outline(ring_next, same, xy, face, out)
        p = order[k]
        px, py, step = xy[2 * p], xy[2 * p + 1], min(p & -p, stride)
        a = b = e = -1
        on_edge, least, most = False, 0, 0
        if is_constrained:
            a, b = ring_neighbours(p, step, ring_next, same)
            e = side_between(a, b, face, out) if a >= 0 else -1
            if e >= 0:
                join(e, across(e, face), face)
                e, on_edge, least, most = locate_beside(e, px, py, xy, face)
        is_beside = e >= 0
        if not is_beside:
            near = out[same[p - step]] if p > 0 else 0
            e, on_edge = locate(px, py, near, xy, face)
            if e < 0:
                return -1, is_constrained
            same[p] = corner_at(p, place(e), xy, face) if on_edge else p
            if same[p] != p:
                continue
        same[p] = p
        if on_edge:
            size = split_edge(p, place(e), count, stack, face, out)
        else:
            size = split_triangle(p, place(e), count, stack, face, out)
        count += 2
        if is_beside:
            size = most
            to_b, to_p = place(stack[least]) + 2, place(stack[most - 1]) + 1
            constrain(p, a, to_b, to_p, face, out)
        legalise(p, stack, least, size, xy, face, out)
        if a >= 0 and not is_beside:
            to_b, to_p = side_between(p, b, face, out), side_between(a, p, face, out)
            if to_b >= 0 and to_p >= 0:
                constrain(p, a, to_b, to_p, face, out)
            elif step == 1:  # a segment would have to be forced
                return -1, is_constrained
    return count, is_constrained
