r"""Delaunay triangulation of vertices, one inserted after the other along their rings.

Each starts its way from a ring neighbour that is already there; edges that are no longer Delaunay
are flipped. All of a triangle lies together, in half a line of the cache, and no remainder by 3
need be taken to go around it: both took a third of the time.

half-edge e = 8 t + i    side i of triangle t, every one of which turns left
face[e]                  the vertex that side leaves
face[e + 4]              the same side seen from the other triangle; -1 where there is none
face[8 t + 3]            room for what whoever goes on with the triangles notes about each

            c                     a  b  c   a triangle
          / | \\                   d        the vertex across a-b
         /  |  \\
        a --+-- b     flip: the diagonal a-b becomes c-d
         \\  |  /
          \\ | /
            d

Source: C. L. Lawson, Software for C1 Surface Interpolation, 1977 (flips). Signs are exact.
"""

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.places import place
from midrib.kernels.predicates import in_circle, orient
from midrib.types import Floats, Ints, Places

__all__ = ["BLOCK", "FACE", "TWIN", "coarse_to_fine", "insert_all", "is_convex", "should_flip"]

FACE, TWIN = 8, 4  # places of a triangle; from the place of a half-edge to that of its twin
COARSE, BLOCK = 8, 1024  # vertices; the triangles of a block fit into the cache


@njit(borrows=True)
def after(e: int) -> int:
    """Next half-edge of the same triangle, turning left."""
    return e - 2 if e & 3 == 2 else e + 1


@njit(borrows=True)
def before(e: int) -> int:
    """Previous half-edge of the same triangle."""
    return e + 2 if e & 3 == 0 else e - 1


@njit(borrows=True)
def first_of(e: int) -> int:
    """First half-edge of the same triangle."""
    return e & -FACE


@njit(borrows=True)
def join(e: int, f: int, face: Places) -> None:
    """Make e and f two sides of one edge; f may be -1."""
    face[e + TWIN] = f
    if f >= 0:
        face[place(f) + TWIN] = e


@njit(borrows=True)
def write_triangle(e: int, a: int, b: int, p: int, face: Places, out: Places) -> None:
    """Write a b p at the three half-edges from e; remember a half-edge that leaves each."""
    face[e], face[e + 1], face[e + 2] = a, b, p
    out[a], out[b], out[p] = e, e + 1, e + 2


@njit(borrows=True)
def turn(a: int, b: int, px: float, py: float, xy: Floats) -> float:
    """``orient`` of a, b and p."""
    return orient(xy[2 * a], xy[2 * a + 1], xy[2 * b], xy[2 * b + 1], px, py)


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
        f = place(face[place(side) + TWIN])
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


@njit(inline=True, borrows=True)
def should_flip(
    ax: float, ay: float, bx: float, by: float, cx: float, cy: float, dx: float, dy: float
) -> bool:
    """Whether c-d is the better diagonal of the quadrilateral a d b c, of which a-b is an edge.

    Four vertices of one straight bank lie on a circle up to rounding. Left alone, slivers as long
    as the bank would stay, and walks through them make the whole quadratic: there a much shorter
    diagonal is taken, if it lies inside.
    """
    inside = in_circle(ax, ay, bx, by, cx, cy, dx, dy)
    if inside != 0.0:
        return inside > 0.0
    old = (ax - bx) * (ax - bx) + (ay - by) * (ay - by)
    new = (cx - dx) * (cx - dx) + (cy - dy) * (cy - dy)
    return 2.0 * new < old and is_convex(ax, ay, bx, by, cx, cy, dx, dy)


@njit(borrows=True)
def is_convex(
    ax: float, ay: float, bx: float, by: float, cx: float, cy: float, dx: float, dy: float
) -> bool:
    """Whether a and b lie strictly on either side of c-d, the diagonal across the edge a-b."""
    return orient(ax, ay, dx, dy, cx, cy) > 0.0 and orient(dx, dy, bx, by, cx, cy) > 0.0


@njit(borrows=True)
def legalise(p: int, stack: Places, size: int, xy: Floats, face: Places, out: Places) -> None:
    """Flip the edges across from the new vertex p as long as one should be; p gets each.

    p is the last corner of its triangles, all of which are on the stack, and stays it.
    """
    px, py = xy[2 * p], xy[2 * p + 1]
    while size > 0:
        size -= 1
        e = place(stack[place(size)])
        if face[e + TWIN] < 0:
            continue
        f = place(face[e + TWIN])
        f_after, f_before = after(f), before(f)
        a, b, d = place(face[e]), place(face[e + 1]), place(face[f_before])
        if should_flip(
            xy[2 * a], xy[2 * a + 1], xy[2 * b], xy[2 * b + 1], px, py, xy[2 * d], xy[2 * d + 1]
        ):
            # a b p and b a d become a d p and d b p; the side p-a stays as it is.
            second = first_of(f)
            ad, db, bp = face[f_after + TWIN], face[f_before + TWIN], face[e + 1 + TWIN]
            face[e + 1] = d
            face[second], face[second + 1], face[second + 2] = d, b, p
            out[a], out[d], out[b] = e, second, second + 1
            join(e, ad, face)
            join(second, db, face)
            join(second + 1, bp, face)
            join(e + 1, second + 2, face)
            stack[place(size)], stack[place(size + 1)] = e, second
            size += 2


