r"""Constrained Delaunay triangulation of the inside of rings.

Vertices go in one at a time, see ``insertion``: where rings are drawn finely, beside the edges that
draw them so far. Mostly all ring segments are edges then, and what is inside is gathered at once,
see ``gathering``. If not, they go in once more, without looking for the rings. Where that does not
help, segments are forced in; then the triangles to the left of a segment are kept.

half-edge e = 3 t + i    side i of triangle t, from tri[e] to the start of the next side;
                         every triangle turns left
twin[e]                  the same side seen from the other triangle; -1 where there is none
segment[e]               the ring segment that lies on e in the direction of e; FREE where none
                         does; BLOCKED where the segment runs the other way

            c                     a  b  c   a triangle
          / | \\                   d        the vertex across a-b
         /  |  \\
        a --+-- b     flip: the diagonal a-b becomes c-d
         \\  |  /
          \\ | /
            d

Source: C. L. Lawson, Software for C1 Surface Interpolation, 1977 (flips); S. W. Sloan, A Fast
Algorithm for Generating Constrained Delaunay Triangulations, Computers & Structures 47, 1993.
Signs are exact, so every ring that is simple and touches others in points only is triangulated.
"""

import numpy as np

from midrib.kernels.gathering import gather_inside
from midrib.kernels.insertion import insert_all
from midrib.kernels.jit import njit
from midrib.kernels.places import FURTHEST, place
from midrib.kernels.predicates import orient
from midrib.kernels.stars import FACE, across, is_convex, should_flip
from midrib.kernels.tables import range_of, with_places
from midrib.types import Floats, Ints, Places

__all__ = ["triangulate_rings"]

FREE, BLOCKED = -1, -2
REACH = 2.0**16  # the outer triangle lies so many extents away; it only has to hold every vertex
DELAUNAY_PASSES = 6  # over the edges that constraints disturbed: quality, not correctness


@njit(borrows=True)
def next_side(e: int) -> int:
    """Next half-edge of the same triangle, turning left."""
    return e - 2 if e % 3 == 2 else e + 1


@njit(borrows=True)
def previous_side(e: int) -> int:
    """Previous half-edge of the same triangle."""
    return e + 2 if e % 3 == 0 else e - 1


@njit(borrows=True)
def join(e: int, f: int, twin: Places) -> None:
    """Make e and f two sides of one edge; f may be -1."""
    twin[e] = f
    if f >= 0:
        twin[f] = e


@njit(borrows=True)
def write_triangle(e: int, a: int, b: int, c: int, tri: Places, out: Places) -> None:
    """Write a b c at the three half-edges from e; remember a half-edge that leaves each."""
    tri[e], tri[e + 1], tri[e + 2] = a, b, c
    out[a], out[b], out[c] = e, e + 1, e + 2


@njit(borrows=True)
def flip(e: int, tri: Places, twin: Places, segment: Places, out: Places) -> None:
    """Replace the diagonal e = a-b by c-d; c ends at the last place of both triangles."""
    e = place(e)
    f = place(twin[e])
    e_next, e_previous = next_side(e), previous_side(e)
    f_next, f_previous = next_side(f), previous_side(f)
    on_bc, on_ca = segment[e_next], segment[e_previous]
    on_ad, on_db = segment[f_next], segment[f_previous]
    first, second = e - e % 3, f - f % 3
    flip_free(e, tri, twin, out)
    segment[first], segment[first + 1], segment[first + 2] = on_ad, FREE, on_ca
    segment[second], segment[second + 1], segment[second + 2] = on_db, on_bc, FREE


@njit(borrows=True)
def flip_free(e: int, tri: Places, twin: Places, out: Places) -> None:
    """``flip`` where no segments are, as long as only vertices go in."""
    e = place(e)
    f = place(twin[e])
    e_next, e_previous = next_side(e), previous_side(e)
    f_next, f_previous = next_side(f), previous_side(f)
    a, b, c, d = tri[e], tri[f], tri[e_previous], tri[f_previous]
    bc, ca, ad, db = twin[e_next], twin[e_previous], twin[f_next], twin[f_previous]
    first, second = e - e % 3, f - f % 3
    write_triangle(first, a, d, c, tri, out)
    write_triangle(second, d, b, c, tri, out)
    join(first, ad, twin)
    join(first + 1, second + 2, twin)
    join(first + 2, ca, twin)
    join(second, db, twin)
    join(second + 1, bc, twin)


@njit(borrows=True)
def side_around(a: int, b: int, tri: Places, twin: Places, out: Places) -> int:
    """Return the half-edge from a to b, found by turning around a, or -1."""
    start = place(out[a])
    e = start
    for _ in range(tri.size):
        if tri[next_side(e)] == b:
            return e
        f = twin[previous_side(e)]
        if f == start or f < 0:
            break
        e = place(f)
    return -1


