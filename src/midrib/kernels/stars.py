r"""Triangles around a vertex that goes into a triangulation: split, flipped, and stored.

All of a triangle lies together, in half a line of the cache, and no remainder by 3 need be taken
to go around it: both took a third of the time.

half-edge e = 8 t + i    side i of triangle t, every one of which turns left
face[e]                  the vertex that side leaves
face[e + 4]              the same side seen from the other triangle; its complement, which is
                         negative, where the edge is a constraint, not to be flipped
face[8 t + 3]            room for what whoever goes on with the triangles notes about each
out[v]                   a half-edge that leaves vertex v: the same one as long as it is there

            c                     a  b  c   a triangle
          / | \\                   d        the vertex across a-b
         /  |  \\
        a --+-- b     flip: the diagonal a-b becomes c-d
         \\  |  /
          \\ | /
            d

The sides of the outermost triangle are constraints, with a triangle of nothing beyond them.
Source: C. L. Lawson, Software for C1 Surface Interpolation, 1977 (flips). Signs are exact.
"""

from midrib.kernels.jit import njit
from midrib.kernels.places import place
from midrib.kernels.predicates import in_circle, orient
from midrib.types import Floats, Places

__all__ = [
    "FACE",
    "TWIN",
    "across",
    "after",
    "before",
    "corner_at",
    "first_of",
    "is_convex",
    "join",
    "legalise",
    "should_flip",
    "side_between",
    "split_edge",
    "split_triangle",
    "turn",
    "write_triangle",
]

FACE, TWIN = 8, 4  # places of a triangle; from the place of a half-edge to that of its twin


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
    """Make e and f two sides of one edge; of a constraint where f is the complement of a side."""
    sign = f >> 31
    face[e + TWIN] = f
    face[place(f ^ sign) + TWIN] = e ^ sign


@njit(borrows=True)
def across(e: int, face: Places) -> int:
    """Return the other side of the edge of e, be it a constraint or not."""
    f = face[e + TWIN]
    return place(f ^ (f >> 31))


@njit(borrows=True)
def write_triangle(e: int, a: int, b: int, c: int, face: Places) -> None:
    """Write a b c at the three half-edges from e."""
    face[e], face[e + 1], face[e + 2] = a, b, c


@njit(borrows=True)
def move(v: int, e: int, f: int, out: Places) -> None:
    """Remember that the half-edge e, which leaves v, is at f now."""
    out[v] = f if out[v] == e else out[v]


@njit(borrows=True)
def side_between(a: int, b: int, face: Places, out: Places) -> int:
    """Return the half-edge from a to b, found by turning around a, or -1."""
    e = start = place(out[a])
    for _ in range(face.size):
        if face[after(e)] == b:
            return e
        e = across(before(e), face)
        if e == start:
            break
    return -1


@njit(borrows=True)
def turn(a: int, b: int, px: float, py: float, xy: Floats) -> float:
    """``orient`` of a, b and p."""
    return orient(xy[2 * a], xy[2 * a + 1], xy[2 * b], xy[2 * b + 1], px, py)


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
def legalise(
    p: int, stack: Places, least: int, size: int, xy: Floats, face: Places, out: Places
) -> None:
    """Flip the edges across from the new vertex p as long as one should be; p gets each.

    p is the last corner of its triangles, and stays it. Those from ``least`` to ``size`` on the
    stack are looked at. Constraints stay.
    """
    px, py = xy[2 * p], xy[2 * p + 1]
    while size > least:
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
            write_triangle(second, d, b, p, face)
            move(a, f_after, e, out)
            move(d, f_before, second, out)
            move(b, f, second + 1, out)
            move(b, e + 1, second + 1, out)
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
    e_after, e_before = after(e), before(e)
    a, b, c = place(face[e]), place(face[e_after]), place(face[e_before])
    ab, bc, ca = face[e + TWIN], face[e_after + TWIN], face[e_before + TWIN]
    write_triangle(third, b, c, p, face)
    write_triangle(fourth, c, a, p, face)
    write_triangle(first, a, b, p, face)
    move(a, e, first, out)
    move(b, e_after, third, out)
    move(c, e_before, fourth, out)
    join(first, ab, face)
    join(third, bc, face)
    join(fourth, ca, face)
    join(first + 1, third + 2, face)
    join(third + 1, fourth + 2, face)
    join(fourth + 1, first + 2, face)
    out[p] = first + 2
    stack[0], stack[1], stack[2] = first, third, fourth
    return 3


@njit(inline=True, borrows=True)
def split_edge(p: int, e: int, count: int, stack: Places, face: Places, out: Places) -> int:
    """Cut the triangles a b c and b a d on either side of e = a-b into four at p.

    p lies on e, or where all four corners are seen. They are put on the stack: a d p, d b p, b c p
    and c a p.
    """
    f = across(e, face)
    e_after, e_before, f_after, f_before = after(e), before(e), after(f), before(f)
    a, b, c, d = place(face[e]), place(face[f]), place(face[e_before]), place(face[f_before])
    bc, ca = face[e_after + TWIN], face[e_before + TWIN]
    ad, db = face[f_after + TWIN], face[f_before + TWIN]
    first, second, third, fourth = first_of(e), first_of(f), FACE * count, FACE * count + FACE
    write_triangle(first, b, c, p, face)
    write_triangle(third, c, a, p, face)
    write_triangle(second, a, d, p, face)
    write_triangle(fourth, d, b, p, face)
    move(a, f_after, second, out)
    move(a, e, third + 1, out)
    move(b, e_after, first, out)
    move(b, f, fourth + 1, out)
    move(c, e_before, third, out)
    move(d, f_before, fourth, out)
    join(first, bc, face)
    join(third, ca, face)
    join(second, ad, face)
    join(fourth, db, face)
    join(first + 1, third + 2, face)
    join(third + 1, second + 2, face)
    join(second + 1, fourth + 2, face)
    join(fourth + 1, first + 2, face)
    out[p] = first + 2
    stack[0], stack[1], stack[2], stack[3] = second, fourth, first, third
    return 4


@njit(borrows=True)
def corner_at(p: int, e: int, xy: Floats, face: Places) -> int:
    """Return the corner of the triangle of e that is where p is, or p itself."""
    for v in (place(face[e]), place(face[after(e)]), place(face[before(e)])):
        if xy[2 * v] == xy[2 * p] and xy[2 * v + 1] == xy[2 * p + 1]:
            return v
    return p
