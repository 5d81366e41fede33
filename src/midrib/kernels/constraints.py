r"""Rings as the vertices that are in draw them: constraints, which keep inside from outside.

Half of the triangles of a triangulation are outside, where nobody asks whether they are Delaunay.
Where coarse vertices draw the rings well, each further vertex goes in beside a side a-b of such a
drawing. Then a-p and p-b are constraints instead, and only edges on the left of them are flipped:
a triangulation takes 0.7 to 0.97 of the time.

          c                     c
        /   \\                 /   \\   d
       a --- b               / p   \\
        \\ p /               a ----- b         p may be on either side of a-b, and beyond
          d                                   one more side of its triangle

What comes of it is held against the definition, see ``gathering``: where vertices go in far from
their neighbours, they may have done so among triangles that were not Delaunay.
"""

from midrib.kernels.jit import njit
from midrib.kernels.places import place
from midrib.kernels.stars import TWIN, across, after, before, join, side_between, turn
from midrib.types import Floats, Ints, Places

__all__ = ["COARSE", "constrain", "is_outline", "locate_beside", "ring_neighbours"]

COARSE = 8  # every 8th vertex is to draw the rings
MISSING = 1.0 / 16.0  # of the sides of that drawing that may not be edges
STRAIGHT = 2.0**-20  # of its size, a determinant that may be but rounding


@njit(borrows=True)
def ring_neighbours(p: int, step: int, ring_next: Ints, same: Ints) -> tuple[int, int]:
    """Return the vertices ``step`` before p and after it on its ring; -1, -1 if one is not in."""
    a = b = p - step
    if a < 0:
        return -1, -1
    for _ in range(step):
        b = ring_next[b]
    if b != p:
        return -1, -1
    for _ in range(step):
        b = ring_next[b]
        if b < p:
            break
    return (same[a], same[b]) if same[b] >= 0 else (-1, -1)


@njit(borrows=True)
def is_outline(ring_next: Ints, same: Ints, xy: Floats, face: Places, out: Places) -> bool:
    """Whether the coarse vertices draw rings mostly of sides, no two of which are straight on."""
    missing = 0
    for p in range(0, ring_next.size, COARSE):
        a, b = ring_neighbours(p, COARSE, ring_next, same)
        if a >= 0 and a != b:
            ux, uy = xy[2 * p] - xy[2 * a], xy[2 * p + 1] - xy[2 * a + 1]
            vx, vy = xy[2 * b] - xy[2 * p], xy[2 * b + 1] - xy[2 * p + 1]
            if abs(ux * vy - uy * vx) <= STRAIGHT * (abs(ux * vy) + abs(uy * vx)):
                return False
            missing += side_between(a, same[p], face, out) < 0
    return missing * COARSE <= MISSING * ring_next.size


@njit(borrows=True)
def constrain(p: int, a: int, to_b: int, to_p: int, face: Places, out: Places) -> None:
    """Make constraints of the half-edges from p to b and from a to p, to be found at once then."""
    join(to_b, ~across(to_b, face), face)
    join(to_p, ~across(to_p, face), face)
    out[p], out[a] = to_b, to_p


@njit(borrows=True)
def locate_beside(
    e: int, px: float, py: float, xy: Floats, face: Places
) -> tuple[int, bool, int, int]:
    """Find p in a triangle of the edge e = a-b, or beyond one more side of it.

    Return what to split: a half-edge, and whether its edge or its triangle; and which of the
    triangles that are put on the stack then are on the left of a-p-b: from the third number to
    the fourth. -1 if p is further away.
    """
    nowhere = (-1, False, 0, 0)
    f = across(e, face)
    a, b = place(face[e]), place(face[f])
    by = turn(a, b, px, py, xy)
    if by == 0.0:
        ax, ay, bx, by = xy[2 * a], xy[2 * a + 1], xy[2 * b], xy[2 * b + 1]
        is_between = (px - ax) * (px - bx) + (py - ay) * (py - by) < 0.0
        return (f, True, 0, 2) if is_between else nowhere
    is_left = by > 0.0  # else e is b-a from here on, and a is called b
    e = e if is_left else f
    a, b, c = place(face[e]), place(face[after(e)]), place(face[before(e)])
    bc, ca = turn(b, c, px, py, xy), turn(c, a, px, py, xy)
    if bc > 0.0 and ca > 0.0:
        return (e, False, 1, 3) if is_left else (e, False, 0, 1)
    if bc <= 0.0 and ca <= 0.0:
        return nowhere
    g = before(e) if bc > 0.0 else after(e)
    u, v = (c, a) if bc > 0.0 else (b, c)
    d = place(face[before(across(g, face))])  # a b c and v u d are split at p, which sees both
    if face[g + TWIN] < 0 or turn(u, d, px, py, xy) <= 0.0 or turn(d, v, px, py, xy) <= 0.0:
        return nowhere
    if bc > 0.0:
        return (across(g, face), True, 1, 4) if is_left else (across(g, face), True, 0, 1)
    return (g, True, 0, 3) if is_left else (g, True, 3, 4)