@njit(borrows=True)
def find_side(a: int, b: int, tri: Places, twin: Places, out: Places) -> int:
    """Return the half-edge from a to b, or -1.

    Around a corner of the outer triangle the turn may end too early; then b has it.
    """
    e = side_around(a, b, tri, twin, out)
    if e >= 0:
        return e
    f = side_around(b, a, tri, twin, out)
    return twin[f] if f >= 0 else -1


@njit(borrows=True)
def mark(e: int, k: int, twin: Places, segment: Places) -> bool:
    """Lay ring segment k on half-edge e; False if another segment lies there already."""
    if segment[e] != FREE:
        return False
    segment[e] = k
    segment[twin[e]] = BLOCKED
    return True


@njit(borrows=True)
def first_crossing(
    a: int, b: int, x: Floats, y: Floats, tri: Places, twin: Places, out: Places
) -> tuple[int, int]:
    """Where the segment a-b leaves the triangles around a.

    The half-edge it crosses, or a vertex on its way (-1, vertex).
    """
    start = place(out[a])
    e = start
    for _ in range(tri.size):
        u, v = tri[next_side(e)], tri[previous_side(e)]
        side_u = orient(x[a], y[a], x[b], y[b], x[u], y[u])
        if side_u == 0.0 and (x[u] - x[a]) * (x[b] - x[a]) + (y[u] - y[a]) * (y[b] - y[a]) > 0.0:
            return -1, u
        if side_u < 0.0 and orient(x[a], y[a], x[b], y[b], x[v], y[v]) > 0.0:
            return next_side(e), -1
        f = twin[previous_side(e)]
        if f == start or f < 0:
            break
        e = place(f)
    return -1, -1


@njit(borrows=True)
def crossed_edges(
    a: int,
    b: int,
    e: int,
    crossed: Places,
    x: Floats,
    y: Floats,
    tri: Places,
    twin: Places,
    segment: Places,
) -> tuple[int, int]:
    """Collect the edges (as vertex pairs) that a-b crosses from half-edge e on.

    Return their number and -1, or the first vertex found exactly on a-b, or -2 where another
    segment is crossed.
    """
    count = 0
    for _ in range(tri.size):
        if segment[e] != FREE:
            break
        crossed[2 * count], crossed[2 * count + 1] = tri[e], tri[next_side(e)]
        count += 1
        f = twin[e]
        w = tri[previous_side(f)]
        if w == b:
            return count, -1
        side = orient(x[a], y[a], x[b], y[b], x[w], y[w])
        if side == 0.0:
            return count, w
        # f runs from left to right and w closes its triangle: the next crossing is between w and
        # whichever end of f lies across a-b from it.
        e = next_side(f) if side > 0.0 else previous_side(f)
    return count, -2


@njit(borrows=True)
def force_segment(
    a: int,
    b: int,
    crossed: Places,
    count: int,
    made: Places,
    x: Floats,
    y: Floats,
    tri: Places,
    twin: Places,
    segment: Places,
    out: Places,
) -> int:
    """Flip the ``count`` crossed edges until a-b is an edge; return how many edges were made.

    An edge whose two triangles form no convex quadrilateral waits for its neighbours. The edges
    are gone through back and forth as long as that helps: along a straight bank each waits for the
    one after it, which going one way only would make quadratic. -1 if it does not end.
    """
    n_made, forward = 0, True
    for _ in range(2 * count + 16):
        kept = 0
        for i in range(count):
            at = i if forward else count - 1 - i
            put = kept if forward else count - 1 - kept
            u, v = crossed[2 * at], crossed[2 * at + 1]
            e = find_side(u, v, tri, twin, out)
            c, d = tri[previous_side(e)], tri[previous_side(twin[e])]
            if is_convex(x[u], y[u], x[v], y[v], x[c], y[c], x[d], y[d]):
                flip(e, tri, twin, segment, out)
                ends_meet = c in (a, b) or d in (a, b)
                side_c = orient(x[a], y[a], x[b], y[b], x[c], y[c])
                side_d = orient(x[a], y[a], x[b], y[b], x[d], y[d])
                if ends_meet or (side_c > 0.0) == (side_d > 0.0):
                    made[2 * n_made], made[2 * n_made + 1] = c, d
                    n_made += 1
                    continue
                u, v = c, d
            crossed[2 * put], crossed[2 * put + 1] = u, v
            kept += 1
        if not forward:
            for i in range(kept):
                at = count - kept + i
                crossed[2 * i], crossed[2 * i + 1] = crossed[2 * at], crossed[2 * at + 1]
        forward = not forward if kept < count else True
        count = kept
        if count == 0:
            return n_made
    return -1