@njit(inline=True, borrows=True)
def split_triangle(p: int, e: int, count: int, stack: Places, face: Places, out: Places) -> int:
    """Cut the triangle a b c of the half-edge e = a-b, in which p lies, into three at p.

    They are put on the stack: a b p, b c p and c a p.
    """
    first, third, fourth = first_of(e), FACE * count, FACE * count + FACE
    a, b, c = place(face[e]), place(face[after(e)]), place(face[before(e)])
    ab, bc, ca = face[e + TWIN], face[after(e) + TWIN], face[before(e) + TWIN]
    write_triangle(third, b, c, p, face, out)
    write_triangle(fourth, c, a, p, face, out)
    write_triangle(first, a, b, p, face, out)
    join(first, ab, face)
    join(third, bc, face)
    join(fourth, ca, face)
    join(first + 1, third + 2, face)
    join(third + 1, fourth + 2, face)
    join(fourth + 1, first + 2, face)
    stack[0], stack[1], stack[2] = first, third, fourth
    return 3


@njit(inline=True, borrows=True)
def split_edge(p: int, e: int, count: int, stack: Places, face: Places, out: Places) -> int:
    """Cut the triangles a b c and b a d on either side of e = a-b, on which p lies, at p.

    They are put on the stack: b c p, a d p, c a p and d b p.
    """
    f = place(face[e + TWIN])
    a, b, c, d = place(face[e]), place(face[f]), place(face[before(e)]), place(face[before(f)])
    bc, ca = face[after(e) + TWIN], face[before(e) + TWIN]
    ad, db = face[after(f) + TWIN], face[before(f) + TWIN]
    first, second, third, fourth = first_of(e), first_of(f), FACE * count, FACE * count + FACE
    write_triangle(first, b, c, p, face, out)
    write_triangle(third, c, a, p, face, out)
    write_triangle(second, a, d, p, face, out)
    write_triangle(fourth, d, b, p, face, out)
    join(first, bc, face)
    join(third, ca, face)
    join(second, ad, face)
    join(fourth, db, face)
    join(first + 1, third + 2, face)
    join(third + 1, second + 2, face)
    join(second + 1, fourth + 2, face)
    join(fourth + 1, first + 2, face)
    stack[0], stack[1], stack[2], stack[3] = first, second, third, fourth
    return 4


@njit(borrows=True)
def corner_at(p: int, e: int, xy: Floats, face: Places) -> int:
    """Return the corner of the triangle of e that is where p is, or p itself."""
    for v in (place(face[e]), place(face[after(e)]), place(face[before(e)])):
        if xy[2 * v] == xy[2 * p] and xy[2 * v + 1] == xy[2 * p + 1]:
            return v
    return p


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
def insert_all(n: int, xy: Floats, face: Places, out: Places, same: Ints) -> int:
    """Insert the vertices 0..n-1 into the triangle of the next three.

    Return the number of triangles, -1 on failure. ``out`` becomes a half-edge that leaves each
    vertex, ``same`` the first vertex that is there. Each starts from the nearest one before it
    along the ring that is there already.

    Each step is called in one place only, so that it becomes part of the loop: handing tables
    over took a tenth of the time.
    """
    stack = np.empty(6 * n + 16, np.uint32)
    write_triangle(0, n, n + 1, n + 2, face, out)
    face[TWIN] = face[TWIN + 1] = face[TWIN + 2] = -1
    count, near = 1, 0
    order, stride = coarse_to_fine(n)
    for p in order:
        if p > 0:
            near = out[same[p - min(p & -p, stride)]]
        e, on_edge = locate(xy[2 * p], xy[2 * p + 1], near, xy, face)
        if e < 0:
            return -1
        e, same[p] = place(e), p
        if on_edge:
            same[p] = corner_at(p, e, xy, face)
            if same[p] != p:
                continue
            size = split_edge(p, e, count, stack, face, out)
        else:
            size = split_triangle(p, e, count, stack, face, out)
        legalise(p, stack, size, xy, face, out)
        count += 2
    return count