@njit(borrows=True)
def restore_delaunay(
    made: Places,
    n_made: int,
    x: Floats,
    y: Floats,
    tri: Places,
    twin: Places,
    segment: Places,
    out: Places,
) -> None:
    """Flip the edges that forcing a segment made, where a circle test asks for it."""
    for _ in range(DELAUNAY_PASSES):
        calm = True
        for i in range(n_made):
            e = find_side(made[2 * i], made[2 * i + 1], tri, twin, out)
            if e < 0 or segment[e] != FREE or twin[e] < 0:
                continue
            a, b, c = tri[e], tri[next_side(e)], tri[previous_side(e)]
            d = tri[previous_side(twin[e])]
            if should_flip(x[a], y[a], x[b], y[b], x[c], y[c], x[d], y[d]):
                flip(e, tri, twin, segment, out)
                made[2 * i], made[2 * i + 1] = c, d
                calm = False
        if calm:
            return


@njit()
def insert_segments(
    ring_next: Ints,
    same: Ints,
    touches: Ints,
    x: Floats,
    y: Floats,
    tri: Places,
    twin: Places,
    segment: Places,
    out: Places,
) -> int:
    """Force every ring segment k, from vertex k to ring_next[k], into the triangulation.

    ``touches[k]`` becomes a vertex that lies inside segment k, where there is one. Return 0, or
    1 + k for a segment that crosses or repeats another.
    """
    n = ring_next.size
    crossed = np.empty(2 * tri.size, np.uint32)
    made = np.empty(2 * tri.size, np.uint32)
    for k in range(n):
        a, b = same[k], same[ring_next[k]]
        e = find_side(a, b, tri, twin, out)
        if e < 0:
            start, on_way = first_crossing(a, b, x, y, tri, twin, out)
            if on_way >= 0:
                touches[k] = on_way
                continue
            if start < 0:
                return 1 + k
            count, on_way = crossed_edges(a, b, start, crossed, x, y, tri, twin, segment)
            if on_way >= 0:
                touches[k] = on_way
                continue
            if on_way == -2:
                return 1 + k
            n_made = force_segment(a, b, crossed, count, made, x, y, tri, twin, segment, out)
            if n_made < 0:
                return 1 + k
            e = find_side(a, b, tri, twin, out)
            if not mark(e, k, twin, segment):
                return 1 + k
            restore_delaunay(made, n_made, x, y, tri, twin, segment, out)
        elif not mark(e, k, twin, segment):
            return 1 + k
    return 0


@njit()
def keep_inside(
    count: int, n_segments: int, tri: Places, twin: Places, segment: Places, by_rings: bool
) -> tuple[Ints, Ints, Ints, bool]:
    """Keep the triangles that can be reached from the left of a segment without crossing one.

    Return tri and twin of the kept triangles and the half-edge of each segment; sides
    on a segment have no twin any more. And whether nothing on the right of a segment is kept, nor
    a corner of the outer triangle: then every hole is in the shell and in no other hole.
    """
    count = place(count)
    row, stack = np.full(count, -1, np.int32), np.empty(count, np.uint32)
    side_of_segment, is_one_sided = np.full(n_segments, -1, np.intp), True
    kept, size = 0, 0
    for e in range(3 * count):
        if segment[e] >= 0:
            side_of_segment[segment[e]] = e
    for t in range(0 if by_rings else count):
        e = 3 * place(t)
        if max(segment[e], segment[e + 1], segment[e + 2]) >= 0:
            row[t], stack[kept] = kept, t
            kept += 1
    for k in range(n_segments):  # in order along the rings, see ``gathering``
        e = side_of_segment[k]
        if e >= 0 and row[place(e) // 3] < 0:
            row[place(e) // 3], stack[kept] = kept, place(e) // 3
            kept += 1
    while size < kept:
        e = 3 * place(stack[size])
        size += 1
        for side in range(3):
            f = twin[e + side]
            if segment[e + side] == FREE and f >= 0:
                t = place(f) // 3
                if row[t] < 0:
                    row[t], stack[kept] = kept, t
                    kept += 1
    new_tri, new_twin = np.empty(3 * kept, np.intp), np.empty(3 * kept, np.intp)
    for i in range(kept):
        e, new = 3 * place(stack[i]), 3 * place(i)
        for side in range(3):
            new_tri[new + side] = v = tri[e + side]
            on, f = segment[e + side], twin[e + side]
            is_one_sided = is_one_sided and on != BLOCKED and v < n_segments
            if on >= 0:
                side_of_segment[on] = new + side
            is_open = on == FREE and f >= 0
            new_twin[new + side] = 3 * row[place(f) // 3] + place(f) % 3 if is_open else -1
    return new_tri, new_twin, side_of_segment, is_one_sided


@njit()
def within_triangle(x: Floats, y: Floats) -> Floats:
    """Vertices as x, y, x, y, ...; at the end those of a triangle far around them."""
    n = x.size
    xy = np.empty(2 * n + 6)
    for k in range(n):
        xy[2 * k], xy[2 * k + 1] = x[k], y[k]
    (low_x, high_x), (low_y, high_y) = range_of(x), range_of(y)
    middle_x, middle_y = (low_x + high_x) / 2.0, (low_y + high_y) / 2.0
    far = REACH * max(high_x - low_x, high_y - low_y)
    xy[2 * n], xy[2 * n + 1] = middle_x - 2.0 * far, middle_y - far
    xy[2 * n + 2], xy[2 * n + 3] = middle_x + 2.0 * far, middle_y - far
    xy[2 * n + 4], xy[2 * n + 5] = middle_x, middle_y + 2.0 * far
    return xy


@njit()
def unfold(count: int, face: Places, out: Places) -> tuple[Places, Places]:
    """Return triangles that lie together in the tables above; find ``out`` for those."""
    tri, twin = np.empty(3 * count, np.uint32), np.empty(3 * count, np.int32)
    for t in range(count):
        for side in range(3):
            f = across(FACE * t + side, face)
            v = tri[3 * t + side] = place(face[FACE * t + side])
            out[v] = 3 * t + side
            twin[3 * t + side] = 3 * (f // FACE) + f % FACE if f < FACE * count else -1
    return tri, twin


@njit()
def force_rings(
    count: int,
    x: Floats,
    y: Floats,
    xy: Floats,
    ring_next: Ints,
    same: Ints,
    touches: Ints,
    face: Places,
    out: Places,
    by_rings: bool,
) -> tuple[int, Ints, Ints, Ints, Ints, Ints, bool]:
    """Rings among vertices that are in, as ``triangulate_rings``: whatever rings they are."""
    n, nothing = x.size, np.empty(0, np.intp)
    tri, twin = unfold(count, face, out)
    segment = np.full(tri.size, FREE, np.int32)
    all_x, all_y = with_places(x, n + 3), with_places(y, n + 3)
    for k in range(n, n + 3):
        all_x[k], all_y[k] = xy[2 * k], xy[2 * k + 1]
    status = insert_segments(ring_next, same, touches, all_x, all_y, tri, twin, segment, out)
    is_touched = False
    for k in range(n):
        is_touched = is_touched or touches[k] >= 0
    if status != 0 or is_touched:
        return status, nothing, nothing, nothing, same, touches, False
    kept = keep_inside(count, n, tri, twin, segment, by_rings)
    is_valid = kept[3]
    for k in range(n):
        is_valid = is_valid and same[k] == k
    return 0, kept[0], kept[1], kept[2], same, touches, is_valid


@njit(entry=True)
def triangulate_rings(
    x: Floats, y: Floats, ring_next: Ints, by_rings: bool
) -> tuple[int, Ints, Ints, Ints, Ints, Ints, bool]:
    """Triangulate what lies to the left of the rings.

    Parameters
    ----------
    x, y : (n,) vertices of all rings, no ring closed by a repeated vertex
    ring_next : (n,) the vertex after each one, so that segment k runs from k to ring_next[k]
    by_rings : whether triangles are numbered in order along the rings, which is faster for whoever
        goes along them, or as they came

    Returns
    -------
    status : 0; 1 + k if segment k crosses or repeats another; -1 if a walk did not end
    tri, twin : (3 m,) half-edges as drawn above, of the m triangles inside
    side_of_segment : (n,) the half-edge that ring segment k lies on
    same : (n,) the first vertex with the same coordinates
    touches : (n,) a vertex that lies inside segment k, or -1. Where there is one, nothing else
        is valid: insert it into the ring and call again
    is_valid : whether the rings are those of a valid area, with none that touch. They are simple
        and apart, as each segment is a side of triangles that do not overlap, and holes are in the
        shell only. False may be valid too

    Notes
    -----
    O(n log n) expected for rings of any shape.
    """
    n = x.size
    same, touches = np.full(n, -1, np.intp), np.full(n, -1, np.intp)
    nothing = np.empty(0, np.intp)
    if FACE * (2 * n + 2) > FURTHEST:
        return -1, nothing, nothing, nothing, same, touches, False
    xy = within_triangle(x, y)
    face, out = np.empty(FACE * (2 * n + 2), np.int32), np.empty(n + 3, np.uint32)
    count = -1
    for is_first in (True, False):
        count, is_constrained = insert_all(n, xy, ring_next, is_first, face, out, same)
        if count >= 0:
            inside = gather_inside(count, ring_next, same, xy, is_constrained, face, by_rings)
            if inside.is_done:
                return 0, inside.tri, inside.twin, inside.side_of_segment, same, touches, True
        if not is_constrained:
            break
    if count < 0:
        return -1, nothing, nothing, nothing, same, touches, False
    return force_rings(count, x, y, xy, ring_next, same, touches, face, out, by_rings)
